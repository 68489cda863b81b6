#include "studies/change_report.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "data/certificate_fields.hpp"
#include "data/columns.hpp"
#include "data/csv.hpp"
#include "data/text.hpp"
#include "effects/effect.hpp"
#include "kinematics/units.hpp"
#include "next_measurement/next_measurement.hpp"
#include "report/history.hpp"
#include "studies/change_advice.hpp"
#include "updating/implausible_change.hpp"

namespace demecal::inline studies {
namespace {

/// "= 0.03"; "below 1e-12" where rounding is all that is left of it.
std::string chance_text(double p) {
  constexpr double kRounding = 1e-12;
  return p < kRounding ? "below 1e-12" : fmt::format("= {:.2g}", p);
}

using Json = nlohmann::ordered_json;

Json cause_json(const ChangeCause& cause, const std::string& sentence) {
  const auto [unit, per_inside] = shown_unit(cause.unit);
  return {{"kind", cause.effect.kind},
          {"joint", cause.effect.joint < 0 ? Json() : Json(cause.effect.joint + 1)},
          {"p_value", cause.p_value},
          {"p_family", cause.p_family},
          {"size", cause.size * per_inside},
          {"standard_error", cause.standard_error * per_inside},
          {"unit", unit},
          {"by_model", cause.by_model ? Json(*cause.by_model * per_inside) : Json()},
          {"smallest_detectable", std::isfinite(cause.detectable) ? Json(cause.detectable * per_inside) : Json()},
          {"power", cause.power},
          {"rivals", cause.rivals},
          {"sentence", sentence}};
}

std::string left_out_line(const ChangeReport& change, const DataSet& data) {
  return fmt::format("  left out, since they fit neither the robot as it was nor any change of it: {}\n",
                     names_with_lines(data, change.outliers));
}

std::string answer(const ChangeReport& change) {
  if (change.verdict == ChangeVerdict::unchanged)
    return change.lacking.empty() && change.unseen_zeros.empty()
               ? "The robot is as it was."
               : "As far as these poses can tell, the robot is as it was.";
  if (change.verdict == ChangeVerdict::registration)
    return change.set_up_anew ? "The robot is as it was; the instrument was set up anew."
                              : "The robot is as it was, but its base stands elsewhere in the instrument's frame.";
  if (change.unnamed) return "The robot has changed, by something that cannot be named.";
  return change.more ? "The robot has changed, and not all of it can be named." : "The robot has changed.";
}

}  // namespace

std::string to_json(const ChangeReport& change, const DataSet& data, const std::string& model_file) {
  Json json{{"demecal_check", 1},
            {"model", model_file},
            {"data", data.name},
            {"verdict", std::string(to_string(change.verdict))},
            {"answer", answer(change)},
            {"poses", change.poses},
            {"measurements", change.measurements},
            {"set_up_anew", change.set_up_anew},
            {"far_beyond_usual", is_far_beyond_usual(change)},
            {"p_any", change.p_any},
            {"strain", change.strain},
            {"strain_limit", change.strain_limit},
            {"noise_mm", millimetres(change.noise_m)},
            {"orientations_judged", change.orientation_rad > 0.0},
            {"orientation_noise_deg", change.orientation_rad > 0.0 ? Json(degrees(change.orientation_rad)) : Json()},
            {"error_mm", {{"by_model", millimetres(change.error_m)}, {"explained", millimetres(change.left_m)}}},
            {"cause", Json()},
            {"causes", Json::array()},
            {"advice", what_to_do(change, model_file)},
            {"tried", Json::array()},
            {"outliers", Json::array()},
            {"not_testable", change.lacking}};
  json["unseen_zeros"] = Json::array();
  for (const UnseenZero& one : change.unseen_zeros) {
    json["unseen_zeros"].push_back(one.joint + 1);
    json["not_testable"].push_back(one.sentence);
  }
  for (const std::string& sentence : change.not_testable) json["not_testable"].push_back(sentence);
  const auto of_found = [&](const ChangeCause& cause) {
    return cause_json(cause, sentence_on(change, cause, data.robot));
  };
  for (const ChangeCause& cause : change.found) json["causes"].push_back(of_found(cause));
  if (!change.found.empty()) json["cause"] = of_found(change.found.front());
  for (const ChangeCause& cause : change.found)
    if (!cause.is_registration) {
      json["cause"] = of_found(cause);
      break;
    }
  for (const ChangeCause& cause : change.tried)
    json["tried"].push_back(cause_json(cause, sentence_on(cause, data.robot)));
  for (const std::size_t pose : change.outliers) json["outliers"].push_back(data.poses[pose].pose_id);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string change_text(const ChangeReport& change, const DataSet& data, const std::string& model_file) {
  std::string text = answer(change) + '\n', unseen;
  for (const std::string& sentence : change.lacking) unseen += "  " + sentence + '\n';
  for (const UnseenZero& one : change.unseen_zeros) unseen += "  " + one.sentence + '\n';
  // Where nothing was found, "as far as these poses can tell" wants to be explained first.
  const bool nothing_found = change.verdict == ChangeVerdict::unchanged;
  if (nothing_found) text += unseen;
  for (const ChangeCause& cause : change.found) {
    text += "  " + sentence_on(change, cause, data.robot) + '\n';
    text += fmt::format("    p {} (all causes tried: p {})\n", chance_text(cause.p_value), chance_text(cause.p_family));
    if (!cause.rivals.empty())
      text += fmt::format("    cannot be distinguished with these poses from: {}\n", fmt::join(cause.rivals, ", "));
  }
  text += "  " + what_to_do(change, model_file) + '\n';
  if (!nothing_found) text += unseen;
  text += fmt::format("  errors of the tool: rms {:.3g} mm by the model", millimetres(change.error_m));
  if (!change.found.empty()) text += fmt::format(", {:.3g} mm once this is taken in", millimetres(change.left_m));
  text +=
      fmt::format("; {} poses{}, noise {:.3g} mm{} per axis\n", change.poses,
                  change.measurements > change.poses ? fmt::format(" measured {} times", change.measurements) : "",
                  millimetres(change.noise_m),
                  change.orientation_rad > 0.0 ? fmt::format(" and {:.2g} deg", degrees(change.orientation_rad)) : "");
  if (!change.outliers.empty()) text += left_out_line(change, data);
  text += "  what these poses find nine times in ten:\n";
  for (const ChangeCause& cause : change.tried) {
    const auto [unit, per_inside] = shown_unit(cause.unit);
    text += fmt::format("    {}: {:.2g} {}\n", to_string(cause.effect), cause.detectable * per_inside, unit);
  }
  for (const std::string& sentence : change.not_testable) text += "  " + sentence + '\n';
  return text;
}

namespace {

/// Those behind `model` are of later versions: a record may lack them.
const std::vector<std::string>& history_columns() {
  static const std::vector<std::string> all{"date",  "verdict", "strain", "strain_limit", "error_mm",    "poses",
                                            "cause", "data",    "model",  "robot",        "model_sha256"};
  return all;
}

}  // namespace

std::string checked_robot(const CalibratedModel& model) {
  const std::string serial = model.certificate.text("serial_number");
  return on_one_line(model.nominal.name + (serial.empty() ? "" : ", serial number " + serial));
}

bool CheckRecord::of_model_of(const CheckRecord& other) const {
  const bool both_say = !model_sha256.empty() && !other.model_sha256.empty();
  return both_say ? model_sha256 == other.model_sha256 : model == other.model;
}

CheckRecord check_record(const ChangeReport& change, const DataSet& data, const CalibratedModel& model,
                         const std::string& model_file, const std::string& model_sha256, const std::string& date) {
  std::string causes;
  for (const ChangeCause& cause : change.found) causes += (causes.empty() ? "" : " and ") + to_string(cause.effect);
  if (change.unnamed) causes = "cannot be named";
  if (change.more) causes += " and more";
  return {.date = date,
          .model = model_file,
          .data = data.name,
          .poses = change.poses,
          .verdict = std::string(to_string(change.verdict)),
          .strain = change.strain,
          .strain_limit = change.strain_limit,
          .error_mm = millimetres(change.error_m),
          .cause = causes,
          .robot = checked_robot(model),
          .model_sha256 = model_sha256};
}

std::string check_history_csv(const std::vector<CheckRecord>& records) {
  CsvTable table;
  table.columns = history_columns();
  for (const CheckRecord& one : records)
    table.rows.push_back({0,
                          {on_one_line(one.date), one.verdict, number_text(one.strain), number_text(one.strain_limit),
                           number_text(one.error_mm), std::to_string(one.poses), on_one_line(one.cause),
                           on_one_line(one.data), on_one_line(one.model), on_one_line(one.robot), one.model_sha256}});
  return csv_text(table);
}

std::vector<CheckRecord> read_check_history(const std::string& text, const std::string& file) {
  std::vector<CheckRecord> records;
  if (text.empty()) return records;
  std::istringstream in(text);
  const CsvTable table = read_csv(in, file);
  constexpr std::size_t kRequired = 9;
  std::vector<std::optional<TableColumn>> read(history_columns().size());
  for (std::size_t i = 0; i < read.size(); ++i)
    if (const std::string& name = history_columns()[i]; i < kRequired || std::ranges::count(table.columns, name) > 0)
      read[i].emplace(table, ColumnName{name, {file, table.header_line}});
  const auto text_of = [&](std::size_t column, const CsvRow& row) {
    return read[column] ? read[column]->text(row) : std::string();
  };
  for (const CsvRow& row : table.rows)
    records.push_back({.date = text_of(0, row),
                       .model = text_of(8, row),
                       .data = text_of(7, row),
                       .poses = static_cast<std::uint64_t>(std::max(0.0, read[5]->number(row))),
                       .verdict = text_of(1, row),
                       .strain = read[2]->number(row),
                       .strain_limit = read[3]->number(row),
                       .error_mm = read[4]->number(row),
                       .cause = text_of(6, row),
                       .robot = text_of(9, row),
                       .model_sha256 = text_of(10, row)});
  return records;
}

}  // namespace demecal::inline studies
