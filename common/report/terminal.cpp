#include "report/terminal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "report/data_check_text.hpp"
#include "report/loop_terminal.hpp"
#include "report/terminal_text.hpp"

namespace demecal {
namespace {

struct NamedSet {
  const char* name;
  ErrorFigures ErrorBySet::*figures;
};
constexpr std::array<NamedSet, 3> kSets{{{"calibration", &ErrorBySet::calibration},
                                         {"validation", &ErrorBySet::validation},
                                         {"accept", &ErrorBySet::accept}}};

std::string figures_line(const std::string& head, const ErrorFigures& figures) {
  return fmt::format("  {:<38}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.3f}\n", head, figures.mean_mm, figures.rms_mm,
                     figures.p95_mm, figures.max_mm);
}

std::string heading(const char* what) {
  return fmt::format("  {:<38}{:>9}{:>9}{:>9}{:>9}\n", what, "mean", "rms", "P95", "max");
}

/// What the stage of everything declared adds to the fit.
const char* declared_stage(const CalibrationReport& report) {
  if (report.method == word_of(Method::structural)) return "with the structure found";
  const bool corrected = std::ranges::any_of(report.joints, [](const JointLine& line) { return line.summary.kept; });
  return corrected || report.loop.stopped == StopReason::not_run ? "with joint corrections"
                                                                 : "start of the closed loop";
}

std::string last_fit(const CalibrationReport& report) {
  const std::string figures = loop_added(report.loop) ? fmt::format("{:.3f} mm without and {:.3f} mm with the effects",
                                                                    report.unseen->before_mm, report.unseen->after_mm)
                                                      : fmt::format("{:.3f} mm", report.unseen->after_mm);
  return wrapped(" ",
                 "The numbers come from calibration and validation poses together; while the validation poses were "
                 "unseen, their rms was " +
                     figures + ". Accept poses had no part in anything.",
                 2);
}

std::string stages(const CalibrationReport& report) {
  std::vector<std::pair<const char*, const ErrorBySet*>> rows{{"nominal", &report.nominal},
                                                              {"base fitted", &report.registered},
                                                              {"declared model fitted", &report.declared},
                                                              {declared_stage(report), &report.before}};
  if (loop_added(report.loop)) rows.emplace_back("with the effects found", &report.after);
  std::string text;
  for (const NamedSet& set : kSets) {
    if (!std::isfinite((report.before.*set.figures).mean_mm)) continue;
    text += heading(fmt::format("{} poses, tool error in mm", set.name).c_str());
    for (const auto& [name, errors] : rows) text += figures_line(std::string("  ") + name, errors->*set.figures);
  }
  if (report.unseen) text += last_fit(report);
  return text + intervals_to_terminal(report.pose_errors, report.interval);
}

std::string joints(const CalibrationReport& report) {
  std::string text =
      fmt::format("  {:<8}{:>16}{:>16}   {}\n", "joint", "error before", "error after", "mean absolute, rad");
  for (const JointLine& line : report.joints) {
    const std::string figures = fmt::format("  {:<8}{:>16.3e}{:>16.3e}  ", line.summary.joint + 1,
                                            line.summary.before_rad, line.summary.after_rad);
    text += wrapped(figures, line.summary.kept ? "corrected" : "neutral: " + line.summary.note, figures.size() + 1);
  }
  return text;
}

/// The functions, and the corrections that call them.
std::string shared_functions(const CalibrationReport& report) {
  if (!report.functions) return {};
  if (report.functions->empty()) return "  no structure shortened formulas of two joints: they share no function\n";
  std::string text = "  functions that joints share\n";
  for (const SharedFunctionLine& line : *report.functions) {
    std::string callers;
    for (const int joint : line.joints) callers += fmt::format("{}{}", callers.empty() ? "" : ", ", joint + 1);
    text +=
        wrapped("   ",
                line.definition + (callers.empty() ? "; no correction calls it"
                                                   : (line.joints.size() == 1 ? "; joint " : "; joints ") + callers),
                6);
  }
  for (const JointLine& line : report.joints)
    if (!line.with_functions.empty())
      text += wrapped(fmt::format("    joint {}:", line.summary.joint + 1), line.with_functions, 6);
  return text;
}

std::string structure(const CalibrationReport& report) {
  if (report.method != word_of(Method::structural)) return {};
  if (report.structure.empty()) return "\n  nothing between the links that the validation poses bear out\n";
  std::string text = fmt::format("\n  {:<28}{:>12}{:>18}\n", "transforms found", "value", "standard error");
  for (const FoundTransform& transform : report.structure) {
    text += fmt::format("  {:<28}{:>12.4f}{:>18.4f}\n", transform.name(), transform.at_border(transform.value),
                        transform.at_border(transform.standard_error));
  }
  return text + "  model.yaml has them in its links and tools, which then predict the same everywhere\n";
}

std::string named(const std::string& title, const std::vector<std::string>& names) {
  if (names.empty()) return {};
  constexpr std::size_t kShown = 8;
  std::string shown;
  for (std::size_t i = 0; i < names.size() && i < kShown; ++i) shown += names[i] + " ";
  if (names.size() > kShown) shown += "...";
  return wrapped(fmt::format("  {} ({}):", title, names.size()), shown, 4);
}

/// What to look at before the figures.
std::string data_check(const CalibrationReport& report) {
  const std::string findings = data_check_to_terminal(report.check);
  return findings.empty() ? findings : "  Look at the data first:\n" + findings + "\n";
}

std::string excluded(const CalibrationReport& report) {
  std::vector<std::string> names;
  for (const ExcludedPose& pose : report.excluded)
    names.push_back(fmt::format("{} ({:.2f} mm)", pose.id, pose.error_mm));
  return named("poses excluded by name, in no figure", names);
}

}  // namespace

std::string errors_to_terminal(const ErrorBySet& errors) {
  std::string text = heading("tool error in mm");
  for (const NamedSet& set : kSets) {
    if (std::isfinite((errors.*set.figures).mean_mm))
      text += figures_line(std::string("  ") + set.name, errors.*set.figures);
  }
  return text;
}

std::string intervals_to_terminal(const std::vector<PoseErrorLine>& poses,
                                  const std::optional<PredictionInterval>& interval) {
  const IntervalCoverage accept = coverage_of(poses);
  if (!interval || (accept.poses == 0 && !interval->fitted)) return {};
  const std::string within =
      accept.poses == 0 ? "radii that hold 95 % of errors stand in report.json"
                        : fmt::format(
                              "95 % of errors are predicted within {:.3f} mm (median over accept poses): {} of {} "
                              "accept poses are",
                              accept.median_mm, accept.inside, accept.poses);
  return wrapped("  prediction:", within + "; " + sentence_of(*interval), 4);
}

std::string to_terminal(const CalibrationReport& report) {
  std::string text = data_check(report) + stages(report);
  text += structure(report);
  if (!report.joints.empty()) text.append("\n").append(joints(report)).append(shared_functions(report));
  if (const std::string loop = loop_to_terminal(report.loop, report.described); !loop.empty())
    text.append("\n").append(loop).append("\n");
  text += named("suspected outliers (down-weighted in the fit, included in all errors)", report.outliers);
  text += excluded(report);
  text += named("poses near a singularity, weighed less", report.near_singular);
  for (const std::string& sentence : report.unidentified) text += wrapped("  not seen by these poses:", sentence, 4);
  if (report.noise_floor_mm)
    text += fmt::format("  noise floor from repeats: {:.3f} mm per axis\n", *report.noise_floor_mm);
  if (report.runtime.asynchronous)
    text += "  The islands did not wait for each other: another run of this job gives another result.\n";
  return text;
}

}  // namespace demecal
