#include "errors/input_error.hpp"
#include "languages/named_languages.hpp"
#include "targets.hpp"

namespace demecal::fuzz {
namespace {

Chain six_joints() {
  Chain arm;
  for (int i = 0; i < 6; ++i) {
    Joint joint;
    joint.a_m = 0.1 + 0.1 * i;
    joint.d_m = 0.2;
    joint.alpha_rad = i % 2 == 0 ? 1.5 : 0.0;
    arm.joints.push_back(joint);
  }
  return arm;
}

Target target_of(WrittenIn language, std::vector<std::string> seeds) {
  return {"program_" + to_string(language), std::move(seeds), [language](std::string_view bytes) {
            static const Chain arm = six_joints();
            try {
              const Program program = read_program(language, bytes, "program", arm);
              demand(program.language == to_string(language), "a program keeps its language");
            } catch (const InputError&) {
            }
          }};
}

}  // namespace

std::vector<Target> program_targets() {
  return {
      target_of(WrittenIn::val2, {".PROGRAM one()\n MOVE #p[1]\n.END\n.LOCATIONS\n#p[1] 10.5 -20 30 0 45 -5\n"
                                  "t 1 0 0 0 1 0 0 0 1 10240 -320 16\n.END\n",
                                  ".PROGRAM one()\n TOOL t\n BASE 100,,-50,30\n.END\n.LOCATIONS\n"
                                  "t 1 0 0 0 1 0 0 0 1 0 0 150\np 1 0 0 0 1 0 0 0 1 10 20 30\n.END\n"}),
      target_of(WrittenIn::csv, {"q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,payload_kg\n1,2,3,4,5,6,0.5\n",
                                 "x_mm;y_mm;z_mm;qw;qx;qy;qz\r\n100;200;-300;1;0;0;0\r\n"}),
      target_of(WrittenIn::krl,
                {"DEF one()\nDECL E6POS XP1={X 100.0,Y -20,Z 3e2,A 0,B 90,C 1.5,S 2,T 10}\n"
                 "PTP {E6AXIS: A1 10, A2 -20, A3 30, A4 0, A5 45, A6 5}\nLIN XP1 C_DIS ; a comment\nEND\n",
                 "BASE_DATA[2]={X 1,Y 2,Z 3,A 4,B 5,C 6}\n$TOOL={X 1,Y 2,Z 3,A 4,B 5,C 6}\n$BASE=BASE_DATA[2]\n"
                 "BAS(#TOOL,0)\nDECL FDAT FP1={TOOL_NO 1,BASE_NO 2}\nFDAT_ACT=FP1\nLIN {X 1,Y 2,Z 3,A 4,B 5,C 6}\n"}),
      target_of(
          WrittenIn::rapid,
          {"MODULE m\nCONST robtarget p:=[[100,200,300],[1,0,0,0],[0,-1,0,1],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
           "VAR jointtarget j:=[[1,2,3,4,5,6],[9E9,9E9,9E9,9E9,9E9,9E9]];\nPROC main()\n MoveJ p,v100,z10,tool0;\n"
           "ENDPROC\nENDMODULE\n",
           "PERS tooldata g:=[TRUE,[[0,0,150],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n"
           "PERS wobjdata w:=[FALSE,TRUE,\"\",[[500,0,0],[1,0,0,0]],[[0,0,10],[1,0,0,0]]];\n"
           "MoveL [[1,2,3],[1,0,0,0],[0,0,0,0],[0,0,0,0,0,0]],v100,fine,g\\WObj:=w;\n"}),
      target_of(WrittenIn::urscript,
                {"def one():\n  q = [0.1, -1.2, 1.3, 0, 1.57, d2r(20)]\n  movej(q, a=1.4, v=1.05)\n"
                 "  movel(p[0.1, -0.2, 0.3, 0, 3.14, 0], 1.2, 0.25)\n  "
                 "movej(get_inverse_kin(p[0.1,0.2,0.3,0,0,1]))\nend\n"})};
}

}  // namespace demecal::fuzz
