#include <fmt/format.h>
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <ranges>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data_check/searches.hpp"
#include "data_check/touched_contacts.hpp"
#include "kinematics/units.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "trials/finding.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kThere = 0.3;        ///< of the error: how far off the contact may be that a pose touches instead
constexpr double kTouching_m = 5e-3;  ///< farther off no pose touches a contact, whatever its own does
constexpr double kMuchNearer = 10.0;  ///< how many times farther out than noise goes a pose is that touches a surface

/// A pose far from the contact that it names, at another one.
struct WrongPose {
  std::size_t pose = 0;
  std::string fits;
  double error_m = 0.0, elsewhere_m = 0.0;
};

/// A pose far from the contact that it names, and others (of few) that may be wrong in its place.
struct UnseatedPose {
  std::size_t pose = 0;
  std::vector<std::size_t> instead{};
  double error_m = 0.0, distance_m = 0.0;
};

/// The poses that say what they touch, against where the robot predicts them.
class ContactSearch {
 public:
  explicit ContactSearch(TouchedContacts touched)
      : touched_(std::move(touched)), data_(touched_.data()), far_m_(touched_.far_m()) {}

  std::vector<Finding> findings() {
    std::vector<Finding> all;
    while (const std::optional<WrongPose> wrong = worst_at_another()) {
      all.push_back(named(*wrong));
      touched_.leave_out(wrong->pose);
    }
    name_lone_poses(all);
    std::vector<UnseatedPose> unseated;
    for (const auto& [group, members] : touched_.groups())
      while (const std::optional<UnseatedPose> worst = worst_unseated(group)) {
        touched_.leave_out(worst->pose);
        for (const std::size_t pose : worst->instead) touched_.leave_out(pose);
        unseated.push_back(*worst);
      }
    // Many that are far out are no mistakes of a few poses, but of the arm: backlash that nobody declared, say.
    std::vector<double> errors_m;
    for (const UnseatedPose& one : unseated) errors_m.push_back(one.error_m);
    for (const auto& [group, members] : touched_.groups())
      std::ranges::copy(touched_.errors_m(group), std::back_inserter(errors_m));
    const double unseated_m = std::max(far_m_, gross_error_limit(errors_m));
    for (const UnseatedPose& one : unseated)
      if (one.error_m > unseated_m) all.push_back(one.instead.empty() ? touching_nothing(one) : one_of_few(one));
    return all;
  }

  /// The poses at another contact than they name.
  std::set<std::size_t> wrong_poses() {
    std::set<std::size_t> poses;
    while (const std::optional<WrongPose> wrong = worst_at_another()) {
      poses.insert(wrong->pose);
      touched_.leave_out(wrong->pose);
    }
    return poses;
  }

  /// Without the poses that were found to be wrong.
  const TouchedContacts& touched() const { return touched_; }

 private:
  /// Of the poses that lie far from their own contact and at another one, the one that gains most.
  std::optional<WrongPose> worst_at_another() const {
    std::optional<WrongPose> worst;
    for (const auto& [group, members] : touched_.groups()) {
      const std::vector<std::size_t> poses = touched_.kept(group);
      const std::vector<double> errors_m = touched_.errors_m(group);
      // Where the place is not the middle of most, a wrong pose draws it from others.
      const double least_m =
          touched_.kind_of(group) == ContactKind::point
              ? far_m_
              : std::max(far_m_, 0.5 * std::ranges::max(errors_m.empty() ? std::vector{0.0} : errors_m));
      for (std::size_t i = 0; i < poses.size(); ++i) {
        if (!(errors_m[i] > least_m)) continue;
        const double error_m = touched_.distance_m(group, poses[i]);
        for (const auto& [other, others] : touched_.groups()) {
          if (other.contact == group.contact) continue;
          const double elsewhere_m = touched_.distance_m(touched_.place(other), poses[i]);
          if (!touches_instead(other, error_m, elsewhere_m)) continue;
          if (!worst || error_m - elsewhere_m > worst->error_m - worst->elsewhere_m)
            worst = WrongPose{poses[i], TouchedContacts::name_of(other), error_m, elsewhere_m};
        }
      }
    }
    return worst;
  }

  /// Whether a pose that lies so far from its own contact and from another touches that one. Surfaces, which are met by
  /// chance too, have to be touched by enough others to know where they are.
  bool touches_instead(const ContactGroup& other, double error_m, double elsewhere_m) const {
    if (touched_.kind_of(other) == ContactKind::point)
      return elsewhere_m < kThere * error_m && elsewhere_m < std::max(kTouching_m, far_m_);
    const std::vector<double> errors_m = touched_.errors_m(other);
    return error_m > kMuchNearer * far_m_ && elsewhere_m < far_m_ &&
           std::ranges::any_of(errors_m, [](double one) { return one > 0.0; }) && std::ranges::max(errors_m) < far_m_;
  }

  /// The pose that spoils its contact most, if one lies far out of it; and those without which the others agree as
  /// well.
  std::optional<UnseatedPose> worst_unseated(const ContactGroup& group) const {
    const std::vector<double> errors_m = touched_.errors_m(group);
    if (errors_m.empty()) return std::nullopt;
    UnseatedPose worst{.error_m = std::ranges::max(errors_m)};
    if (!(worst.error_m > far_m_)) return std::nullopt;
    worst.pose = most_spoiling(group, errors_m);
    worst.distance_m = touched_.distance_m(group, worst.pose);
    if (!agree_without(group, worst.pose)) return worst;
    for (const std::size_t other : touched_.kept(group))
      if (other != worst.pose && agree_without(group, other)) worst.instead.push_back(other);
    return worst;
  }

  /// The farthest from a point. Of other places that without which the others agree best: few touches turn a plane
  /// over to come near one that is far off.
  std::size_t most_spoiling(const ContactGroup& group, const std::vector<double>& errors_m) const {
    const std::vector<std::size_t> poses = touched_.kept(group);
    if (touched_.kind_of(group) == ContactKind::point)
      return poses[static_cast<std::size_t>(std::ranges::max_element(errors_m) - errors_m.begin())];
    const auto left_m2 = [&](std::size_t pose) {
      double sum = 0.0;
      for (const double one_m : touched_.errors_m(group, pose)) sum += one_m * one_m;
      return sum;
    };
    return *std::ranges::min_element(poses, {}, left_m2);
  }

  bool agree_without(const ContactGroup& group, std::size_t pose) const {
    return std::ranges::none_of(touched_.errors_m(group, pose), [this](double one_m) { return one_m > far_m_; });
  }

  /// A pose that alone of its set touches a point, and the nearest point that others touch.
  struct LonePose {
    std::size_t pose = 0;
    std::string nearest{};
    double away_m = std::numeric_limits<double>::infinity();
  };

  LonePose lone_pose(const ContactGroup& group) const {
    LonePose lone{.pose = touched_.groups().at(group).front()};
    for (const auto& [other, others] : touched_.groups()) {
      if (other.contact == group.contact || others.size() < 2) continue;
      if (touched_.kind_of(other) != ContactKind::point) continue;
      const double away_m = touched_.distance_m(touched_.place(other), lone.pose);
      if (away_m < lone.away_m) lone = {lone.pose, TouchedContacts::name_of(other), away_m};
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
    for (const auto& [group, members] : touched_.groups()) {
      if (members.size() > 1 || touched_.kind_of(group) != ContactKind::point) continue;
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
                                    "is {}, {} away: correct the name, or exclude the pose.",
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
            .sentence = fmt::format("Line {}{} names contact '{}', but lies {} from it and {} from {}: most likely "
                                    "it touched {}. Correct the name, or exclude the pose.",
                                    pose.line, name_beside_line(pose), pose.contact, distance_text(wrong.error_m),
                                    distance_text(wrong.elsewhere_m), wrong.fits, wrong.fits)};
  }

  Finding touching_nothing(const UnseatedPose& one) const {
    const MeasuredPose& pose = data_.poses[one.pose];
    return {.kind = FindingKind::outlier,
            .poses = {pose.pose_id},
            .as_given_mm = millimetres(one.distance_m),
            .sentence = fmt::format("Line {}{} lies {} from contact '{}', where the others agree within {}: the tool "
                                    "was not seated, or its joint values belong to another moment.",
                                    pose.line, name_beside_line(pose), distance_text(one.distance_m), pose.contact,
                                    distance_text(far_m_))};
  }

  Finding one_of_few(const UnseatedPose& one) const {
    const MeasuredPose& pose = data_.poses[one.pose];
    Finding finding{.kind = FindingKind::outlier, .poses = {pose.pose_id}, .as_given_mm = millimetres(one.distance_m)};
    std::vector<std::size_t> lines{pose.line};
    for (const std::size_t other : one.instead) {
      finding.poses.push_back(data_.poses[other].pose_id);
      lines.push_back(data_.poses[other].line);
    }
    std::ranges::sort(lines);
    finding.sentence = fmt::format(
        "Of lines {} one at least does not fit contact '{}' (by {}): without it the others agree within {}, and too "
        "few "
        "{} poses touch it to tell which. The tool was not seated, or joint values belong to another moment: measure "
        "them again, or exclude them.",
        fmt::join(lines, ", "), pose.contact, distance_text(one.distance_m), distance_text(far_m_),
        to_string(pose.set));
    return finding;
  }

  TouchedContacts touched_;
  const DataSet& data_;
  double far_m_;
};

}  // namespace

std::vector<Finding> find_wrong_contacts(const DataSet& data, const CorrectedRobot& robot) {
  if (!has_contacts(data)) return {};
  const std::set<std::size_t> wrong = ContactSearch(TouchedContacts(data, robot, {})).wrong_poses();
  const std::vector<MovedContact> moved = find_moved_contacts(data, robot, wrong);
  ContactSearch search(TouchedContacts(data, robot, moved));
  std::vector<Finding> found = search.findings();
  for (const MovedContact& one : moved) found.push_back(of_moved_contact(data, one));
  for (Finding& uneven : find_uneven_planes(search.touched(), robot)) {
    const auto of_plane = [&](const std::string& pose) { return std::ranges::count(uneven.poses, pose) > 0; };
    std::erase_if(found, [&](const Finding& one) {  // its rim is no mistake of the poses there
      return one.kind == FindingKind::outlier && std::ranges::all_of(one.poses, of_plane);
    });
    found.push_back(std::move(uneven));
  }
  return found;
}

}  // namespace demecal::inline data_check
