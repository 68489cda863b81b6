#include "report/report_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "expression/text.hpp"
#include "kinematics/units.hpp"
#include "report/data_check_text.hpp"
#include "report/json_number.hpp"
#include "report/loop_json.hpp"
#include "report/pose_errors_json.hpp"

namespace demecal {
namespace {

using Json = nlohmann::ordered_json;

/// Names come from files and may hold bytes that are no UTF-8: they are replaced, lest there be no report.
std::string text_of(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json figures(const ErrorFigures& errors) {
  return {{"mean", number_or_null(errors.mean_mm)},
          {"rms", number_or_null(errors.rms_mm)},
          {"p95", number_or_null(errors.p95_mm)},
          {"max", number_or_null(errors.max_mm)}};
}

Json by_set(const ErrorBySet& errors) {
  return {{"calibration", figures(errors.calibration)},
          {"validation", figures(errors.validation)},
          {"accept", figures(errors.accept)}};
}

Json joint(const JointLine& line) {
  Json entry{{"joint", line.summary.joint + 1},
             {"kept", line.summary.kept},
             {"expression", line.expression},
             {"mean_abs_error_rad",
              {{"before", number_or_null(line.summary.before_rad)}, {"after", number_or_null(line.summary.after_rad)}}},
             {"range_rad", {number_or_null(line.range_rad.lower), number_or_null(line.range_rad.upper)}},
             {"bound_rad", number_or_null(line.summary.bound_rad)},
             {"discontinuities_rad", line.summary.discontinuities_rad}};
  if (!line.with_functions.empty()) entry["with_functions"] = line.with_functions;
  if (!line.summary.note.empty()) entry["note"] = line.summary.note;
  return entry;
}

Json shared_function(const SharedFunctionLine& line) {
  Json joints = Json::array();
  for (const int joint : line.joints) joints.push_back(joint + 1);
  return {{"definition", line.definition}, {"joints", joints}};
}

Json step(const DistalStep& step) {
  return {{"joint", step.joint + 1},
          {"generation", step.generation},
          {"expression", to_text(step.correction.formula())},
          {"index_mm2", number_or_null(step.index_mm2)}};
}

Json parameter(const ParameterEstimate& estimate) {
  const bool angle = estimate.id.is_angle();
  const double border = angle ? degrees(1.0) : millimetres(1.0);
  return {{"name", estimate.id.name()},
          {"nominal", number_or_null(estimate.nominal * border)},
          {"value", number_or_null(estimate.value * border)},
          {"standard_error", number_or_null(estimate.standard_error * border)}};
}

/// Beside the parameters of base and tool: nominally there is nothing between the links.
Json parameter(const FoundTransform& transform) {
  return {{"name", transform.name()},
          {"nominal", 0.0},
          {"value", number_or_null(transform.at_border(transform.value))},
          {"standard_error", number_or_null(transform.at_border(transform.standard_error))}};
}

Json waited_share(const RunFacts& facts) {
  Json all = Json::array();
  for (const auto& [worker, share] : facts.waited_share)
    all.push_back({{"worker", worker}, {"share", number_or_null(share)}});
  return all;
}

Json runtime(const RunFacts& facts) {
  return {{"wall_s", number_or_null(facts.wall_s)},
          {"workers", facts.workers},
          {"islands", facts.islands},
          {"generations", facts.generations},
          {"evaluations", facts.evaluations},
          {"migrations", facts.migrations},
          {"dropped_samples", facts.dropped_samples},
          {"interrupted", facts.interrupted},
          {"asynchronous", facts.asynchronous},
          {"resumed", facts.resumed},
          {"waited_share", waited_share(facts)}};
}

Json excluded(const std::vector<ExcludedPose>& poses) {
  Json all = Json::array();
  for (const ExcludedPose& pose : poses)
    all.push_back({{"id", pose.id}, {"set", pose.set}, {"error_mm", number_or_null(pose.error_mm)}});
  return all;
}

Json error_stages(const CalibrationReport& report) {
  return {{"nominal", by_set(report.nominal)},
          {"registered", by_set(report.registered)},
          {"declared", by_set(report.declared)},
          {"before", by_set(report.before)},
          {"after", by_set(report.after)}};
}

/// Which poses the numbers of the model come from, and what validation poses said while they were unseen.
Json last_fit(const CalibrationReport& report) {
  if (!report.unseen) return {{"poses", {"calibration"}}};
  return {{"poses", {"calibration", "validation"}},
          {"unseen_validation_rms_mm",
           {{"before", number_or_null(report.unseen->before_mm)}, {"after", number_or_null(report.unseen->after_mm)}}}};
}

}  // namespace

std::string to_json(const CalibrationReport& report) {
  Json json{{"demecal_report", 1},      {"job", report.job},   {"robot", report.robot},
            {"method", report.method},  {"seed", report.seed}, {"data_sha256", report.data_sha256},
            {"version", report.version}};
  json["data_check"] = data_check_to_json(report.check);
  json["poses"] = {{"calibration", report.poses.calibration}, {"validation", report.poses.validation},
                   {"accept", report.poses.accept},           {"outliers", report.outliers},
                   {"excluded", excluded(report.excluded)},   {"near_singular", report.near_singular}};
  json["error_mm"] = error_stages(report);
  json["last_fit"] = last_fit(report);
  json["pose_errors"] = pose_errors_to_json(report.pose_errors);
  json["prediction_interval"] = report.interval ? prediction_to_json(*report.interval) : Json(nullptr);
  json["noise_floor_mm"] = report.noise_floor_mm ? number_or_null(*report.noise_floor_mm) : Json(nullptr);
  add_loop(report.loop, report.described, json);
  json["performance_index_mm2"] = {{"before", number_or_null(report.index_before_mm2)},
                                   {"after", number_or_null(report.index_after_mm2)}};
  json["joints"] = Json::array();
  for (const JointLine& line : report.joints) json["joints"].push_back(joint(line));
  if (report.functions) {
    json["shared_functions"] = Json::array();
    for (const SharedFunctionLine& line : *report.functions) json["shared_functions"].push_back(shared_function(line));
  }
  if (report.method == word_of(Method::distal)) {
    json["distal"] = Json::array();
    for (const DistalStep& one : report.distal) json["distal"].push_back(step(one));
  }
  json["parameters"] = Json::array();
  for (const ParameterEstimate& estimate : report.estimates) {
    if (estimate.id.kind == ParameterId::Kind::effect) continue;  // effects stand with the rounds that added them
    json["parameters"].push_back(parameter(estimate));
  }
  for (const FoundTransform& transform : report.structure) json["parameters"].push_back(parameter(transform));
  json["unidentified"] = report.unidentified;
  json["runtime"] = runtime(report.runtime);
  return text_of(json, 2);
}

std::string errors_to_json(const ErrorBySet& errors, const DataCheck& check,
                           const std::vector<UnappliedEffect>& unapplied, const std::vector<PoseErrorLine>& poses) {
  Json effects = Json::array();
  for (const UnappliedEffect& one : unapplied) {
    effects.push_back({{"kind", one.kind},
                       {"joint", one.joint < 0 ? Json(nullptr) : Json(one.joint + 1)},
                       {"lacking", one.lacking},
                       {"poses", one.poses},
                       {"sentence", one.sentence()}});
  }
  const Json found = data_check_to_json(check), of_poses = pose_errors_to_json(poses);
  return text_of(Json{{"error_mm", by_set(errors)},
                      {"pose_errors", of_poses},
                      {"data_check", found},
                      {"effects_not_applied", effects}},
                 -1);
}

}  // namespace demecal
