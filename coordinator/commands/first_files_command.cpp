#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "coordinator/commands.hpp"
#include "coordinator/result_folder.hpp"
#include "data/data_set.hpp"
#include "data_check/check_data.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"
#include "drafting/draft_data_set.hpp"
#include "drafting/templates.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "languages/languages.hpp"
#include "parsed_programs/language.hpp"
#include "report/evaluation.hpp"
#include "tables/layout.hpp"
#include "terminal/report_text.hpp"
#include "trials/finding.hpp"
#include "yaml/files.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal {
namespace {

struct TemplateRequest {
  std::string kind, out;
  std::vector<std::string> given;
  bool force = false;
};

TemplateKind template_kind(const std::string& word) {
  if (word == "robot") return TemplateKind::robot;
  if (word == "dataset") return TemplateKind::dataset;
  if (word == "job") return TemplateKind::job;
  return word == "scenario" ? TemplateKind::scenario : TemplateKind::preparation;
}

ExitCode run_template(const TemplateRequest& request) {
  const std::filesystem::path out = request.out;
  const std::filesystem::path folder = out.has_parent_path() ? out.parent_path() : ".";
  const std::vector<std::filesystem::path> given(request.given.begin(), request.given.end());
  const std::string text = template_text(template_kind(request.kind), given, folder);
  if (request.out.empty()) {
    fmt::print("{}", text);
    return ExitCode::done;
  }
  if (std::filesystem::exists(out) && !request.force)
    throw ArgumentError(request.out + " is there already: name another file, or overwrite it with --force");
  write_file(out, text);
  fmt::print("{} written\n", request.out);
  return ExitCode::done;
}

struct NewRequest {
  std::string folder, robot, urdf, base, tip, delimiter, decimal;
  std::vector<std::string> poses;
  bool force = false;
};

const std::vector<std::string> kNewFiles{"robot.yaml", "dataset.yaml", "job.yaml"};

/// The new files as they were before: put back unless keep() is called, so that nothing half-made is left.
class EarlierFiles {
 public:
  EarlierFiles(const std::string& folder, bool had_folder) : folder_(folder), had_folder_(had_folder) {
    for (const std::string& name : kNewFiles)
      if (std::filesystem::exists(folder_ / name)) texts_[name] = read_file(folder_ / name);
  }
  EarlierFiles(const EarlierFiles&) = delete;
  EarlierFiles& operator=(const EarlierFiles&) = delete;
  ~EarlierFiles() {
    if (kept_) return;
    std::error_code ignored;
    for (const std::string& name : kNewFiles) {
      const auto earlier = texts_.find(name);
      if (earlier == texts_.end()) {
        std::filesystem::remove(folder_ / name, ignored);
      } else {
        std::ofstream(folder_ / name, std::ios::binary) << earlier->second;
      }
    }
    if (!had_folder_) std::filesystem::remove_all(folder_, ignored);
  }
  void keep() { kept_ = true; }

 private:
  std::filesystem::path folder_;
  bool had_folder_, kept_ = false;
  std::map<std::string, std::string> texts_{};
};

ToldLayout told_layout(const NewRequest& request) {
  ToldLayout told;
  for (const Delimiter delimiter : {Delimiter::comma, Delimiter::semicolon, Delimiter::tab, Delimiter::blanks}) {
    if (request.delimiter == to_string(delimiter)) told.delimiter = delimiter;
  }
  if (!request.decimal.empty()) told.decimal = request.decimal == "comma" ? ',' : '.';
  return told;
}

/// Of the drafts whose rows fit together the first that the check of the data finds least wrong with, written; throws
/// what is wrong with the likeliest where none does.
DataSetDraft write_fitting_draft(const std::filesystem::path& file, const std::vector<DataSetDraft>& drafts) {
  std::optional<InputError> likeliest;
  const DataSetDraft* best = nullptr;
  DataVerdict least = DataVerdict::contradiction;
  for (const DataSetDraft& draft : drafts) {
    write_file(file, draft.text);
    try {
      DataSet data = load_data_set(file);
      const DataVerdict verdict = drafts.size() == 1 ? least : check_without_copies(data).verdict();
      if (best != nullptr && verdict >= least) continue;
      best = &draft;
      least = verdict;
      if (verdict == DataVerdict::plausible) break;
    } catch (const InputError& fault) {
      // Where clocks that agree do not fit, it is what hinders them to be brought together that matters.
      if (!likeliest || draft.text.find("offset_s: auto") != std::string::npos) likeliest = fault;
    }
  }
  if (best == nullptr) throw InputError(*likeliest);
  write_file(file, best->text);
  return *best;
}

/// The robot file's text as it has to be in another folder: it names its URDF from where it stands.
std::string moved_robot_text(const std::filesystem::path& file, const std::filesystem::path& folder) {
  std::string text = read_file(file.string());
  const YamlNode root = parse_yaml(text, file.string());
  const YamlNode* const urdf = root.find("urdf");
  const YamlNode* const named = urdf == nullptr ? nullptr : urdf->find("file");
  if (named == nullptr) return text;
  const std::string name = named->text();
  const std::size_t place = text.find(name, text.find("urdf:"));
  const std::filesystem::path whole = std::filesystem::absolute(file.parent_path() / name).lexically_normal(),
                              beside = std::filesystem::absolute(folder).lexically_normal(),
                              moved = whole.lexically_relative(beside);
  if (place != std::string::npos) text.replace(place, name.size(), (moved.empty() ? whole : moved).string());
  return text;
}

/// The arm's file as it will stand in the new folder, and what was assumed of it.
ImportedRobot robot_file(const NewRequest& request) {
  if (request.urdf.empty()) return {.text = moved_robot_text(request.robot, request.folder), .notes = {}};
  ImportRequest urdf{request.urdf, {}, {}, request.folder + "/robot.yaml"};
  if (!request.base.empty()) urdf.base = request.base;
  if (!request.tip.empty()) urdf.tip = request.tip;
  return import_urdf(urdf);
}

void require_no_programs(const std::vector<std::filesystem::path>& files) {
  for (const std::filesystem::path& file : files) {
    const Language* const language = recognize_language(read_file(file.string()), file.string());
    if (language != nullptr && language->name != "csv")
      throw InputError({file.string(), 0}, "",
                       "is a robot program: `demecal prepare` puts its targets beside an instrument's readings "
                       "(`demecal template preparation --for` this file and the readings begins its file)");
  }
}

/// Writes the tool point into an imported arm's file, which has none of its own, where the poses tell where it is;
/// returns what is to be said of it.
std::vector<std::string> write_found_tool(const NewRequest& request, std::string robot_text) {
  constexpr std::string_view kNone = "tool_mm: [0, 0, 0]";
  const std::size_t place = request.urdf.empty() ? std::string::npos : robot_text.find(kNone);
  if (place == std::string::npos) return {};
  const std::optional<Eigen::Vector3d> tool_m = tool_elsewhere(load_data_set(request.folder + "/dataset.yaml"));
  if (!tool_m) return {};
  const std::string point =
      fmt::format("[{:.1f}, {:.1f}, {:.1f}]", 1e3 * tool_m->x(), 1e3 * tool_m->y(), 1e3 * tool_m->z());
  robot_text.replace(place, kNone.size(), "tool_mm: " + point);
  write_file(request.folder + "/robot.yaml", robot_text);
  return {"tool_mm is " + point +
          ", where these poses have the measured point on the flange; programs whose tool is within 3 mm of it are "
          "corrected for that tool's error too"};
}

struct NewFiles {
  DataSetDraft draft;
  std::vector<std::string> notes;  ///< of the arm
  CheckedData checked;
};

/// Writes them and reads them back. Where the data do not fit, they stay only if dataset.yaml is where that is put
/// right.
NewFiles write_new_files(const NewRequest& request, const ImportedRobot& arm, const std::vector<DataSetDraft>& drafts,
                         EarlierFiles& earlier) {
  const std::string data_set = request.folder + "/dataset.yaml";
  try {
    write_file(request.folder + "/robot.yaml", arm.text);
    write_file(request.folder + "/job.yaml", first_job_text("dataset.yaml"));
    const DataSetDraft draft = write_fitting_draft(data_set, drafts);
    std::vector<std::string> notes = arm.notes;
    for (std::string& note : write_found_tool(request, arm.text)) notes.push_back(std::move(note));
    CheckedData checked = load_checked(data_set);
    earlier.keep();
    return {draft, std::move(notes), std::move(checked)};
  } catch (const InputError& fault) {
    const bool there = fault.where().file == data_set;
    if (there) earlier.keep();
    fmt::print(stderr, "{}: {}\n", request.folder,
               there ? fmt::format("the data do not fit together as dataset.yaml has them; {} stay there to be put "
                                   "right and tried by `demecal check {}`",
                                   fmt::join(kNewFiles, ", "), data_set)
                     : "nothing was written there, since the data do not fit");
    throw;
  }
}

ExitCode run_new(const NewRequest& request) {
  const ImportedRobot arm = robot_file(request);
  const std::string named = request.urdf.empty() ? request.robot : request.folder + "/robot.yaml";
  const Robot robot = read_robot(parse_yaml(arm.text, named).with_version("robot", 1));
  const auto joints = static_cast<std::size_t>(robot.chain.size());
  const ToldLayout told = told_layout(request);
  const std::vector<std::filesystem::path> files(request.poses.begin(), request.poses.end());
  require_no_programs(files);
  const std::size_t rails = leading_rails(robot.chain);
  const std::vector<GivenTable> tables = read_given_tables(files, joints, told, joint_names(robot), rails);
  const std::vector<DataSetDraft> drafts = draft_data_sets(tables, request.folder, "robot.yaml", joints, told, rails);
  const bool had_folder = std::filesystem::exists(request.folder);
  make_writable(request.folder, kNewFiles, request.force);
  EarlierFiles earlier(request.folder, had_folder);  // put back behind `written`, which notes what is there
  const FilesBeingWritten written(request.folder, kNewFiles);
  const auto [draft, notes, checked] = write_new_files(request, arm, drafts, earlier);
  fmt::print("{}: {} poses of {}; {} written\n", request.folder, checked.data.poses.size(), robot.name,
             fmt::join(kNewFiles, ", "));
  fmt::print("Assumed; check it in dataset.yaml:\n");
  for (const std::string& sentence : draft.assumed) fmt::print("  {}\n", sentence);
  for (const std::string& note : notes) fmt::print("Check in robot.yaml: {}\n", note);
  fmt::print("Check in robot.yaml: dimensions, signs and offsets of joints, tool_mm.\n");
  if (refuses(checked, false, ShownFindings::all)) return ExitCode::contradiction;
  fmt::print("{}", to_terminal(data_check_entry(checked.check), ShownFindings::all));
  fmt::print("Next: demecal calibrate {}/job.yaml --out {}/result\n", request.folder, request.folder);
  return ExitCode::done;
}

}  // namespace

void add_template(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<TemplateRequest>();
  CLI::App* command =
      app.add_subcommand("template", "a commented file to begin with, filled in as far as given files tell");
  command->add_option("kind", request->kind, "robot, dataset, job, scenario or preparation")
      ->required()
      ->check(CLI::IsMember({"robot", "dataset", "job", "scenario", "preparation"}));
  command->add_option("--for", request->given, "tables of poses or readings, robot programs, ROBOT.yaml, DATASET.yaml");
  command->add_option("--out", request->out, "file to write; without it, standard output");
  command->add_flag("--force", request->force, "overwrite the file");
  command->callback([request, &exit_code] { exit_code = run_template(*request); });
}

void add_new(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<NewRequest>();
  CLI::App* command =
      app.add_subcommand("new", "robot, data set and job from an arm's file and the files of a measurement");
  command->add_option("folder", request->folder, "folder to write")->required();
  CLI::Option_group* arm = command->add_option_group("arm", "one of");
  arm->add_option("--robot", request->robot, "ROBOT.yaml");
  CLI::Option* urdf = arm->add_option("--urdf", request->urdf, "URDF or SDF of the arm");
  arm->require_option(1);
  command->add_option("--base", request->base, "LINK of that file that the arm stands on")->needs(urdf);
  command->add_option("--tip", request->tip, "LINK of that file at the arm's flange")->needs(urdf);
  command->add_option("--poses", request->poses, "tables with joints and measured points; several are joined")
      ->required();
  command->add_option("--delimiter", request->delimiter, "between columns, where it cannot be told")
      ->check(CLI::IsMember({"comma", "semicolon", "tab", "blanks"}));
  command->add_option("--decimal", request->decimal, "sign of decimals, where it cannot be told")
      ->check(CLI::IsMember({"point", "comma"}));
  command->add_flag("--force", request->force,
                    "overwrite files that demecal did not write, or that were changed since");
  command->callback([request, &exit_code] { exit_code = run_new(*request); });
}

}  // namespace demecal
