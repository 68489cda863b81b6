#include "terminal/report_text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "data/data_set.hpp"
#include "report/evaluation.hpp"
#include "report/figures.hpp"
#include "report/pose_places.hpp"
#include "terminal/text.hpp"

namespace demecal::inline terminal {
namespace {

constexpr std::size_t kStageColumns = 42, kSetColumns = 38;  // of what heads a line of figures

std::string figures_line(const std::string& head, std::size_t columns, const SetErrors& errors) {
  std::string line = "  " + left_aligned(head, columns);
  for (const std::optional<double>& figure : {errors.mean_mm, errors.rms_mm, errors.p95_mm, errors.max_mm})
    line += right_aligned(figure ? fmt::format("{:.3f}", *figure) : "–", 9);
  return line + "\n";
}

std::string figures_heading(const std::string& what, std::size_t columns) {
  return fmt::format("  {:<{}}{:>9}{:>9}{:>9}{:>9}\n", what, columns, "mean", "rms", "P95", "max");
}

std::string last_fit(const Report& report) {
  if (!report.unseen_validation_rms_mm) return {};
  const double before_mm = report.unseen_validation_rms_mm->before.value_or(0.0);
  const double after_mm = report.unseen_validation_rms_mm->after.value_or(0.0);
  const std::string figures = report.added_any()
                                  ? fmt::format("{:.3f} mm without and {:.3f} mm with the effects", before_mm, after_mm)
                                  : fmt::format("{:.3f} mm", after_mm);
  return wrapped(" ",
                 "The numbers come from calibration and validation poses together; while the validation poses were "
                 "unseen, their rms was " +
                     figures + ". Accept poses had no part in anything.",
                 2);
}

/// How far single poses are predicted to err, and how many accept poses did not keep to it.
std::string intervals_text(const std::vector<PoseErrorEntry>& poses, const std::optional<PredictionEntry>& prediction) {
  const IntervalCoverage accept = coverage_of(poses);
  if (!prediction || (accept.poses == 0 && prediction->pose_set != "calibration")) return {};
  const std::string within =
      accept.poses == 0 ? "radii that hold 95 % of errors stand in report.json"
                        : fmt::format(
                              "95 % of errors are predicted within {:.3f} mm (median over accept poses): {} of {} "
                              "accept poses are",
                              accept.median_mm, accept.inside, accept.poses);
  const std::string beyond = beyond_radii_sentence(accept);
  return wrapped("  prediction:", within + "; " + prediction->remark, 4) +
         (beyond.empty() ? "" : wrapped("  NOTE:", beyond, 4));
}

std::string workspace(const std::optional<WorkspaceEntry>& error) {
  const std::string sentence = error ? workspace_sentence(*error) : "";
  return sentence.empty() ? "" : wrapped("  workspace:", sentence, 4);
}

std::string stages(const Report& report) {
  const std::vector<Stage> all = error_stages(report);
  std::string text;
  for (const ReportPoseSet& set : kPoseSets) {
    if (!(report.before.*set.errors).mean_mm) continue;
    text += figures_heading(fmt::format("{} poses, tool error in mm", set.name), kStageColumns);
    for (const Stage& stage : all) text += figures_line("  " + stage.title, kStageColumns, stage.on(set));
  }
  const std::string outliers = outliers_sentence(report);
  return text + last_fit(report) + (outliers.empty() ? "" : wrapped(" ", outliers, 2)) +
         intervals_text(report.pose_errors, report.prediction_interval) + workspace(report.workspace_error);
}

std::string length_line(const LengthErrorEntry& length) {
  const auto number = [](const std::optional<double>& mm) { return mm ? fmt::format("{:+.3f}", *mm) : "–"; };
  return fmt::format("    {:<38}{:>10.3f}{:>9}{:>9}\n",
                     fmt::format("{} to {} ({})", length.between.empty() ? "" : length.between.front(),
                                 length.between.empty() ? "" : length.between.back(), length.set),
                     length.known_mm.value_or(0.0), number(length.before_mm), number(length.error_mm));
}

/// All of them or, of a plate with many holes, say, those that the model has farthest off.
std::string lengths(std::vector<LengthErrorEntry> all) {
  constexpr std::size_t kMost = 12;
  if (all.empty()) return {};
  const auto off_mm = [](const LengthErrorEntry& one) { return std::abs(one.error_mm.value_or(0.0)); };
  if (all.size() > kMost) std::ranges::stable_sort(all, std::greater{}, off_mm);
  std::string text =
      fmt::format("  {:<40}{:>10}{:>9}{:>9}\n", "known lengths, error in mm", "known", "before", "after");
  for (std::size_t i = 0; i < std::min(kMost, all.size()); ++i) text += length_line(all[i]);
  if (all.size() > kMost)
    text += fmt::format("    and {} more, off by {:.3f} mm at most\n", all.size() - kMost, off_mm(all[kMost]));
  return text;
}

/// The rms error of each station's poses in a set.
std::string stations(const Report& report) {
  if (report.stations.empty()) return {};
  const auto number = [](const std::optional<double>& mm) { return mm ? fmt::format("{:.3f}", *mm) : "–"; };
  std::string text = fmt::format("\n  {:<50}{:>9}{:>9}{:>9}\n", "stations, rms in mm", "tool fit", "before", "after");
  for (const StationEntry& one : report.stations) {
    const auto line = [&](const char* set, const SetErrors ErrorBySet::*errors) {
      if (!(one.after.*errors).rms_mm) return;
      text += fmt::format("    {:<48}{:>9}{:>9}{:>9}\n", fmt::format("{}, {} poses: {}", one.name, one.poses, set),
                          number((one.registered.*errors).rms_mm), number((one.before.*errors).rms_mm),
                          number((one.after.*errors).rms_mm));
    };
    line("calibration", &ErrorBySet::calibration);
    line("validation", &ErrorBySet::validation);
    line("accept", &ErrorBySet::accept);
  }
  const std::string noise = station_noise_sentence(report.stations);
  return noise.empty() ? text : text + wrapped("   ", noise, 4);
}

/// What was touched: what contacts tell, their spread, and the lengths between them.
std::string contacts(const Report& report) {
  if (report.contacts.empty()) return {};
  std::string text =
      fmt::format("\n  {:<40}{:>10}{:>9}{:>9}{:>9}\n", "contacts, rms in mm", "poses", "tool fit", "before", "after");
  const auto number = [](const std::optional<double>& mm) { return mm ? fmt::format("{:.3f}", *mm) : "–"; };
  for (const ContactEntry& one : report.contacts)
    text += fmt::format("    {:<38}{:>10}{:>9}{:>9}{:>9}\n", fmt::format("{} ({})", one.contact, one.set), one.poses,
                        number(one.registered_rms_mm), number(one.before_rms_mm), number(one.after_rms_mm));
  text += lengths(report.length_errors);
  for (const std::string& note : report.contact_notes) text += wrapped("  -", note, 4);
  return text;
}

/// The correction as people read it, or that it is too long for that, and whether it was held back.
std::string correction_words(const JointEntry& joint) {
  const std::string limit = limit_sentence(joint);
  return (joint.short_form.empty() ? "corrected by a formula too long to show: see model.yaml" : joint.short_form) +
         (limit.empty() ? "" : ". " + limit);
}

/// What came of evolution.
std::string origins(const Report& report) {
  const std::string sentence = origins_sentence(report);
  return sentence.empty() ? "" : wrapped(" ", sentence, 2);
}

/// Where joints had no targets, as beside an old model: how far they are corrected.
std::string corrections_alone(const Report& report) {
  std::string text = fmt::format("  {:<8}{:>16}\n", "joint", "corrected, mrad");
  for (const JointEntry& joint : report.joints) {
    const std::string most = joint.kept && joint.bound_rad ? fmt::format("up to {:.3g}", 1e3 * *joint.bound_rad) : "–";
    const std::string figures = "  " + left_aligned(std::to_string(joint.joint), 8) + right_aligned(most, 16) + "  ";
    text += wrapped(figures, joint.kept ? correction_words(joint) : "neutral: " + joint.note, figures.size() + 1);
  }
  return text;
}

std::string joints(const Report& report) {
  const bool told = std::ranges::any_of(report.joints, [](const JointEntry& joint) {
    return joint.mean_abs_error_rad.before || joint.mean_abs_error_rad.after;
  });
  if (!told) return corrections_alone(report) + origins(report);
  std::string text =
      fmt::format("  {:<8}{:>16}{:>16}   {}\n", "joint", "error before", "error after", "mean absolute, rad");
  const auto rad = [](const std::optional<double>& error) { return error ? fmt::format("{:.3e}", *error) : "–"; };
  for (const JointEntry& joint : report.joints) {
    const std::string figures = "  " + left_aligned(std::to_string(joint.joint), 8) +
                                right_aligned(rad(joint.mean_abs_error_rad.before), 16) +
                                right_aligned(rad(joint.mean_abs_error_rad.after), 16) + "  ";
    text += wrapped(figures, joint.kept ? correction_words(joint) : "neutral: " + joint.note, figures.size() + 1);
  }
  return text + origins(report);
}

/// The functions, and the corrections that call them.
std::string shared_functions(const Report& report) {
  if (!report.shared_functions) return {};
  if (report.shared_functions->empty()) {
    return "  no structure shortened formulas of two joints: they share no function\n";
  }
  std::string text = "  functions that joints share\n";
  for (const auto& [definition, joints] : *report.shared_functions) {
    const std::string callers = fmt::format("; joint{} {}", joints.size() == 1 ? "" : "s", fmt::join(joints, ", "));
    text += wrapped("   ", definition + (joints.empty() ? "; no correction calls it" : callers), 6);
  }
  for (const JointEntry& joint : report.joints) {
    if (!joint.with_functions.empty())
      text += wrapped(fmt::format("    joint {}:", joint.joint), joint.with_functions, 6);
  }
  return text;
}

/// Of the structural method: what stands between the links.
std::string structure(const Report& report) {
  if (report.method != "structural") return {};
  std::string rows;
  for (const auto& [name, nominal, value, error] : report.parameters) {
    if (name.starts_with("after link "))
      rows += fmt::format("  {:<28}{:>12.4f}{:>18.4f}\n", name, value.value_or(0.0), error.value_or(0.0));
  }
  if (rows.empty()) return "\n  nothing between the links that the validation poses bear out\n";
  return fmt::format("\n  {:<28}{:>12}{:>18}\n", "transforms found", "value", "standard error") + rows +
         "  model.yaml has them in its links and tools, which then predict the same everywhere\n";
}

std::string listed_poses(const std::string& title, const std::vector<std::string>& names) {
  if (names.empty()) return {};
  constexpr std::size_t kShown = 8;
  std::string shown;
  for (std::size_t i = 0; i < names.size() && i < kShown; ++i) shown += names[i] + " ";
  if (names.size() > kShown) shown += "...";
  return wrapped(fmt::format("  {} ({}):", title, names.size()), shown, 4);
}

/// What to look at before the figures.
std::string data_check_text(const Report& report) {
  const std::string findings = to_terminal(report.data_check, ShownFindings::ten);
  return findings.empty() ? findings : "  Look at the data first:\n" + findings + "\n";
}

std::string excluded(const Report& report) {
  std::vector<std::string> names;
  for (const ExcludedPose& pose : report.poses.excluded)
    names.push_back(fmt::format("{} ({:.2f} mm)", pose.id, pose.error_mm.value_or(0.0)));
  return listed_poses("poses excluded by name, in no figure", names);
}

}  // namespace

std::string to_terminal(const Report& report) {
  std::string text = data_check_text(report) + stages(report) + stations(report) + contacts(report) + structure(report);
  if (!report.joints.empty()) text.append("\n").append(joints(report)).append(shared_functions(report));
  if (const std::string loop = loop_to_terminal(report); !loop.empty()) text.append("\n").append(loop).append("\n");
  text += listed_poses("suspected outliers (down-weighted in the fit, included in all errors)", report.poses.outliers);
  text += excluded(report);
  text += listed_poses("poses near a singularity, weighed less", report.poses.near_singular);
  for (const std::string& sentence : report.unidentified) text += wrapped("  not seen by these poses:", sentence, 4);
  if (report.noise_floor_mm)
    text += fmt::format("  noise floor from repeats: {:.3f} mm per axis\n", *report.noise_floor_mm);
  if (report.runtime.asynchronous)
    text += "  The islands did not wait for each other: another run of this job gives another result.\n";
  return text;
}

std::string to_terminal(const Evaluation& evaluation) {
  std::string text = figures_heading("tool error in mm", kSetColumns);
  for (const ReportPoseSet& set : kPoseSets) {
    const SetErrors& errors = evaluation.error_mm.*set.errors;
    if (errors.mean_mm) text += figures_line(std::string("  ") + set.name, kSetColumns, errors);
  }
  text += lengths(evaluation.length_errors);
  text += intervals_text(evaluation.pose_errors, evaluation.prediction);
  for (const std::string& sentence : evaluation.widened_by) text += wrapped("  NOTE:", sentence, 4);
  const bool said = !beyond_radii_sentence(coverage_of(evaluation.pose_errors)).empty();
  if (!said && !evaluation.beyond_radii.empty()) text += wrapped("  NOTE:", evaluation.beyond_radii, 4);
  if (evaluation.uncertainty && evaluation.uncertainty->expanded_mm) {
    text += fmt::format("  a corrected position is reached to within ± {:.3f} mm (k = 2)\n",
                        *evaluation.uncertainty->expanded_mm);
  }
  text += evaluation.of_one_contact ? wrapped("  workspace:", one_contact_sentence(), 4)
                                    : workspace(evaluation.workspace_error);
  return text;
}

std::string to_terminal(const DataCheckEntry& check, ShownFindings shown) {
  constexpr std::size_t kTen = 10;
  std::vector<const FindingEntry*> findings;
  for (const FindingEntry& finding : check.findings) findings.push_back(&finding);
  std::ranges::stable_sort(findings, [](const FindingEntry* one, const FindingEntry* other) {
    return contradicts(*one) && !contradicts(*other);
  });
  std::string text;
  const std::size_t count = shown == ShownFindings::all ? findings.size() : std::min(findings.size(), kTen);
  for (std::size_t i = 0; i < count; ++i) text += wrapped("  -", findings[i]->sentence, 4);
  if (findings.size() > count) text += fmt::format("  - {} more in report.json\n", findings.size() - count);
  return text;
}

}  // namespace demecal::inline terminal
