// Configurations that programs state in words whose meaning differs between arms: the same words, the same sides.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "corrected_arm.hpp"
#include "languages/written_program.hpp"
#include "programs/configuration.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

/// The sides of wrist_arm()'s shoulder, elbow and wrist, from its lengths (Denavit-Hartenberg).
std::array<bool, 3> sides(const JointVector& q) {
  const double reach = 0.65 * std::cos(q[1]) + 0.6 * std::sin(q[1] + q[2]);
  return {reach > 0.0, std::cos(q[2]) > 0.0, q[4] > 0.0};
}

/// Whether no side is near to changing.
bool told(const JointVector& q) {
  const double reach = 0.65 * std::cos(q[1]) + 0.6 * std::sin(q[1] + q[2]);
  return std::abs(reach) > 0.1 && std::abs(std::cos(q[2])) > 0.1 && std::abs(std::sin(q[4])) > 0.1;
}

JointVector told_joints(RandomStream& stream, const Chain& arm) {
  while (true) {
    const JointVector joints = 0.9 * random_joints(stream, arm);
    if (told(joints) && is_regular(arm, joints)) return joints;
  }
}

TEST(SamePosture, IsThatOfTheSidesOfShoulderElbowAndWrist) {
  RandomStream stream{7530};
  const Chain arm = wrist_arm();
  int same = 0;
  for (int i = 0; i < 300; ++i) {
    const JointVector one = told_joints(stream, arm), other = told_joints(stream, arm);
    const std::optional<bool> found = same_posture(arm, one, other);
    ASSERT_TRUE(found);
    EXPECT_EQ(*found, sides(one) == sides(other)) << one.transpose() << " | " << other.transpose();
    same += *found ? 1 : 0;
  }
  EXPECT_GT(same, 10);
}

TEST(SamePosture, DoesNotDependOnCouplingsAndIsNotToldOfOtherArms) {
  RandomStream stream{7531};
  Chain arm = wrist_arm();
  arm.couplings.push_back({2, 1, 1.0});
  for (int i = 0; i < 50; ++i) {
    const JointVector one = told_joints(stream, wrist_arm()), other = told_joints(stream, wrist_arm());
    EXPECT_EQ(same_posture(arm, commanded_joints(arm, one), commanded_joints(arm, other)), sides(one) == sides(other));
  }
  const Chain any = random_arm(stream, 6, Convention::standard_dh);
  EXPECT_EQ(same_posture(any, random_joints(stream, any), random_joints(stream, any)), std::nullopt);
  JointVector singular = told_joints(stream, wrist_arm());
  singular[4] = 0.0;
  EXPECT_EQ(same_posture(wrist_arm(), singular, singular), std::nullopt);
}

struct TaughtListing {
  RandomStream stream{7532};
  CommandModel model = erring_model(stream, elbow_arm(stream));
  std::string moves{}, positions{};
  int count = 0;

  void joints(const JointVector& joints) {
    const std::string number = std::to_string(++count);
    moves += "   :J P[" + number + "] 100% FINE ;\n";
    positions += joints_line(WrittenIn::fanuc_ls, joints, count, 9) + '\n';
  }
  void pose(const JointVector& joints, const std::string& words, char motion = 'J') {
    const std::string number = std::to_string(++count);
    moves += std::string("   :") + motion + " P[" + number + "] 100% FINE ;\n";
    const Eigen::Isometry3d pose = model.nominal_tool(joints);
    positions += fanuc_position(number, " CONFIG : '" + words + "',", {"X", "Y", "Z", "W", "P", "R"},
                                six_numbers(pose, about_fixed_xyz(pose)), 9) +
                 '\n';
  }
  CorrectedProgram corrected(const JointVector& near = {}) const {
    const std::string text = "/PROG  T\n/MN\n" + moves + "/POS\n" + positions + "/END\n";
    return correct_program(text, read_program(WrittenIn::fanuc_ls, text, "p.ls", model.nominal.chain), model,
                           {.temperature_celsius = 20.0, .near = near});
  }
};

JointVector standing() {
  JointVector joints(6);
  joints << 0.4, -0.7, 0.5, 0.3, 0.9, -0.2;
  return joints;
}

TEST(Words, MeanTheSidesOfThePoseBeforeThatHadThem) {
  RandomStream stream{7533};
  int far = 0;
  for (int i = 0; i < 40; ++i) {
    TaughtListing listing;
    const JointVector first = told_joints(stream, listing.model.nominal.chain);
    JointVector second = told_joints(stream, listing.model.nominal.chain);
    while (sides(second) != sides(first)) second = told_joints(stream, listing.model.nominal.chain);
    listing.joints(first + JointVector::Constant(6, 0.02));
    listing.pose(first, "N U T, 0, 0, 0");
    listing.pose(second, "N U T, 0, 0, 0");
    const CorrectedProgram corrected = listing.corrected();
    if (corrected.targets[1].from != JointsFrom::before) continue;
    EXPECT_LT((corrected.targets[1].nominal - first).norm(), 1e-6);
    ASSERT_EQ(corrected.targets[2].from, JointsFrom::stated);
    const JointVector apart = corrected.targets[2].nominal - second;
    for (const double angle : apart) EXPECT_NEAR(wrap_near(angle, 0.0), 0.0, 1e-6);
    far += (second - first).cwiseAbs().maxCoeff() > 1.0 ? 1 : 0;
  }
  EXPECT_GT(far, 20);
}

TEST(Words, ThatAreNewLeaveTheLineAndSaySo) {
  TaughtListing listing;
  JointVector flipped = standing();
  flipped[3] += 3.14159265358979;
  flipped[4] *= -1.0;
  flipped[5] += 3.14159265358979;
  listing.joints(standing());
  listing.pose(standing() + JointVector::Constant(6, 0.1), "N U T, 0, 0, 0");
  listing.pose(flipped, "F U T, 0, 0, 0");
  listing.pose(standing() + JointVector::Constant(6, -0.1), "N U T, 0, 0, 0");
  const CorrectedProgram corrected = listing.corrected();
  EXPECT_EQ(corrected.targets[1].outcome, CorrectionOutcome::corrected);
  EXPECT_EQ(corrected.targets[2].outcome, CorrectionOutcome::uncorrected);
  ASSERT_EQ(corrected.warnings.size(), 2u);
  EXPECT_THAT(corrected.warnings[0].sentence, HasSubstr("the side that the arm comes from"));
  EXPECT_THAT(corrected.warnings[1].sentence, HasSubstr("configuration, stated as 'FUT,0,0,0', which does not mean"));
  EXPECT_EQ(corrected.targets[3].from, JointsFrom::stated);
}

TEST(Words, AreToldByJointsOrAUserVeryNearAndByALine) {
  TaughtListing near;
  near.pose(standing(), "N U T, 0, 0, 0");
  EXPECT_EQ(near.corrected().targets[0].outcome, CorrectionOutcome::uncorrected);
  EXPECT_EQ(near.corrected(standing() + JointVector::Constant(6, 0.05)).targets[0].from, JointsFrom::given);
  EXPECT_EQ(near.corrected(standing() + JointVector::Constant(6, 0.8)).targets[0].from, JointsFrom::undetermined);
  TaughtListing line;
  line.joints(standing() + JointVector::Constant(6, 0.1));
  line.pose(standing(), "N U T, 0, 0, 0", 'L');
  EXPECT_EQ(line.corrected().targets[1].from, JointsFrom::line);
}

TEST(Words, OfOneConfigurationThatContradictEachOtherLeaveTheLine) {
  for (const auto& [words, left] : {std::pair{"F U T, 0, 0, 0", true}, {"N U T, 0, 0, 1", false}}) {
    TaughtListing listing;
    listing.joints(standing());
    listing.pose(standing() + JointVector::Constant(6, 0.05), "N U T, 0, 0, 0");
    listing.joints(standing());
    listing.pose(standing() + JointVector::Constant(6, -0.05), words);
    const CorrectedProgram corrected = listing.corrected();
    EXPECT_EQ(corrected.targets[1].outcome, CorrectionOutcome::corrected);
    EXPECT_EQ(corrected.targets[3].outcome == CorrectionOutcome::uncorrected, left) << words;
    EXPECT_EQ(std::ranges::count_if(corrected.warnings,
                                    [](const Remark& warning) {
                                      return warning.sentence.find("'NUT,0,0,0' states elsewhere") != std::string::npos;
                                    }),
              left ? 1 : 0);
  }
}

TEST(Words, OfAJobContradictEachOtherInTheirFirstThreeNumbers) {
  const Chain arm = wrist_arm();
  const JointVector joints = standing();
  const Eigen::Isometry3d tool = forward(arm, joints) * Eigen::Translation3d(arm.tool_m);
  ConfigurationFinder finder({}, standing());
  finder.arrive(joints, "0,0,0,0,0,0");
  finder.arrive(joints, "");
  Target target;
  for (const auto& [words, contradicted] : {std::pair{"1,0,0,0,0,0", true}, {"0,0,0,1,0,0", false}}) {
    target.hint.configuration = words;
    EXPECT_EQ(!finder.find(arm, target, tool).contradicted_by.empty(), contradicted) << words;
  }
}

/// A VAL3 program that moves to joints and poses one after the other.
struct Application {
  RandomStream stream{7534};
  CommandModel model = erring_model(stream, elbow_arm(stream));
  std::string data{}, moves{};
  int count = 0;

  void add(const std::string& type, const std::string& value, const std::string& motion) {
    const std::string name = "v" + std::to_string(count++);
    data += "<Data name=\"" + name + "\" type=\"" + type + "\">" + value + "</Data>\n";
    moves += motion + '(' + name + ",flange,m)\n";
  }
  void joints(const JointVector& joints) { add("jointRx", joints_line(WrittenIn::val3, joints, 0, 9), "movej"); }
  /// `words`: of shoulder, elbow and wrist.
  void pose(const JointVector& joints, const std::array<std::string, 3>& words, const std::string& motion = "movej") {
    const Eigen::Isometry3d pose = forward(model.nominal.chain, joints);
    std::string value = pose_line(WrittenIn::val3, pose, joints, 0, 9);
    value.insert(value.find(" fatherId"),
                 " shoulder=\"" + words[0] + "\" elbow=\"" + words[1] + "\" wrist=\"" + words[2] + "\"");
    add("pointRx", value, motion);
  }
  CorrectedTarget last(const JointVector& near = {}) const {
    const std::string text = data + "<Program name=\"start\"><Code>begin\n" + moves + "end</Code></Program>\n";
    return correct_program(text, read_program(WrittenIn::val3, text, "p.dtx", model.nominal.chain), model,
                           {.temperature_celsius = 20.0, .near = near})
        .targets.back();
  }
};

const std::array<std::string, 3> kSame{"ssame", "esame", "wsame"};

JointVector wrist_turned_over(JointVector joints) {
  joints[3] -= 3.14159265358979;
  joints[4] *= -1.0;
  joints[5] += 3.14159265358979;
  return joints;
}

void expect_reached(const CorrectedTarget& corrected, const JointVector& joints) {
  ASSERT_EQ(corrected.nominal.size(), joints.size());
  EXPECT_NE(corrected.from, JointsFrom::undetermined);
  for (Eigen::Index i = 0; i < joints.size(); ++i)
    EXPECT_NEAR(wrap_near(corrected.nominal[i] - joints[i], 0.0), 0.0, 1e-6) << i;
}

TEST(Parts, ThatAreKeptStayOnTheirSideHoweverFarTheJointsAre) {
  RandomStream stream{7535};
  for (int i = 0; i < 30; ++i) {
    Application program;
    const JointVector before = told_joints(stream, program.model.nominal.chain);
    JointVector goal = told_joints(stream, program.model.nominal.chain);
    while (sides(goal) != sides(before)) goal = told_joints(stream, program.model.nominal.chain);
    program.joints(before);
    program.pose(goal, kSame);
    expect_reached(program.last(), goal);
  }
  Application near;
  near.joints(wrist_turned_over(standing()) + JointVector::Constant(6, 0.3));
  near.moves += "movej(v0,flange,m)\n";
  near.pose(standing(), kSame);
  expect_reached(near.last(), wrist_turned_over(standing()));
}

TEST(Parts, AreNotKnownWhereNothingTellsTheirSide) {
  Application first;
  first.pose(standing(), kSame);
  EXPECT_EQ(first.last().outcome, CorrectionOutcome::uncorrected);
  expect_reached(first.last(standing() + JointVector::Constant(6, 0.8)), standing());
  Application flat;
  JointVector singular = standing() + JointVector::Constant(6, 0.9);
  singular[4] = 0.0;
  flat.joints(singular);
  flat.pose(standing(), kSame);
  EXPECT_EQ(flat.last().outcome, CorrectionOutcome::uncorrected) << "on which side the wrist is cannot be told";
  Application line;
  line.joints(standing() + JointVector::Constant(6, 0.1));
  line.pose(standing(), kSame, "movel");
  EXPECT_EQ(line.last().from, JointsFrom::line);
}

TEST(Parts, ThatWordsStateAreOnTheSideOfEarlierPosesWithTheseWords) {
  const JointVector near = standing() + JointVector::Constant(6, 0.05);
  const JointVector far = wrist_turned_over(standing()) + JointVector::Constant(6, 0.1);
  for (const std::string wrist : {"wpositive", "wsame", "wfree"}) {
    Application program;
    program.joints(near);
    program.pose(standing(), {"lefty", "epositive", "wpositive"});
    program.joints(far);
    program.pose(standing(), {"lefty", "esame", wrist});
    expect_reached(program.last(), wrist == "wpositive" ? standing() : wrist_turned_over(standing()));
  }
  Application unknown;
  JointVector away = standing();
  away += JointVector::Constant(6, 0.7);
  unknown.joints(away);
  unknown.pose(standing(), {"righty", "epositive", "wsame"});
  EXPECT_EQ(unknown.last().outcome, CorrectionOutcome::uncorrected) << "what righty means is not known";
}

TEST(Parts, OfWhichAnySideWillDoAreThoseOfTheNearestJoints) {
  Application program;
  program.joints(wrist_turned_over(standing()) + JointVector::Constant(6, 0.1));
  program.pose(standing(), {"sfree", "efree", "wfree"});
  expect_reached(program.last(), wrist_turned_over(standing()));
}

}  // namespace
}  // namespace demecal
