// A program of several files is corrected as if it were one, each number in the file that holds it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "corrected_arm.hpp"
#include "errors/input_error.hpp"
#include "languages/written_program.hpp"
#include "programs/summary.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

/// The parts of a program: motions, points, and the tools and frames that the controller keeps.
struct ProgramParts {
  WrittenIn language = WrittenIn::krl;
  std::string motions, points, frames;
  JointVector near{};  ///< of the first point

  std::vector<ProgramFile> files() const {
    if (language == WrittenIn::krl) return {{"a.src", motions}, {"a.dat", points}, {"config.dat", frames}};
    return {{"main.mod", motions}, {"points.mod", points}, {"tools.sys", frames}};
  }
  std::string one_file() const { return frames + points + motions; }
};

std::string krl_frame(const Eigen::Isometry3d& pose) {
  std::vector<double> values = in_mm(pose);
  const std::vector<double> angles = abc(pose);
  values.insert(values.end(), angles.begin(), angles.end());
  return named({"X", "Y", "Z", "A", "B", "C"}, values, 9);
}

std::string rapid_frame_text(const Eigen::Isometry3d& pose) {
  return "[" + listed(in_mm(pose), 9) + "],[" + listed(wxyz(pose), 9) + "]";
}

void add_krl(int index, const Eigen::Isometry3d& pose, const JointVector& joints, ProgramParts& parts) {
  int bits = 0;
  for (int joint = 0; joint < 6; ++joint) bits |= joints[joint] < 0.0 ? 1 << joint : 0;
  const std::string number = std::to_string(index);
  parts.points += "DECL E6POS XP" + number + "={" + krl_frame(pose) + ",S 2,T " + std::to_string(bits) + ",E1 0.0}\n";
  parts.points += "DECL FDAT FP" + number + "={TOOL_NO 1,BASE_NO 2,IPO_FRAME #BASE}\n";
  parts.motions += std::string(index % 2 == 0 ? "LIN" : "PTP") + " XP" + number + "\n";
}

void add_rapid(int index, const Eigen::Isometry3d& pose, const JointVector& joints, ProgramParts& parts) {
  const std::string number = std::to_string(index);
  const auto quadrant = [&](int joint) {
    return std::to_string(static_cast<int>(std::floor(joints[joint] / 1.5707963)));
  };
  parts.points += "CONST robtarget p" + number + ":=[" + rapid_frame_text(pose) + ",[" + quadrant(0) + ',' +
                  quadrant(3) + ',' + quadrant(5) + ",0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n";
  parts.motions += std::string(index % 2 == 0 ? "MoveL" : "MoveJ") + " p" + number + ",v100,fine,grip\\WObj:=table;\n";
}

ProgramParts random_parts(RandomStream& stream, WrittenIn language, const Chain& arm) {
  ProgramParts parts{.language = language, .motions = {}, .points = {}, .frames = {}};
  const Eigen::Isometry3d tool = random_pose(stream), frame = random_pose(stream);
  const bool krl = language == WrittenIn::krl;
  parts.motions = krl ? "&ACCESS RVP\nDEF a()\nBAS(#TOOL,1)\nBAS(#BASE,2)\n" : "MODULE m\nPROC main()\n";
  for (int index = 1; index <= 4; ++index) {
    const JointVector joints = regular_joints(stream, arm);
    if (index == 1) parts.near = joints;
    const Eigen::Isometry3d pose = frame.inverse() * forward(arm, joints) * tool;
    krl ? add_krl(index, pose, joints, parts) : add_rapid(index, pose, joints, parts);
  }
  parts.motions += krl ? "END\n" : "ENDPROC\nENDMODULE\n";
  parts.frames = krl ? "TOOL_DATA[1]={" + krl_frame(tool) + "}\nBASE_DATA[2]={" + krl_frame(frame) + "}\n"
                     : "PERS tooldata grip:=[TRUE,[" + rapid_frame_text(tool) +
                           "],[1,[0,0,1],[1,0,0,0],0,0,0]];\nPERS wobjdata table:=[FALSE,TRUE,\"\",[" +
                           rapid_frame_text(frame) + "],[[0,0,0],[1,0,0,0]]];\n";
  return parts;
}

CorrectedProgram corrected_of(const ProgramSource& source, WrittenIn language, const CommandModel& model,
                              const JointVector& near = {}) {
  return correct_program(source.text(), read_program(row_of(language), source, model.nominal.chain), model,
                         {.near = near});
}

/// What every target's numbers became, by its name.
std::map<std::string, std::vector<std::string>> texts_by_name(const CorrectedProgram& corrected) {
  std::map<std::string, std::vector<std::string>> texts;
  for (std::size_t i = 0; i < corrected.targets.size(); ++i)
    texts[corrected.program.targets[i].name] = corrected.targets[i].texts;
  return texts;
}

TEST(SeveralFiles, AreCorrectedAsTheSameProgramInOneFile) {
  RandomStream stream{7601};
  for (int repetition = 0; repetition < 10; ++repetition) {
    const CommandModel model = erring_model(stream, elbow_arm(stream));
    for (const WrittenIn language : {WrittenIn::krl, WrittenIn::rapid}) {
      const ProgramParts parts = random_parts(stream, language, model.nominal.chain);
      const ProgramSource several(parts.files()), one(parts.one_file(), "one");
      const CorrectedProgram apart = corrected_of(several, language, model, parts.near);
      const auto texts = texts_by_name(apart);
      EXPECT_THAT(texts, SizeIs(4));
      EXPECT_EQ(texts, texts_by_name(corrected_of(one, language, model, parts.near)));
      const std::vector<std::string> files = corrected_files(several, apart);
      EXPECT_EQ(files.at(0), parts.motions);
      EXPECT_NE(files.at(1), parts.points);
      EXPECT_EQ(files.at(2), parts.frames);
      EXPECT_EQ(files[0] + '\n' + files[1] + '\n' + files[2], apart.text);
      for (const Target& target : apart.program.targets)
        EXPECT_EQ(apart.program.file_name(target.place.file), parts.files()[1].name);
    }
  }
}

TEST(SeveralFiles, StayByteForByteUnderANeutralModel) {
  RandomStream stream{7602};
  for (const WrittenIn language : {WrittenIn::krl, WrittenIn::rapid}) {
    const CommandModel model = neutral_model(stream, elbow_arm(stream));
    std::vector<ProgramFile> files = random_parts(stream, language, model.nominal.chain).files();
    for (ProgramFile& file : files) file.text = "\xEF\xBB\xBF" + file.text;
    const ProgramSource source(files);
    const CorrectedProgram corrected = corrected_of(source, language, model);
    EXPECT_THAT(corrected.targets, SizeIs(4));
    const std::vector<std::string> texts = corrected_files(source, corrected);
    for (std::size_t file = 0; file < files.size(); ++file) EXPECT_EQ(texts[file], files[file].text);
  }
}

TEST(SeveralFiles, OfVal3GiveThePointsTheToolsOfTheirMotions) {
  RandomStream stream{7605};
  const auto numbers = [](const Eigen::Isometry3d& pose) {
    return enclosed({" x=\"", " y=\"", " z=\"", " rx=\"", " ry=\"", " rz=\""},
                    six_numbers(pose, pose.linear().eulerAngles(0, 1, 2)), 9, "\"");
  };
  for (int repetition = 0; repetition < 5; ++repetition) {
    const CommandModel model = erring_model(stream, elbow_arm(stream));
    const std::vector<Eigen::Isometry3d> tools{random_pose(stream), random_pose(stream)};
    std::string points = "<Data name=\"p\" type=\"pointRx\">\n", motions;
    JointVector near;
    for (int point = 0; point < 3; ++point) {
      const JointVector joints = regular_joints(stream, model.nominal.chain);
      if (point == 0) near = joints;
      const std::string key = std::to_string(point);
      points += "<Value key=\"" + key + '"' + numbers(forward(model.nominal.chain, joints) * tools[1]) + "/>\n";
      motions += "movej(p[" + key + "], t[1], m)\n";
    }
    points += "</Data>\n";
    const std::string one_tool = "<Data name=\"t\" type=\"tool\"><Value key=\"1\"" + numbers(tools[1]) + "/></Data>\n";
    const std::string two_tools = "<Data name=\"t\" type=\"tool\"><Value key=\"0\"" + numbers(tools[0]) +
                                  "/><Value key=\"1\"" + numbers(tools[1]) + "/></Data>\n";
    const std::string code = "<Program name=\"start\"><Code><![CDATA[begin\n" + motions + "end]]></Code></Program>\n";
    const ProgramSource several(std::vector<ProgramFile>{{"a.dtx", points + two_tools}, {"start.pgx", code}});
    const CorrectedProgram told = corrected_of(several, WrittenIn::val3, model, near);
    const CorrectedProgram one = corrected_of(ProgramSource(points + one_tool, "a.dtx"), WrittenIn::val3, model, near);
    EXPECT_THAT(texts_by_name(told), SizeIs(3));
    EXPECT_EQ(texts_by_name(told), texts_by_name(one));
    EXPECT_NE(corrected_files(several, told).at(0), points + two_tools);
    EXPECT_EQ(corrected_files(several, told).at(1), code);
  }
}

const std::string kPoint = "={X 10,Y 0,Z 0,A 0,B 0,C 0,S 2,T 2}\n";

Program krl_program(const std::vector<ProgramFile>& files) {
  const ProgramSource source(files);
  return read_program(row_of(WrittenIn::krl), source, wrist_arm());
}

TEST(SeveralFiles, SharingANameForTwoPointsLeaveBoth) {
  const Program program = krl_program({{"a.src", "PTP XP1\nLIN XP2\n"},
                                       {"a.dat", "DECL E6POS XP1" + kPoint + "DECL E6POS XP2" + kPoint},
                                       {"b.dat", "\n\nDECL E6POS xp1" + kPoint}});
  ASSERT_THAT(program.targets, SizeIs(1));
  EXPECT_EQ(program.targets.front().name, "XP2");
  ASSERT_THAT(program.uncorrected, SizeIs(2));
  EXPECT_THAT(program.uncorrected[0].sentence, HasSubstr("stands in b.dat, too"));
  EXPECT_THAT(program.uncorrected[1].sentence, HasSubstr("stands in a.dat, too"));
  EXPECT_EQ(program.uncorrected[1].place.line, 3u);
  EXPECT_EQ(program.file_name(program.uncorrected[1].place.file), "b.dat");
}

TEST(SeveralFiles, GivingAToolTwiceDoNotTellIt) {
  const std::string point = "DECL E6POS XP1" + kPoint, use = "BAS(#TOOL,1)\nLIN XP1\n";
  const auto tool = [&](const std::string& first, const std::string& second) {
    return krl_program({{"a.src", use}, {"a.dat", point + first}, {"config.dat", second}}).targets.at(0).frames;
  };
  const std::string one = "TOOL_DATA[1]={X 1,Y 0,Z 0,A 0,B 0,C 0}\n",
                    other = "TOOL_DATA[1]={X 2,Y 0,Z 0,A 0,B 0,C 0}\n";
  EXPECT_TRUE(tool(one, one).tool);
  EXPECT_THAT(tool(one, other).unknown_tool, HasSubstr("TOOL_DATA[1] is given more than once"));
  const std::string moved = "MoveL [[1,2,3],[1,0,0,0],[0,0,0,0],[0,0,0,0,0,0]],v9,fine,t;\n";
  const auto data = [](double z_mm) {
    return "PERS tooldata t:=[TRUE,[[0,0," + std::to_string(z_mm) + "],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n";
  };
  const ProgramSource modules({{"a.mod", data(1) + moved}, {"b.mod", data(2)}});
  EXPECT_THAT(read_program(row_of(WrittenIn::rapid), modules, wrist_arm()).targets.at(0).frames.unknown_tool,
              HasSubstr("t is given more than once"));
}

TEST(SeveralFiles, KeepTheirLocalTools) {
  const std::string moved = "MoveL [[1,2,3],[1,0,0,0],[0,0,0,0],[0,0,0,0,0,0]],v9,fine,t;\n";
  const auto unknown = [&](const std::string& scope) {
    const std::string tool = scope + "PERS tooldata t:=[TRUE,[[0,0,1],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n";
    const ProgramSource modules({{"a.mod", "MODULE a\n  " + tool + moved}, {"b.mod", moved}});
    const Program program = read_program(row_of(WrittenIn::rapid), modules, wrist_arm());
    EXPECT_EQ(program.targets.at(0).frames.unknown_tool, "");
    return program.targets.at(1).frames.unknown_tool;
  };
  EXPECT_EQ(unknown(""), "");
  EXPECT_THAT(unknown("LOCAL "), HasSubstr("LOCAL to another file"));
}

TEST(SeveralFiles, DoNotPassOnWhatTheySet) {
  const std::string set = "$TOOL={X 1,Y 2,Z 3,A 0,B 0,C 0}\n$BASE={X 1,Y 2,Z 3,A 0,B 0,C 0}\n";
  const Program program = krl_program({{"a.src", set + "LIN XP1\n"},
                                       {"b.src", "LIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\n" + set + "LIN XP3\n"},
                                       {"a.dat", "E6POS XP1" + kPoint + "E6POS XP2" + kPoint + "E6POS XP3" + kPoint}});
  ASSERT_THAT(program.targets, SizeIs(4));
  const std::string unknown = "$TOOL is set in another file of the program";
  EXPECT_EQ(program.targets[0].frames.unknown_tool, unknown);
  EXPECT_EQ(program.targets[0].frames.unknown_frame, "$BASE is set in another file of the program");
  EXPECT_EQ(program.targets[1].frames.unknown_tool, "");
  EXPECT_EQ(program.targets[2].frames.unknown_tool, unknown) << "XP2, to which no motion goes";
  EXPECT_EQ(program.targets[3].frames.unknown_tool, "");
}

TEST(SeveralFiles, DoNotTellWhereTheArmComesFrom) {
  RandomStream stream{7603};
  const CommandModel model = erring_model(stream, elbow_arm(stream));
  const JointVector joints = regular_joints(stream, model.nominal.chain);
  const std::string from = "PTP {" + named({"A1", "A2", "A3", "A4", "A5", "A6"}, in_degrees(joints), 6) + "}\n";
  const std::string to = "LIN {" + krl_frame(model.nominal_tool(joints)) + "}\n";
  const CorrectedProgram together = corrected_of(ProgramSource(from + to, "a.src"), WrittenIn::krl, model);
  EXPECT_EQ(together.targets.at(1).from, JointsFrom::line);
  const ProgramSource apart(std::vector<ProgramFile>{{"a.src", from}, {"b.src", to}});
  EXPECT_NE(corrected_of(apart, WrittenIn::krl, model).targets.at(1).from, JointsFrom::line);
}

TEST(SeveralFiles, AreNamedWhereSomethingIsWrongAndInSummaries) {
  try {
    krl_program({{"a.src", "LIN XP1\nLIN {X 1, Y 2"}, {"a.dat", "E6POS XP1" + kPoint}});
    ADD_FAILURE() << "no fault, though the first file leaves a bracket open";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where().file, "a.src");
    EXPECT_EQ(error.where().line, 2u);
  }
  try {
    krl_program({{"a.src", "LIN XP1\n"}, {"a.dat", "\nE6POS XP1={X 1,Y 2,Z x3..,A 0,B 0,C 0}\n"}});
    ADD_FAILURE() << "no fault";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.dat:2: 'x3..': must be a number (column 22)"));
  }
  const ProgramSource tables(std::vector<ProgramFile>{{"a.csv", "q1_deg\n1\n"}, {"b.csv", "q1_deg\n1\n"}});
  EXPECT_THROW(read_program(row_of(WrittenIn::csv), tables, wrist_arm()), InputError);

  RandomStream stream{7604};
  const CommandModel model = erring_model(stream, elbow_arm(stream));
  const ProgramParts parts = random_parts(stream, WrittenIn::krl, model.nominal.chain);
  const CorrectedProgram corrected = corrected_of(ProgramSource(parts.files()), WrittenIn::krl, model, parts.near);
  EXPECT_THAT(summary_table(corrected, model.nominal.chain), HasSubstr("  a.dat:3: XP2"));
  EXPECT_THAT(summary_json(corrected, model.nominal.chain),
              HasSubstr("\"name\":\"XP2\",\"file\":\"a.dat\",\"line\":3"));
}

}  // namespace
}  // namespace demecal
