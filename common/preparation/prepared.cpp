#include "preparation/prepared.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "data/read_poses.hpp"
#include "data/text.hpp"
#include "errors/check.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline preparation {
namespace {

using PosesByKey = std::map<std::string, std::size_t>;

PosesByKey by_key(const std::vector<NamedPoint>& points, const std::string& file) {
  PosesByKey found;
  for (const NamedPoint& point : points) {
    if (!found.emplace(point.key, point.target).second) {
      throw InputError({file, 0}, point.name,
                       "is not the only pose of number " + point.key + "; name the array with pose_points");
    }
  }
  return found;
}

bool cover(const PosesByKey& poses, const std::vector<NamedPoint>& joints) {
  return std::all_of(joints.begin(), joints.end(), [&](const NamedPoint& point) { return poses.contains(point.key); });
}

/// The one array of poses beside the precision points that has a pose for every one of them, where there is just one.
std::optional<PosesByKey> poses_beside(const Program& program, const std::vector<NamedPoint>& joints) {
  const bool any = std::any_of(program.targets.begin(), program.targets.end(),
                               [](const Target& target) { return target.is_pose(); });
  if (!any) return std::nullopt;
  std::map<std::string, std::vector<NamedPoint>> arrays;
  for (NamedPoint& point : named_points(program, PointKind::poses, "")) arrays[point.array].push_back(point);
  std::vector<PosesByKey> candidates;
  for (const auto& [array, points] : arrays) {
    PosesByKey poses = by_key(points, program.file);
    if (cover(poses, joints)) candidates.push_back(std::move(poses));
  }
  if (candidates.size() != 1) return std::nullopt;
  return candidates.front();
}

MeasuredPose commanded(const Target& target, const RawSet& set) {
  MeasuredPose pose;
  pose.joints = stated_joints(target);
  if (target.approach && !target.approach->hasNaN()) pose.approach = target.approach;  // of all joints or none
  pose.payload_kg = target.payload_kg;
  pose.temperature_celsius = target.temperature_celsius;
  pose.time_s = target.time_s;
  pose.set = set.set;
  pose.line = target.place.line;
  if (pose.payload_kg.value_or(0.0) < 0.0) {
    throw InputError({set.joints.program.file, pose.line}, number_text(*pose.payload_kg),
                     "column payload_kg must not be negative: it is a mass");
  }
  return pose;
}

void add_set(const RawMeasurements& raw, std::size_t entry, Prepared& prepared) {
  const RawSet& set = raw.sets[entry];
  const std::vector<NamedPoint> points = named_points(set.joints.program, PointKind::joints, set.points);
  const auto rows = rows_of_points(set.readings, points, set.joints.program.file);
  const auto poses = programmed_poses(set, points);
  const std::size_t first = prepared.poses.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    require_kept_numbers(set.joints.program, points[i].target);
    if (poses[i]) require_kept_numbers(file_of_poses(set).program, *poses[i]);
    PreparedPose pose{.entry = entry,
                      .id = points[i].name,
                      .commanded = commanded(set.joints.program.targets[points[i].target], set),
                      .pose_target = poses[i],
                      .nominal_m = {},
                      .measured = average(set.readings, rows[i])};
    const Eigen::Vector3d at_joints_m = tool_position(raw.robot.chain, pose.commanded.joints);
    pose.nominal_m = poses[i] ? point_in_base(file_of_poses(set).program, *poses[i]) : at_joints_m;
    prepared.programmed_from_joints_m =
        std::max(prepared.programmed_from_joints_m, (pose.nominal_m - at_joints_m).norm());
    prepared.poses.push_back(std::move(pose));
  }
  std::vector<MeasuredPose> commanded_poses;
  for (std::size_t i = first; i < prepared.poses.size(); ++i) commanded_poses.push_back(prepared.poses[i].commanded);
  check_joint_limits(commanded_poses, raw.robot.chain, set.joints.program.file);
}

/// Names that several sets use get the number of their set before them.
void make_ids_unique(std::vector<PreparedPose>& poses) {
  std::map<std::string, std::size_t> uses;
  for (const PreparedPose& pose : poses) ++uses[pose.id];
  const bool shared = std::any_of(uses.begin(), uses.end(), [](const auto& use) { return use.second > 1; });
  for (PreparedPose& pose : poses) {
    if (shared) pose.id = std::to_string(pose.entry + 1) + ":" + pose.id;
  }
}

struct PointLists {
  std::vector<Eigen::Vector3d> measured_m, nominal_m;
};

PointLists point_lists(const Prepared& prepared, bool calibration_only) {
  PointLists lists;
  for (const PreparedPose& pose : prepared.poses) {
    if (calibration_only && pose.commanded.set != PoseSet::calibration) continue;
    lists.measured_m.push_back(pose.measured.point_m);
    lists.nominal_m.push_back(pose.nominal_m);
  }
  return lists;
}

void fit(const RawMeasurements& raw, Prepared& prepared) {
  const PointLists every_set = point_lists(prepared, false), calibration = point_lists(prepared, true);
  if (is_mirrored(every_set.measured_m, every_set.nominal_m)) {
    throw InputError({raw.file, 0}, "",
                     "the measured points are the nominal ones in a mirror; check instrument.cords.side, which cord "
                     "is a, b and c, and that coordinates are right-handed");
  }
  prepared.best_fit = best_fit(calibration.measured_m, calibration.nominal_m);
  prepared.fitted_to_calibration = prepared.best_fit.has_value();
  if (!prepared.best_fit) prepared.best_fit = best_fit(every_set.measured_m, every_set.nominal_m);
}

/// Whether every pose has it.
template <typename Member>
bool all_have(const Prepared& prepared, Member member) {
  return std::all_of(prepared.poses.begin(), prepared.poses.end(),
                     [&](const PreparedPose& pose) { return (pose.commanded.*member).has_value(); });
}

}  // namespace

std::vector<std::optional<std::size_t>> programmed_poses(const RawSet& set, const std::vector<NamedPoint>& joints) {
  std::optional<PosesByKey> poses;
  const PointFile& file = file_of_poses(set);
  const bool is_named = set.poses || !set.pose_points.empty();
  if (is_named) {
    poses = by_key(named_points(file.program, PointKind::poses, set.pose_points), file.program.file);
  } else {
    poses = poses_beside(file.program, joints);
  }
  std::vector<std::optional<std::size_t>> targets(joints.size());
  for (std::size_t i = 0; poses && i < joints.size(); ++i) {
    const auto pose = poses->find(joints[i].key);
    if (pose == poses->end()) {
      throw InputError({file.program.file, 0}, joints[i].name, "has no programmed pose of the same number");
    }
    targets[i] = pose->second;
  }
  return targets;
}

std::string_view to_string(FrameKind kind) {
  return kind == FrameKind::three_points ? "three_points" : "best_fit";
}

Prepared prepare_measurements(const RawMeasurements& raw) {
  Prepared prepared;
  for (std::size_t entry = 0; entry < raw.sets.size(); ++entry) add_set(raw, entry, prepared);
  make_ids_unique(prepared.poses);
  if (raw.local_frame) prepared.three_points = raw.local_frame->base_from_instrument();
  fit(raw, prepared);
  return prepared;
}

std::vector<Eigen::Vector3d> differences(const Prepared& prepared, FrameKind kind) {
  DEMECAL_CHECK(prepared.frame(kind), "no frame by " << to_string(kind));
  std::vector<Eigen::Vector3d> found;
  for (const PreparedPose& pose : prepared.poses) {
    found.emplace_back(*prepared.frame(kind) * pose.measured.point_m - pose.nominal_m);
  }
  return found;
}

DataSet prepared_data_set(const RawMeasurements& raw, const Prepared& prepared, std::optional<FrameKind> kind) {
  DataSet data;
  data.name = raw.name;
  // Lines of its poses are those of the programs.
  std::vector<std::string> programs;
  for (const RawSet& set : raw.sets)
    if (std::ranges::count(programs, set.joints.program.file) == 0) programs.push_back(set.joints.program.file);
  data.file = joined_words(programs, ", ");
  data.robot = raw.robot;
  data.frame = kind ? Frame::base : Frame::sensor;
  const bool approach = all_have(prepared, &MeasuredPose::approach);
  const bool payload = all_have(prepared, &MeasuredPose::payload_kg);
  const bool temperature = all_have(prepared, &MeasuredPose::temperature_celsius);
  const bool time = all_have(prepared, &MeasuredPose::time_s);
  for (const PreparedPose& from : prepared.poses) {
    MeasuredPose pose = from.commanded;
    pose.pose_id = from.id;
    if (!approach) pose.approach.reset();
    if (!payload) pose.payload_kg.reset();
    if (!temperature) pose.temperature_celsius.reset();
    if (!time) pose.time_s.reset();
    std::vector<Eigen::Vector3d> points_m{from.measured.point_m};
    if (raw.repeats == Repeats::keep) {
      points_m.clear();
      for (const std::size_t row : from.measured.rows) {
        points_m.push_back(raw.sets[from.entry].readings.rows[row].point_m);
      }
    }
    for (const Eigen::Vector3d& point_m : points_m) {
      pose.position_m = kind ? Eigen::Vector3d(*prepared.frame(*kind) * point_m) : point_m;
      data.poses.push_back(pose);
    }
  }
  return data;
}

}  // namespace demecal::inline preparation
