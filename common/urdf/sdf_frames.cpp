#include "urdf/sdf_frames.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline urdf {
namespace {

constexpr double kRoundedAway = 1e-13;  ///< m or rad: what the calculation of a place leaves where there is none

bool is_true(const XmlAttribute* attribute) {
  return attribute != nullptr && (lower_case(attribute->value) == "true" || attribute->value == "1");
}

Origin origin_of_quaternion(const XmlValues& values, const XmlElement& pose) {
  constexpr double kUnit = 1e-3;
  const std::vector<double> n = values.numbers(pose, 7);
  const Eigen::Quaterniond turn(n[6], n[3], n[4], n[5]);
  if (!(std::abs(turn.norm() - 1.0) < kUnit))
    values.fail(pose, number_text(turn.norm()), "is the length of a quaternion; it must be 1: x, y, z, then w");
  return origin_of(Eigen::Translation3d(n[0], n[1], n[2]) * turn.normalized());
}

Origin origin_of_pose(const XmlValues& values, const XmlElement& pose) {
  if (without_blanks(pose.text).empty()) return {};
  const bool in_degrees = is_true(pose.attribute("degrees"));
  const XmlAttribute* format = pose.attribute("rotation_format");
  if (format != nullptr && format->value == "quat_xyzw") {
    if (in_degrees) values.fail(pose, "degrees", "is stated of a quaternion, which has none: remove it");
    return origin_of_quaternion(values, pose);
  }
  if (format != nullptr && format->value != "euler_rpy")
    values.fail(pose, format->value, "is no rotation_format: euler_rpy or quat_xyzw");
  const std::vector<double> n = values.numbers(pose, 6);
  Origin origin{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
  for (double& angle : origin.rpy_rad) angle = in_degrees ? radians(angle) : angle;
  return origin;
}

Eigen::Isometry3d place_of(const std::vector<const SdfFrame*>& up) {
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  for (const SdfFrame* frame : up) place = pose_of(frame->origin) * place;
  return place;
}

Origin with_exact_zeros(Origin origin) {
  for (Eigen::Vector3d* values : {&origin.xyz_m, &origin.rpy_rad}) {
    for (double& value : *values) value = std::abs(value) < kRoundedAway ? 0.0 : value;
  }
  return origin;
}

}  // namespace

SdfPose read_pose(const XmlValues& values, const XmlElement& element) {
  const XmlElement* pose = element.child("pose");
  if (pose == nullptr) return {};
  const XmlAttribute* undefined = pose->attribute("frame");
  if (undefined != nullptr && !undefined->value.empty()) {
    values.fail(*pose, undefined->value,
                "is the `frame` of a pose, which SDF 1.5 and 1.6 gave no meaning: leave it out, or state relative_to "
                "of SDF 1.7");
  }
  const XmlAttribute* stated = pose->attribute("relative_to");
  return {origin_of_pose(values, *pose), stated == nullptr ? "" : stated->value};
}

SdfFrames::SdfFrames(std::string file, std::size_t line) : file_(std::move(file)) {
  frames_[kModelFrame] = {.relative_to = "", .line = line};
}

void SdfFrames::add(const std::string& name, SdfFrame frame) {
  const std::size_t line = frame.line;
  if (!frames_.emplace(name, std::move(frame)).second)
    throw InputError({file_, line}, name, "is the name of a second link, joint or frame of the model; rename one");
}

void SdfFrames::require(const std::string& name, std::size_t line) const {
  if (contains(name)) return;
  std::vector<std::string> known;
  for (const auto& [other, frame] : frames_) known.push_back(other);
  throw InputError({file_, line}, name,
                   "is no link, joint or frame of the model (nearest is " + nearest_name(name, known) + ")");
}

void SdfFrames::check_ends(const std::string& name, std::string SdfFrame::*next, const char* rule) const {
  std::string way = name;
  std::size_t steps = 0;
  for (const SdfFrame* at = &frame(name); !(at->*next).empty(); at = &frame(at->*next)) {
    require(at->*next, at->line);
    if (steps < 8 || at->*next == name) way += " -> " + at->*next;
    if (++steps > frames_.size() || at->*next == name) throw InputError({file_, frame(name).line}, way, rule);
  }
}

void SdfFrames::check() const {
  for (const auto& [name, frame] : frames_) {
    check_ends(name, &SdfFrame::relative_to, "are frames stated in each other, a ring without a beginning");
    check_ends(name, &SdfFrame::attached_to, "are frames attached to each other, a ring without a link");
  }
}

const std::string& SdfFrames::link_of(const std::string& name) const {
  const std::string* at = &name;
  while (!frame(*at).attached_to.empty()) at = &frame(*at).attached_to;
  return *at;
}

std::vector<const SdfFrame*> SdfFrames::up_from(const std::string& name) const {
  std::vector<const SdfFrame*> up;
  for (const SdfFrame* at = &frame(name); !at->relative_to.empty(); at = &frame(at->relative_to)) up.push_back(at);
  return up;
}

Origin SdfFrames::origin_in(const std::string& base, const std::string& name) const {
  std::vector<const SdfFrame*> up = up_from(name), down = up_from(base);
  while (!up.empty() && !down.empty() && up.back() == down.back()) up.pop_back(), down.pop_back();
  const auto stands_apart = [](const SdfFrame* frame) { return frame->origin != Origin{}; };
  const auto first = std::ranges::find_if(up, stands_apart);
  if (std::ranges::none_of(down, stands_apart)) {
    if (first == up.end()) return {};
    if (std::none_of(std::next(first), up.end(), stands_apart)) return (*first)->origin;
  }
  const Eigen::Isometry3d place = place_of(down).inverse() * place_of(up);
  if (!place.matrix().allFinite()) throw InputError({file_, frame(name).line}, name, "stands too far away");
  return with_exact_zeros(origin_of(place));
}

}  // namespace demecal::inline urdf
