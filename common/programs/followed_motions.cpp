#include "programs/followed_motions.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <ranges>
#include <set>
#include <type_traits>
#include <utility>

#include "kinematics/chain.hpp"
#include "parsed_programs/arrivals.hpp"
#include "parsed_programs/orientation.hpp"
#include "programs/nominal_joints.hpp"

namespace demecal::inline programs {
namespace {

/// What is known of the arm behind a motion.
struct ArmKnowledge {
  std::optional<JointVector> joints{};
  std::string words{};    ///< that state their configuration
  AddedToJoints added{};  ///< by their correction
  ApproachSigns signs{};
  bool about = false;  ///< it is near these joints: they tell its posture, and no side of the next motion
  bool operator==(const ArmKnowledge&) const = default;
};

constexpr double kMoved = 2e-3;  ///< rad or m: a joint that changes by less has not moved

/// A joint that turns back by more has left the side that it came from. Far above what is rounded where corrected
/// numbers are written, far below what joints lose.
constexpr double kTurnsBack = 5e-6;  ///< rad or m

/// Takes the signs of a motion to these joints, and that the arm is there.
void arrive_at(const JointVector& joints, const AddedToJoints& added, const std::string& words, ArmKnowledge& arm) {
  const bool tells_sides = arm.joints && !arm.about;
  if (!tells_sides) arm.signs.setZero();
  for (Eigen::Index i = 0; i < joints.size() && tells_sides; ++i) {
    const double change = joints[i] - (*arm.joints)[i];
    if (std::abs(change) >= kMoved) arm.signs[i] = change > 0.0 ? 1.0 : -1.0;
    const double least = change + added.least[i] - arm.added.most[i],
                 most = change + added.most[i] - arm.added.least[i];
    if (std::min(arm.signs[i] * least, arm.signs[i] * most) < -kTurnsBack) arm.signs[i] = 0.0;
  }
  arm.joints = joints;
  arm.added = added;
  arm.words = words;
  arm.about = false;
}

bool same_joints(const JointVector& one, const JointVector& other) {
  constexpr double kSameJoints = 1e-6;  ///< rad or m
  return (one - other).cwiseAbs().maxCoeff() <= kSameJoints;
}

/// Leaves what is known on both paths.
void keep_common(const ArmKnowledge& other, ArmKnowledge& arm) {
  if (!arm.joints || !other.joints || !same_joints(*arm.joints, *other.joints) || arm.words != other.words) {
    arm.joints.reset();
    arm.words.clear();
  }
  arm.added.take_in(other.added.least);
  arm.added.take_in(other.added.most);
  arm.about = arm.about || other.about;
  for (Eigen::Index i = 0; i < arm.signs.size(); ++i) {
    if (arm.signs[i] != other.signs[i]) arm.signs[i] = 0.0;
  }
}

/// Takes in what another path finds.
void merge_found(const Configurations& other, Configurations& found) {
  if (other.joints.empty()) return;
  if (found.joints.empty()) {
    found = other;
    return;
  }
  for (const JointVector& joints : other.joints) {
    const auto known = [&](const JointVector& one) { return same_joints(one, joints); };
    if (std::ranges::none_of(found.joints, known)) found.joints.push_back(joints);
  }
  if (found.joints.size() > 1) found.from = JointsFrom::undetermined;
  if (found.contradicted_by.empty()) found.contradicted_by = other.contradicted_by;
}

class ArmFollower {
 public:
  ArmFollower(const Program& program, const CommandModel& model, const Circumstances& circumstances,
              const std::vector<AddedToJoints>& added)
      : program_(program),
        model_(model),
        circumstances_(circumstances),
        added_(added),
        arrivals_(arrivals(program)),
        last_(middle_joints(model)),
        finder_(circumstances.near, middle_joints(model)) {
    nowhere_.signs.setZero(last_.size());
    nowhere_.added = {JointVector::Zero(last_.size()), JointVector::Zero(last_.size())};
    for (std::size_t i = 0; i < program.targets.size(); ++i) {
      const Target& target = program.targets[i];
      visits_.push_back({.order = target.order, .target = i, .near = target.near_motions.contains(target.order)});
      for (const std::size_t order : target.further_motions) visits_.push_back({order, i, true});
      for (const auto& [order, place] : target.near_motions)
        if (order != target.order) visits_.push_back({order, i, true, true});
    }
    std::ranges::stable_sort(visits_, {}, &TargetVisit::order);
    for (std::size_t i = 0; i < visits_.size(); ++i) begins_.try_emplace(visits_[i].order, i);
    for (const auto& [motion, origins] : arrivals_) {
      for (const std::size_t origin : origins) followers_[origin].insert(motion);
    }
  }

  std::vector<TargetVisit> visits() {
    std::set<std::size_t> due;
    for (const auto& [motion, begin] : begins_) due.insert(motion);
    while (!due.empty()) {
      const std::size_t motion = *due.begin();
      due.erase(due.begin());
      if (!follow(motion)) continue;
      const std::set<std::size_t>& next = followers_[motion];
      due.insert(next.begin(), next.end());
    }
    const auto counts = [this](const TargetVisit& visit) {
      return !visit.near || visit.order == program_.targets[visit.target].order;
    };
    std::erase_if(visits_, std::not_fn(counts));
    return std::move(visits_);
  }

 private:
  /// Follows the motion, coming from where it is known to come from; whether what is known behind it has changed.
  bool follow(std::size_t motion) {
    const std::vector<ArmKnowledge> origins = origins_of(motion);
    if (origins.empty()) return false;
    std::optional<ArmKnowledge> behind;
    for (const ArmKnowledge& origin : origins) {
      const ArmKnowledge end = moved(motion, origin, !behind);
      behind ? keep_common(end, *behind) : static_cast<void>(behind = end);
    }
    const auto [before, fresh] = behind_.try_emplace(motion, *behind);
    if (fresh) return true;
    keep_common(before->second, *behind);
    if (*behind == before->second) return false;
    before->second = *behind;
    return true;
  }

  /// What is known of the arm before the motion, on each path that was followed so far.
  std::vector<ArmKnowledge> origins_of(std::size_t motion) const {
    const std::vector<std::size_t>& from = arrivals_.at(motion);
    if (from.empty()) return {nowhere_};
    std::vector<ArmKnowledge> origins;
    for (const std::size_t origin : from) {
      const auto known = behind_.find(origin);
      if (known != behind_.end() && std::ranges::find(origins, known->second) == origins.end())
        origins.push_back(known->second);
    }
    return origins;
  }

  /// Goes on from `arm` by the motion, to all its targets, or to one of them that is not told; `first` of the paths
  /// that lead here.
  ArmKnowledge moved(std::size_t motion, ArmKnowledge arm, bool first) {
    const bool to_one = std::ranges::find(program_.joints_lost_at, motion) != program_.joints_lost_at.end();
    const ArmKnowledge origin = arm;
    for (std::size_t i = begins_.at(motion); i < visits_.size() && visits_[i].order == motion; ++i) {
      if (to_one) arm = origin;
      const Target& target = program_.targets[visits_[i].target];
      TargetVisit& visit = visits_[i];
      const Configurations found = configurations(target, arm);
      const AddedToJoints& added = added_[visit.target];
      arm = visit.near ? arrived_near(target, target.near_motions.at(motion), added, std::move(arm))
                       : arrived(target, found, added, std::move(arm));
      if (first) {
        visit = {visit.order, visit.target, visit.again, visit.near, found, arm.signs};
      } else {
        merge_found(found, visit.found);
        join_signs(arm.signs, visit);
      }
    }
    return arm;
  }

  static void join_signs(const ApproachSigns& signs, TargetVisit& visit) {
    for (Eigen::Index i = 0; i < signs.size(); ++i) {
      if (signs[i] == visit.approach[i]) continue;
      visit.differing_sides = visit.differing_sides || signs[i] * visit.approach[i] != 0.0;
      visit.approach[i] = 0.0;
    }
  }

  ArmKnowledge arrived(const Target& target, const Configurations& found, const AddedToJoints& added,
                       ArmKnowledge arm) {
    const bool known = found.joints.size() == 1 && found.from != JointsFrom::undetermined &&
                       found.contradicted_by.empty() &&
                       !(target.is_pose() && contradictions(target.hint, found.joints.front()) > 0);
    if (!known || !target.not_sent_to.empty()) return nowhere_;
    last_ = found.joints.front();
    arrive_at(found.joints.front(), added, target.hint.configuration, arm);
    if (target.is_pose()) finder_.arrive(arm.joints, arm.words);
    return arm;
  }

  /// A place near a target is told by the target's own numbers, so that its correction shifts both.
  ArmKnowledge arrived_near(Target target, const NearPlace& place, const AddedToJoints& added, ArmKnowledge arm) {
    target.motion = place.motion;
    const bool told = place.shift_m && target.is_pose() && target.form != OrientationForm::unknown;
    const Eigen::Vector3d shift_m = told ? *place.shift_m : Eigen::Vector3d::Zero();
    arm = arrived(target, configurations(target, arm, shift_m, place.along_tool), added, std::move(arm));
    arm.about = arm.about || !told;
    if (arm.about) arm.signs.setZero();
    return arm;
  }

  /// The joints that the arm comes to the target with from where it is, or to a place that is shifted from it.
  Configurations configurations(const Target& target, const ArmKnowledge& arm,
                                const Eigen::Vector3d& shift_m = Eigen::Vector3d::Zero(), bool along_tool = true) {
    if (!target.is_pose()) return {JointsFrom::target, {stated_joints(target)}};
    if (!target.not_sent_to.empty() || !unknown_frames(target, circumstances_).empty()) return {};
    Chain chain = model_.nominal.chain;
    if (target.frames.tool) chain.tool_m = target.frames.tool->translation();
    finder_.arrive(arm.joints, arm.words);
    if (target.form != OrientationForm::unknown) {
      Eigen::Isometry3d pose = stated_tool_pose(target);
      pose.translation() += stated_axes(target, along_tool) * shift_m;
      return finder_.find(chain, target, pose);
    }
    const auto joints = joints_at_point(chain, stated_point(target), last_);
    return joints ? Configurations{JointsFrom::before, {*joints}} : Configurations{};
  }

  const Program& program_;
  const CommandModel& model_;
  const Circumstances& circumstances_;
  const std::vector<AddedToJoints>& added_;  ///< to each target
  std::map<std::size_t, std::vector<std::size_t>> arrivals_;
  std::map<std::size_t, std::set<std::size_t>> followers_;  ///< the motions behind each
  std::vector<TargetVisit> visits_;
  std::map<std::size_t, std::size_t> begins_;   ///< of each motion's visits
  std::map<std::size_t, ArmKnowledge> behind_;  ///< each motion that was followed
  ArmKnowledge nowhere_;
  JointVector last_;  ///< that were known, for positions without an orientation
  ConfigurationFinder finder_;
};

}  // namespace

void AddedToJoints::take_in(const JointVector& added) {
  least = least.cwiseMin(added);
  most = most.cwiseMax(added);
}

std::vector<AddedToJoints> nothing_added(const Program& program, const CommandModel& model) {
  const JointVector zero = JointVector::Zero(model.nominal.chain.size());
  return {program.targets.size(), AddedToJoints{zero, zero}};
}

std::string unknown_frames(const Target& target, const Circumstances& circumstances) {
  if (target.is_pose() && !target.frames.unknown_frame.empty()) return target.frames.unknown_frame;
  return circumstances.tool_given && !target.frames.several_tools ? "" : target.frames.unknown_tool;
}

std::set<std::string> untold_tools(const Program& program) {
  std::set<std::string> names;
  for (const Target& target : program.targets) {
    const StatedFrames& frames = target.frames;
    if (target.not_sent_to.empty() && !frames.unknown_tool.empty() && !frames.tool_name.empty() &&
        !frames.several_tools)
      names.insert(frames.tool_name);
  }
  return names;
}

std::vector<TargetVisit> followed_motions(const Program& program, const CommandModel& model,
                                          const Circumstances& circumstances, const std::vector<AddedToJoints>& added) {
  return ArmFollower(program, model, circumstances, added).visits();
}

}  // namespace demecal::inline programs
