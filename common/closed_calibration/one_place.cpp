#include "closed_calibration/one_place.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "decompositions/decompositions.hpp"
#include "diagnosis/outcome.hpp"
#include "effects/arm_state.hpp"
#include "parameters/posterior.hpp"
#include "prediction/measurement.hpp"
#include "random/random_purpose.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline closed_calibration {
namespace {

constexpr double kAway_m = 0.3;  ///< of the second place
constexpr std::uint64_t kPlacesSeed = 1;

double workspace_rms_m(const Posterior& posterior, double model_error_m, const CorrectedRobot& robot,
                       const std::vector<Interval>& measured) {
  const PredictionInterval interval{.model_error_m = model_error_m};
  return workspace_error(posterior, interval, robot, measured, false,
                         RandomStream{kPlacesSeed, number_of(RandomPurpose::workspace_places)})
      .rms_m;
}

/// Joints near those of the pose at which the tool point is moved by `away_m`; nothing where the arm does not get
/// there.
std::optional<JointVector> joints_moved(const CorrectedRobot& robot, const Chain& chain, const MeasuredPose& pose,
                                        const Eigen::Vector3d& away_m) {
  constexpr int kSteps = 40;
  constexpr double kDamping = 1e-6, kLongest_rad = 0.3, kThere_m = 1e-7;
  const Eigen::Vector3d goal_m = robot.predict(Stop(pose), pose.target).translation() + away_m;
  Stop stop(pose);
  for (int step = 0; step < kSteps; ++step) {
    const PoseAndJacobian now = robot.predict_with_jacobian(stop, pose.target);
    const Eigen::Vector3d left_m = goal_m - now.pose.translation();
    if (left_m.norm() < kThere_m) break;
    const Eigen::MatrixXd rows = now.jacobian.topRows<3>();
    Eigen::MatrixXd square = rows * rows.transpose();
    square.diagonal().array() += kDamping;
    Eigen::VectorXd change = rows.transpose() * PivotedCholesky(square).solve(left_m);
    const double longest = change.cwiseAbs().maxCoeff();
    if (longest > kLongest_rad) change *= kLongest_rad / longest;
    stop.joints += change;
  }
  if ((goal_m - robot.predict(stop, pose.target).translation()).norm() > kThere_m) return std::nullopt;
  for (int joint = 0; joint < chain.size(); ++joint) {
    const Joint& link = chain.joints[static_cast<std::size_t>(joint)];
    if (stop.joints[joint] < link.lower || stop.joints[joint] > link.upper) return std::nullopt;
  }
  return stop.joints;
}

std::string name_elsewhere(const std::string& contact) {
  return contact + " elsewhere";
}

/// The data with these poses once more at the same contacts moved by `away_m`, each as far off its contact as it is;
/// nothing where fewer than `kReached` of them get there.
std::optional<DataSet> with_second_place(const DataSet& data, const CorrectedRobot& robot,
                                         const std::vector<std::size_t>& poses, const Eigen::Vector3d& away_m) {
  constexpr double kReached = 0.8;
  DataSet both = data;
  for (const std::size_t pose : poses) {
    const std::optional<JointVector> joints = joints_moved(robot, data.robot.chain, data.poses[pose], away_m);
    if (!joints) continue;
    MeasuredPose moved = data.poses[pose];
    moved.joints = *joints;
    moved.contact = name_elsewhere(moved.contact);
    both.poses.push_back(std::move(moved));
  }
  if (static_cast<double>(both.poses.size() - data.poses.size()) < kReached * static_cast<double>(poses.size()))
    return std::nullopt;
  for (const auto& [contact, form] : data.contacts.forms) both.contacts.forms[name_elsewhere(contact)] = form;
  for (KnownDistance known : data.contacts.distances) {
    known.first = name_elsewhere(known.first);
    if (!known.second.empty()) known.second = name_elsewhere(known.second);
    both.contacts.distances.push_back(std::move(known));
  }
  return both;
}

/// Links of which `both` leaves half the standard deviation and less, most gained first.
std::vector<ParameterId> links_gained(const Posterior& one, const Posterior& both) {
  constexpr double kHalf = 0.5;
  std::vector<std::pair<double, ParameterId>> gained;
  for (std::size_t i = 0; i < one.ids.size(); ++i) {
    const auto same = std::ranges::find(both.ids, one.ids[i]);
    if (one.ids[i].kind != ParameterId::Kind::link || same == both.ids.end()) continue;
    const double share =
        both.factor.row(same - both.ids.begin()).norm() / one.factor.row(static_cast<Eigen::Index>(i)).norm();
    if (share < kHalf) gained.emplace_back(share, one.ids[i]);
  }
  std::ranges::stable_sort(gained, {}, [](const auto& entry) { return entry.first; });
  std::vector<ParameterId> links;
  for (auto& [share, id] : gained) links.push_back(std::move(id));
  return links;
}

}  // namespace

std::vector<Eigen::Vector3d> touched_places_m(const DataSet& data, const CorrectedRobot& robot) {
  const CorrectedRobot placed = with_own_contacts(robot, data);
  std::vector<Eigen::Vector3d> places_m;
  for (const auto& [group, poses] : contact_groups(data, poses_of(data, PoseSet::calibration))) {
    const ContactPlace& place = placed.contacts.at(group);
    const bool on_wire = data.poses[poses.front()].contact_length_m > 0.0;
    if (on_wire || place.kind == ContactKind::plane || place.kind == ContactKind::line)
      for (const std::size_t pose : poses) places_m.push_back(touch_of(robot, data.poses[pose]).point_m);
    else
      places_m.push_back(place.frame.translation());
  }
  return places_m;
}

std::optional<double> one_place_m(const DataSet& data, const CorrectedRobot& robot) {
  constexpr double kOnePlace_m = 0.2;
  if (has_instrument(data)) return std::nullopt;
  const std::vector<Eigen::Vector3d> places_m = touched_places_m(data, robot);
  double apart_m = 0.0;
  for (const Eigen::Vector3d& one_m : places_m)
    for (const Eigen::Vector3d& other_m : places_m) apart_m = std::max(apart_m, (one_m - other_m).norm());
  return places_m.empty() || apart_m > kOnePlace_m ? std::nullopt : std::optional(apart_m);
}

void take_back_unjudged(const DataSet& data, LoopResult& found) {
  constexpr double kLeastShare = 0.5;
  const auto is_added = [](const Round& round) { return round.verdict == Verdict::added; };
  const auto reads_wire = [](const MeasuredPose& pose) { return pose.contact_length_m > 0.0; };
  const auto first = std::ranges::find_if(found.outcome.rounds, is_added);
  if (first == found.outcome.rounds.end() || std::ranges::any_of(data.poses, reads_wire)) return;
  if (!one_place_m(data, found.before.robot)) return;
  const std::vector<std::size_t> validation = poses_of(data, PoseSet::validation);
  const std::vector<std::size_t> poses = validation.empty() ? poses_of(data, PoseSet::calibration) : validation;
  const double before_mm = error_figures(found.before.robot, data, poses).rms_mm;
  const double after_mm = error_figures(found.model.robot, data, poses).rms_mm;
  if (after_mm * after_mm < (1.0 - kLeastShare) * before_mm * before_mm) return;
  found.outcome.p_structure_left = first->p_structure;
  found.outcome.independent_m = found.before.scales[kPosition];
  for (Round& round : found.outcome.rounds) {
    if (!is_added(round)) continue;
    round.verdict = Verdict::rejected;
    round.reason = "judged at one place alone, where the effects explain less than half of the squared error";
  }
  found.model = found.before;
  found.best.reset();
  found.front = {};
}

std::optional<SecondPlace> second_place(const DataSet& data, const CalibratedModel& model,
                                        const std::vector<std::size_t>& poses) {
  if (!model.posterior || !model.interval || model.measured.empty()) return std::nullopt;
  const double model_error_m = model.interval->model_error_m;
  std::optional<SecondPlace> best;
  for (int direction = 0; direction < 6; ++direction) {
    const Eigen::Vector3d away_m = (direction % 2 == 0 ? kAway_m : -kAway_m) * Eigen::Vector3d::Unit(direction / 2);
    const std::optional<DataSet> both = with_second_place(data, model.robot, poses, away_m);
    if (!both) continue;
    std::vector<std::size_t> all = poses;
    for (std::size_t pose = data.poses.size(); pose < both->poses.size(); ++pose) all.push_back(pose);
    const Posterior posterior = fitted_posterior(*both, model.declared, model.robot, all).posterior;
    const double both_m = workspace_rms_m(posterior, model_error_m, model.robot, model.measured);
    if (best && best->both_m <= both_m) continue;
    best = SecondPlace{away_m, workspace_rms_m(*model.posterior, model_error_m, model.robot, model.measured), both_m,
                       links_gained(*model.posterior, posterior)};
  }
  return best;
}

}  // namespace demecal::inline closed_calibration
