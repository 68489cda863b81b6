// Proposed poses: feasible, and more telling than random ones.
#include "decompositions/decompositions.hpp"
#include "next_measurement/next_measurement.hpp"

#include <gtest/gtest.h>

#include <set>

#include "fitting/known_arm.hpp"
#include "laboratory.hpp"
#include "next_measurement/experiments.hpp"

namespace demecal {
namespace {

constexpr int kProposed = 8;

double log_determinant(const Eigen::MatrixXd& covariance) {
  return eigen_system(covariance).values.cwiseMax(1e-30).array().log().sum();
}

Visit visit_of(const Stop& stop) {
  Visit visit{.commanded = stop.joints, .approach = stop.approach, .payload_kg = stop.payload_kg};
  if (visit.approach.size() == 0) visit.approach = ApproachSigns::Zero(stop.joints.size());
  return visit;
}

/// The covariance of the model's numbers, its scales kept, once the stops are measured too.
Eigen::MatrixXd covariance_with(Laboratory& laboratory, DataSet data, const DiagnosedModel& model,
                                const std::vector<Stop>& stops) {
  std::vector<Visit> visits;
  for (const Stop& stop : stops) visits.push_back(visit_of(stop));
  laboratory.measure(data, visits);
  // What stops tell does not depend on how well the model fits them: none is far out.
  for (MeasuredPose& pose : data.poses) pose.position_m = model.robot.predict(Stop(pose), pose.target).translation();
  return linearize(laboratory.diagnosed(data), model).covariance;
}

std::vector<Stop> random_stops(const DiagnosisProblem& problem, RandomStream& random) {
  const FeasiblePoses feasible(problem.data, problem.fitted);
  std::vector<Stop> stops;
  for (int i = 0; i < kProposed; ++i) {
    Stop& stop = stops.emplace_back(feasible.draw(feasible.allowed(), random));
    stop.approach = ApproachSigns(stop.joints.size());
    for (double& sign : stop.approach) sign = random.chance(0.5) ? 1.0 : -1.0;
  }
  return stops;
}

DataSet measured(
    Laboratory& laboratory, int poses, const std::function<void(Visit&)>& change = [](Visit&) {}) {
  DataSet data = laboratory.data_set();
  std::vector<Visit> visits;
  for (int i = 0; i < poses; ++i) change(visits.emplace_back(laboratory.visit()));
  laboratory.measure(data, visits);
  return data;
}

TEST(Proposal, TellsMoreOfTheWholeModelThanRandomPoses) {
  Laboratory laboratory(laden_puma({-150, -20, 45, 200}), 51);
  laboratory.declared.geometry = laboratory.declared.tool = true;
  const DataSet data = measured(laboratory, 25);
  const DiagnosisProblem problem = laboratory.diagnosed(data);
  const DiagnosedModel model = laboratory.model_with(problem, {.kind = "gain", .joint = 3});
  const auto proposed = propose_poses(problem, model, {}, kProposed, RandomStream{1});
  const double best = log_determinant(covariance_with(laboratory, data, model, proposed));
  RandomStream random{2};
  for (int i = 0; i < 20; ++i) {
    EXPECT_LT(best, log_determinant(covariance_with(laboratory, data, model, random_stops(problem, random)))) << i;
  }
}

TEST(Proposal, TellsMoreOfRivalsThanRandomPoses) {
  Laboratory laboratory(laden_puma({-150, -20, 45, 200}), 52);
  const DataSet data =
      measured(laboratory, 25, [](Visit& visit) { visit.commanded[2] = visit.commanded[1] + radians(200.0); });
  const DiagnosisProblem problem = laboratory.diagnosed(data);
  const Effect coupling{.kind = "coupling", .joint = 2, .settings = {{"from", 2}}, .form = "linear", .values = {1e-4}};
  const Effect gain{.kind = "gain", .joint = 2};
  DiagnosedModel model = laboratory.model_with(problem, coupling);
  const AmbiguousEffect ambiguous{coupling, {{gain, 1.0, 0.0}}};
  const auto proposed = propose_poses(problem, model, {ambiguous}, kProposed, RandomStream{1});
  model.robot.effects.push_back(gain);
  model.robot.effects.back().values = {0.0};
  const auto unsure = [&](const std::vector<Stop>& stops) {
    return log_determinant(covariance_with(laboratory, data, model, stops).bottomRightCorner(2, 2));
  };
  const double best = unsure(proposed);
  RandomStream random{2};
  for (int i = 0; i < 20; ++i) EXPECT_LT(best, unsure(random_stops(problem, random))) << i;
}

TEST(Proposal, KeepsToLimitsFloorAndRecordedPayloads) {
  Laboratory laboratory(laden_puma({-150, -20, 45, 200}), 53);
  const DataSet data = measured(laboratory, 40, [i = 0](Visit& visit) mutable { visit.payload_kg = 1.0 + i++ % 2; });
  const DiagnosisProblem problem = laboratory.diagnosed(data);
  const DiagnosedModel model = laboratory.model_with(problem, {.kind = "gain", .joint = 3});
  const auto stops = propose_poses(problem, model, {}, 30, RandomStream{1});
  ASSERT_EQ(stops.size(), 30u);
  const FeasiblePoses feasible(data, problem.fitted);
  double lowest_m = 1e9, lowest_measured_m = 1e9;
  for (const MeasuredPose& pose : data.poses) {
    lowest_measured_m = std::min(lowest_measured_m, tool_position(data.robot.chain, pose.joints).z());
  }
  for (const Stop& stop : stops) {
    for (Eigen::Index i = 0; i < 6; ++i) {
      const Joint& joint = data.robot.chain.joints[static_cast<std::size_t>(i)];
      EXPECT_GT(stop.joints[i], joint.lower);
      EXPECT_LT(stop.joints[i], joint.upper);
      EXPECT_EQ(std::abs(stop.approach[i]), 1.0);
    }
    EXPECT_TRUE(feasible.contains(stop.joints));
    EXPECT_TRUE(stop.payload_kg == 1.0 || stop.payload_kg == 2.0) << stop.payload_kg;
    EXPECT_FALSE(stop.temperature_celsius || stop.time_s);
    lowest_m = std::min(lowest_m, tool_position(data.robot.chain, stop.joints).z());
  }
  EXPECT_GE(lowest_m, lowest_measured_m - 0.05);
}

TEST(Proposal, IsAFunctionOfItsArguments) {
  Laboratory laboratory(laden_puma({-150, -20, 45, 200}), 54);
  const DataSet data = measured(laboratory, 20);
  const DiagnosisProblem problem = laboratory.diagnosed(data);
  const DiagnosedModel model = laboratory.model_with(problem, {.kind = "gain", .joint = 3});
  const auto once = propose_poses(problem, model, {}, 5, RandomStream{1});
  const auto again = propose_poses(problem, model, {}, 5, RandomStream{1});
  const auto more = propose_poses(problem, model, {}, 6, RandomStream{1});
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(once[i].joints, again[i].joints);
    EXPECT_EQ(once[i].joints, more[i].joints);
  }
  EXPECT_TRUE(propose_poses(problem, model, {}, 0, RandomStream{1}).empty());
}

TEST(Proposal, ServesEveryKindOfMeasurement) {
  RandomStream random{55};
  for (const int kind : {0, 1, 2}) {
    KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
    if (kind == 2) arm.data.anchors_m = {{2, 0, 0}, {0, 2, 1}, {-2, 1, 0}, {0, 0, 3}};
    const Instrument instrument{1e-4, 1e-4, kind != 2, kind == 1};
    measure(arm, random, instrument, 15);
    const DeclaredModel declared{.registration = true, .joint_offset = true};
    const DiagnosisProblem problem{arm.data, declared, all_poses(arm.data), {}};
    DiagnosedModel model;
    model.robot = nominal_robot(arm.data);
    model.smooth = smooth_corrections(arm.data, problem.fitted, model.robot, false);
    model.scales = {kind != 2 ? 1e-4 : 0.0, kind == 1 ? 1e-4 : 0.0, kind == 2 ? 1e-4 : 0.0};
    EXPECT_EQ(propose_poses(problem, model, {}, 4, random).size(), 4u) << kind;
  }
}

TEST(FeasiblePoses, StayWithinTheReachThatWasMeasured) {
  Laboratory laboratory(laden_puma({-100, -60, 60, 120}), 56);
  const DataSet data = measured(laboratory, 10);
  std::vector<std::size_t> poses{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  const FeasiblePoses feasible(data, poses);
  double farthest_m = 0.0;
  for (const MeasuredPose& pose : data.poses) {
    EXPECT_TRUE(feasible.contains(pose.joints));
    farthest_m = std::max(farthest_m, tool_position(data.robot.chain, pose.joints).norm());
  }
  RandomStream random{1};
  std::set<double> drawn;
  for (int i = 0; i < 200; ++i) {
    const JointVector joints = feasible.draw(feasible.allowed(), random);
    drawn.insert(joints[0]);
    EXPECT_LE(tool_position(data.robot.chain, joints).norm(), 1.1 * farthest_m);
  }
  EXPECT_GT(drawn.size(), 150u);
}

}  // namespace
}  // namespace demecal
