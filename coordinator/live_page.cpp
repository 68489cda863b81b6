#include "coordinator/live_page.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "config/model_file.hpp"
#include "coordinator/commands.hpp"
#include "data/data_set.hpp"
#include "data_files/data_set_file.hpp"
#include "effects/arm_state.hpp"
#include "errors/input_error.hpp"
#include "fitting/fit.hpp"
#include "http/access.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"
#include "monitor/events.hpp"
#include "monitor/state_json.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"
#include "updating/fleet_model.hpp"
#include "workflows/workflows.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

constexpr double kIslandInterval_s = 0.5;
constexpr double kStateInterval_s = 1.0;
constexpr std::size_t kFewestOfToken = 16;

/// The first line of the file, where it is fit to be sent.
std::string token_in(const std::string& file) {
  const std::string text = read_file(file);
  const std::string token = text.substr(0, text.find_first_of("\r\n"));
  constexpr const char* kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~";
  if (token.size() < kFewestOfToken || token.find_first_not_of(kLetters) != std::string::npos) {
    throw InputError({file, 1}, "", "must be a token of 16 or more letters, digits and -._~");
  }
  return token;
}

LiveServerOptions server_options(const std::string& where, const std::string& token_file) {
  LiveServerOptions options;
  try {
    options.endpoint = parse_endpoint(where);
  } catch (const InputError& error) {
    throw ArgumentError(error.what());
  }
  if (!token_file.empty()) {
    options.token = token_in(token_file);
  } else if (!is_loopback(options.endpoint.address)) {
    options.token = random_token();
  }
  return options;
}

}  // namespace

LivePage::LivePage(const std::string& where, const std::string& token_file, std::string place)
    : place_(std::move(place)), server_(server_options(where, token_file)), events_(kIslandInterval_s) {
  server_.publish(first_event_line(), "");
  server_.set_state(state_json(events_.watched(), 0.0, place_));
}

void LivePage::take(const Message& message, double now_s) {
  publish(events_.take(message, now_s));
}

void LivePage::tick(double now_s) {
  publish(events_.due(now_s));
  if (!changed_ || now_s - state_set_s_ < kStateInterval_s) return;
  server_.set_state(state_json(events_.watched(), now_s, place_));
  state_set_s_ = now_s;
  changed_ = false;
}

void LivePage::publish(std::vector<PacedLine> lines) {
  for (PacedLine& line : lines) {
    server_.publish(std::move(line.text), std::move(line.key));
    changed_ = true;
  }
}

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
