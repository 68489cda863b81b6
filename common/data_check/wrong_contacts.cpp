#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data_check/searches.hpp"
#include "kinematics/units.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"
#include "trials/finding.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kFar = 8.0;       ///< deviations beyond which no noise goes
constexpr double kLeast_m = 3e-4;  ///< what a ball's play may be
constexpr double kThere = 0.3;     ///< of the error: how far off the contact may be that a pose touches instead

/// A pose far from the contact that it names, at another one.
struct WrongPose {
  std::size_t pose = 0;
  std::string fits;
  double error_m = 0.0, elsewhere_m = 0.0;
};

/// The poses that say what they touch, and where the robot predicts them.
class ContactSearch {
 public:
  /// Poses from where a contact moved are a group of their own.
  ContactSearch(const DataSet& data, const CorrectedRobot& robot, const std::vector<MovedContact>& moved)
      : data_(data), groups_(contact_groups(data)) {
    for (const MovedContact& one : moved) {
      std::vector<std::size_t>& before = groups_.at(one.group);
      before.resize(before.size() - one.from_there.size());
      groups_[{one.group.contact + " once moved", one.group.set}] = one.from_there;
    }
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
    name_lone_poses(all);
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

  /// A pose that alone of its set touches a point, and the nearest point that others touch.
  struct LonePose {
    std::size_t pose = 0;
    std::string nearest{};
    double away_m = std::numeric_limits<double>::infinity();
  };

  LonePose lone_pose(const ContactGroup& group) const {
    LonePose lone{.pose = groups_.at(group).front()};
    for (const auto& [other, others] : groups_) {
      if (other.contact == group.contact || others.size() < 2) continue;
      if (data_.contacts.form_of(other.contact).kind != ContactKind::point) continue;
      const double away_m = contact_residual(place_without(other, std::nullopt), touches_[lone.pose]).norm();
      if (away_m < lone.away_m) lone = {lone.pose, other.contact, away_m};
    }
    return lone;
  }

  /// Whether a known length needs the contact: then one touch tells what it is there for.
  bool ends_length(const std::string& contact) const {
    return std::ranges::any_of(data_.contacts.distances, [&](const KnownDistance& known) {
      return known.first == contact || known.second == contact;
    });
  }

  /// Poses that are alone at the contact they name: by themselves where they are at another one, the rest set by set.
  void name_lone_poses(std::vector<Finding>& all) const {
    std::map<PoseSet, std::vector<std::size_t>> elsewhere;
    for (const auto& [group, members] : groups_) {
      if (members.size() > 1 || data_.contacts.form_of(group.contact).kind != ContactKind::point) continue;
      const LonePose lone = lone_pose(group);
      if (lone.away_m < far_m_) {
        all.push_back(misnamed(lone));
      } else if (!ends_length(group.contact)) {
        elsewhere[group.set].push_back(lone.pose);
      }
    }
    for (const auto& [set, poses] : elsewhere) all.push_back(touched_once(set, poses));
  }

  Finding misnamed(const LonePose& lone) const {
    const MeasuredPose& pose = data_.poses[lone.pose];
    return {.kind = FindingKind::wrong_contact,
            .poses = {pose.pose_id},
            .if_changed_mm = millimetres(lone.away_m),
            .sentence = fmt::format("Line {}{} alone of the {} poses touches '{}': nothing can be told of it. Nearest "
                                    "is '{}', {} away: correct the name, or exclude the pose.",
                                    pose.line, name_beside_line(pose), to_string(pose.set), pose.contact, lone.nearest,
                                    distance_text(lone.away_m))};
  }

  Finding touched_once(PoseSet set, const std::vector<std::size_t>& poses) const {
    const MeasuredPose& first = data_.poses[poses.front()];
    Finding finding{.kind = FindingKind::wrong_contact};
    for (const std::size_t pose : poses) finding.poses.push_back(data_.poses[pose].pose_id);
    finding.sentence = fmt::format("Line {}{} alone of the {} poses touches '{}'", first.line, name_beside_line(first),
                                   to_string(set), first.contact);
    if (poses.size() > 1) finding.sentence += fmt::format(", and so do {} more at theirs", poses.size() - 1);
    finding.sentence +=
        ": nothing can be told of what is touched once. Touch it in more poses, correct the name, or "
        "exclude the pose.";
    return finding;
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
  const std::vector<MovedContact> moved = find_moved_contacts(data, robot);
  std::vector<Finding> found = ContactSearch(data, robot, moved).findings();
  for (const MovedContact& one : moved) found.push_back(of_moved_contact(data, one));
  return found;
}

}  // namespace demecal::inline data_check
