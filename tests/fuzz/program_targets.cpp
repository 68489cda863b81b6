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
      target_of(
          WrittenIn::krl,
          {"DEF one()\nDECL E6POS XP1={X 100.0,Y -20,Z 3e2,A 0,B 90,C 1.5,S 2,T 10}\n"
           "PTP {E6AXIS: A1 10, A2 -20, A3 30, A4 0, A5 45, A6 5}\nLIN XP1 C_DIS ; a comment\nEND\n",
           "$TECH[1].MODE=#CYCLE\nRET=RSI_ON(#RELATIVE)\n$ORI_TYPE=#CONSTANT\nCIRC {X 1,Y 2,Z 3,A 4,B 5,C 6},{X 2,Y "
           "2,Z 3,A 4,B 5,C 6},CA 360\n",
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
                 "movej(get_inverse_kin(p[0.1,0.2,0.3,0,0,1]))\nend\n"}),
      target_of(
          WrittenIn::fanuc_ls,
          {"/PROG  A\n/MN\n   1:J P[1] 100% FINE    ;\n   2:C P[2:up]    \n    :  P[3] 100mm/sec FINE INC ;\n/POS\n"
           "P[1:\"home\"]{\n   GP1:\n\tUF : 0, UT : 2,\tCONFIG : 'N U T, 0, 0, 0',\n\tX = 1.5 mm,\tY = -.5 mm,\tZ = 3 "
           "mm,\n\tW = 4 deg,\tP = 5 deg,\tR = 6 deg,\n\tE1= 7 mm\n};\n/END\n",
           "/POS\nP[2]{\n   GP1:\n\tUF : F, UT : 0,\n\tJ1= ***** deg,\tJ2= 2 deg,\tJ3= 3 deg,\n\tJ4= 4 deg,\tJ5= 5 "
           "deg,\tJ6= 6 deg\n   GP2:\n\tJ1= 1 mm\n};\n/END\n",
           "/MN\n 1:  Track TAST[1] ;\n 2:L P[1] 9mm/sec FINE COORD ;\n 3:  Track End ;\n 4:  IF R[1]=1,JMP LBL[2] ;\n "
           "5:  "
           "Independent GP \n  :  GP1:S P[1] 9mm/sec FINE\n  :  GP2:J P[2] 9% FINE ;\n 6:  PR[1]=P[1]-P[2] ;\n 7:  "
           "LBL[2] "
           ";\n/POS\nP[1]{\n UF : 0, UT : 0,\n X = 1 mm, Y = 2 mm, Z = 3 mm, W = 4 deg, P = 5 deg, R = 6 "
           "deg\n};\n/END\n"}),
      target_of(
          WrittenIn::yaskawa_jbi,
          {"/JOB\n//POS\n///TOOL 1\n///POSTYPE PULSE\n///PULSE\nC00000=1,2,3,4,5,6\nBC00000=9\n///USER 2\n///POSTYPE "
           "USER\n///RECTAN\n///RCONF 1,0,0\nC00001=1.5,2,3,4,5,6\n//INST\nNOP\nMOVL C00001 V=50.0\nEND\n",
           "//POS\n///POSTYPE ROBOT\n///RECTAN\nP002=1,2,3,4,5,6\n//INST\nSFTON P2\nMOVJ P00002\nSFTOF\nSMOVL "
           "C1\nCOMARCON\n"
           "MOVL P002\nCOMARCOF\nCALL JOB:A\n"}),
      target_of(
          WrittenIn::kawasaki_as,
          {".SYSDATA\nBASE 0 0 1 0 0 0\n.END\n.PROGRAM a()\n 10 TOOL t\n BASE NULL\n LMOVE f+p\n.END\n.TRANS\nt 0 0 "
           "150 0 0 0\np[1] 10, 20, 30, 1, 2, 3, 99\n.END\n.JOINTS\n#h 1 2 3 4 5 6\n.END\n",
           ".PROGRAM a()\n CVLMOVE p,1\n x = DX(p)\n PRINT \"p\n ALTER ON\n POINT q = TRANS(1,2,3,4,5,6)\n JMOVE "
           "#PPOINT(1,2,3,4,5,6) ; x\n LMOVE SHIFT(p BY "
           "0,0,-5)\n LEFTY\n.END\n"}),
      target_of(
          WrittenIn::val3,
          {"<?xml version=\"1.0\"?>\n<Datas><Data name=\"f\" type=\"frame\"><Value key=\"0\" x=\"500\"/></Data>\n<Data "
           "name='p' type='pointRx'><Value key='1' x='1' y='2' z='3' rx='4' ry='5' rz='6' "
           "fatherId='f[0]'/></Data></Datas>\n",
           "<Data name=\"j\" type=\"jointRx\"><Value j1=\"1\" j2=\"2\" j3=\"3\" j4=\"4\" j5=\"5\" j6=\"6\"/></Data>"
           "<!-- --><![CDATA[ < ]]>",
           "<Data name=\"p\" type=\"pointRx\"><Value x=\"1\" y=\"2\" z=\"3\" rx=\"4\" ry=\"5\" rz=\"6\"/></Data>"
           "<Program name=\"a\"><Local name=\"l\"/><Code><![CDATA[begin\n movec(p,l,t[n],m)\n "
           "p.trf.x=f(g(p[1]))\nend]]>"
           "</Code></Program>"})};
}

}  // namespace demecal::fuzz
