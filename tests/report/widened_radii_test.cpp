// Radii of evaluations: the same that programs state, wider outside of what was measured, which is said.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "made_up_loop.hpp"
#include "report/evaluation.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre, ::testing::HasSubstr, ::testing::IsEmpty, ::testing::Not;

/// Measured within 1 rad with 0 to 5 kg, by poses of a path where `along_path`; its interval has heavy tails.
CalibratedModel measured_model(const DataSet& data, bool along_path = false) {
  CalibratedModel model;
  model.nominal = data.robot;
  model.robot = nominal_robot(data);
  model.robot.payloads_kg = Interval{0.0, 5.0};
  model.measured.assign(model.robot.chain.joints.size(), Interval{-1.0, 1.0});
  model.posterior = Posterior{{{.kind = ParameterId::Kind::link, .index = 1, .link = LinkParameter::theta}},
                              {},
                              Eigen::MatrixXd::Constant(1, 1, 1e-5)};
  model.interval =
      PredictionInterval{.quantile = 2.9, .noise_m = 1e-5, .model_error_m = 2e-5, .along_path = along_path};
  return model;
}

DataSet one_pose(double second_rad, double payload_kg) {
  DataSet data;
  data.robot = made_up_arm();
  data.poses.resize(1);
  data.poses[0].joints = JointVector::Constant(6, 0.3);
  data.poses[0].joints[1] = second_rad;
  data.poses[0].payload_kg = payload_kg;
  data.poses[0].position_m = Eigen::Vector3d(0.1, 0.2, 0.3);
  return data;
}

TEST(Evaluation, StatesTheRadiusOfACorrectedPositionThatProgramsDo) {
  for (const double second_rad : {0.3, 1.4})
    for (const double payload_kg : {2.0, 9.0}) {
      const DataSet data = one_pose(second_rad, payload_kg);
      const CalibratedModel model = measured_model(data);
      const Stop stop(data.poses[0]);
      const std::vector<std::size_t> rows{0};
      const auto stated = uncertainty_of(model, data, rows, {});
      ASSERT_TRUE(stated && stated->expanded_mm);
      EXPECT_NEAR(*stated->expanded_mm,
                  1e3 * real_radius95_m(*model.interval, *model.posterior, model.robot, stop, widening_at(model, stop)),
                  1e-12);
    }
}

TEST(Evaluation, WidensRadiiByPayloadsAndGapsThatWereNotMeasuredAndSaysSo) {
  const DataSet within = one_pose(0.3, 5.0), beyond = one_pose(0.3, 20.0);
  CalibratedModel model = measured_model(within);
  const auto radius_mm = [&](const DataSet& data) {
    return *pose_errors(data, model, model.robot, nullptr)[0].interval95_mm;
  };
  const auto said = [&](const DataSet& data) { return widened_sentences(model, data, std::vector<std::size_t>{0}); };
  const double known_mm = radius_mm(within);
  EXPECT_GT(radius_mm(beyond), 2.0 * known_mm);
  EXPECT_THAT(pose_errors(beyond, model, model.robot, nullptr)[0].flags, ElementsAre("outside_measured"));
  EXPECT_THAT(said(within), IsEmpty());
  EXPECT_THAT(said(beyond),
              ElementsAre("1 of the 1 measurements lies outside of what the model was measured at, and its radius is "
                          "widened by judgement: payload at 20 kg, measured 0 .. 5 kg."));
  model.measured_gaps = {{1, {{0.0, 0.7}}}};
  EXPECT_GT(radius_mm(within), 1.1 * known_mm);
  EXPECT_THAT(said(within), ElementsAre(HasSubstr("joint 2 at 17.2 deg, measured nowhere in 0 .. 40.1 deg")));
  Evaluation evaluation;
  evaluation.widened_by = said(beyond);
  EXPECT_EQ(nlohmann::json::parse(to_json(evaluation))["widened_by"][0], evaluation.widened_by[0]);
}

TEST(Evaluation, WidensRadiiWhereAJumpMayBeOnEitherSideAndSaysSo) {
  const DataSet near = one_pose(0.3, 5.0), far = one_pose(0.4, 5.0);
  CalibratedModel model = measured_model(near);
  model.robot.effects.push_back(
      {.kind = "jump", .joint = 1, .settings = {{"at_rad", 0.29}, {"within_rad", 0.02}}, .values = {0.01}});
  const auto said = [&](const DataSet& data) { return widened_sentences(model, data, std::vector<std::size_t>{0}); };
  EXPECT_THAT(said(far), IsEmpty());
  EXPECT_THAT(said(near),
              ElementsAre("1 of the 1 measurements is so close to a jump that it may be on either side, and "
                          "its radius holds both: joint 2 at 17.2 deg, where it jumps by 10 mrad: on which "
                          "side it is, the poses did not tell."));
  EXPECT_GT(*pose_errors(near, model, model.robot, nullptr)[0].interval95_mm,
            *pose_errors(far, model, model.robot, nullptr)[0].interval95_mm);
}

TEST(PredictionEntry, SaysWherePosesFollowEachOtherAlongAPath) {
  const DataSet data = one_pose(0.3, 1.0);
  EXPECT_THAT(prediction_entry(*measured_model(data, true).interval).remark, HasSubstr("along a path"));
  EXPECT_THAT(prediction_entry(*measured_model(data).interval).remark, Not(HasSubstr("path")));
  const std::vector<std::size_t> rows{0};
  EXPECT_THAT(uncertainty_of(measured_model(data, true), data, rows, {})->remark, HasSubstr("along a path"));
}

}  // namespace
}  // namespace demecal
