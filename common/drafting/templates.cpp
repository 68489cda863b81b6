#include "drafting/templates.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>

#include "data/data_set.hpp"
#include "data/text.hpp"
#include "data_files/link_inertias.hpp"
#include "data_files/robot_file.hpp"
#include "drafting/draft_data_set.hpp"
#include "drafting/template_texts.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/drawn_arm.hpp"
#include "languages/languages.hpp"
#include "parsed_programs/language.hpp"
#include "tables/guess_columns.hpp"
#include "tables/read_table.hpp"
#include "urdf/sdf_file.hpp"
#include "urdf/urdf_arm.hpp"
#include "urdf/urdf_file.hpp"
#include "yaml/files.hpp"
#include "yaml/yaml_node.hpp"
#include "yaml/yaml_text.hpp"

namespace demecal::inline drafting {
namespace {

/// What the given files are.
struct GivenFiles {
  std::optional<std::filesystem::path> robot, data_set, urdf;
  std::vector<std::filesystem::path> tables, programs;
};

bool is_yaml(const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string());
  return ending == ".yaml" || ending == ".yml";
}

void take_yaml(const std::filesystem::path& path, GivenFiles& given) {
  const YamlNode root = read_yaml(path);
  if (root.find("demecal_robot")) {
    given.robot = path;
  } else if (root.find("demecal_dataset")) {
    given.data_set = path;
  } else {
    root.fail("",
              "is neither a robot nor a data set: templates are filled in by these, by tables of poses and by robot "
              "programs");
  }
}

GivenFiles sorted(const std::vector<std::filesystem::path>& files) {
  GivenFiles given;
  for (const std::filesystem::path& path : files) {
    if (is_yaml(path)) {
      take_yaml(path, given);
      continue;
    }
    const std::string ending = lower_case(path.extension().string());
    if (ending == ".urdf" || ending == ".sdf") {
      given.urdf = path;
      continue;
    }
    const Language* const language = recognize_language(read_file(path), path.string());
    const bool program = language != nullptr && language->name != "csv";
    (program ? given.programs : given.tables).push_back(path);
  }
  return given;
}

std::string relative_to(const std::filesystem::path& folder, const std::filesystem::path& path) {
  std::error_code fault;
  const auto relative =
      std::filesystem::relative(std::filesystem::absolute(path), std::filesystem::absolute(folder), fault);
  return yaml_text(fault || relative.empty() ? std::filesystem::absolute(path).string() : relative.generic_string());
}

std::string filled(std::string_view text, std::string_view place, const std::string& value) {
  std::string result(text);
  for (std::size_t at = result.find(place); at != std::string::npos; at = result.find(place, at + value.size()))
    result.replace(at, place.size(), value);
  return result;
}

std::string with_certificate_keys(std::string_view text) {
  return filled(text, "@CERTIFICATE@", std::string(kCertificateKeys));
}

std::size_t joints_given(const GivenFiles& given) {
  if (given.robot) return static_cast<std::size_t>(load_robot(*given.robot).chain.size());
  for (const GivenTable& table : read_given_tables(given.tables, 0, {})) {
    const std::size_t joints = count_joint_columns(table.read.table);
    if (joints > 0) return joints;
  }
  return 6;
}

std::string robot_template(const GivenFiles& given) {
  constexpr std::string_view kSix[] = {
      "alpha_deg: -90, a_mm: 175, d_mm: 495, theta_offset_deg: 0, limits_deg: [-170, 170]",
      "alpha_deg: 0, a_mm: 720, d_mm: 0, theta_offset_deg: -90, limits_deg: [-75, 110]",
      "alpha_deg: -90, a_mm: 130, d_mm: 0, theta_offset_deg: 0, limits_deg: [-120, 75]",
      "alpha_deg: 90, a_mm: 0, d_mm: 680, theta_offset_deg: 0, limits_deg: [-190, 190]",
      "alpha_deg: -90, a_mm: 0, d_mm: 0, theta_offset_deg: 0, limits_deg: [-115, 115]",
      "alpha_deg: 0, a_mm: 0, d_mm: 105, theta_offset_deg: 0, limits_deg: [-350, 350]"};
  std::string joints;
  for (std::size_t joint = 0; joint < joints_given(given); ++joint)
    joints += "  - {type: revolute, " + std::string(kSix[std::min<std::size_t>(joint, 5)]) + "}   # joint " +
              std::to_string(joint + 1) + "\n";
  return filled(kRobotTemplate, "@JOINTS@", joints);
}

std::string robot_name(const GivenFiles& given, const std::filesystem::path& folder) {
  return given.robot ? relative_to(folder, *given.robot) : "robot.yaml";
}

std::string data_set_template(const GivenFiles& given, const std::filesystem::path& folder) {
  const std::size_t joints = joints_given(given);
  if (given.tables.empty()) {
    std::vector<std::string> names;
    for (std::size_t joint = 1; joint <= joints; ++joint) names.push_back("q" + std::to_string(joint) + "_deg");
    return filled(filled(with_certificate_keys(kDataSetTemplate), "@ROBOT@", robot_name(given, folder)), "@JOINTS@",
                  yaml_list(names));
  }
  const std::vector<GivenTable> tables = read_given_tables(given.tables, joints, {});
  const std::string robot =
      given.robot ? std::filesystem::relative(*given.robot, folder).generic_string() : "robot.yaml";
  const DataSetDraft draft = draft_data_sets(tables, folder, robot, joints, {}).front();
  std::string text = "# What was measured, and in which columns of which files\n";
  for (const GivenTable& table : tables) {
    if (!table.read.found.empty()) text += yaml_comment(table.path.filename().string() + ": " + table.read.found);
  }
  for (const std::string& assumed : draft.assumed) text += yaml_comment("assumed: " + assumed);
  return text + draft.text;
}

std::string preparation_template(const GivenFiles& given, const std::filesystem::path& folder) {
  const auto has_joints = [](const std::filesystem::path& path) {
    return count_joint_columns(read_table(read_file(path), path.string()).table) > 0;
  };
  std::string program = "poses.csv", readings = "readings.txt";
  if (!given.programs.empty()) program = relative_to(folder, given.programs.front());
  for (const std::filesystem::path& table : given.tables)
    (has_joints(table) ? program : readings) = relative_to(folder, table);
  return filled(filled(filled(kPreparationTemplate, "@ROBOT@", robot_name(given, folder)), "@PROGRAM@", program),
                "@READINGS@", readings);
}

}  // namespace

std::string template_text(TemplateKind kind, const std::vector<std::filesystem::path>& files,
                          const std::filesystem::path& folder) {
  const GivenFiles given = sorted(files);
  switch (kind) {
    case TemplateKind::robot:
      return given.urdf ? import_urdf({given.urdf->string(), {}, {}, (folder / "robot.yaml").string()}).text
                        : robot_template(given);
    case TemplateKind::dataset:
      return data_set_template(given, folder);
    case TemplateKind::job:
      return filled(with_certificate_keys(kJobTemplate), "@DATA@",
                    given.data_set ? relative_to(folder, *given.data_set) : "dataset.yaml");
    case TemplateKind::scenario:
      return filled(kScenarioTemplate, "@ROBOT@", robot_name(given, folder));
    case TemplateKind::preparation:
      return preparation_template(given, folder);
  }
  return "";
}

std::string first_job_text(const std::string& data_set) {
  return filled(with_certificate_keys(kJobTemplate), "@DATA@", yaml_text(data_set));
}

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
  const UrdfFile urdf = parse_urdf_or_sdf(read_file(request.file), request.file);
  const UrdfArm arm = arm_between(urdf, request.base, request.tip);
  Robot robot;
  robot.name = urdf.robot.empty() ? "arm" : urdf.robot;
  robot.drawing = arm.drawing;
  robot.masses = arm.masses;
  for (const LinkMass& mass : arm.masses) robot.drawing->centres_m.push_back(mass.centre_m);
  if (!urdf.is_sdf) robot.urdf = UrdfSource{seen_from(request.file, request.beside), arm.base, arm.tip};
  std::ostringstream text;
  text << yaml_comment("Imported from " + std::filesystem::path(request.file).filename().string() + ": from link " +
                       arm.base + " to link " + arm.tip);
  for (const std::string& note : arm.notes) text << yaml_comment("Check: " + note);
  text << "demecal_robot: 1\n" << robot_text(robot, arm.inertias);
  read_robot(parse_yaml(text.str(), request.beside));  // what would be refused is not written
  return {text.str(), arm.notes, arm.base, arm.tip};
}

}  // namespace demecal::inline drafting
