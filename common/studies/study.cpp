#include "studies/study.hpp"

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "data/csv.hpp"
#include "data/text.hpp"
#include "expression/tree.hpp"
#include "report/json.hpp"

namespace demecal::inline studies {
namespace {

using Json = nlohmann::ordered_json;

/// Nothing where there is no run, or one without the figure.
template <class Figure>
std::optional<MedianInterval> interval_of(const std::vector<StudyRun>& runs, Figure StudyRun::*figure) {
  std::vector<double> values;
  for (const StudyRun& run : runs) {
    const std::optional<double> value(run.*figure);
    if (!value || !std::isfinite(*value)) return std::nullopt;
    values.push_back(*value);
  }
  if (values.empty()) return std::nullopt;
  return median_interval(std::move(values));
}

std::string field(std::optional<double> value) {
  return value && std::isfinite(*value) ? number_text(*value) : "";
}

/// A number where the text is one.
Json value_json(const std::string& text) {
  const std::optional<double> value = parse_number(text);
  if (!value) return text;
  return std::floor(*value) == *value && std::abs(*value) < 1e15 ? Json(static_cast<std::int64_t>(*value))
                                                                 : Json(*value);
}

Json parameters_json(const Study& study, std::size_t cell) {
  Json json = Json::object();
  for (std::size_t i = 0; i < study.keys.size(); ++i) json[study.keys[i]] = value_json(study.cells[cell][i]);
  return json;
}

Json interval_json(const std::optional<MedianInterval>& figure) {
  if (!figure) return nullptr;
  return {{"median", figure->median},
          {"lower", figure->lower},
          {"upper", figure->upper},
          {"interval", figure->confidence ? "order_statistics" : "least_and_largest"},
          {"confidence", json_of(figure->confidence)}};
}

Json cells_json(const Study& study) {
  Json json = Json::array();
  const std::vector<StudyCell> cells = study_cells(study);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    json.push_back({{"cell", i + 1},
                    {"parameters", parameters_json(study, i)},
                    {"runs", cells[i].runs},
                    {"calibration_rms_mm", interval_json(cells[i].calibration_mm)},
                    {"validation_rms_mm", interval_json(cells[i].validation_mm)},
                    {"accept_rms_mm", interval_json(cells[i].accept_mm)},
                    {"nodes", interval_json(cells[i].nodes)},
                    {"evaluations", interval_json(cells[i].evaluations)},
                    {"wall_s", interval_json(cells[i].wall_s)}});
  }
  return json;
}

Json run_json(const StudyRun& run) {
  return {{"cell", run.cell + 1},
          {"seed", run.seed},
          {"calibration_rms_mm", json_of(run.calibration_mm)},
          {"validation_rms_mm", json_of(run.validation_mm)},
          {"accept_rms_mm", json_of(run.accept_mm)},
          {"nodes", run.nodes},
          {"joints_corrected", run.corrected},
          {"evaluations", run.evaluations},
          {"wall_s", run.wall_s}};
}

Json block_json(const BuildingBlock& block) {
  return {{"block", block_text(block.form)}, {"nodes", block.form.size()},       {"joints", block.joints},
          {"islands", block.islands},        {"individuals", block.individuals}, {"mean_rank_share", block.rank_share}};
}

}  // namespace

std::vector<StudyCell> study_cells(const Study& study) {
  std::vector<StudyCell> cells;
  for (std::size_t i = 0; i < study.cells.size(); ++i) {
    std::vector<StudyRun> runs;
    for (const StudyRun& run : study.runs) {
      if (run.cell == i) runs.push_back(run);
    }
    cells.push_back({runs.size(), interval_of(runs, &StudyRun::calibration_mm),
                     interval_of(runs, &StudyRun::validation_mm), interval_of(runs, &StudyRun::accept_mm),
                     interval_of(runs, &StudyRun::nodes), interval_of(runs, &StudyRun::evaluations),
                     interval_of(runs, &StudyRun::wall_s)});
  }
  return cells;
}

std::string study_csv(const Study& study) {
  CsvTable table{.file = {}, .header_line = 0, .columns = {"cell", "seed"}, .rows = {}};
  table.columns.insert(table.columns.end(), study.keys.begin(), study.keys.end());
  for (const char* column : {"calibration_rms_mm", "validation_rms_mm", "accept_rms_mm", "nodes", "joints_corrected",
                             "evaluations", "wall_s"}) {
    table.columns.emplace_back(column);
  }
  for (const StudyRun& run : study.runs) {
    std::vector<std::string> fields{std::to_string(run.cell + 1), std::to_string(run.seed)};
    fields.insert(fields.end(), study.cells[run.cell].begin(), study.cells[run.cell].end());
    for (const std::optional<double>& figure : {run.calibration_mm, run.validation_mm, run.accept_mm})
      fields.push_back(field(figure));
    fields.push_back(std::to_string(run.nodes));
    fields.push_back(std::to_string(run.corrected));
    fields.push_back(std::to_string(run.evaluations));
    fields.push_back(fmt::format("{:.3f}", run.wall_s));
    table.rows.push_back({0, std::move(fields)});
  }
  return csv_text(table);
}

std::string to_json(const Study& study, int indent) {
  Json json{{"demecal_study", 1},
            {"job", study.job},
            {"robot", study.robot},
            {"data", study.data},
            {"data_sha256", study.data_sha256},
            {"version", study.version},
            {"closed_loop", study.closed_loop},
            {"interrupted", study.interrupted},
            {"parameters", study.keys},
            {"seeds", study.seeds},
            {"cells", cells_json(study)}};
  json["runs"] = Json::array();
  for (const StudyRun& run : study.runs) json["runs"].push_back(run_json(run));
  json["islands"] = study.islands;
  json["blocks"] = Json::array();
  for (const BuildingBlock& block : study.blocks) json["blocks"].push_back(block_json(block));
  return to_text(json, indent);
}

}  // namespace demecal::inline studies
