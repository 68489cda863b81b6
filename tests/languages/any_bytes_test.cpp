// Readers end with a program or with a sentence, whatever bytes they are given.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "errors/input_error.hpp"
#include "kinematics/forward.hpp"
#include "languages/written_program.hpp"
#include "parsed_programs/payload_flow.hpp"

namespace demecal {
namespace {

constexpr std::string_view kTelling = "[]{}(),;:=\"'!#.$&\n\r\t p1-eE";

/// The text with a few bytes changed, taken out, doubled, or cut off.
std::string disturbed(RandomStream& stream, std::string text) {
  const std::size_t changes = 1 + stream.index(4);
  for (std::size_t i = 0; i < changes && !text.empty(); ++i) {
    const std::size_t at = stream.index(text.size());
    switch (stream.index(5)) {
      case 0:
        text[at] = kTelling[stream.index(kTelling.size())];
        break;
      case 1:
        text.erase(at, 1 + stream.index(6));
        break;
      case 2:
        text.insert(at, text.substr(at, stream.index(30)));
        break;
      case 3:
        text[at] = static_cast<char>(stream.index(256));
        break;
      default:
        text.resize(at);
    }
  }
  return text;
}

/// Every number lies inside the text, and none overlaps another.
void expect_sound(const Program& program, const std::string& text) {
  std::vector<std::pair<std::size_t, std::size_t>> spans;
  for (const Target& target : program.targets) {
    for (const auto* cells : {&target.joints, &target.position, &target.orientation}) {
      for (const Cell& cell : *cells) spans.emplace_back(cell.begin, cell.begin + cell.size);
    }
  }
  std::sort(spans.begin(), spans.end());
  std::size_t last = 0;
  for (const auto& [begin, end] : spans) {
    EXPECT_GE(begin, last);
    EXPECT_LT(begin, end);
    last = end;
  }
  EXPECT_LE(last, text.size());
}

TEST(Readers, EndWithAProgramOrASentence) {
  RandomStream stream{7401};
  const Chain arm = wrist_arm();
  int read = 0, refused = 0;
  for (int repetition = 0; repetition < 400; ++repetition) {
    for (const WrittenIn language : kLanguages) {
      const bool of_poses = stream.chance(0.5) || !has_joint_targets(language);
      const auto line = [&](int index) {
        const JointVector joints = random_joints(stream, arm);
        return of_poses ? pose_line(language, forward(arm, joints), joints, index, 3)
                        : joints_line(language, joints, index, 3);
      };
      const std::string text = disturbed(stream, written(language, of_poses, 2, line, "\n"));
      try {
        expect_sound(read_program(language, text, "p", arm), text);
        ++read;
      } catch (const InputError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(read, 200);
  EXPECT_GT(refused, 200);
}

/// Programs that state tools, frames and configurations in every way that is read.
const std::vector<std::pair<WrittenIn, std::string>>& stating_programs() {
  static const std::vector<std::pair<WrittenIn, std::string>> programs{
      {WrittenIn::val2,
       ".PROGRAM a\n 10 TOOL t\n BASE 100,,-50,30\n MOVE p\n.END\n.LOCATIONS\n"
       "t 1 0 0 0 1 0 0 0 1 0 0 150\np 1 0 0 0 1 0 0 0 1 10 20 30\n.END\n"},
      {WrittenIn::krl,
       "&ACCESS RVP\nDEF a()\nTOOL_DATA[1]={X 1,Y 2,Z 3,A 4,B 5,C 6}\nBASE_DATA[2]={X 1,Y 2,Z 3,A 4,B 5,C 6}\n"
       "DECL FDAT FP1={TOOL_NO 1,BASE_NO 2,IPO_FRAME #BASE,POINT2[] \" \"}\nFDAT_ACT=FP1\nBAS(#TOOL,1)\n"
       "$BASE=BASE_DATA[2]\n$TOOL={X 1,Y 2,Z 3,A 4,B 5,C 6}\n$BASE.X=3\n$TOOL=$NULLFRAME\n"
       "DECL E6POS XP1={X 10,Y 0,Z 0,A 0,B 0,C 0,S 2,T 2}\nLIN XP1 C_DIS\nPTP {E6POS: X 1,Y 2,Z 3,A 4,B 5,C 6}\nEND\n"},
      {WrittenIn::rapid,
       "MODULE m\nPERS tooldata g:=[TRUE,[[0,0,150],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n"
       "PERS wobjdata w:=[FALSE,TRUE,\"\",[[500,0,0],[1,0,0,0]],[[0,0,10],[1,0,0,0]]];\nw.uframe:=f;\n"
       "CONST robtarget p{1}:=[[[100,200,300],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]];\n"
       "MoveC p{1},Offs(p{1},0,0,5),v100,fine,g\\WObj:=w;\nMoveJ p{1},v9,fine,tool0;\nENDMODULE\n"},
      {WrittenIn::urscript,
       "def a():\n t=p[0,0,0.3,0,0,0]\n q=p[0.1,0.2,0.3,0,0,0]\n set_tcp(t)\n movej(get_inverse_kin(q, "
       "qnear=[0,0,0,0,0,0]))\n"
       " set_tcp(p[0,0,0,0,0,0])\n movel(q)\nend\n"},
      {WrittenIn::fanuc_ls,
       "/PROG  A\n/MN\n   1:  UFRAME_NUM=2 ;\n   2:J P[1] 100% FINE    ;\n   3:C P[2:up]    \n    :  P[3] 100mm/sec "
       "FINE ;\n"
       "   4:L P[R[1]] 100mm/sec FINE Offset,PR[2] ;\n/POS\nP[1:\"home\"]{\n   GP1:\n\tUF : F, UT : 2,\tCONFIG : 'N U "
       "T, 0, "
       "0, 0',\n\tX = 1.5 mm,\tY = -.5 mm,\tZ = 3 mm,\n\tW = 4 deg,\tP = 5 deg,\tR = 6 deg,\n\tE1= 7 mm\n};\n"
       "P[2]{\n   GP1:\n\tUF : 0, UT : 0,\n\tJ1= ******** deg,\tJ2= 2 deg,\tJ3= 3 deg,\n\tJ4= 4 deg,\tJ5= 5 deg,\tJ6= "
       "6 "
       "deg\n};\n/END\n"},
      {WrittenIn::yaskawa_jbi,
       "/JOB\n//NAME A\n//POS\n///NPOS 3,1,0,1,0,0\n///TOOL 1\n///POSTYPE "
       "PULSE\n///PULSE\nC00000=1,2,3,4,5,6\nBC00000=9\n"
       "///USER 2\n///POSTYPE USER\n///RECTAN\n///RCONF 1,0,0,0,0,0,0,0\nC00001=1.5,2,3,4,5,6\nP00002=1,2,3,4,5,6,7\n"
       "//INST\n///GROUP1 RB1\nNOP\nSFTON P002 UF#(1)\nMOVL C00001 V=50.0\nSFTOF\nSMOVL C1 +MOVJ EC00000\nEND\n"},
      {WrittenIn::kawasaki_as,
       ".SYSDATA\nBASE 0 0 1 0 0 0\nTOOL 1 2 3 4 5 6\n.END\n.PROGRAM a()\n 10 TOOL t\n BASE NULL\n LMOVE f+p\n"
       " POINT q = TRANS(1,2,3,4,5,6)\n JMOVE #PPOINT(1,2,3,4,5,6)\n LMOVE SHIFT(p BY 0,0,-5)\n LEFTY\n.END\n"
       ".TRANS\nt 0 0 150 0 0 0\np[1] 10, 20, 30, 1, 2, 3, 99\n.END\n.JOINTS\n#h 1 2 3 4 5 6\n.END\n"},
      {WrittenIn::val3,
       "<?xml version=\"1.0\"?>\n<Database><Datas><Data name=\"f\" type=\"frame\"><Value key=\"0\" x=\"500\" "
       "fatherId=\"world[0]\"/></Data>\n<Data name='p' type='pointRx'><Value key='1' x='1' y='2' z='3' rx='4' ry='5' "
       "rz='6' "
       "shoulder='lefty' elbow='epositive' wrist='wpositive' fatherId='f[0]'/><Value key='2' x='1' "
       "fatherId='p'/></Data>\n"
       "<Data name=\"t\" type=\"tool\"><Value key=\"0\" z=\"150\"/></Data><!-- -->\n<![CDATA[ <Data> "
       "]]></Datas></Database>\n<Programs><Program name=\"a\"><Parameter name=\"x\"/><Code><![CDATA[begin\n movej(p[1],"
       "t,m) // movel(p[1],t,m)\n movel(appro(p[n],{0,0,-5,0,0,0}),t[0],m)\n f[0].trf.x=3\n call go(p[\"1\"],x)\n"
       "end]]></Code></Program></Programs>\n"}};
  return programs;
}

TEST(Readers, EndWithFramesOrASentence) {
  RandomStream stream{7403};
  const Chain arm = wrist_arm();
  int read = 0, refused = 0;
  for (int repetition = 0; repetition < 500; ++repetition) {
    for (const auto& [language, whole] : stating_programs()) {
      const std::string text = disturbed(stream, whole);
      try {
        const Program program = read_program(language, text, "p", arm);
        expect_sound(program, text);
        for (const Target& target : program.targets) {
          if (!target.is_pose()) continue;
          EXPECT_TRUE(stated_tool_pose(target).matrix().allFinite()) << text;
        }
        ++read;
      } catch (const InputError&) {
        ++refused;
      }
      marked_line(with_mark(text, row_of(language), "corrected by demecal"));
    }
  }
  EXPECT_GT(read, 200);
  EXPECT_GT(refused, 200);
}

/// The same for arms on a rail, and with statements that set the payload.
TEST(Readers, OfArmsOnRailsAndPayloadsEndWithAProgramOrASentence) {
  RandomStream stream{7405};
  Chain arm = wrist_arm();
  Joint rail;
  rail.type = JointType::prismatic;
  rail.upper = 3.0;
  arm.joints.insert(arm.joints.begin(), rail);
  const std::vector<std::pair<WrittenIn, std::string>> programs{
      {WrittenIn::krl,
       "DEF a()\nLOAD_DATA[2]={M 12.5,CM {X 0,Y 0,Z 9,A 0,B 0,C 0}}\n$LOAD=LOAD_DATA[2]\n$BASE=$ROBROOT\nPTP {A1 1,A2 "
       "2,A3 3,A4 4,A5 5,A6 6,E1 700}\nWHILE TRUE\n$LOAD.M=3\nfetch()\nENDWHILE\nEND\nDEF fetch()\n$LOAD={M 4}\n"
       "LIN {X 1,Y 2,Z 3,A 4,B 5,C 6,E1 800}\nEND\n"},
      {WrittenIn::rapid,
       "MODULE m\nPERS loaddata part1:=[5.5,[50,0,50],[1,0,0,0],0,0,0];\nPROC a()\nGripLoad part1;\nMoveAbsJ "
       "[[1,2,3,4,5,6],[700,9E9,9E9,9E9,9E9,9E9]],v9,fine,tool0;\nGripLoad load0;\nENDPROC\nENDMODULE\n"},
      {WrittenIn::yaskawa_jbi,
       "/JOB\n//POS\n///NPOS 2,2,0,1,1,0\n///POSTYPE ROBOT\n///RECTAN\nC00000=1,2,3,4,5,6\nC00001=1,2,3,4,5,7\n"
       "BC00000=700.5\nBC00001=800\nP00002=1,2,3,4,5,6\nBP00002=5\n//INST\nNOP\nMOVL C00000 BC00000 V=5\nMOVJ C00001 "
       "BC00001 VJ=5\nMOVJ PX002 VJ=5\nEND\n"},
      {WrittenIn::kawasaki_as,
       ".PROGRAM a()\nWEIGHT 6,0,0,100\nJMOVE #h\nWEIGHT 2.5\nLMOVE p\n.END\n.TRANS\np 1 2 3 4 5 6 "
       "9\n.END\n.JOINTS\n#h "
       "1 2 3 4 5 6 700\n.END\n"},
      {WrittenIn::csv,
       "id,x_mm,y_mm,z_mm,qw,qx,qy,qz,e1_mm,payload_kg\na,1,2,3,1,0,0,0,700,2\nb,1,2,3,1,0,0,0,800,2\n"}};
  int read = 0, refused = 0;
  for (int repetition = 0; repetition < 500; ++repetition) {
    for (const auto& [language, whole] : programs) {
      const std::string text = disturbed(stream, whole);
      try {
        const Program program = with_followed_payloads(read_program(language, text, "p", arm));
        expect_sound(program, text);
        for (const Target& target : program.targets) {
          EXPECT_TRUE(stated_joints(target).allFinite()) << text;
          EXPECT_GE(target.payload_kg.value_or(0.0), 0.0);
        }
        ++read;
      } catch (const InputError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(read, 200);
  EXPECT_GT(refused, 200);
}

TEST(Readers, OfSeveralFilesEndWithAProgramOrASentence) {
  RandomStream stream{7404};
  const Chain arm = wrist_arm();
  int read = 0, refused = 0;
  for (int repetition = 0; repetition < 500; ++repetition) {
    for (const auto& [language, whole] : stating_programs()) {
      if (!row_of(language).of_several_files) continue;
      const std::string text = stream.chance(0.5) ? whole : disturbed(stream, whole);
      const std::size_t cut = stream.index(text.size() + 1);
      const ProgramSource source({{"a", text.substr(0, cut)}, {"b", text.substr(cut)}});
      try {
        const Program program = read_program(row_of(language), source, arm);
        expect_sound(program, source.text());
        for (const Target& target : program.targets) {
          EXPECT_EQ(target.place.file, source.file_at(target.begin()));
          EXPECT_LE(target.place.line, 1u + static_cast<std::size_t>(std::ranges::count(text, '\n')));
        }
        ++read;
      } catch (const InputError& error) {
        EXPECT_THAT((std::vector<std::string>{"a", "b"}), ::testing::Contains(error.where().file));
        ++refused;
      }
    }
  }
  EXPECT_GT(read, 200);
  EXPECT_GT(refused, 200);
}

TEST(Readers, RefuseBracketsWithoutEnd) {
  for (const char bracket : {'[', '{', '('}) {
    std::string text = "movej(";
    for (int i = 0; i < 100000; ++i) text += bracket;
    for (const WrittenIn language : {WrittenIn::krl, WrittenIn::rapid, WrittenIn::urscript}) {
      try {
        read_program(language, text, "p", wrist_arm());
      } catch (const InputError&) {
        continue;
      }
      EXPECT_TRUE(bracket == '(' || (bracket == '{') != (language == WrittenIn::krl));
    }
  }
}

}  // namespace
}  // namespace demecal
