#include "coordinator/result_folder.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "closed_calibration/loop_passes.hpp"
#include "config/model_file.hpp"
#include "coordinator/argument_error.hpp"
#include "coordinator/written_files.hpp"
#include "data_check/check_data.hpp"
#include "errors/input_error.hpp"
#include "html/page.hpp"
#include "report/history.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

std::vector<HistoryRow> history_rows(const std::vector<Progress>& history) {
  std::vector<HistoryRow> rows;
  for (const Progress& progress : history) {
    rows.push_back({progress.island, progress.generation, progress.figures, progress.evaluations,
                    progress.migrants_taken, progress.worker});
  }
  return rows;
}

}  // namespace

std::vector<std::string> result_files(Method method) {
  std::vector<std::string> files{"model.yaml", "report.json", "report.html"};
  if (method != Method::diagnose && method != Method::structural) files.emplace_back("history.csv");
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

void write_result(const std::string& folder, const std::string& name, const std::string& bytes) {
  WrittenFiles(folder).write(name, bytes);
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
  write_result(folder, "model.yaml", model_text(result.model));
  CalibratedModel written = load_model(model_path);
  written.joints = result.model.joints;  // what is for people alone is not read back
  written.estimates = result.model.estimates;
  DataCheck check = result.check;
  check_fitted(data, written.robot, check);
  const Report report = make_report({.data = data,
                                     .model = written,
                                     .before = added_any(result.loop) ? result.before : written.robot,
                                     .loop = result.loop,
                                     .preparation = result.preparation,
                                     .calibration = result.calibration,
                                     .check = check,
                                     .distal = result.distal,
                                     .structure = result.structure,
                                     .runtime = result.facts});
  write_result(folder, "report.json", to_json(report));
  const bool evolves = method != Method::diagnose && method != Method::structural;
  const std::vector<HistoryRow> history = evolves ? history_rows(result.history) : std::vector<HistoryRow>{};
  if (report.distal) write_result(folder, "distal.csv", distal_csv(*report.distal));
  if (evolves) write_result(folder, "history.csv", history_csv(history));
  write_result(folder, "report.html", report_html(report, fitness_of(history)));
  return report;
}

}  // namespace demecal
