#include "coordinator/result_folder.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "calibration/loop_passes.hpp"
#include "config/files.hpp"
#include "config/model_text.hpp"
#include "data_check/fitted_model.hpp"
#include "errors/input_error.hpp"
#include "report/history.hpp"
#include "report/report_html.hpp"
#include "report/report_json.hpp"

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

void make_writable(const std::string& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw InputError({folder, 0}, "", "cannot make the results folder: " + failure.message());
  const std::string probe = folder + "/.demecal-probe";
  if (!std::ofstream(probe))
    throw InputError({folder, 0}, "", std::string("cannot write here: ") + std::strerror(errno));
  std::filesystem::remove(probe, failure);
}

CalibrationReport write_results(const std::string& folder, const DataSet& data, const CalibrateResult& result) {
  const std::string model_path = folder + "/model.yaml";
  write_file(model_path, model_text(result.model));
  CalibratedModel written = load_model(model_path);
  written.joints = result.model.joints;  // what is for people alone is not read back
  written.estimates = result.model.estimates;
  const CorrectedRobot& before = added_any(result.loop) ? result.before : written.robot;
  CalibrationReport report =
      make_report(data, written, before, result.loop, result.preparation, result.calibration, result.facts);
  report.check = result.check;
  check_fitted(data, written.robot, report.check);
  const bool evolves = result.model.method != Method::diagnose && result.model.method != Method::structural;
  if (!evolves && !has_corrections(written.robot)) report.joints.clear();
  report.structure = result.structure;
  if (result.model.method == Method::structural) report.unidentified.clear();  // they are of the fit to compare with
  report.distal = result.distal;
  const std::string json = to_json(report);
  write_file(folder + "/report.json", json);
  const std::string history = history_csv(history_rows(result.history));
  if (result.model.method == Method::distal) write_file(folder + "/distal.csv", distal_csv(result.distal));
  if (evolves) write_file(folder + "/history.csv", history);
  write_file(folder + "/report.html", report_html(json, evolves ? history : ""));
  return report;
}

}  // namespace demecal
