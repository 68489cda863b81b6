#include "data_files/robot_file.hpp"
#include "parsed_programs/program.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "kinematics/units.hpp"
#include "parsed_programs/orientation.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline data_files {
namespace {

/// A way to write a frame's orientation; angles in deg have a key that says so.
struct WrittenOrientation {
  std::string_view key;
  OrientationForm form;
  std::size_t numbers;
};

constexpr std::array<WrittenOrientation, 6> kOrientations{
    {{"rpy_deg", OrientationForm::fixed_xyz_angles, 3},
     {"abc_deg", OrientationForm::zyx_angles, 3},
     {"rxryrz_deg", OrientationForm::xyz_angles, 3},
     {"oat_deg", OrientationForm::zyz_angles, 3},
     {"quaternion_wxyz", OrientationForm::quaternion, 4},
     {"rotation_vector_rad", OrientationForm::rotation_vector, 3}}};

Eigen::Matrix3d read_rotation(const YamlNode& node, const WrittenOrientation& written) {
  std::vector<double> numbers = node.numbers();
  if (numbers.size() != written.numbers) node.fail("", "must be " + std::to_string(written.numbers) + " numbers");
  const bool of_degrees = written.key.ends_with("_deg");
  double square = 0.0;
  for (double& number : numbers) {
    if (of_degrees && std::abs(number) > 360.0) node.fail(number_text(number), "must be from -360 to 360");
    if (of_degrees) number = radians(number);
    square += number * number;
  }
  if (written.form == OrientationForm::quaternion && std::abs(std::sqrt(square) - 1.0) > 1e-3)
    node.fail("", "must be a unit quaternion");
  if (written.form == OrientationForm::rotation_vector && std::sqrt(square) > 2.0 * std::numbers::pi)
    node.fail("", "must be a rotation vector in rad, at most one turn");
  return rotation_from(written.form, numbers);
}

Eigen::Isometry3d read_frame(const YamlNode& node) {
  node.with_keys({"xyz_mm", "rpy_deg", "abc_deg", "rxryrz_deg", "oat_deg", "quaternion_wxyz", "rotation_vector_rad"});
  const WrittenOrientation* given = nullptr;
  for (const WrittenOrientation& written : kOrientations) {
    if (node.find(written.key) == nullptr) continue;
    if (given != nullptr) node.at(written.key).fail("", "is a second orientation; give one");
    given = &written;
  }
  if (given == nullptr)
    node.fail("",
              "must have an orientation: rpy_deg, abc_deg, rxryrz_deg, oat_deg, quaternion_wxyz or "
              "rotation_vector_rad");
  Eigen::Isometry3d frame(read_rotation(node.at(given->key), *given));
  frame.translation() = metres(1.0) * node.at("xyz_mm").vector3();
  return frame;
}

std::map<std::string, Eigen::Isometry3d> read_frames(const YamlNode* node) {
  std::map<std::string, Eigen::Isometry3d> frames;
  if (node == nullptr) return frames;
  if (node->kind != YamlNode::Kind::map) node->fail("must be a map of numbers or names and frames");
  for (const YamlNode& child : node->children) {
    if (!frames.emplace(lower_case(child.name), read_frame(child)).second)
      child.fail("", "is named twice: letter case makes no difference");
  }
  return frames;
}

}  // namespace

ControllerData load_frames(const std::filesystem::path& path) {
  const YamlNode root = read_yaml(path).with_version("frames", 1);
  root.with_keys({"demecal_frames", "frames", "tools"});
  if (root.find("frames") == nullptr && root.find("tools") == nullptr) root.fail("", "must have frames or tools");
  return {.frames = read_frames(root.find("frames")), .tools = read_frames(root.find("tools"))};
}

}  // namespace demecal::inline data_files
