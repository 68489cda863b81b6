#include <filesystem>
#include <sstream>

#include "config/input_files.hpp"
#include "urdf/urdf_arm.hpp"
#include "urdf/urdf_file.hpp"
#include "yaml/files.hpp"
#include "yaml/yaml_node.hpp"
#include "yaml/yaml_text.hpp"

namespace demecal::inline config {
namespace {

/// The path of `file` as seen from the folder of `beside`.
std::string seen_from(const std::string& file, const std::string& beside) {
  const std::filesystem::path folder = std::filesystem::absolute(beside).lexically_normal().parent_path();
  const std::filesystem::path whole = std::filesystem::absolute(file).lexically_normal();
  const std::filesystem::path relative = whole.lexically_relative(folder);
  return relative.empty() ? whole.string() : relative.string();
}

}  // namespace

ImportedRobot import_urdf(const ImportRequest& request) {
  const UrdfFile urdf = parse_urdf(read_file(request.file), request.file);
  const UrdfArm arm = arm_between(urdf, request.base, request.tip);
  Robot robot;
  robot.name = urdf.robot.empty() ? "arm" : urdf.robot;
  robot.drawing = arm.drawing;
  robot.masses = arm.masses;
  for (const LinkMass& mass : arm.masses) robot.drawing->centres_m.push_back(mass.centre_m);
  robot.urdf = UrdfSource{seen_from(request.file, request.beside), arm.base, arm.tip};
  std::ostringstream text;
  text << yaml_comment("Imported from " + std::filesystem::path(request.file).filename().string() + ": from link " +
                       arm.base + " to link " + arm.tip);
  for (const std::string& note : arm.notes) text << yaml_comment("Check: " + note);
  text << "demecal_robot: 1\n" << robot_text(robot);
  read_robot(parse_yaml(text.str(), request.beside));  // what would be refused is not written
  return {text.str(), arm.notes};
}

}  // namespace demecal::inline config
