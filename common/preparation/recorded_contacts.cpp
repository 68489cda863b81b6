#include "preparation/recorded_contacts.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>

#include "data/read_poses.hpp"
#include "errors/check.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "preparation/touched_places.hpp"
#include "random/distributions.hpp"

namespace demecal::inline preparation {
namespace {

constexpr double kMoved_m = 2e-4;  ///< of a tool in a socket: more is no standing
constexpr double kMovedSigmas = 4.0;
constexpr std::size_t kLeastPostures = 4;  ///< of a contact: any two places have a middle
constexpr double kOtherPosture = 0.0175;   ///< rad or m
constexpr double kFarOut = 3.0;            ///< times the scatter of the others there
constexpr double kNearlyAsNear = 2.0;      ///< another contact within that many times the own distance
constexpr double kSurelyThere_m = 5e-3;

using Indices = std::vector<std::size_t>;

Eigen::Vector3d median_point(const std::vector<Eigen::Vector3d>& points_m) {
  Eigen::Vector3d centre;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Eigen::Vector3d& point_m : points_m) values.push_back(point_m[axis]);
    centre[axis] = median(std::move(values));
  }
  return centre;
}

/// Root mean square distance, by the median one of a normal cloud.
double robust_scatter_m(const std::vector<Eigen::Vector3d>& points_m, const Eigen::Vector3d& centre_m) {
  const double of_median = std::sqrt(3.0) / normal_length_quantile(3, 0.5);
  std::vector<double> distances_m;
  for (const Eigen::Vector3d& point_m : points_m) distances_m.push_back((point_m - centre_m).norm());
  return of_median * median(std::move(distances_m));
}

bool same_posture(const JointVector& one, const JointVector& other) {
  return (one - other).cwiseAbs().maxCoeff() < kOtherPosture;
}

class RecordingSearch {
 public:
  explicit RecordingSearch(const Recordings& recordings) : recordings_(recordings), arm_(recordings.robot.chain) {}

  RecordedContacts run() {
    for (std::size_t log = 0; log < recordings_.logs.size(); ++log) add_log(log);
    place_tool();
    group();
    if (kept_.empty()) fail_without_contacts();
    judge_in_contacts();
    name_contacts();
    check_names(recordings_, found_);
    std::vector<std::optional<std::size_t>> contact_of_group(groups_.groups);
    for (const auto& [group, kept] : number_of_group_) contact_of_group[group] = order_.at(kept);
    found_.notes = grouping_notes(recordings_, found_, groups_, contact_of_group);
    return std::move(found_);
  }

 private:
  void add_log(std::size_t log) {
    StandstillSearch search = find_standstills(recordings_.logs[log], recordings_.standing, arm_);
    found_.noise.push_back(search.noise);
    std::vector<JudgedStandstill> all;
    for (Standstill& at : search.found) all.push_back({.at = std::move(at)});
    for (Standstill& at : search.too_short) all.push_back({.at = std::move(at), .standing = Standing::too_short});
    std::ranges::sort(all, {}, [](const JudgedStandstill& one) { return one.at.first_line; });
    std::vector<MeasuredPose> poses;
    for (JudgedStandstill& one : all) {
      one.at.log = log;
      MeasuredPose& pose = poses.emplace_back();
      pose.joints = one.at.joints;
      pose.line = one.at.first_line;
      found_.standstills.push_back(std::move(one));
    }
    check_joint_limits(poses, arm_, recordings_.logs[log].file);
  }

  /// Takes the tool point by which most of them agree, and leaves out those whose tool went on.
  void place_tool() {
    std::vector<Eigen::Isometry3d> flanges;
    for (const JudgedStandstill& one : found_.standstills)
      if (one.standing != Standing::too_short) flanges.push_back(forward(arm_, one.at.joints));
    found_.tool_m = flanges.size() > kLeastPostures ? common_tool_point(flanges, arm_.tool_m) : arm_.tool_m;
    Chain arm = arm_;
    arm.tool_m = found_.tool_m;
    for (JudgedStandstill& one : found_.standstills) {
      one.place_m = tool_position(arm, one.at.joints);
      const Eigen::MatrixXd slopes = joint_jacobian(arm, one.at.joints, arm.tool_m).topRows(3);
      one.moved_m = (slopes * one.at.drift).norm();
      const double noise_m = (slopes * one.at.drift_sigma.asDiagonal()).norm();
      const bool went_on = one.moved_m > std::max(kMoved_m, kMovedSigmas * noise_m);
      if (went_on && one.standing != Standing::too_short) one.standing = Standing::moving;
    }
  }

  std::vector<Eigen::Vector3d> places_of(const Indices& standstills) const {
    std::vector<Eigen::Vector3d> places_m;
    for (const std::size_t i : standstills) places_m.push_back(found_.standstills[i].place_m);
    return places_m;
  }

  std::size_t postures_of(const Indices& standstills) const {
    std::vector<JointVector> postures;
    for (const std::size_t i : standstills) {
      const JointVector& joints = found_.standstills[i].at.joints;
      if (std::ranges::none_of(postures, [&](const JointVector& other) { return same_posture(joints, other); }))
        postures.push_back(joints);
    }
    return postures.size();
  }

  void group() {
    for (std::size_t i = 0; i < found_.standstills.size(); ++i)
      if (found_.standstills[i].standing == Standing::alone) grouped_.push_back(i);
    if (grouped_.size() < kLeastPostures) return;
    groups_ = group_places(places_of(grouped_), recordings_.gap_m);
    std::vector<Indices> members(groups_.groups);
    for (std::size_t i = 0; i < grouped_.size(); ++i) members[groups_.group_of[i]].push_back(grouped_[i]);
    for (std::size_t group = 0; group < members.size(); ++group) {
      const std::size_t postures = postures_of(members[group]);
      if (postures == 1 && members[group].size() > 1)
        for (const std::size_t i : members[group]) found_.standstills[i].standing = Standing::one_posture;
      if (postures < kLeastPostures) continue;
      number_of_group_[group] = kept_.size();
      kept_.push_back(members[group]);
    }
  }

  [[noreturn]] void fail_without_contacts() const {
    const InputError::Where where{recordings_.logs.front().file, 0};
    std::size_t stood = 0, moving = 0;
    for (const JudgedStandstill& one : found_.standstills) {
      stood += one.standing == Standing::too_short ? 0 : 1;
      moving += one.standing == Standing::moving ? 1 : 0;
    }
    const double fastest_deg_per_s = degrees(found_.noise.front().fastest.maxCoeff());
    if (stood == 0)
      throw InputError(where, "",
                       fmt::format("the arm stands nowhere for {} s: every joint must be slower than {:.2g} deg/s "
                                   "(mm/s where it slides) that long. Hold it still at every touch, or set "
                                   "log.still_s or log.still_deg_per_s",
                                   recordings_.standing.least_s, fastest_deg_per_s));
    throw InputError(
        where, "",
        fmt::format("holds {} standstills (in {} the tool went on by more than {} mm), but no place that it "
                    "came to in {} postures or more: touch each point in many postures and hold still; "
                    "where places are nearer or farther apart than the arm's errors suggest, set "
                    "log.gap_mm",
                    stood, moving, millimetres(kMoved_m), kLeastPostures));
  }

  /// Sets contact and distance of every standstill, and leaves out those that their contact is not surely of.
  void judge_in_contacts() {
    std::vector<Eigen::Vector3d> centres_m;
    std::vector<double> scatters_m;
    for (const Indices& members : kept_) {
      centres_m.push_back(median_point(places_of(members)));
      scatters_m.push_back(robust_scatter_m(places_of(members), centres_m.back()));
    }
    std::map<std::size_t, std::size_t> own;
    for (std::size_t contact = 0; contact < kept_.size(); ++contact)
      for (const std::size_t i : kept_[contact]) own[i] = contact;
    for (std::size_t i = 0; i < found_.standstills.size(); ++i) {
      JudgedStandstill& one = found_.standstills[i];
      const auto nearest = nearest_of(centres_m, one.place_m, own.contains(i) ? std::optional(own[i]) : std::nullopt);
      if (!own.contains(i)) {
        one.contact = nearest->first;
        one.from_contact_m = nearest->second;
        continue;
      }
      one.contact = own[i];
      one.from_contact_m = (one.place_m - centres_m[own[i]]).norm();
      one.standing = Standing::touches;
      if (one.from_contact_m < kSurelyThere_m) continue;
      if (one.from_contact_m > kFarOut * scatters_m[own[i]]) one.standing = Standing::far_out;
      if (nearest && nearest->second < kNearlyAsNear * one.from_contact_m) one.standing = Standing::between_contacts;
    }
  }

  static std::optional<std::pair<std::size_t, double>> nearest_of(const std::vector<Eigen::Vector3d>& centres_m,
                                                                  const Eigen::Vector3d& place_m,
                                                                  const std::optional<std::size_t>& except) {
    std::optional<std::pair<std::size_t, double>> nearest;
    for (std::size_t contact = 0; contact < centres_m.size(); ++contact) {
      const double apart_m = (centres_m[contact] - place_m).norm();
      if (contact != except && (!nearest || apart_m < nearest->second)) nearest = {contact, apart_m};
    }
    return nearest;
  }

  /// Numbers contacts by the first pose that touches them.
  void name_contacts() {
    std::map<std::size_t, std::size_t> number;
    for (const JudgedStandstill& one : found_.standstills)
      if (one.standing == Standing::touches) number.emplace(*one.contact, number.size());
    for (std::size_t contact = 0; contact < kept_.size(); ++contact) number.emplace(contact, number.size());
    for (JudgedStandstill& one : found_.standstills) one.contact = number.at(*one.contact);
    order_ = number;
    const auto& names = recordings_.names;
    for (std::size_t contact = 0; contact < kept_.size(); ++contact)
      found_.contacts.push_back({.name = contact < names.size() ? names[contact] : letters(contact)});
    for (std::size_t contact = 0; contact < kept_.size(); ++contact) measure(contact);
    for (RecordedContact& one : found_.contacts) {
      for (const RecordedContact& other : found_.contacts) {
        const double apart_m = (one.place_m - other.place_m).norm();
        if (&one != &other && apart_m < one.nearest_m.value_or(std::numeric_limits<double>::infinity()))
          one.nearest_m = apart_m;
      }
    }
  }

  /// A to Z, AA, AB, ...
  static std::string letters(std::size_t number) {
    constexpr std::size_t kLetters = 26;
    std::string text;
    for (std::size_t rest = number + 1; rest > 0; rest = (rest - 1) / kLetters)
      text.insert(text.begin(), static_cast<char>('A' + (rest - 1) % kLetters));
    return text;
  }

  void measure(std::size_t contact) {
    RecordedContact& measured = found_.contacts[contact];
    std::vector<Eigen::Vector3d> places_m;
    for (const JudgedStandstill& one : found_.standstills)
      if (one.standing == Standing::touches && one.contact == contact) places_m.push_back(one.place_m);
    measured.poses = places_m.size();
    for (const Eigen::Vector3d& place_m : places_m) measured.place_m += place_m / static_cast<double>(places_m.size());
    double squares_m2 = 0.0;
    for (const Eigen::Vector3d& place_m : places_m) squares_m2 += (place_m - measured.place_m).squaredNorm();
    measured.scatter_m = places_m.empty() ? 0.0 : std::sqrt(squares_m2 / static_cast<double>(places_m.size()));
  }

  const Recordings& recordings_;
  const Chain& arm_;
  RecordedContacts found_;
  Indices grouped_;
  PlaceGroups groups_;
  std::map<std::size_t, std::size_t> number_of_group_, order_;
  std::vector<Indices> kept_;
};

}  // namespace

RecordedContacts find_contacts(const Recordings& recordings) {
  DEMECAL_CHECK(!recordings.logs.empty(), "no log");
  return RecordingSearch(recordings).run();
}

}  // namespace demecal::inline preparation
