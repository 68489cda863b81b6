#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "expression/bound.hpp"
#include "report/error_fields.hpp"
#include "report/json.hpp"
#include "report/pose_places.hpp"
#include "report/report.hpp"

namespace demecal::inline report {
namespace {

constexpr std::uint64_t kReportVersion = 1;

}  // namespace

// Not in an anonymous namespace: json_of() and read_json() find these by their arguments.

nlohmann::ordered_json json_of(const std::vector<NamedNumber>& numbers) {
  nlohmann::ordered_json named = nlohmann::ordered_json::object();
  for (const NamedNumber& number : numbers) named[number.name] = json_of(number.value);
  return named;
}

void read_json(const JsonValue& json, std::vector<NamedNumber>& numbers) {
  for (const auto& [name, value] : json.members()) numbers.push_back({name, value.number()});
}

nlohmann::ordered_json json_of(const std::vector<NamedInterval>& intervals) {
  nlohmann::ordered_json named = nlohmann::ordered_json::object();
  for (const NamedInterval& interval : intervals)
    named[interval.name] = {json_of(interval.lower), json_of(interval.upper)};
  return named;
}

void read_json(const JsonValue& json, std::vector<NamedInterval>& intervals) {
  for (const auto& [name, ends] : json.members()) {
    const std::vector<JsonValue> both = ends.elements();
    NamedInterval& interval = intervals.emplace_back(NamedInterval{name, std::nullopt, std::nullopt});
    if (both.size() != 2) continue;
    interval.lower = both[0].number();
    interval.upper = both[1].number();
  }
}

nlohmann::ordered_json json_of(const std::optional<Interval>& range) {
  return range ? nlohmann::ordered_json{range->lower, range->upper} : nlohmann::ordered_json{nullptr, nullptr};
}

void read_json(const JsonValue& json, std::optional<Interval>& range) {
  const std::vector<double> ends = json.numbers();
  if (ends.empty()) return;
  if (ends.size() != 2 || ends[0] > ends[1]) json.refuse("must be the two ends of a range, the lower one first");
  range = Interval{ends[0], ends[1]};
}

void fields(auto& visit, Like<BeforeAfter> auto& figure) {
  visit("before", figure.before, "after", figure.after);
}

void fields(auto& visit, Like<ExcludedPose> auto& pose) {
  visit("id", pose.id, "set", pose.set, "error_mm", pose.error_mm);
}

void fields(auto& visit, Like<WorkspaceEntry> auto& error) {
  visit("rms_mm", error.rms_mm, "p95_mm", error.p95_mm, "beside_base", error.beside_base);
}
void fields(auto& visit, Like<PredictionEntry> auto& prediction) {
  visit("quantile", prediction.quantile, "noise_mm", prediction.noise_mm, "distance_noise_mm",
        prediction.distance_noise_mm, "model_error_mm", prediction.model_error_mm, "told_by", prediction.pose_set,
        "poses", prediction.poses, "gross_errors", prediction.gross_errors, "remark", prediction.remark);
}

template <class Visit>
void place_fields(Visit& visit, Like<EffectEntry> auto& effect) {
  visit("kind", effect.kind, "joint", effect.joint);
  if constexpr (kReads<Visit>) {
    if (effect.joint == 0U) effect.joint.reset();
  }
  visit.when(!effect.form.empty(), "form", effect.form);
  visit("parameters", effect.parameters);
  visit.when(!effect.standard_errors.empty(), "standard_errors", effect.standard_errors);
}

void fields(auto& visit, Like<EffectEntry> auto& effect) {
  place_fields(visit, effect);
  const bool has_size = effect.amplitude || !effect.unit.empty();
  visit.when(has_size, "amplitude", effect.amplitude);
  visit.when(has_size, "unit", effect.unit);
}

void fields(auto& visit, Like<RivalEntry> auto& rival) {
  fields(visit, rival.effect);
  visit("cosine", rival.cosine, "nats_behind", rival.nats_behind);
}

void fields(auto& visit, Like<ClassMember> auto& member) {
  visit("kind", member.kind, "joint", member.joint);
}

void fields(auto& visit, Like<NextMeasurementEntry> auto& next) {
  visit("sentence", next.sentence, "poses", next.poses);
}

void fields(auto& visit, Like<RoundEntry> auto& round) {
  visit("round", round.round, "group", round.group, "verdict", round.verdict, "effect", round.effect, "diagnosis",
        round.diagnosis, "formula", round.formula, "reason", round.reason, "implausible", round.implausible, "class",
        round.members, "class_sentence", round.class_sentence, "rivals", round.rivals, "p_structure", round.p_structure,
        "p_family", round.p_family, "permutations", round.null_draws, "fall_nats", round.gain_nats, "confirmed",
        round.confirmed, "confirmed_lower", round.confirmed_lower, "sign_stability", round.sign_stability, "interval",
        round.interval, "validation_before_mm", round.validation_before_mm, "validation_after_mm",
        round.validation_after_mm, "further", round.next_measurement);
}

void fields(auto& visit, Like<NotFoundEntry> auto& missing) {
  place_fields(visit, missing.effect);
  visit("smallest_detectable", missing.smallest_detectable, "unit", missing.unit, "sentence", missing.sentence);
}

void fields(auto& visit, Like<UntestableEntry> auto& kind) {
  visit("kind", kind.kind, "reason", kind.reason);
}

void fields(auto& visit, Like<DecoyEntry> auto& decoy) {
  visit("name", decoy.name, "best_fall_nats", decoy.best_gain_nats, "p_left", decoy.p_left, "won", decoy.won);
}

void fields(auto& visit, Like<NoiseEntry> auto& noise) {
  visit("independent_mm", noise.independent_mm, "estimated", noise.estimated, "joint_repeatability_mrad",
        noise.joint_repeatability_mrad, "shared_by_repeats_mm", noise.shared_by_repeats_mm, "shared_in_order_mm",
        noise.shared_in_order_mm, "correlation_in_order", noise.correlation_in_order);
}

template <class Visit>
void fields(Visit& visit, Like<JointEntry> auto& joint) {
  visit("joint", joint.joint, "kept", joint.kept, "expression", joint.expression, "mean_abs_error_rad",
        joint.mean_abs_error_rad, "range_rad", joint.range_rad, "bound_rad", joint.bound_rad, "discontinuities_rad",
        joint.discontinuities_rad);
  visit.when(joint.limit_rad.has_value(), "limit_rad", joint.limit_rad);
  visit.when(!joint.with_functions.empty(), "with_functions", joint.with_functions);
  visit.when(!joint.note.empty(), "note", joint.note);
  visit.when(!joint.origin.empty(), "origin", joint.origin);
  visit.when(!joint.short_form.empty(), "short_form", joint.short_form);
  visit.when(!joint.as_evolved.empty(), "as_evolved", joint.as_evolved);
  visit.when(!joint.as_evolved.empty(), "as_evolved_error_rad", joint.as_evolved_error_rad);
  if constexpr (kReads<Visit>) {
    if (!visit.has("kept")) joint.kept = !joint.expression.empty();
  }
}

void fields(auto& visit, Like<SharedFunctionEntry> auto& function) {
  visit("definition", function.definition, "joints", function.joints);
}

void fields(auto& visit, Like<DistalEntry> auto& step) {
  visit("joint", step.joint, "generation", step.generation, "expression", step.expression, "index_mm2", step.index_mm2);
}

void fields(auto& visit, Like<ParameterEntry> auto& parameter) {
  visit("name", parameter.name, "nominal", parameter.nominal, "value", parameter.value, "standard_error",
        parameter.standard_error);
}

void fields(auto& visit, Like<WaitingEntry> auto& waited) {
  visit("worker", waited.worker, "share", waited.share);
}

void fields(auto& visit, Like<RuntimeEntry> auto& runtime) {
  visit("wall_s", runtime.wall_s, "workers", runtime.workers, "islands", runtime.islands, "generations",
        runtime.generations, "evaluations", runtime.evaluations, "migrations", runtime.migrations, "evolved_sets",
        runtime.evolved_sets, "dropped_samples", runtime.dropped_samples, "interrupted", runtime.interrupted,
        "asynchronous", runtime.asynchronous, "resumed", runtime.resumed, "waited_share", runtime.waited_share);
}

void fields(auto& visit, Like<CauseEntry> auto& cause) {
  visit("cause", cause.cause, "joint", cause.joint, "name", cause.name, "effects", cause.effects);
  visit.within("error_mm", [&](auto& error) { error("without", cause.without_mm, "with", cause.with_mm); });
  visit("share_of_error", cause.share_of_error, "interval_mm", cause.interval_mm, "advice", cause.advice,
        "alternatives", cause.alternatives);
}

void fields(auto& visit, Like<UnexplainedEntry> auto& unexplained) {
  visit("error_mm", unexplained.error_mm, "left_mm", unexplained.left_mm, "noise_mm", unexplained.noise_mm, "advice",
        unexplained.advice);
}

void fields(auto& visit, Like<FrontEntry> auto& point) {
  visit("causes", point.causes, "validation_rms_mm", point.validation_rms_mm, "accept_rms_mm", point.accept_rms_mm,
        "chosen", point.chosen);
}

void fields(auto& visit, Like<ContactEntry> auto& contact) {
  visit("contact", contact.contact, "set", contact.set, "kind", contact.kind, "poses", contact.poses,
        "registered_rms_mm", contact.registered_rms_mm, "before_rms_mm", contact.before_rms_mm, "after_rms_mm",
        contact.after_rms_mm);
}

void fields(auto& visit, Like<StationEntry> auto& station) {
  visit("name", station.name, "poses", station.poses);
  visit.within("error_mm", [&](auto& stage) {
    stage("registered", station.registered, "before", station.before, "after", station.after);
  });
  visit("noise_mm", station.noise_mm, "noise_floor_mm", station.noise_floor_mm);
}

bool has_figures(const ErrorBySet& errors) {
  return errors.calibration.mean_mm || errors.validation.mean_mm || errors.accept.mean_mm;
}

void loop_fields(auto& visit, Like<Report> auto& report) {
  visit("causes", report.causes, "front", report.front, "unexplained", report.unexplained, "rounds", report.rounds,
        "dropped", report.dropped, "not_found", report.not_found, "unseen", report.untestable, "considered",
        report.considered, "decoys", report.decoys, "stopped", report.stopped, "lack_of_fit_p", report.lack_of_fit_p,
        "explained_share", report.explained_share, "structure_left_p", report.structure_left_p, "noise", report.noise,
        "candidates", report.candidates, "permutations", report.null_draws);
}

void fields(auto& visit, Like<Report> auto& report) {
  visit("job", report.job, "robot", report.robot, "method", report.method, "seed", report.seed, "data_sha256",
        report.data_sha256, "version", report.version, "data_check", report.data_check);
  visit.within("poses", [&](auto& poses) {
    poses("calibration", report.poses.calibration, "validation", report.poses.validation, "accept",
          report.poses.accept);
    poses("outliers", report.poses.outliers, "excluded", report.poses.excluded, "near_singular",
          report.poses.near_singular);
  });
  visit.within("error_mm", [&](auto& stage) {
    stage("nominal", report.nominal, "registered", report.registered, "declared", report.declared, "before",
          report.before, "after", report.after);
    stage.when(has_figures(report.as_evolved), "as_evolved", report.as_evolved);
  });
  visit.when(!report.stations.empty(), "stations", report.stations);
  visit.within("last_fit", [&](auto& fit) {
    fit("poses", report.fitted_sets);
    fit.when(report.unseen_validation_rms_mm.has_value(), "unseen_validation_rms_mm", report.unseen_validation_rms_mm);
  });
  visit.when(report.arm.has_value(), "arm", report.arm);
  visit("pose_errors", report.pose_errors);
  visit.when(!report.contacts.empty(), "length_errors_mm", report.length_errors);
  visit.when(!report.contacts.empty(), "contacts", report.contacts);
  visit.when(!report.contact_notes.empty(), "contact_notes", report.contact_notes);
  visit("prediction_interval", report.prediction_interval);
  visit.when(report.workspace_error.has_value(), "workspace_error", report.workspace_error);
  visit("noise_floor_mm", report.noise_floor_mm);
  loop_fields(visit, report);
  visit("performance_index_mm2", report.performance_index_mm2, "joints", report.joints);
  visit.when(report.shared_functions.has_value(), "shared_functions", report.shared_functions);
  visit.when(report.distal.has_value(), "distal", report.distal);
  visit("parameters", report.parameters, "unidentified", report.unidentified, "runtime", report.runtime);
}

std::string to_json(const Report& report) {
  nlohmann::ordered_json json{{"demecal_report", kReportVersion}};
  JsonWriter write(json);
  fields(write, report);
  return to_text(json, 2);
}

Report read_report(const std::string& text, const std::string& file) {
  const JsonValue json = JsonValue::parse(text, file);
  const JsonValue version = json["demecal_report"];
  if (version.count() != kReportVersion)
    version.refuse("must be 1, the version of the reports that this program reads");
  Report report;
  read_json(json, report);
  // Reports that other programs wrote may leave it to the order.
  for (std::size_t i = 0; i < report.rounds.size(); ++i) {
    if (report.rounds[i].round == 0) report.rounds[i].round = i + 1;
  }
  for (std::size_t i = 0; i < report.joints.size(); ++i) {
    if (report.joints[i].joint == 0) report.joints[i].joint = i + 1;
    std::ranges::sort(report.joints[i].discontinuities_rad);
  }
  return report;
}

}  // namespace demecal::inline report
