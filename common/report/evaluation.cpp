#include "report/evaluation.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "effects/effect.hpp"
#include "kinematics/units.hpp"
#include "parameters/posterior.hpp"
#include "pieces/pieces.hpp"
#include "prediction/lacking_circumstances.hpp"
#include "prediction/only_places.hpp"
#include "random/distributions.hpp"
#include "random/random_purpose.hpp"
#include "random/random_stream.hpp"
#include "report/error_fields.hpp"
#include "report/json.hpp"

namespace demecal::inline report {
namespace {

/// Where the radii come from: a sentence for an engineer.
std::string origin_of(const PredictionInterval& interval) {
  constexpr std::size_t kFewest = 19;
  const std::string poses =
      fmt::format("{} distinct {} poses", interval.poses, interval.fitted ? "calibration" : "validation");
  std::string text = interval.fitted ? "no validation poses: the intervals come from " + poses +
                                           ", to which the model was fitted, and may be too narrow"
                                     : "the intervals come from " + poses + " while they were unseen";
  if (interval.poses < kFewest) text += "; too few for an empirical quantile: normal errors are assumed";
  if (interval.gross_errors > 0)
    text += fmt::format("; {} far out left out: intervals hold for poses measured without gross errors",
                        interval.gross_errors);
  if (interval.along_path) text += std::string("; ") + kAlongPathRemark;
  return text;
}

}  // namespace

void fields(auto& visit, Like<UnappliedEffect> auto& effect) {
  visit("kind", effect.kind, "joint", effect.joint, "lacking", effect.lacking, "poses", effect.poses, "sentence",
        effect.sentence);
}

void fields(auto& visit, Like<Evaluation> auto& evaluation) {
  visit("error_mm", evaluation.error_mm, "pose_errors", evaluation.pose_errors, "data_check", evaluation.data_check,
        "effects_not_applied", evaluation.effects_not_applied, "uncertainty", evaluation.uncertainty, "beyond_radii",
        evaluation.beyond_radii, "widened_by", evaluation.widened_by, "orientations_judged",
        evaluation.orientations_judged);
  visit.when(evaluation.touches, "length_errors_mm", evaluation.length_errors);
}

void fields(auto& visit, Like<ComparedMethod> auto& method) {
  visit("method", method.key, "title", method.title, "parameters", method.parameters, "wall_s", method.wall_s, "chosen",
        method.chosen, "error_mm", method.error_mm);
}

void fields(auto& visit, Like<Comparison> auto& comparison) {
  visit("job", comparison.job, "robot", comparison.robot, "data", comparison.data, "data_sha256",
        comparison.data_sha256);
  visit.within("poses", [&](auto& poses) {
    poses("calibration", comparison.poses[0], "validation", comparison.poses[1], "accept", comparison.poses[2]);
  });
  visit("methods", comparison.methods);
}

SetErrors set_errors(const ErrorFigures& figures) {
  return {if_finite(figures.mean_mm), if_finite(figures.rms_mm), if_finite(figures.p95_mm), if_finite(figures.max_mm)};
}

ErrorBySet errors_by_set(const CorrectedRobot& robot, const DataSet& data) {
  const auto of = [&](PoseSet set) { return set_errors(error_figures(robot, data, poses_of(data, set))); };
  return {of(PoseSet::calibration), of(PoseSet::validation), of(PoseSet::accept)};
}

std::vector<PoseErrorEntry> pose_errors(const DataSet& data, const CalibratedModel& model, const CorrectedRobot& robot,
                                        const CorrectedRobot* before) {
  std::vector<PoseErrorEntry> poses(data.poses.size());
  std::vector<std::size_t> all(data.poses.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::vector<double> after_m = tool_errors_m(robot, data, all);
  const std::vector<double> before_m = before == nullptr ? std::vector<double>{} : tool_errors_m(*before, data, all);
  const std::set<ContactGroup> untold = only_placed(data);
  in_batches(poses.size(), [&](std::size_t i) {
    const MeasuredPose& pose = data.poses[i];
    PoseErrorEntry& entry = poses[i];
    entry = {pose.pose_id, pose.target, std::string(to_string(pose.set)), {}, {}, {}};
    const Widening there_by = widening_at(model, Stop(pose));
    if (!pose.contact.empty() && untold.contains(group_of(pose))) return;
    if (before != nullptr) entry.before_mm = if_finite(millimetres(before_m[i]));
    entry.after_mm = if_finite(millimetres(after_m[i]));
    if (model.posterior && model.interval)
      entry.interval95_mm =
          if_finite(millimetres(radius95_m(*model.interval, *model.posterior, robot, data, pose, there_by)));
    if (is_outside_measured(model, Stop(pose), there_by)) entry.flags.emplace_back("outside_measured");
  });
  return poses;
}

PredictionEntry prediction_entry(const PredictionInterval& interval) {
  return {.quantile = if_finite(interval.quantile),
          .noise_mm = if_finite(millimetres(interval.noise_m)),
          .distance_noise_mm = if_finite(millimetres(interval.distance_noise_m)),
          .model_error_mm = if_finite(millimetres(interval.model_error_m)),
          .pose_set = interval.fitted ? "calibration" : "validation",
          .poses = interval.poses,
          .gross_errors = interval.gross_errors,
          .remark = origin_of(interval)};
}

std::optional<WorkspaceEntry> workspace_entry(const CalibratedModel& model, bool placed) {
  if (!model.posterior || !model.interval || model.measured.empty()) return {};
  const WorkspaceError error = workspace_error(*model.posterior, *model.interval, model.robot, model.measured, placed,
                                               RandomStream{model.seed, number_of(RandomPurpose::workspace_places)});
  return WorkspaceEntry{if_finite(millimetres(error.rms_m)), if_finite(millimetres(error.p95_m)), !placed};
}

std::string workspace_sentence(const WorkspaceEntry& error) {
  if (!error.rms_mm || !error.p95_mm) return {};
  return fmt::format(
      "the tool is predicted to be off by {:.3f} mm (rms), {:.3f} mm in 95 % of cases, with joints "
      "anywhere in their measured ranges{}; measurement noise is not in it",
      *error.rms_mm, *error.p95_mm, error.beside_base ? " and the arm as a whole shifted and turned to fit best" : "");
}

namespace {

/// The chance that of `count` tries, each of which succeeds with `share`, at most `successes` do: the tail of a
/// binomial is one of Fisher's F.
double chance_of_at_most(std::size_t successes, std::size_t count, double share) {
  if (successes >= count) return 1.0;
  const auto above = static_cast<double>(successes + 1), below = static_cast<double>(count - successes);
  return fisher_p_value(share / (1.0 - share) * below / above, 2.0 * above, 2.0 * below);
}

}  // namespace

IntervalCoverage coverage_of(const std::vector<PoseErrorEntry>& poses, PoseSet set) {
  IntervalCoverage coverage;
  std::vector<double> radii_mm, multiples;
  std::set<std::string> names;
  for (const PoseErrorEntry& pose : poses) {
    if (pose.set != to_string(set) || !pose.after_mm || !pose.interval95_mm) continue;
    ++coverage.poses;
    coverage.inside += *pose.after_mm <= *pose.interval95_mm ? 1 : 0;
    coverage.distinct += pose.id.empty() || names.insert(pose.id).second ? 1 : 0;
    radii_mm.push_back(*pose.interval95_mm);
    multiples.push_back(*pose.after_mm / *pose.interval95_mm);
  }
  if (radii_mm.empty()) return coverage;
  coverage.median_mm = median(radii_mm);
  coverage.least_radii = std::ranges::min(multiples);
  return coverage;
}

std::string beyond_radii_sentence(const IntervalCoverage& coverage, PoseSet set) {
  constexpr double kRare = 1e-3, kFar = 5.0;
  if (coverage.poses == 0) return {};
  const std::size_t inside = coverage.inside * coverage.distinct / coverage.poses;
  const bool far = coverage.least_radii > kFar;
  if (!far && chance_of_at_most(inside, coverage.distinct, kIntervalShare) > kRare) return {};
  return fmt::format(
      "Only {} of {} {} poses lie within the radius that is to hold 95 % of them: they differ from those that the "
      "model "
      "was made from by something that it does not know. No radius, and no figure of a corrected position, holds for "
      "them. See whether arm, tool, instrument or conditions changed between (`demecal check` compares a model with "
      "new "
      "poses), or whether the poses before were as good.",
      coverage.inside, coverage.poses, to_string(set));
}

std::string beyond_radii_sentence(const std::vector<PoseErrorEntry>& poses) {
  for (const PoseSet set : {PoseSet::accept, PoseSet::validation, PoseSet::calibration}) {
    std::string sentence = beyond_radii_sentence(coverage_of(poses, set), set);
    if (!sentence.empty()) return sentence;
  }
  return {};
}

DataCheckEntry data_check_entry(const DataCheck& check) {
  DataCheckEntry entry{std::string(to_string(check.verdict())), {}};
  for (const Finding& finding : check.findings) {
    entry.findings.push_back({std::string(to_string(finding.kind)), static_cast<std::uint64_t>(finding.joint + 1),
                              finding.poses, if_finite(finding.as_given_mm), if_finite(finding.if_changed_mm),
                              finding.sentence});
  }
  return entry;
}

bool contradicts(const FindingEntry& finding) {
  return trials::contradicts(finding.kind);
}

std::vector<UnappliedEffect> unapplied_effects(const CorrectedRobot& robot, const DataSet& data) {
  std::vector<std::size_t> poses(data.poses.size());
  std::iota(poses.begin(), poses.end(), std::size_t{0});
  std::vector<UnappliedEffect> all;
  for (const LackingCircumstance& one : lacking_circumstances(robot, data, poses)) {
    const Effect& effect = *one.effect;
    all.push_back({effect.kind, std::nullopt, std::string(one.words->name), one.without, to_string(one)});
    if (effect.joint >= 0) all.back().joint = static_cast<std::uint64_t>(effect.joint) + 1;
  }
  return all;
}

std::string to_json(const Evaluation& evaluation) {
  return to_text(json_of(evaluation), -1);
}

std::string to_json(const Comparison& comparison, int indent) {
  nlohmann::ordered_json json{{"demecal_comparison", 1}};
  JsonWriter write(json);
  fields(write, comparison);
  return to_text(json, indent);
}

namespace {

/// Poses enough for a mean of what the posterior says.
constexpr std::size_t kMostJudged = 300;

/// Means over poses, widened outside of what was measured as radii are there.
struct MeanSquares {
  double numbers_m2 = 0.0, left_m2 = 0.0, unstated_m2 = 0.0;
};

MeanSquares mean_squares(const CalibratedModel& model, const DataSet& data, std::span<const std::size_t> rows) {
  const std::size_t step = 1 + (rows.size() - 1) / kMostJudged;
  MeanSquares mean;
  double count = 0.0;
  for (std::size_t i = 0; i < rows.size(); i += step) {
    const MeasuredPose& pose = data.poses[rows[i]];
    const Widening there_by = widening_at(model, Stop(pose));
    const double widened_squared = std::pow(there_by.factor, 2);
    mean.numbers_m2 += widened_squared * posterior_square_m2(*model.posterior, model.robot, data, pose);
    mean.left_m2 += widened_squared * 3.0 * std::pow(model.interval->model_error_m, 2) +
                    std::pow(there_by.held_radius_m() / real_quantile(), 2);
    mean.unstated_m2 += std::pow(there_by.unstated_m, 2);
    count += 1.0;
  }
  mean.numbers_m2 /= count;
  mean.left_m2 /= count;
  mean.unstated_m2 /= count;
  return mean;
}

}  // namespace

std::optional<UncertaintyEntry> uncertainty_of(const CalibratedModel& model, const DataSet& data,
                                               std::span<const std::size_t> rows, std::optional<double> instrument_m) {
  if (!model.posterior || !model.interval || rows.empty()) return std::nullopt;
  const double scale = real_quantile() / kCoverageFactor;
  const MeanSquares mean = mean_squares(model, data, rows);
  const double numbers_m = scale * std::sqrt(mean.numbers_m2), left_m = scale * std::sqrt(mean.left_m2);
  const double stated_m = instrument_m.value_or(0.0) / kCoverageFactor;
  const double unstated_m = std::sqrt(mean.unstated_m2) / kCoverageFactor;
  const double standard_m = std::hypot(std::hypot(numbers_m, left_m), std::hypot(stated_m, unstated_m));
  UncertaintyEntry entry;
  entry.contributions = {
      {"numbers of the model, from the noise of the calibration measurements", "A", if_finite(millimetres(numbers_m))},
      {"error that the model leaves at poses it was not fitted to", "A", if_finite(millimetres(left_m))},
      {"instrument, as its calibration states", "B", {}}};
  if (instrument_m) entry.contributions.back().standard_mm = millimetres(stated_m);
  if (unstated_m > 0.0)
    entry.contributions.push_back(
        {"payload or temperature, which poses do not state: any that was measured", "B", millimetres(unstated_m)});
  entry.standard_mm = if_finite(millimetres(standard_m));
  entry.coverage_factor = kCoverageFactor;
  entry.expanded_mm = if_finite(millimetres(kCoverageFactor * standard_m));
  entry.remark = prediction_entry(*model.interval).remark;
  return entry;
}

}  // namespace demecal::inline report
