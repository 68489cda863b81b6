#include <fmt/format.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <ranges>
#include <string>
#include <vector>

#include "errors/input_error.hpp"
#include "expression/bound.hpp"
#include "expression/text.hpp"
#include "html/chart.hpp"
#include "html/markup.hpp"
#include "html/sections.hpp"
#include "kinematics/units.hpp"
#include "report/figures.hpp"
#include "report/history.hpp"
#include "report/report.hpp"

namespace demecal::inline html {
namespace {

/// An angle in mrad with three decimals; a dash where there is none.
std::string mrad(std::optional<double> angle_rad) {
  return fixed(angle_rad ? std::optional(1e3 * *angle_rad) : std::nullopt, 3);
}

/// The range in degrees, "-160.0 to 160.0"; a dash where there is none.
std::string range_deg(const JointEntry& joint) {
  if (!joint.range_rad) return "–";
  return fixed(degrees(joint.range_rad->lower), 1) + " to " + fixed(degrees(joint.range_rad->upper), 1);
}

std::string joint_row(const JointEntry& joint) {
  const auto& [before_rad, after_rad] = joint.mean_abs_error_rad;
  return table_row(
      "joint " + std::to_string(joint.joint),
      {mrad(before_rad), mrad(after_rad), joint.kept ? change(before_rad, after_rad) : "–",
       joint.kept ? mrad(joint.bound_rad) : "–", range_deg(joint),
       joint.kept ? std::to_string(joint.discontinuities_rad.size()) : "–",
       joint.kept ? "<span class=\"badge yes\">corrected</span>" : "<span class=\"badge\">neutral</span>"});
}

std::string joints_table(const std::vector<JointEntry>& joints) {
  std::string rows;
  for (const JointEntry& joint : joints) rows += joint_row(joint);
  if (rows.empty()) return rows;
  return "<p class=\"note\">A corrected joint really goes to theta + g(theta) where theta is commanded. Errors are "
         "mean absolute joint errors over the calibration poses; one mrad moves a tool one metre away by one mm.</p>\n"
         "<div class=\"panel\"><table id=\"joints\">\n<thead><tr><th></th><th>error before, mrad</th>"
         "<th>after, mrad</th><th>change</th><th>bound of g, mrad</th><th>range, deg</th><th>jumps</th><th></th></tr>"
         "</thead>\n<tbody>\n" +
         rows + "</tbody></table></div>\n";
}

/// Functions that joints share, and who calls them.
std::string function_definitions(const Report& report) {
  std::string lines;
  for (const auto& [definition, callers] : report.shared_functions.value_or(std::vector<SharedFunctionEntry>{})) {
    std::string joints;
    for (const std::uint64_t joint : callers)
      joints += (joints.empty() ? (callers.size() == 1 ? "joint " : "joints ") : ", ") + std::to_string(joint);
    lines += "<code>" + escaped(definition) + "</code> <span>" + (joints.empty() ? "called by no joint" : joints) +
             "</span>\n";
  }
  if (lines.empty()) return lines;
  return "<p class=\"note\">Functions that formulas of several joints share, each with its own coefficients (c) and "
         "arguments (a).</p>\n<pre class=\"formula\">" +
         lines + "</pre>\n";
}

/// Joints that evolved but that the report does not list, as in one cut short.
void add_unlisted(const FitnessHistory& history, std::vector<JointEntry>& joints) {
  for (const auto& [joint, curves] : history.joints) {
    if (std::ranges::find(joints, joint, &JointEntry::joint) != joints.end()) continue;
    joints.emplace_back();
    joints.back().joint = joint;
  }
}

std::string joint_head(const JointEntry& joint) {
  const auto& [before_rad, after_rad] = joint.mean_abs_error_rad;
  const char* const badge =
      joint.kept ? "<span class=\"badge yes\">corrected</span>" : "<span class=\"badge\">neutral</span>";
  std::string gain;
  if (joint.kept && before_rad && after_rad) {
    gain = fmt::format("<span class=\"gain\">mean absolute error <b>{} → {} mrad</b> ({})</span>", mrad(before_rad),
                       mrad(after_rad), change(before_rad, after_rad));
  } else if (before_rad) {
    gain = fmt::format("<span class=\"gain\">mean absolute error <b>{} mrad</b></span>", mrad(before_rad));
  }
  return fmt::format("<header><h3>Joint {}</h3>{}{}</header>\n", joint.joint, badge, gain);
}

std::string jumps(const JointEntry& joint) {
  std::string text;
  for (const double jump_rad : joint.discontinuities_rad)
    text += (text.empty() ? "" : ", ") + fixed(degrees(jump_rad), 1);
  return text.empty() ? "without jumps" : "jumps at " + text + " deg";
}

std::string plot_caption(const JointEntry& joint) {
  const std::string bound =
      joint.bound_rad ? "never beyond " + mrad(joint.bound_rad) + " mrad" : "no bound known: a pole cannot be excluded";
  return fmt::format("<figcaption>Correction over the calibrated range; {}; {}.</figcaption>", bound, jumps(joint));
}

std::string plot(const JointEntry& joint) {
  if (!joint.kept || !joint.range_rad || joint.range_rad->lower == joint.range_rad->upper) return {};
  try {
    const std::string label = fmt::format("Correction of joint {}", joint.joint);
    return "<figure>" + correction_chart(parse(joint.expression), *joint.range_rad, joint.discontinuities_rad, label) +
           plot_caption(joint) + "</figure>\n";
  } catch (const InputError& fault) {
    return "<figure><figcaption>No plot: the formula cannot be read, " + escaped(fault.what()) +
           ".</figcaption></figure>\n";
  }
}

std::string evolution_figure(const JointEntry& joint, const FitnessHistory& history) {
  const std::string chart = fitness_chart(history, joint.joint);
  if (chart.empty()) return {};
  const std::size_t islands = history.joints.at(joint.joint).size();
  return fmt::format("<figure>{}<figcaption>Evolution on {} island{}: {}.</figcaption></figure>\n", chart, islands,
                     islands == 1 ? "" : "s", fitness_caption(history, joint.joint));
}

std::string formula_line(const JointEntry& joint) {
  if (!joint.kept || joint.expression.empty()) return {};
  const std::string folded = joint.with_functions.empty()
                                 ? ""
                                 : "\n<span>         = </span><code>" + escaped(joint.with_functions) + "</code>";
  const std::string brief = joint.short_form.empty()
                                ? ""
                                : "<p class=\"note\">In short: <code>" + escaped(joint.short_form) + "</code></p>\n";
  return brief + "<pre class=\"formula\"><span>g(theta) = </span><code>" + escaped(joint.expression) + "</code>" +
         folded + "</pre>\n";
}

/// Where the formula is from.
std::string origin_line(const JointEntry& joint) {
  if (joint.origin == "smooth_terms")
    return "<p class=\"note\">This is a sum of smooth terms that was fitted to the poses; no evolved formula is in the "
           "model.</p>\n";
  if (joint.origin == "evolved_and_smooth_terms")
    return "<p class=\"note\">An evolved formula, with smooth terms added that were fitted to the poses.</p>\n";
  return joint.origin == "evolved" ? "<p class=\"note\">This formula evolved.</p>\n" : "";
}

std::string limit_line(const JointEntry& joint) {
  const std::string limit = limit_sentence(joint);
  return limit.empty() ? "" : "<p class=\"note\">" + escaped(limit) + "</p>\n";
}

bool holds_what_evolved(const JointEntry& joint) {
  return joint.kept && joint.origin != "smooth_terms";
}

/// The joint's error, its correction as plot and formula or why it has none, and the course of its evolution.
std::string joint_card(const JointEntry& joint, const FitnessHistory& history) {
  const std::string note =
      joint.note.empty() ? "" : "<p class=\"note\">Left neutral: " + escaped(joint.note) + ".</p>\n";
  const std::string curve = plot(joint), evolution = evolution_figure(joint, history);
  const std::string evolved = joint.as_evolved.empty()
                                  ? ""
                                  : fmt::format("<p class=\"note\">As evolved{}, {} mrad left: <code>{}</code></p>\n",
                                                holds_what_evolved(joint) ? "" : " (not in the model)",
                                                mrad(joint.as_evolved_error_rad), escaped(joint.as_evolved));
  return "<article class=\"joint\">\n" + joint_head(joint) + note +
         (curve.empty() ? "" : "<div class=\"pair\">\n" + curve + "</div>\n") + formula_line(joint) +
         origin_line(joint) + limit_line(joint) + evolved +
         (evolution.empty()
              ? ""
              : fmt::format("<details><summary class=\"soft\">{}</summary>\n{}</details>\n",
                            holds_what_evolved(joint) ? "how it evolved" : "how formulas for it evolved", evolution)) +
         "</article>\n";
}

}  // namespace

std::string joints_section(const Report& report, const FitnessHistory& history) {
  std::vector<JointEntry> joints = report.joints;
  const std::string origins = origins_sentence(report);
  std::string body = joints_table(joints) + (origins.empty() ? "" : "<p>" + escaped(origins) + "</p>\n") +
                     function_definitions(report);
  add_unlisted(history, joints);
  if (std::ranges::any_of(joints, [](const JointEntry& joint) { return !joint.short_form.empty(); })) {
    body += fmt::format(
        "<p class=\"note\">In short: formulas that people read. With those of all joints together in place of the long "
        "ones the rms error of the {} poses is at most 5 % larger.</p>\n",
        judging_set(report));
  }
  for (const JointEntry& joint : joints) body += joint_card(joint, history);
  if (!history.joints.empty()) {
    body +=
        "<p class=\"note\">Evolution: best fitness of each island, the weighted sum of absolute errors over the "
        "joint's calibration poses in units of that joint's scale; logarithmic, the same scale for all joints.</p>\n";
  }
  return section("joint-corrections", "Joint corrections", body);
}

}  // namespace demecal::inline html
