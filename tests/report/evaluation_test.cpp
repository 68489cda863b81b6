// What a model, or several, do at the poses of a data set, and what a model holds that poses do not let it apply.
#include "report/evaluation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "kinematics/random_arm.hpp"
#include "made_up_comparison.hpp"
#include "made_up_loop.hpp"

namespace demecal {
namespace {

using ::testing::AllOf, ::testing::HasSubstr, ::testing::IsEmpty, ::testing::Not;

DataSet three_poses() {
  DataSet data;
  data.robot = made_up_arm();
  data.poses.resize(3);
  for (MeasuredPose& pose : data.poses) pose.approach = ApproachSigns::Ones(6);
  return data;
}

CorrectedRobot with_backlash() {
  CorrectedRobot robot;
  robot.effects = {made_up_backlash(), made_up_harmonic(2, 9, 1e-4, 0.0)};
  return robot;
}

TEST(UnappliedEffects, AreNoneWherePosesHoldWhatEffectsNeed) {
  EXPECT_THAT(unapplied_effects(with_backlash(), three_poses()), IsEmpty());
}

TEST(UnappliedEffects, NameTheEffectItsNeedAndThePoses) {
  DataSet data = three_poses();
  data.poses[0].approach.reset();
  data.poses[2].approach.reset();
  const std::vector<UnappliedEffect> found = unapplied_effects(with_backlash(), data);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].lacking, "approach");
  EXPECT_EQ(found[0].sentence,
            "backlash of joint 2 cannot be applied as it was calibrated at 2 of 3 poses: they do not state the side "
            "from which joints come, and no side is taken");
}

TEST(UnappliedEffects, StandInTheJsonOfAnEvaluation) {
  DataSet data = three_poses();
  data.poses[1].approach.reset();
  const std::vector<UnappliedEffect> found = unapplied_effects(with_backlash(), data);
  const nlohmann::json written =
      nlohmann::json::parse(to_json(Evaluation{{}, {}, {}, found, {}}))["effects_not_applied"];
  ASSERT_EQ(written.size(), 1u);
  EXPECT_EQ(written[0]["kind"], "backlash");
  EXPECT_EQ(written[0]["joint"], 2);
  EXPECT_EQ(written[0]["poses"], 1);
  EXPECT_EQ(written[0]["lacking"], "approach");
}

/// `poses` accept poses with a radius of 0.1 mm, each of `targets` targets, of which the first `inside` poses keep to
/// it.
IntervalCoverage coverage(int poses, int inside, int targets) {
  std::vector<PoseErrorEntry> entries;
  for (int i = 0; i < poses * targets; ++i)
    entries.push_back(
        {"P" + std::to_string(i / targets), "", "accept", {}, i / targets < inside ? 0.05 : 0.2, 0.1, {}});
  entries.push_back({"other", "", "validation", {}, 9.0, 0.1, {}});
  return coverage_of(entries);
}

TEST(BeyondRadii, IsSaidOnlyWhereChanceHardlyDoesIt) {
  EXPECT_THAT(beyond_radii_sentence(coverage(40, 30, 1)), HasSubstr("Only 30 of 40 accept poses lie within"));
  EXPECT_THAT(beyond_radii_sentence(coverage(40, 36, 1)), IsEmpty());
  EXPECT_THAT(beyond_radii_sentence(coverage(40, 40, 1)), IsEmpty());
  EXPECT_THAT(beyond_radii_sentence(coverage(0, 0, 1)), IsEmpty());
  EXPECT_THAT(beyond_radii_sentence(coverage(20, 0, 1)), HasSubstr("Only 0 of 20"));
}

TEST(BeyondRadii, AreSaidOfOnePoseThatIsFarOff) {
  const auto of_errors = [](std::initializer_list<double> after_mm) {
    std::vector<PoseErrorEntry> entries(after_mm.size());
    std::ranges::transform(after_mm, entries.begin(), [](double error_mm) {
      PoseErrorEntry entry;
      entry.set = "accept";
      entry.after_mm = error_mm;
      entry.interval95_mm = 0.2;
      return entry;
    });
    return beyond_radii_sentence(entries);
  };
  EXPECT_THAT(of_errors({1.1}), HasSubstr("Only 0 of 1 accept poses"));
  EXPECT_THAT(of_errors({0.9}), IsEmpty());
  EXPECT_THAT(of_errors({1100.0, 0.3}), IsEmpty()) << "one of two may be a gross error";
}

TEST(BeyondRadii, CountsTheTargetsOfOnePoseOnce) {
  EXPECT_THAT(beyond_radii_sentence(coverage(15, 12, 3)), IsEmpty());
  EXPECT_THAT(beyond_radii_sentence(coverage(45, 36, 1)), HasSubstr("Only 36 of 45"));
}

TEST(BeyondRadii, IsSaidOfTheFirstSetThatItHoldsOf) {
  std::vector<PoseErrorEntry> entries;
  for (int i = 0; i < 40; ++i) entries.push_back({"A" + std::to_string(i), "", "accept", {}, 0.05, 0.1, {}});
  EXPECT_THAT(beyond_radii_sentence(entries), IsEmpty());
  for (int i = 0; i < 40; ++i) entries.push_back({"C" + std::to_string(i), "", "calibration", {}, 0.2, 0.1, {}});
  EXPECT_THAT(beyond_radii_sentence(entries), HasSubstr("Only 0 of 40 calibration poses"));

  Evaluation evaluation{{}, entries, {}, {}, {}};
  evaluation.beyond_radii = beyond_radii_sentence(entries);
  EXPECT_EQ(nlohmann::json::parse(to_json(evaluation))["beyond_radii"], evaluation.beyond_radii);
}

TEST(EvaluationJson, StandsOnOneLineWithAllSets) {
  const ErrorBySet errors = made_up_report().after;
  const std::string text = to_json(Evaluation{errors, {}, {}, {}, {}});
  EXPECT_EQ(text.find('\n'), text.size() - 1);
  const nlohmann::json written = nlohmann::json::parse(text);
  EXPECT_EQ(written["error_mm"]["calibration"]["mean"], *errors.calibration.mean_mm);
  EXPECT_EQ(written["error_mm"]["calibration"]["max"], *errors.calibration.max_mm);
  EXPECT_EQ(written["error_mm"]["validation"]["rms"], *errors.validation.rms_mm);
  EXPECT_EQ(written["error_mm"]["validation"]["p95"], *errors.validation.p95_mm);
  EXPECT_TRUE(written["error_mm"]["accept"]["max"].is_null());
}

TEST(Comparison, HoldsItsFiguresInJsonAndNullWhereThereAreNone) {
  const auto json = nlohmann::json::parse(to_json(two_methods()));
  EXPECT_EQ(json["demecal_comparison"], 1);
  EXPECT_EQ(json["poses"]["validation"], 20);
  EXPECT_EQ(json["methods"][0]["error_mm"]["validation"]["mean"], 5.25);
  EXPECT_EQ(json["methods"][0]["parameters"], 81);
  EXPECT_TRUE(json["methods"][0]["error_mm"]["accept"]["rms"].is_null());
  EXPECT_TRUE(json["methods"][1]["error_mm"]["calibration"]["max"].is_null());
}

TEST(FollowEachOther, PosesOfAPathDoAndScatteredOnesDoNot) {
  RandomStream stream{6101};
  for (int trial = 0; trial < 20; ++trial) {
    DataSet scattered, path;
    scattered.robot.chain = path.robot.chain = random_arm(stream, 6, Convention::standard_dh);
    JointVector from = random_joints(stream, path.robot.chain), to = from;
    for (int i = 0; i < 60; ++i) {
      MeasuredPose pose;
      pose.joints = random_joints(stream, scattered.robot.chain);
      scattered.poses.push_back(pose);
      scattered.poses.push_back(pose);  // a repeat is no step
      if (i % 6 == 0) {
        from = to;
        to = random_joints(stream, path.robot.chain);
      }
      pose.joints = from + (i % 6) / 6.0 * (to - from);
      path.poses.push_back(pose);
    }
    EXPECT_FALSE(follow_each_other(scattered));
    EXPECT_TRUE(follow_each_other(path));
  }
}

/// Calibration poses that touch a contact with these joints each.
DataSet touching(const std::vector<std::pair<std::string, JointVector>>& touches) {
  RandomStream random{81};
  DataSet data;
  data.robot.chain = random_arm(random, 6, Convention::standard_dh);
  for (const auto& [contact, joints] : touches) {
    MeasuredPose pose;
    pose.joints = joints;
    pose.contact = contact;
    data.poses.push_back(pose);
  }
  return data;
}

TEST(ContactNotes, SayWhereEverythingWasTouchedAtOnePlace) {
  const JointVector here = JointVector::Constant(6, 0.3), there = JointVector::Constant(6, -0.9);
  const JointVector near = JointVector::Constant(6, 0.31);
  const auto notes = [](const DataSet& data) {
    std::string all;
    for (const std::string& note : contact_notes(data, nominal_robot(data), {}, {})) all += note + '\n';
    return all;
  };
  EXPECT_THAT(notes(touching({{"a", here}, {"a", near}})), HasSubstr("touch one contact"));
  EXPECT_THAT(notes(touching({{"a", here}, {"b", near}})), HasSubstr("judged at one place"));
  const DataSet apart = touching({{"a", here}, {"b", there}});
  ASSERT_GT(
      (nominal_robot(apart).predict(here, "").translation() - nominal_robot(apart).predict(there, "").translation())
          .norm(),
      0.2);
  EXPECT_THAT(notes(apart), AllOf(Not(HasSubstr("touch one contact")), Not(HasSubstr("judged at one place"))));
  const JointVector between = JointVector::Constant(6, -0.3);
  DataSet wide = touching({{"a", here}, {"a", there}, {"a", between}, {"b", near}, {"b", there}, {"b", between}});
  for (MeasuredPose& pose : wide.poses) pose.contact_kind = ContactKind::plane;
  for (const char* plane : {"a", "b"}) wide.contacts.forms[plane].kind = ContactKind::plane;
  EXPECT_THAT(notes(wide), Not(HasSubstr("judged at one place")));
}

TEST(ContactNotes, CallNoLengthUnfittedThatOtherPosesTouchAgain) {
  const JointVector here = JointVector::Constant(6, 0.3), there = JointVector::Constant(6, -0.9);
  const DataSet data = touching({{"a", here}, {"b", there}});
  const auto entry = [](const std::string& one, const std::string& other, const std::string& set) {
    return LengthErrorEntry{
        .between = {one, other}, .set = set, .known_mm = 50.0, .sigma_mm = 0.05, .before_mm = {}, .error_mm = 0.1};
  };
  const auto says = [&](const std::vector<LengthErrorEntry>& lengths) {
    const auto notes = contact_notes(data, nominal_robot(data), lengths, {"calibration"});
    return std::ranges::any_of(notes, [](const std::string& note) {
      return note.find("that nothing was fitted to: off by 0.100 mm (rms of 1,") != std::string::npos;
    });
  };
  EXPECT_TRUE(says({entry("a", "b", "calibration"), entry("c", "d", "accept")}));
  EXPECT_TRUE(says({entry("a", "b", "calibration"), entry("b", "a", "accept"), entry("c", "d", "accept")}));
  EXPECT_FALSE(says({entry("a", "b", "calibration"), entry("b", "a", "accept")}));
}

TEST(ContactNotes, NameWiresWhoseZeroIsElsewhere) {
  RandomStream random{82};
  std::vector<std::pair<std::string, JointVector>> pulls;
  for (int i = 0; i < 40; ++i)
    pulls.emplace_back("wire", JointVector::NullaryExpr(6, [&] { return random.real(-1.0, 1.0); }));
  DataSet data = touching(pulls);
  data.contacts.forms["wire"] = {ContactKind::sphere, {}};
  for (const double off_m : {2e-4, -4e-3}) {
    for (MeasuredPose& pose : data.poses) {
      pose.contact_kind = ContactKind::sphere;
      pose.contact_length_m =
          (touch_of(nominal_robot(data), pose).point_m - Eigen::Vector3d(3.0, 1.0, 2.0)).norm() + off_m;
    }
    std::string all;
    for (const std::string& note : contact_notes(data, nominal_robot(data), {}, {})) all += note + '\n';
    EXPECT_EQ(all.find("'wire' 4.0 mm too short") != std::string::npos, off_m == -4e-3) << all;
    EXPECT_EQ(all.find("Wires read") != std::string::npos, off_m == -4e-3) << all;
  }
}

TEST(WorkspaceError, HasNoFiguresWhereOneContactAloneWasTouched) {
  const JointVector here = JointVector::Constant(6, 0.3), there = JointVector::Constant(6, -0.9);
  const WorkspaceEntry figures{0.1, 0.2, true};
  const auto of_one = without_figures_of_one_contact(figures, touching({{"a", here}, {"a", there}}));
  ASSERT_TRUE(of_one);
  EXPECT_FALSE(of_one->rms_mm || of_one->p95_mm);
  EXPECT_TRUE(of_one->beside_base) << "the stages are named by it";
  EXPECT_TRUE(workspace_sentence(*of_one).empty());
  EXPECT_EQ(without_figures_of_one_contact(figures, touching({{"a", here}, {"b", there}}))->rms_mm, 0.1);
  DataSet measured = touching({{"a", here}, {"a", there}});
  measured.poses.front().position_m = Eigen::Vector3d::Zero();
  EXPECT_EQ(without_figures_of_one_contact(figures, measured)->rms_mm, 0.1);
}

}  // namespace
}  // namespace demecal
