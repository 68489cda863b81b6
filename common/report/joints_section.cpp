#include <algorithm>

#include "report/html_text.hpp"
#include "report/joint_card.hpp"
#include "report/sections.hpp"

namespace demecal {
namespace {

std::string row(const JointEntry& joint) {
  const bool corrected = joint.kept;
  return table_row(
      "joint " + std::to_string(joint.joint),
      {mrad(joint.before_rad), mrad(joint.after_rad), corrected ? change(joint.before_rad, joint.after_rad) : "–",
       corrected ? mrad(joint.bound_rad) : "–", range_deg(joint),
       corrected ? std::to_string(joint.jumps_rad.size()) : "–",
       corrected ? "<span class=\"badge yes\">corrected</span>" : "<span class=\"badge\">neutral</span>"});
}

std::string table(const std::vector<JointEntry>& joints) {
  std::string rows;
  for (const JointEntry& joint : joints) rows += row(joint);
  if (rows.empty()) return rows;
  return "<p class=\"note\">A corrected joint really goes to theta + g(theta) where theta is commanded. Errors are "
         "mean "
         "absolute joint errors over the calibration poses; one mrad moves a tool one metre away by one mm.</p>\n"
         "<div class=\"panel\"><table id=\"joints\">\n<thead><tr><th></th><th>error before, mrad</th>"
         "<th>after, mrad</th><th>change</th><th>bound of g, mrad</th><th>range, deg</th><th>jumps</th><th></th></tr>"
         "</thead>\n<tbody>\n" +
         rows + "</tbody></table></div>\n";
}

/// Functions that joints share, and who calls them.
std::string function_definitions(const JsonValue& report) {
  std::string lines;
  for (const JsonValue& function : report["shared_functions"].elements()) {
    const std::vector<double> callers = function["joints"].numbers();
    std::string joints;
    for (const double joint : callers)
      joints += (joints.empty() ? (callers.size() == 1 ? "joint " : "joints ") : ", ") + fixed(joint, 0);
    lines += "<code>" + escaped(function["definition"].text()) + "</code> <span>" +
             (joints.empty() ? "called by no joint" : joints) + "</span>\n";
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

}  // namespace

std::string joints_section(const JsonValue& report, const FitnessHistory& history) {
  std::vector<JointEntry> joints = joint_entries(report);
  std::string body = table(joints) + function_definitions(report);
  add_unlisted(history, joints);
  for (const JointEntry& joint : joints) body += joint_card(joint, history);
  if (!history.joints.empty()) {
    body +=
        "<p class=\"note\">Evolution: best fitness of each island, the weighted sum of absolute errors over the "
        "joint's calibration poses in units of that joint's scale; logarithmic, the same scale for all joints.</p>\n";
  }
  return section("joint-corrections", "Joint corrections", body);
}

}  // namespace demecal
