#include "closed_calibration/links_alone.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "expression/bound.hpp"
#include "fitting/fit.hpp"
#include "kinematics/chain.hpp"
#include "parameters/declared_model.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline closed_calibration {
namespace {

constexpr int kSampledPoses = 500;

/// Somewhere in what was measured, come to from any side, with any payload of those measured.
Stop sampled_stop(const CalibratedModel& model, RandomStream& random) {
  JointVector q(model.nominal.chain.size());
  ApproachSigns approach(q.size());
  for (int i = 0; i < q.size(); ++i) {
    const auto joint = static_cast<std::size_t>(i);
    const Joint& row = model.nominal.chain.joints[joint];
    const Interval range = model.measured.empty() ? Interval{row.lower, row.upper} : model.measured[joint];
    q[i] = random.real(range.lower, range.upper);
    approach[i] = random.chance(0.5) ? 1.0 : -1.0;
  }
  Stop stop(q);
  stop.approach = approach;
  if (const auto& carried = model.robot.payloads_kg) stop.payload_kg = random.real(carried->lower, carried->upper);
  return stop;
}

LinksAlone compared_links(CorrectedRobot links, const CorrectedRobot& robot, const std::vector<Stop>& stops) {
  LinksAlone alone{std::move(links)};
  for (const Stop& stop : stops) {
    const double lack_m = (robot.predict(stop, "").translation() - alone.links.predict(stop, "").translation()).norm();
    alone.mean_m += lack_m / static_cast<double>(stops.size());
    alone.most_m = std::max(alone.most_m, lack_m);
  }
  return alone;
}

/// What the robot predicts, as if it had been measured in its own base.
DataSet as_predicted_poses(const CalibratedModel& model, const CorrectedRobot& robot, const std::vector<Stop>& stops) {
  DataSet data;
  data.robot = model.nominal;
  data.frame = Frame::base;
  for (const Stop& stop : stops) {
    const Eigen::Isometry3d tool = robot.predict(stop, "");
    MeasuredPose pose;
    pose.joints = stop.joints;
    pose.position_m = tool.translation();
    pose.orientation = Eigen::Quaterniond(tool.linear());
    data.poses.push_back(std::move(pose));
  }
  return data;
}

}  // namespace

LinksAlone links_alone(const CalibratedModel& model, const CorrectedRobot& robot) {
  RandomStream random{1};
  std::vector<Stop> fitted, judged;
  for (int i = 0; i < kSampledPoses; ++i) fitted.push_back(sampled_stop(model, random));
  for (int i = 0; i < kSampledPoses; ++i) judged.push_back(sampled_stop(model, random));
  CorrectedRobot bare = robot;
  bare.effects.clear();
  for (JointCorrection& correction : bare.corrections) correction = {};
  LinksAlone own = compared_links(bare, robot, judged);
  if (own.most_m == 0.0) return own;
  std::vector<std::size_t> all(fitted.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const FitOptions options{.starts = 0, .robust = false, .prior_m = 0.0, .prior_rad = 0.0};
  const Fit fit = fit_declared(as_predicted_poses(model, robot, fitted), all, {.joint_offset = true, .geometry = true},
                               bare, options);
  if (fit.status == FitStatus::too_few_poses) return own;
  LinksAlone nearer = compared_links(fit.robot, robot, judged);
  nearer.fitted = true;
  return nearer.mean_m < own.mean_m ? nearer : own;
}

}  // namespace demecal::inline closed_calibration
