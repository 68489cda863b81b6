#include "data_check/searches.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "data_check/explanations.hpp"
#include "data_check/trial_fit.hpp"
#include "effects/arm_state.hpp"
#include "fitting/fit.hpp"
#include "kinematics/units.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kImplausible_m = 5e-3;  ///< of the median pose: no arm leaves so much once its links are fitted
constexpr double kApart_m = 2e-2;        ///< the same with links as described
constexpr double kFar = 8.0;             ///< deviations beyond which no noise goes
constexpr double kLeast_m = 3e-4;        ///< what a ball's play may be
constexpr double kThere = 0.3;           ///< of the error: how far off the contact may be that a pose touches instead

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

/// The nominal arm with its tool where the calibration poses have it: known lengths have no say, since an arm whose
/// links may bend would follow wrong ones.
std::optional<Fit> stiff_arm(const DataSet& data) {
  DataSet free = data;
  free.contacts.distances.clear();
  const Fit fit = fit_declared(free, poses_of(data, PoseSet::calibration), {.registration = true, .tool = true},
                               nominal_robot(data));
  if (fit.status == FitStatus::too_few_poses) return std::nullopt;
  return fit;
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

/// How joints are read where the nominal arm then holds the poses together far better.
std::optional<Finding> other_reading(const DataSet& data, double as_given_m) {
  constexpr double kExplains = 0.3;
  double best_m = kExplains * as_given_m;
  std::optional<Explanation> best;
  for (Explanation& reading : whole_set_explanations(data.robot.chain)) {
    const DataSet changed = with_joints_read(data, reading);
    const std::optional<Fit> fit = stiff_arm(changed);
    const double left_m = fit ? median_tool_error_m(changed, fit->robot) : best_m;
    if (!(left_m < best_m)) continue;
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

/// A pose far from the contact that it names, at another one.
struct WrongPose {
  std::size_t pose = 0;
  std::string fits;
  double error_m = 0.0, elsewhere_m = 0.0;
};

/// The poses that say what they touch, and where the robot predicts them.
class ContactSearch {
 public:
  ContactSearch(const DataSet& data, const CorrectedRobot& robot) : data_(data), groups_(contact_groups(data)) {
    for (const MeasuredPose& pose : data.poses)
      touches_.push_back(pose.contact.empty() ? Touch{Eigen::Vector3d::Zero()} : touch_of(robot, pose));
    std::vector<double> errors_m;
    for (const auto& [group, members] : groups_) {
      if (members.size() < 2) continue;
      const ContactPlace place = place_without(group, std::nullopt);
      for (const std::size_t pose : members) errors_m.push_back(contact_residual(place, touches_[pose]).norm());
    }
    if (!errors_m.empty()) far_m_ = std::max(kLeast_m, kFar * median(errors_m) / normal_length_quantile(3, 0.5));
  }

  std::vector<Finding> findings() {
    std::vector<Finding> all;
    while (const std::optional<WrongPose> wrong = worst_at_another()) {
      all.push_back(named(*wrong));
      left_out_.push_back(wrong->pose);
    }
    std::vector<std::pair<std::size_t, double>> left;
    std::vector<double> errors_m;
    for (const auto& [group, members] : groups_) {
      for (const std::size_t pose : members) {
        if (std::ranges::find(left_out_, pose) != left_out_.end()) continue;
        left.emplace_back(pose, error_at(group, pose));
        errors_m.push_back(left.back().second);
      }
    }
    // Many that are far out are no mistakes of a few poses, but of the arm: backlash that nobody declared, say.
    const double unseated_m = std::max(far_m_, gross_error_limit(errors_m));
    for (const auto& [pose, error_m] : left)
      if (error_m > unseated_m) all.push_back(touching_nothing(pose, error_m));
    return all;
  }

 private:
  /// Where the group's poses but one have the contact; of points the median along each axis, which few cannot move.
  ContactPlace place_without(const ContactGroup& group, std::optional<std::size_t> without) const {
    std::vector<Touch> touches;
    for (const std::size_t pose : groups_.at(group)) {
      const bool out = std::ranges::find(left_out_, pose) != left_out_.end() || pose == without;
      if (!out) touches.push_back(touches_[pose]);
    }
    if (touches.empty()) touches.push_back(touches_[groups_.at(group).front()]);
    ContactPlace place = contact_place(data_.contacts.form_of(group.contact), touches);
    if (place.kind != ContactKind::point) return place;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> along;
      for (const Touch& touch : touches) along.push_back(touch.point_m[axis]);
      place.frame.translation()[axis] = median(along);
    }
    return place;
  }

  double error_at(const ContactGroup& group, std::size_t pose) const {
    return contact_residual(place_without(group, pose), touches_[pose]).norm();
  }

  /// Of the poses that lie far from their own contact and at another one, the one that gains most.
  std::optional<WrongPose> worst_at_another() const {
    std::optional<WrongPose> worst;
    for (const auto& [group, members] : groups_) {
      if (members.size() < 2) continue;
      for (const std::size_t pose : members) {
        if (std::ranges::find(left_out_, pose) != left_out_.end()) continue;
        const double error_m = error_at(group, pose);
        if (!(error_m > far_m_)) continue;
        for (const auto& [other, others] : groups_) {
          if (other == group || data_.poses[others.front()].contact_kind != ContactKind::point) continue;
          if (other.contact == group.contact) continue;
          const double elsewhere_m = contact_residual(place_without(other, std::nullopt), touches_[pose]).norm();
          if (elsewhere_m > kThere * error_m) continue;
          if (!worst || error_m - elsewhere_m > worst->error_m - worst->elsewhere_m)
            worst = WrongPose{pose, other.contact, error_m, elsewhere_m};
        }
      }
    }
    return worst;
  }

  Finding named(const WrongPose& wrong) const {
    const MeasuredPose& pose = data_.poses[wrong.pose];
    return {.kind = FindingKind::wrong_contact,
            .poses = {pose.pose_id},
            .as_given_mm = millimetres(wrong.error_m),
            .if_changed_mm = millimetres(wrong.elsewhere_m),
            .sentence = fmt::format("Line {}{} names contact '{}', but lies {} from it and {} from '{}': most likely "
                                    "it touched '{}'. Correct the name, or exclude the pose.",
                                    pose.line, name_beside_line(pose), pose.contact, distance_text(wrong.error_m),
                                    distance_text(wrong.elsewhere_m), wrong.fits, wrong.fits)};
  }

  Finding touching_nothing(std::size_t index, double error_m) const {
    const MeasuredPose& pose = data_.poses[index];
    return {.kind = FindingKind::outlier,
            .poses = {pose.pose_id},
            .as_given_mm = millimetres(error_m),
            .sentence = fmt::format("Line {}{} lies {} from contact '{}', where the others agree within {}: the tool "
                                    "was not seated, or its joint values belong to another moment.",
                                    pose.line, name_beside_line(pose), distance_text(error_m), pose.contact,
                                    distance_text(far_m_))};
  }

  const DataSet& data_;
  std::map<ContactGroup, std::vector<std::size_t>> groups_;
  std::vector<Touch> touches_;
  std::vector<std::size_t> left_out_;
  double far_m_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::vector<Finding> find_wrong_contacts(const DataSet& data, const CorrectedRobot& robot) {
  if (!has_contacts(data)) return {};
  return ContactSearch(data, robot).findings();
}

std::vector<Finding> check_contacts(const DataSet& data) {
  if (!has_contacts(data)) return {};
  if (const std::optional<Fit> stiff = stiff_arm(data)) {
    const double apart_m = median_tool_error_m(data, stiff->robot);
    if (apart_m > kApart_m)
      if (auto reading = other_reading(data, apart_m)) return {std::move(*reading)};
    if (apart_m < kApart_m)
      if (auto wrong = find_wrong_lengths(data, stiff->robot, apart_m); !wrong.empty()) return wrong;
  }
  const std::optional<Fit> fit = fitted_arm(data);
  if (!fit) return {};
  const double left_m = median_tool_error_m(data, fit->robot);
  if (left_m > kImplausible_m) return {of_other_robot(left_m)};
  return find_wrong_contacts(data, fit->robot);
}

}  // namespace demecal::inline data_check
