#include "coordinator/result_folder.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <ranges>
#include <sstream>
#include <system_error>
#include <utility>

#include "calibration/admissible.hpp"
#include "calibration/calibration.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "closed_calibration/loop_passes.hpp"
#include "config/model_file.hpp"
#include "coordinator/commands.hpp"
#include "data_check/check_data.hpp"
#include "errors/input_error.hpp"
#include "fitting/fit.hpp"
#include "fitting/stations.hpp"
#include "html/page.hpp"
#include "prediction/corrected_robot.hpp"
#include "protocol/messages.hpp"
#include "report/evaluation.hpp"
#include "report/history.hpp"
#include "report/make_report.hpp"
#include "trials/finding.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

constexpr const char* kList = ".demecal-files";
/// In place of a hash: of a file that is being written.
constexpr const char* kAnything = "----------------------------------------------------------------";

/// Words near the beginning of files by which those of earlier versions are known.
struct Mark {
  const char* name;
  const char* words;
};
constexpr std::array<Mark, 6> kMarks{{{"model.yaml", "demecal_model:"},
                                      {"report.json", "\"demecal_report\":"},
                                      {"report.html", "calibration report</title>"},
                                      {"events.jsonl", "\"demecal_events\":"},
                                      {"study.json", "\"demecal_study\":"},
                                      {"comparison.json", "\"demecal_comparison\":"}}};

bool has_mark(const std::string& folder, const Mark& mark) {
  constexpr std::size_t kBeginning = 4096;
  const std::string path = folder + "/" + mark.name;
  return std::filesystem::is_regular_file(path) &&
         read_file(path).substr(0, kBeginning).find(mark.words) != std::string::npos;
}

/// The file by whose mark one is known that has none of its own, and that nobody but demecal writes; otherwise none.
std::string witness_of(const std::string& name) {
  const auto is_its = [&name](const Mark& mark) { return mark.name == name; };
  if (std::ranges::any_of(kMarks, is_its)) return name;
  if (name == "study.csv") return "study.json";
  const bool result =
      name == "history.csv" || name == "fronts.csv" || name == "distal.csv" || name == "pose-errors.csv";
  return result ? "report.json" : "";
}

bool is_of_earlier_version(const std::string& folder, const std::string& name) {
  const std::string witness = witness_of(name);
  return std::ranges::any_of(kMarks, [&](const Mark& mark) { return mark.name == witness && has_mark(folder, mark); });
}

std::vector<HistoryRow> history_rows(const std::vector<Progress>& history) {
  std::vector<HistoryRow> rows;
  for (const Progress& progress : history) {
    rows.push_back({progress.island, progress.generation, progress.figures, progress.evaluations,
                    progress.migrants_taken, progress.worker});
  }
  return rows;
}

}  // namespace

bool holds_no_run(const std::string& folder) {
  const std::filesystem::path path(folder);
  const auto holds = [&](const char* name) { return std::filesystem::exists(path / name); };
  return !std::filesystem::is_empty(path) &&
         std::ranges::none_of(std::array{"run.journal", "events.jsonl", "model.yaml", "report.json"}, holds);
}

std::vector<std::string> result_files(Method method) {
  std::vector<std::string> files{"model.yaml", "model-best.yaml", "report.json", "report.html", "pose-errors.csv"};
  if (has_islands(method)) files.emplace_back("history.csv");
  if (has_islands(method)) files.emplace_back("fronts.csv");
  if (method == Method::distal) files.emplace_back("distal.csv");
  return files;
}

void make_writable(const std::string& folder, const std::vector<std::string>& files, bool force) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw InputError({folder, 0}, "", "cannot make the results folder: " + failure.message());
  const std::string probe = folder + "/.demecal-probe";
  if (!std::ofstream(probe))
    throw InputError({folder, 0}, "", std::string("cannot write here: ") + std::strerror(errno));
  std::filesystem::remove(probe, failure);
  const std::vector<std::string> strangers = WrittenFiles(folder).strangers(files);
  if (strangers.empty() || force) return;
  const bool one = strangers.size() == 1;
  throw ArgumentError(fmt::format(
      "{}: {} {} there already and {} not what demecal wrote there, or changed since: choose another folder, move {} "
      "away, or overwrite {} with --force",
      folder, fmt::join(strangers, ", "), one ? "is" : "are", one ? "is" : "are", one ? "it" : "them",
      one ? "it" : "them"));
}

void remove_earlier_results(const std::string& folder, const std::vector<std::string>& written) {
  std::vector<std::string> names = result_files(Method::distal);  // which has all that others have
  names.insert(names.end(), {"proposed.csv", "comparison.json", "events.jsonl"});
  WrittenFiles files(folder);
  for (const std::string& name : names) {
    if (std::ranges::find(written, name) == written.end()) files.remove(name);
  }
}

void write_result(const std::string& folder, const std::string& name, const std::string& bytes) {
  WrittenFiles(folder).write(name, bytes);
}

void write_named(const std::string& path, const std::string& bytes, const std::string& input, bool force) {
  const std::filesystem::path file(path);
  std::error_code none;
  if (std::filesystem::equivalent(file, input, none))
    throw ArgumentError(path + " is the file that was read, which is never overwritten; name another");
  const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
  make_writable(folder, {file.filename().string()}, force);
  write_result(folder, file.filename().string(), bytes);
}

FilesBeingWritten::FilesBeingWritten(std::string folder, std::vector<std::string> files)
    : folder_(std::move(folder)), files_(std::move(files)) {
  WrittenFiles written(folder_);
  for (const std::string& file : files_) written.begin(file);
}

FilesBeingWritten::~FilesBeingWritten() {
  try {
    WrittenFiles written(folder_);
    for (const std::string& file : files_) written.note_as_is(file);
  } catch (const std::exception&) {
    // The list still says that they are being written: the next run takes them for its own.
  }
}

Report write_results(const std::string& folder, const DataSet& data, const CalibrateResult& result) {
  const Method method = result.model.method;
  const std::string model_path = folder + "/model.yaml";
  remove_earlier_results(folder, result_files(method));
  const auto with_findings = [&](CalibratedModel model) {
    model.data_findings = result.check.kinds();
    model.of_one_contact = touches_one_contact_alone(data);
    return model_text(model);
  };
  write_result(folder, "model.yaml", with_findings(result.model));
  if (result.best) {
    write_result(folder, "model-best.yaml", with_findings(*result.best));
  } else {
    std::filesystem::remove(folder + "/model-best.yaml");
  }
  CalibratedModel written = load_model(model_path);
  written.robot = seen_from_stations(std::move(written.robot), written.stations, data);
  written.joints = result.model.joints;  // what is for people alone is not read back
  written.estimates = result.model.estimates;
  DataCheck check = result.check;
  check_fitted(data, written.robot, written.posterior, written.interval, check);
  const Report report = make_report({.data = data,
                                     .model = written,
                                     .before = added_any(result.loop) ? result.before : written.robot,
                                     .loop = result.loop,
                                     .preparation = result.preparation,
                                     .calibration = result.calibration,
                                     .check = check,
                                     .candidates = result.candidates,
                                     .distal = result.distal,
                                     .structure = result.structure,
                                     .runtime = result.facts});
  write_result(folder, "report.json", to_json(report));
  write_result(folder, "pose-errors.csv", pose_errors_csv(report));
  const bool evolves = has_islands(method);
  const std::vector<HistoryRow> history = evolves ? history_rows(result.history) : std::vector<HistoryRow>{};
  if (report.distal) write_result(folder, "distal.csv", distal_csv(*report.distal));
  if (evolves) write_result(folder, "history.csv", history_csv(history));
  if (evolves) write_result(folder, "fronts.csv", fronts_csv(evolved_fronts(result.candidates)));
  write_result(folder, "report.html", report_html(report, fitness_of(history)));
  return report;
}

WrittenFiles::WrittenFiles(std::string folder) : folder_(std::move(folder)) {
  if (!std::filesystem::exists(path_of(kList))) {
    take_over();
    return;
  }
  std::istringstream lines(read_file(path_of(kList)));
  std::string hash, name;
  while (lines >> hash >> std::ws && std::getline(lines, name)) hashes_[name].insert(hash);
}

/// Results of a folder whose list is lost are as if listed; tables and files that people write, too, are not.
void WrittenFiles::take_over() {
  if (!std::filesystem::is_directory(folder_)) return;
  for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && is_of_earlier_version(folder_, name))
      hashes_[name] = {sha256(read_file(entry.path()))};
  }
}

bool WrittenFiles::is_ours(const std::string& name) const {
  const auto known = hashes_.find(name);
  if (known == hashes_.end()) return false;
  return known->second.contains(kAnything) || known->second.contains(sha256(read_file(path_of(name))));
}

std::vector<std::string> WrittenFiles::strangers(const std::vector<std::string>& names) const {
  std::vector<std::string> found;
  for (const std::string& name : names) {
    if (std::filesystem::exists(path_of(name)) && !is_ours(name)) found.push_back(name);
  }
  return found;
}

void WrittenFiles::write(const std::string& name, const std::string& bytes) {
  hashes_[name].insert(sha256(bytes));
  save();
  write_file(path_of(name), bytes);
  note_as_is(name);
}

void WrittenFiles::begin(const std::string& name) {
  hashes_[name] = {kAnything};
  save();
}

void WrittenFiles::note_as_is(const std::string& name) {
  if (std::filesystem::exists(path_of(name))) {
    hashes_[name] = {sha256(read_file(path_of(name)))};
  } else {
    hashes_.erase(name);
  }
  save();
}

void WrittenFiles::remove(const std::string& name) {
  const auto known = hashes_.find(name);
  if (known == hashes_.end() || known->second.contains(kAnything)) return;
  if (std::filesystem::exists(path_of(name)) && !is_ours(name)) return;
  std::filesystem::remove(path_of(name));
  hashes_.erase(known);
  save();
}

void WrittenFiles::save() const {
  std::string text;
  for (const auto& [name, hashes] : hashes_) {
    for (const std::string& hash : hashes) text += hash + "  " + name + "\n";
  }
  write_file(path_of(kList), text);
}

}  // namespace demecal
