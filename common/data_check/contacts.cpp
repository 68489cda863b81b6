#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data/stated_radius.hpp"
#include "data_check/searches.hpp"
#include "data_check/touched_contacts.hpp"
#include "kinematics/chain.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"
#include "trials/finding.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "effects/arm_state.hpp"
#include "fitting/fit.hpp"
#include "kinematics/units.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"
#include "trials/explanations.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kImplausible_m = 5e-3;  ///< of the median pose: no arm leaves so much once its links are fitted
constexpr double kNoContact_m = 1e-2;    ///< the same of the poses of one contact
constexpr double kApart_m = 2e-2;        ///< of the median pose with links as described

DeclaredModel declared_for(const DataSet& data, std::size_t poses) {
  const DeclaredModel all{.registration = true, .tool = true, .joint_offset = true, .geometry = true};
  return 3 * poses > 2 * free_parameters(data, all).size() ? all : DeclaredModel{.registration = true, .tool = true};
}

/// Tool and links as the calibration poses have them; nothing where they are too few.
std::optional<Fit> fitted_arm(const DataSet& data) {
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  const Fit fit = fit_declared(data, poses, declared_for(data, poses.size()), nominal_robot(data));
  if (fit.status == FitStatus::too_few_poses) return std::nullopt;
  return fit;
}

double median_tool_error_m(const DataSet& data, const CorrectedRobot& robot) {
  return median(tool_errors_m(robot, data, poses_of(data, PoseSet::calibration)));
}

/// The same of the contact whose poses are farthest apart.
double most_apart_m(const DataSet& data, const CorrectedRobot& robot) {
  double most_m = 0.0;
  for (const auto& [group, poses] : contact_groups(data))
    if (group.set == PoseSet::calibration) most_m = std::max(most_m, median(tool_errors_m(robot, data, poses)));
  return most_m;
}

/// How far the tool points of the calibration poses are from their middle, root mean square: an arm that is read to
/// move less has everything nearer together.
double spread_of_points_m(const DataSet& data, const CorrectedRobot& robot) {
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(poses.size()));
  for (std::size_t i = 0; i < poses.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) = touch_of(robot, data.poses[poses[i]]).point_m;
  return std::sqrt((points.colwise() - points.rowwise().mean()).squaredNorm() / static_cast<double>(poses.size()));
}

/// The same data with joints read in another way.
DataSet with_joints_read(const DataSet& data, const Explanation& reading) {
  Trial trial{.chain = data.robot.chain, .tools_m = {}, .rows = {}};
  for (const MeasuredPose& pose : data.poses)
    trial.rows.push_back({.joints = pose.joints, .point_m = Eigen::Vector3d::Zero()});
  reading.apply(trial);
  DataSet changed = data;
  changed.robot.chain = trial.chain;
  for (std::size_t i = 0; i < trial.rows.size(); ++i) changed.poses[i].joints = trial.rows[i].joints;
  return changed;
}

/// How joints are read where the nominal arm then holds the poses together far better, of the way that they go.
std::optional<Finding> other_reading(const DataSet& data, const CorrectedRobot& as_given, double as_given_m) {
  constexpr double kExplains = 0.3;
  double best_share = kExplains * as_given_m / spread_of_points_m(data, as_given), best_m = as_given_m;
  std::optional<Explanation> best;
  for (Explanation& reading : whole_set_explanations(data.robot.chain)) {
    const DataSet changed = with_joints_read(data, reading);
    const std::optional<CorrectedRobot> robot = stiff_arm(changed);
    if (!robot) continue;
    const double left_m = median_tool_error_m(changed, *robot);
    const double share = left_m / spread_of_points_m(changed, *robot);
    if (!(share < best_share && left_m < as_given_m)) continue;
    best_share = share;
    best_m = left_m;
    best = std::move(reading);
  }
  if (!best) return std::nullopt;
  return Finding{.kind = best->kind,
                 .joint = best->joint,
                 .as_given_mm = millimetres(as_given_m),
                 .if_changed_mm = millimetres(best_m),
                 .sentence = "The poses that touch one contact agree if " + best->clause + " " +
                             before_and_after(as_given_m, best_m) + ". Correct the data or the robot file."};
}

Finding of_other_robot(double as_given_m) {
  return {.kind = FindingKind::other_robot,
          .as_given_mm = millimetres(as_given_m),
          .sentence = fmt::format(
              "Poses that touch one contact are predicted {} from their middle even with all links fitted: the joint "
              "angles are not of this robot, the joints are in another order or unit, or rows name the wrong contacts.",
              distance_text(as_given_m))};
}

/// A contact that its touches are nowhere near, those that `found` names left out, whatever else agrees by `robot`.
std::optional<Finding> scattered_contact(const DataSet& data, const CorrectedRobot& robot,
                                         const std::vector<Finding>& found) {
  TouchedContacts touched(data, robot, {});
  for (std::size_t pose = 0; pose < data.poses.size(); ++pose)
    for (const Finding& one : found)
      if (std::ranges::count(one.poses, data.poses[pose].pose_id) > 0) touched.leave_out(pose);
  for (const auto& [group, poses] : touched.groups()) {
    if (group.set != PoseSet::calibration || touched.kept(group).size() < 2) continue;
    std::vector<double> distances_m;
    const ContactPlace place = touched.place(group);
    for (const std::size_t pose : touched.kept(group)) distances_m.push_back(touched.distance_m(place, pose));
    const double left_m = median(std::move(distances_m));
    if (left_m <= kNoContact_m) continue;
    return Finding{.kind = FindingKind::wrong_kind,
                   .as_given_mm = millimetres(left_m),
                   .sentence = fmt::format(
                       "Calibration poses that touch '{0}' lie {1} from one {2} (median) even with all links fitted, "
                       "which no arm does whose other contacts agree: '{0}' is of another kind, or rows name the wrong "
                       "contacts. State it under contacts.kinds, or correct the names.",
                       group.contact, distance_text(left_m), to_string(touched.kind_of(group)))};
  }
  return std::nullopt;
}

/// The far touches of a ball, by `robot`: at most one in four of many that lie ten times as far from the middle of most
/// as the middle touch does, which no ball is long enough for, or twenty times as far off the sphere.
std::vector<std::size_t> far_touches(const TouchedContacts& touched, const ContactGroup& group,
                                     const CorrectedRobot& robot) {
  constexpr std::size_t kMany = 12, kFewOf = 4;
  constexpr double kOffMiddle = 10.0, kOffSphere = 20.0;
  const std::vector<std::size_t>& poses = touched.groups().at(group);
  if (touched.kind_of(group) != ContactKind::sphere || poses.size() < kMany) return {};
  const DataSet& data = touched.data();
  if (std::ranges::any_of(poses, [&](std::size_t pose) { return data.poses[pose].contact_length_m > 0.0; })) return {};
  const ContactPlace place = touched.place(group);
  Eigen::Vector3d middle_m;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> along_m;
    for (const std::size_t pose : poses) along_m.push_back(touch_of(robot, data.poses[pose]).point_m[axis]);
    middle_m[axis] = median(std::move(along_m));
  }
  std::vector<double> away_m, off_m;
  for (const std::size_t pose : poses) {
    away_m.push_back((touch_of(robot, data.poses[pose]).point_m - middle_m).norm());
    off_m.push_back(touched.distance_m(place, pose));
  }
  const double most_away_m = kOffMiddle * median(away_m), most_off_m = kOffSphere * median(off_m);
  std::vector<std::size_t> far;
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (away_m[i] > most_away_m || off_m[i] > most_off_m) far.push_back(poses[i]);
  return kFewOf * far.size() <= poses.size() ? far : std::vector<std::size_t>{};
}

/// The data without touches that are as far from their ball as another one is: they would bend the arm by which they
/// and all others are judged.
DataSet without_far_touches(DataSet data) {
  const CorrectedRobot robot = nominal_robot(data);
  const TouchedContacts touched(data, robot, {});
  std::set<std::string> far;
  for (const auto& [group, poses] : touched.groups())
    for (const std::size_t pose : far_touches(touched, group, robot)) far.insert(data.poses[pose].pose_id);
  std::erase_if(data.poses, [&](const MeasuredPose& pose) { return far.contains(pose.pose_id); });
  return data;
}

}  // namespace

std::optional<CorrectedRobot> stiff_arm(const DataSet& data) {
  DataSet free = data;
  free.contacts.distances.clear();
  free.contacts.angles.clear();
  const Fit fit = fit_declared(free, poses_of(data, PoseSet::calibration), {.registration = true, .tool = true},
                               nominal_robot(data));
  if (fit.status == FitStatus::too_few_poses) return std::nullopt;
  return fit.robot;
}

std::vector<Finding> check_contacts(const DataSet& all) {
  if (!has_contacts(all)) return {};
  const DataSet data = without_far_touches(all);
  if (const std::optional<CorrectedRobot> stiff = stiff_arm(data)) {
    if (auto computed = find_computed_contacts(data, *stiff)) return {std::move(*computed)};
    const double apart_m = median_tool_error_m(data, *stiff);
    if (most_apart_m(data, *stiff) > kNoContact_m)
      if (auto exchanged = find_exchanged_contacts(data)) return {std::move(*exchanged)};
    std::vector<Finding> kinds = find_wrong_kinds(data);
    if (apart_m < kApart_m && !kinds.empty()) return kinds;  // where most agree joints are read as they are meant
    if (most_apart_m(data, *stiff) > kApart_m)
      if (auto reading = other_reading(data, *stiff, apart_m)) return {std::move(*reading)};
    if (!kinds.empty()) return kinds;
    if (auto angles = find_wrong_angles(data, *stiff); !angles.empty()) return angles;
    if (apart_m < kApart_m)
      if (auto wrong = find_wrong_lengths(data, *stiff, apart_m); !wrong.empty()) return wrong;
  }
  std::vector<Finding> radii = find_disagreeing_radii(data);
  DataSet known = data;  // a wrong radius would bend the arm that poses are judged by
  if (!radii.empty())
    std::erase_if(known.contacts.distances,
                  [](const KnownDistance& one) { return is_radius(one) && !is_wire_zero(one); });
  const std::optional<Fit> fit = fitted_arm(known);
  if (!fit) return radii;
  const double left_m = median_tool_error_m(data, fit->robot);
  if (left_m > kImplausible_m) return {of_other_robot(left_m)};
  std::vector<Finding> found = find_wrong_contacts(all, fit->robot);
  if (auto scattered = scattered_contact(data, fit->robot, found)) return {std::move(*scattered)};
  std::ranges::move(radii, std::back_inserter(found));
  return found;
}

}  // namespace demecal::inline data_check
