// VAL3 programs tell with which tool points are moved to, and which values are not as the data have them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kinematics/random_arm.hpp"
#include "languages/reading_checks.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string value(const std::string& key, const std::string& more = "") {
  return "<Value key=\"" + key + "\" x=\"1\" y=\"2\" z=\"3\" rx=\"0\" ry=\"0\" rz=\"0\" " + more + "/>";
}

const std::string kData =
    "<Database xmlns=\"http://www.staubli.com/robotics/VAL3/Data/2\"><Datas>\n<Data name=\"p\" type=\"pointRx\">\n" +
    value("0", "fatherId=\"f[0]\"") + "\n" + value("1", "fatherId=\"f[1]\"") + "\n" + value("up") +
    "\n</Data>\n<Data name=\"j\" type=\"jointRx\"><Value j1=\"1\" j2=\"2\" j3=\"3\" j4=\"4\" j5=\"5\" "
    "j6=\"6\"/></Data>\n"
    "<Data name=\"f\" type=\"frame\">" +
    value("0") + value("1", "fatherId=\"f[0]\"") +
    "</Data>\n<Data name=\"t\" type=\"tool\"><Value key=\"0\" z=\"100\"/><Value key=\"1\" z=\"200\"/></Data>\n"
    "<Data name=\"trShort\" type=\"trsf\"><Value key=\"0\" z=\"-60\"/></Data>"
    "<Data name=\"trLong\" type=\"trsf\"><Value key=\"0\" z=\"-400\"/></Data>\n"
    "</Datas></Database>\n";

std::string program_text(const std::string& code, const std::string& locals = "") {
  return "<Programs xmlns=\"http://www.staubli.com/robotics/VAL3/Program/2\">\n<Program name=\"start\">" + locals +
         "<Code><![CDATA[\nbegin\n" + code + "end\n]]></Code>\n</Program>\n</Programs>\n";
}

Program read_application(const std::string& code, const std::string& locals = "") {
  const ProgramSource source({{"a.dtx", kData}, {"start.pgx", program_text(code, locals)}});
  return read_program(row_of(WrittenIn::val3), source, wrist_arm());
}

const Target* find_target(const Program& program, const std::string& name) {
  for (const Target& target : program.targets) {
    if (target.name == name) return &target;
  }
  return nullptr;
}

double tool_z_mm(const Program& program, const std::string& name) {
  const Target* target = find_target(program, name);
  if (target == nullptr || !target->frames.tool) return -1.0;
  return 1e3 * target->frames.tool->translation().z();
}

/// What is said of a target that is left.
std::string left(const Program& program, const std::string& name) {
  for (const Remark& remark : program.uncorrected) {
    if (remark.name == name) return remark.sentence;
  }
  return "";
}

TEST(Val3Program, TellsTheToolOfEveryMotion) {
  const Program program = read_application(
      "  movej(j, t, mFast)\n  // movel(p[1], t[0], m)\n  putln(\"movel(p[1],t[0],m)\")\n"
      "  movel(p[1],\n    t[1], mFast)\n  nId = movel(appro(p, {0,0,-50,0,0,0}), flange, mFast)\n  movel(p, flange, "
      "m)\n"
      "  if nX==1\n    movec(p[\"up\"], p[1], t[1], mFast)\n  endIf\n  open(t)\n");
  EXPECT_THAT(names(program), ElementsAre("p[0]", "p[1]", "p[up]", "j[0]"));
  EXPECT_THAT(program.uncorrected, IsEmpty());
  EXPECT_EQ(tool_z_mm(program, "j[0]"), 100.0);
  EXPECT_EQ(tool_z_mm(program, "p[1]"), 200.0);
  EXPECT_EQ(tool_z_mm(program, "p[0]"), 0.0);
  EXPECT_EQ(tool_z_mm(program, "p[up]"), 200.0);
  EXPECT_EQ(find_target(program, "p[1]")->motion, Motion::line);
  EXPECT_EQ(find_target(program, "p[0]")->motion, Motion::line);
  ASSERT_EQ(find_target(program, "p[0]")->near_motions.size(), 1u);
  const auto& [begin, place] = *find_target(program, "p[0]")->near_motions.begin();
  EXPECT_LT(begin, find_target(program, "p[0]")->order) << "the way to a point near it ends elsewhere";
  EXPECT_EQ(place.motion, Motion::line);
  EXPECT_TRUE(place.shift_m.value_or(Eigen::Vector3d::Zero()).isApprox(Eigen::Vector3d(0.0, 0.0, -0.05)));
  EXPECT_LT(find_target(program, "j[0]")->order, find_target(program, "p[1]")->order);
  EXPECT_EQ(program.file_at(find_target(program, "j[0]")->order), 1u);
  EXPECT_EQ(find_target(program, "j[0]")->place.file, 0u);
}

TEST(Val3Program, LeavesWhatItsMotionsDoNotTell) {
  const auto tool = [](const std::string& code, const std::string& name) {
    const Program program = read_application(code);
    const Target* target = find_target(program, name);
    return target == nullptr ? std::string("no target") : target->frames.unknown_tool;
  };
  EXPECT_THAT(tool("", "p[1]"), HasSubstr("no motion tells which"));
  EXPECT_THAT(tool("movej(p[1],t[n],m)\n", "p[1]"), HasSubstr("is given neither"));
  EXPECT_THAT(tool("movej(p[1],t,m)\nmovel(p[1],t[1],m)\n", "p[1]"), HasSubstr("different tools"));
  EXPECT_EQ(tool("movej(p[n],t[1],m)\n", "p[1]"), "");
  EXPECT_THAT(tool("movej(p[n],t[1],m)\nmovej(p[1],t,m)\n", "p[1]"), HasSubstr("different tools"));
  EXPECT_THAT(tool("t[1].trf.z=3\nmovej(p[1],t[1],m)\n", "p[1]"), HasSubstr("the program changes it"));
  EXPECT_THAT(tool("call change(t[n])\nmovej(p[1],t[1],m)\n", "p[1]"), HasSubstr("in change(), which is not followed"));
  EXPECT_THAT(tool("movej(p[1],pick(),m)\n", "p[1]"), HasSubstr("is computed"));
}

TEST(Val3Program, LeavesPointsAndFramesThatItChanges) {
  for (const char* code :
       {"p[1]=here(t,f)\n", "p[1].trf.x = p.trf.x+3\n", "p[n].trf.x=1\n", "call go(p[1], t)\n", "nX=p[1].trf.x\n",
        "p[1].trf={1,2,3,0,0,0}\n", "if distance(x,y)>2 and same(p[1])\n", "bOk=pointToJoint(t,jA,jB,p[1])\n"}) {
    const Program program = read_application(std::string(code) + "movel(p[1],t,m)\nmovel(p[\"up\"],t,m)\n");
    EXPECT_EQ(find_target(program, "p[1]"), nullptr) << code;
    EXPECT_THAT(left(program, "p[1]"), HasSubstr("the program")) << code;
  }
  for (const char* code : {"movel(appro(p[1],tr),t,m)\n", "jA=herej()\n", "bOk=pointToJoint(t,jA,p[1],jB)\n",
                           "pA=here(t,f)\n", "if p==3\n", "nX=distance(p[1],pA)\n", "open(t)\n"}) {
    EXPECT_NE(find_target(read_application(std::string(code) + "movel(p[1],t,m)\n"), "p[1]"), nullptr) << code;
  }
  const auto frame = [](const std::string& code, const std::string& name) {
    const Program program = read_application(code + "movel(p,t,m)\nmovel(p[1],t,m)\nmovel(p[\"up\"],t,m)\n");
    const Target* target = find_target(program, name);
    return target == nullptr ? std::string("no target") : target->frames.unknown_frame;
  };
  EXPECT_EQ(frame("", "p[1]"), "");
  EXPECT_THAT(frame("bOk=setFrame(pA,pB,pC,f[0])\n", "p[0]"), HasSubstr("setFrame(), which is not followed"));
  EXPECT_THAT(frame("f[0].trf.x=3\n", "p[1]"), HasSubstr("changes it")) << "f[1] hangs on f[0]";
  EXPECT_EQ(frame("f[1].trf.x=3\n", "p[0]"), "");
}

TEST(Val3Program, SaysWhereMotionsGoToNothingThatIsGiven) {
  const Program program =
      read_application("movel(compose(p[1],f,tr)+x,t,m)\nmovej(x_j,t,m)\nmovej(pLost,t,m)\nmovej(j,t,m)\n",
                       "<Parameters><Parameter name=\"x_j\" type=\"jointRx\"/></Parameters>");
  ASSERT_EQ(program.uncorrected.size(), 3u);
  EXPECT_THAT(program.uncorrected[0].sentence, HasSubstr("'compose(p[1],f,tr)+x', which is computed"));
  EXPECT_EQ(program.uncorrected[0].place.line, 4u);
  EXPECT_EQ(program.file_name(program.uncorrected[0].place.file), "start.pgx");
  EXPECT_THAT(program.uncorrected[1].sentence, HasSubstr("'x_j'"));
  EXPECT_THAT(left(program, "pLost[0]"), HasSubstr("is not given in this program"));
  const Program hidden = read_application("p[1].trf.x=3\nmovej(p[1],t,m)\n", "<Local name=\"p\" type=\"pointRx\"/>");
  EXPECT_NE(find_target(hidden, "p[1]"), nullptr) << "the program's own p is another";
  const ProgramSource alone(program_text("movel(pA,t,m)\n"), "start.pgx");
  const Program without = read_program(row_of(WrittenIn::val3), alone, wrist_arm());
  EXPECT_THAT(without.targets, IsEmpty());
  EXPECT_THAT(left(without, "pA[0]"), HasSubstr("is not given"));
  expect_fault(WrittenIn::val3, program_text("a(a(a(a(a(a(a(a(a(a(a(a(a(a(a(a(a(a(a(a(a(a(a(a(a(\n"), 4,
               "nested too deeply");
}

TEST(Val3Program, SaysWhereMotionsComeNearAPointOnly) {
  const auto said = [](const std::string& code) {
    const Program program = read_application(code);
    return program.remarks.empty() ? std::string()
                                   : program.remarks.front().name + ": " + program.remarks.front().sentence;
  };
  for (const char* motion : {"movel(appro(p,{0,0,-50,0,0,0}),t,m)\n", "movel(appro(p,{30,40,0,0,0,0}),t,m)\n",
                             "movel(compose(p,f,{0,0,99,0,0,0}),t,m)\n"})
    EXPECT_EQ(said(motion), "") << motion;
  EXPECT_THAT(said("movel(appro(p,{0,0,-300,0,0,0}),t,m)\n"), HasSubstr("p[0]: a place 300 mm away from it"));
  EXPECT_THAT(said("movel(compose(p[1],f,{0,300,400,0,0,0}),t,m)\n"), HasSubstr("p[1]: a place 500 mm away from it"));
  EXPECT_EQ(said("movel(appro(p,trShort),t,m)\n"), "");
  EXPECT_THAT(said("movel(appro(p,trLong),t,m)\n"), HasSubstr("p[0]: a place 400 mm away from it"));
  EXPECT_THAT(said("trLong.z=3\nmovel(appro(p,trLong),t,m)\n"), HasSubstr("not known"));
  EXPECT_THAT(said("movel(appro(p,trApproach),t,m)\n"), HasSubstr("distance from it that is not known"));
  EXPECT_THAT(said("movel(appro(p,{0,0,z,0,0,0}),t,m)\n"), HasSubstr("distance from it that is not known"));
  EXPECT_THAT(said("movel(appro(p,{0,0,-50,0,90,0}),t,m)\n"), HasSubstr("not known")) << "it is turned";
}

TEST(Val3Program, TakesMotionsToComposedPointsForMotionsNearThem) {
  const Program program =
      read_application("movel(compose(p[1],f,{0,0,50,0,0,0}),t[1],m)\nmovel(compose(p[1],f,tr)+1,t,m)\n");
  ASSERT_EQ(program.uncorrected.size(), 1u);
  EXPECT_EQ(program.uncorrected[0].place.line, 5u);
  EXPECT_EQ(tool_z_mm(program, "p[1]"), 200.0);
  EXPECT_EQ(find_target(program, "p[1]")->motion, Motion::joints) << "the way to a point near it ends elsewhere";
}

TEST(Val3Program, SaysOnceThatCallsOfOtherProgramsAreNotFollowed) {
  const Program program = read_application("call grip()\nmovel(p,t,m)\ncall grip()\ncall other:open(1)\n");
  ASSERT_EQ(program.remarks.size(), 1u);
  EXPECT_THAT(program.remarks[0].sentence, HasSubstr("grip, other:open"));
  EXPECT_EQ(program.remarks[0].place.line, 4u);
  const ProgramSource both({{"a.dtx", kData}, {"start.pgx", program_text("call start()\nmovel(p,t,m)\n", "")}});
  EXPECT_THAT(read_program(row_of(WrittenIn::val3), both, wrist_arm()).remarks, IsEmpty());
}

TEST(Val3Program, SaysThatLibrariesAndTasksOfOtherProgramsAreNotFollowed) {
  const auto said = [](const std::string& code) {
    const Program program = read_application(code + "movel(p,t,m)\n");
    return program.remarks.empty() ? std::string() : program.remarks.front().sentence;
  };
  EXPECT_THAT(said("libLoad(\"Disk://cell2\")\n"), HasSubstr("libLoad(\"Disk://cell2\"), are not in the files given"));
  EXPECT_THAT(said("cell:libLoad(sPath)\n"), HasSubstr("libLoad(sPath), are not"));
  EXPECT_THAT(said("taskCreate \"bg\",10,watch(1)\n"), HasSubstr("watch, are not in the files given"));
  EXPECT_THAT(said("taskCreate \"bg\",10,start()\n"), IsEmpty()) << "it is in the file";
  EXPECT_THAT(said("taskKill(\"bg\")\n"), IsEmpty());
}

}  // namespace
}  // namespace demecal
