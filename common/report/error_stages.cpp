#include "report/error_stages.hpp"

#include <algorithm>

namespace demecal {
namespace {

struct StageName {
  const char* key;
  const char* title;
};
constexpr std::array<StageName, 5> kStages{{{"nominal", "nominal robot"},
                                            {"registered", "base fitted"},
                                            {"declared", "declared model fitted"},
                                            {"before", "with joint corrections"},
                                            {"after", "with the effects found"}}};

StageFigures figures(const JsonValue& json) {
  return {json["mean"].number(), json["rms"].number(), json["p95"].number(), json["max"].number()};
}

bool has_figures(const Stage& stage) {
  return std::ranges::any_of(stage.sets, [](const StageFigures& set) { return set.mean_mm.has_value(); });
}

bool loop_added(const JsonValue& report) {
  const std::vector<JsonValue> rounds = report["rounds"].elements();
  return std::ranges::any_of(rounds, [](const JsonValue& round) { return round["verdict"].text() == "added"; });
}

/// What the stage of everything declared adds to the fit.
const char* declared_stage(const JsonValue& report) {
  if (report["method"].text() == "structural") return "with the structure found";
  const std::vector<JsonValue> joints = report["joints"].elements();
  const bool corrected =
      std::ranges::any_of(joints, [](const JsonValue& joint) { return joint["kept"].truth().value_or(false); });
  const std::string stopped = report["stopped"].text();
  return corrected || stopped.empty() || stopped == "not_run" ? "with joint corrections" : "start of the closed loop";
}

}  // namespace

const Stage* ErrorStages::find(const std::string& key) const {
  const auto found = std::ranges::find(stages, key, &Stage::key);
  return found == stages.end() ? nullptr : &*found;
}

ErrorStages error_stages(const JsonValue& report) {
  ErrorStages errors;
  const JsonValue error_mm = report["error_mm"];
  for (const auto& [key, title] : kStages) {
    Stage stage{.key = key, .title = title, .sets = {}};
    if (stage.key == "before") stage.title = declared_stage(report);
    for (std::size_t set = 0; set < ErrorStages::kSets.size(); ++set) {
      stage.sets[set] = figures(error_mm[key][ErrorStages::kSets[set]]);
    }
    const bool repeats_last = stage.key == "after" && errors.find("before") != nullptr && !loop_added(report);
    if (has_figures(stage) && !repeats_last) errors.stages.push_back(std::move(stage));
  }
  for (std::size_t set = 0; set < ErrorStages::kSets.size(); ++set) {
    errors.poses[set] = report["poses"][ErrorStages::kSets[set]].count().value_or(0);
    const auto measured = [set](const Stage& stage) { return stage.sets[set].mean_mm.has_value(); };
    if (std::ranges::any_of(errors.stages, measured)) errors.shown.push_back(set);
  }
  return errors;
}

std::optional<Judgement> judgement(const ErrorStages& errors) {
  if (errors.stages.size() < 2) return std::nullopt;
  const Stage* const registered = errors.find("registered");
  const Stage& before = registered != nullptr ? *registered : errors.stages.front();
  const Stage& after = errors.stages.back();
  if (&before == &after) return std::nullopt;
  for (std::size_t set = ErrorStages::kSets.size(); set-- > 0;) {
    if (before.sets[set].mean_mm && after.sets[set].mean_mm)
      return Judgement{set, before.title, after.title, before.sets[set], after.sets[set]};
  }
  return std::nullopt;
}

}  // namespace demecal
