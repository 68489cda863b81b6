#include "coordinator/arm_view.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "config/model_file.hpp"
#include "data_files/data_set_file.hpp"
#include "errors/input_error.hpp"
#include "fitting/fit.hpp"
#include "kinematics/forward.hpp"
#include "prediction/corrected_robot.hpp"
#include "updating/fleet_model.hpp"
#include "workflows/workflows.hpp"

namespace demecal {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostDrawnPoses = 12000;
constexpr std::size_t kMostDrawnArms = 48;

/// At most `most` of the poses with a position, spread over all of them.
std::vector<const MeasuredPose*> drawn_poses(const DataSet& data, std::size_t most) {
  std::vector<const MeasuredPose*> all, drawn;
  for (const MeasuredPose& pose : data.poses) {
    if (pose.position_m) all.push_back(&pose);
  }
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i) {
    drawn.push_back(all[i * all.size() / std::min(most, all.size())]);
  }
  return drawn;
}

/// Appends the point in mm, to the micrometre.
void append_mm(Json& list, const Eigen::Vector3d& point_m) {
  for (const double value_m : {point_m.x(), point_m.y(), point_m.z()}) list.push_back(std::round(1e6 * value_m) / 1e3);
}

/// Base, joints and tool, in the frame of the measurements.
Json arm_line(const CorrectedRobot& robot, const MeasuredPose& pose) {
  Json line = Json::array();
  append_mm(line, robot.sensor_from_base.translation());
  for (int joints = 1; joints <= robot.chain.size(); ++joints) {
    Chain part = robot.chain;
    part.joints.resize(static_cast<std::size_t>(joints));
    append_mm(line, (robot.sensor_from_base * forward(part, pose.joints.head(joints))).translation());
  }
  append_mm(line, robot.predict(Stop(pose), pose.target).translation());
  return line;
}

/// Where the tool was measured, less where the robot has it.
Json misses(const CorrectedRobot& robot, const std::vector<const MeasuredPose*>& poses) {
  Json list = Json::array();
  for (const MeasuredPose* pose : poses) {
    append_mm(list, *pose->position_m - robot.predict(Stop(*pose), pose->target).translation());
  }
  return list;
}

/// What the model misses; nothing where none is named.
Json misses_of_model(const std::string& file, const DataSet& data, const std::vector<const MeasuredPose*>& poses) {
  if (file.empty()) return Json::array();
  const CalibratedModel model = load_model(file);
  require_one_robot(model, file, "the picture");
  require_same_arm(model.robot, data);
  return misses(model.robot, poses);
}

CorrectedRobot registered_robot(const DataSet& data) {
  const DeclaredModel base_and_tool{.registration = true, .tool = true};
  const Fit fit = fit_registration(data, poses_of(data, PoseSet::calibration), base_and_tool, nominal_robot(data));
  if (fit.status != FitStatus::converged) throw InputError({data.file, 0}, "", fit.sentence);
  return fit.robot;
}

}  // namespace

std::string arm_event(const std::string& data_file, const std::string& model_file) {
  const DataSet data = load_data_set(data_file);
  const std::vector<const MeasuredPose*> poses = drawn_poses(data, kMostDrawnPoses);
  if (poses.empty()) throw InputError({data.file, 0}, "", "no pose has a measured position: there is nothing to draw");
  const CorrectedRobot robot = registered_robot(data);
  Json event{{"event", "arm"}, {"t_s", 0.0}, {"data", data.name}};
  event["arms_mm"] = Json::array();
  for (const MeasuredPose* pose : drawn_poses(data, kMostDrawnArms)) event["arms_mm"].push_back(arm_line(robot, *pose));
  event["poses_mm"] = Json::array();
  for (const MeasuredPose* pose : poses) append_mm(event["poses_mm"], *pose->position_m);
  event["before_mm"] = misses(robot, poses);
  event["after_mm"] = misses_of_model(model_file, data, poses);
  return event.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace demecal
