#include "terminal/report_text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "evolution/building_blocks.hpp"
#include "random/distributions.hpp"
#include "report/evaluation.hpp"
#include "report/report.hpp"
#include "studies/study.hpp"
#include "terminal/text.hpp"

namespace demecal::inline terminal {
namespace {

constexpr std::size_t kWidestForm = 56;

using Line = std::vector<std::string>;

template <class Written>
std::string interval_text(const std::optional<MedianInterval>& figure, const Written& text) {
  if (!figure) return "-";
  return fmt::format("{} [{}, {}]", text(figure->median), text(figure->lower), text(figure->upper));
}

std::string interval_with_decimals(const std::optional<MedianInterval>& figure, int digits) {
  return interval_text(figure, [digits](double value) { return fmt::format("{:.{}f}", value, digits); });
}

std::string in_thousands(double value) {
  if (value < 1e4) return fmt::format("{:.0f}", value);
  return value < 1e7 ? fmt::format("{:.0f}k", 1e-3 * value) : fmt::format("{:.1f}M", 1e-6 * value);
}

/// The last word of "gp.population_size": no two parameters share it.
std::string short_name(const std::string& key) {
  return key.substr(key.find('.') + 1);
}

/// Columns as wide as what they hold, right-aligned.
std::string aligned_lines(const std::vector<Line>& lines) {
  std::vector<std::size_t> widths(lines.front().size());
  for (const Line& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], display_width(line[i]));
  }
  std::string text;
  for (const Line& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) text += "  " + right_aligned(line[i], widths[i]);
    text += "\n";
  }
  return text;
}

/// What the brackets hold.
std::string meaning(const std::vector<StudyCell>& cells) {
  double least_sure = 1.0;
  bool any_sure = false, any_range = false;
  for (const StudyCell& cell : cells) {
    if (!cell.nodes) continue;
    any_range = any_range || !cell.nodes->confidence;
    if (!cell.nodes->confidence) continue;
    any_sure = true;
    least_sure = std::min(least_sure, *cell.nodes->confidence);
  }
  const std::string sure = fmt::format(
      "the interval between two of the runs' figures that holds the median over all seeds with at least "
      "95 % confidence ({:.1f} %, by order statistics)",
      100.0 * least_sure);
  const std::string range = fmt::format(
      "the least and the largest figure, since an interval with 95 % confidence takes "
      "at least {} runs",
      least_for_interval());
  if (!any_sure && !any_range) return "";
  std::string text = "The median over the seeds, and in brackets ";
  if (any_sure && any_range) {
    text += sure + "; with fewer than " + std::to_string(least_for_interval()) + " runs " + range;
  } else {
    text += any_sure ? sure : range;
  }
  return wrapped("", text + ".", 1);
}

struct ShownSet {
  const char* title;
  std::optional<MedianInterval> StudyCell::*figure;
};

/// The sets that have poses, those that formulas were fitted to only where there are no others.
std::vector<ShownSet> shown_sets(const std::vector<StudyCell>& cells) {
  std::vector<ShownSet> shown;
  for (const ShownSet& set :
       {ShownSet{"validation mm", &StudyCell::validation_mm}, ShownSet{"accept mm", &StudyCell::accept_mm}}) {
    const auto has_poses = [&](const StudyCell& cell) { return (cell.*set.figure).has_value(); };
    if (std::any_of(cells.begin(), cells.end(), has_poses)) shown.push_back(set);
  }
  if (shown.empty()) shown.push_back({"calibration mm", &StudyCell::calibration_mm});
  return shown;
}

std::string error_cell(const std::optional<double>& figure_mm) {
  return figure_mm ? fmt::format("{:.4f}", *figure_mm) : "-";
}

}  // namespace

std::string study_table(const Study& study) {
  const std::vector<StudyCell> cells = study_cells(study);
  Line head;
  for (const std::string& key : study.keys) head.push_back(short_name(key));
  const std::vector<ShownSet> shown = shown_sets(cells);
  head.emplace_back("runs");
  for (const ShownSet& set : shown) head.emplace_back(set.title);
  for (const char* column : {"nodes", "evaluations", "time s"}) head.emplace_back(column);
  std::vector<Line> lines{head};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const StudyCell& cell = cells[i];
    Line line = study.cells[i];
    line.push_back(std::to_string(cell.runs));
    for (const ShownSet& set : shown) line.push_back(interval_with_decimals(cell.*set.figure, 4));
    line.push_back(interval_with_decimals(cell.nodes, 0));
    line.push_back(interval_text(cell.evaluations, in_thousands));
    line.push_back(interval_with_decimals(cell.wall_s, 1));
    lines.push_back(std::move(line));
  }
  return fmt::format("{}: {} on {}, {} {}, {} of {} runs{}\n\n{}\n{}", study.job, study.robot, study.data, cells.size(),
                     cells.size() == 1 ? "cell" : "cells", study.runs.size(), cells.size() * study.seeds.size(),
                     study.interrupted ? " (interrupted)" : "", aligned_lines(lines), meaning(cells)) +
         " mm: rms of the tool error with the formulas" + (study.closed_loop ? ", and the effects found," : "") +
         " in place; nodes: of all joints' formulas.\n";
}

std::string blocks_table(const Study& study, std::size_t most) {
  if (study.blocks.empty()) {
    return fmt::format(
        "No expression of two functions or more stands in formulas of two joints ({} islands looked at).\n",
        study.islands);
  }
  std::vector<Line> lines{{"block", "joints", "islands", "individuals", "rank"}};
  for (const BuildingBlock& block : study.blocks) {
    if (lines.size() > most) break;
    lines.push_back({left_aligned(block_text(block.form), kWidestForm), std::to_string(block.joints),
                     std::to_string(block.islands), std::to_string(block.individuals),
                     fmt::format("{:.2f}", block.rank_share)});
  }
  lines.front().front() = left_aligned("block", kWidestForm);
  return fmt::format(
             "Blocks that the best formulas of each length share across joints ({} islands, c a constant):\n\n{}",
             study.islands, aligned_lines(lines)) +
         wrapped("", "rank: the share of its island's front that an individual with the block is fitter than, mean.",
                 1) +
         (study.blocks.size() > most ? fmt::format(" {} more are in study.json.\n", study.blocks.size() - most) : "");
}

std::string comparison_table(const Comparison& comparison) {
  const auto& [calibration, validation, accept] = comparison.poses;
  std::string text = fmt::format("{} on {}: {} poses fitted, {} of validation, {} of acceptance\n\n", comparison.robot,
                                 comparison.data, calibration, validation, accept);
  text += fmt::format("{:42}{:>8}{:>20}{:>20}{:>9}\n", "", "", "validation, mm", "accept, mm", "");
  text += fmt::format("{:42}{:>8}{:>10}{:>10}{:>10}{:>10}{:>9}\n", "method", "numbers", "mean", "rms", "mean", "rms",
                      "time, s");
  std::string notes;
  for (const ComparedMethod& method : comparison.methods) {
    const SetErrors &on_validation = method.error_mm.validation, &on_accept = method.error_mm.accept;
    text += fmt::format("{:42}{:>8}{:>10}{:>10}{:>10}{:>10}{:>9.2f}\n", method.title, method.parameters,
                        error_cell(on_validation.mean_mm), error_cell(on_validation.rms_mm),
                        error_cell(on_accept.mean_mm), error_cell(on_accept.rms_mm), method.wall_s);
    if (!method.chosen.empty()) notes += fmt::format("  {}: {}\n", method.title, method.chosen);
  }
  if (!notes.empty()) text += "\nchosen by cross-validation within the poses fitted, and notes:\n" + notes;
  return text;
}

}  // namespace demecal::inline terminal
