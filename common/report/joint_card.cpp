#include "report/joint_card.hpp"

#include <fmt/format.h>

#include "errors/input_error.hpp"
#include "expression/text.hpp"
#include "kinematics/units.hpp"
#include "report/correction_chart.hpp"
#include "report/fitness_chart.hpp"
#include "report/html_text.hpp"

namespace demecal {
namespace {

std::string head(const JointEntry& joint) {
  const char* const badge =
      joint.kept ? "<span class=\"badge yes\">corrected</span>" : "<span class=\"badge\">neutral</span>";
  std::string gain;
  if (joint.kept && joint.before_rad && joint.after_rad) {
    gain = fmt::format("<span class=\"gain\">mean absolute error <b>{} → {} mrad</b> ({})</span>",
                       mrad(joint.before_rad), mrad(joint.after_rad), change(joint.before_rad, joint.after_rad));
  } else if (joint.before_rad) {
    gain = fmt::format("<span class=\"gain\">mean absolute error <b>{} mrad</b></span>", mrad(joint.before_rad));
  }
  return fmt::format("<header><h3>Joint {}</h3>{}{}</header>\n", joint.joint, badge, gain);
}

std::string jumps(const JointEntry& joint) {
  std::string text;
  for (const double jump_rad : joint.jumps_rad) text += (text.empty() ? "" : ", ") + fixed(degrees(jump_rad), 1);
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
    return "<figure>" + correction_chart(parse(joint.expression), *joint.range_rad, joint.jumps_rad, label) +
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
  return "<pre class=\"formula\"><span>g(theta) = </span><code>" + escaped(joint.expression) + "</code>" + folded +
         "</pre>\n";
}

}  // namespace

std::string joint_card(const JointEntry& joint, const FitnessHistory& history) {
  const std::string note =
      joint.note.empty() ? "" : "<p class=\"note\">Left neutral: " + escaped(joint.note) + ".</p>\n";
  const std::string figures = plot(joint) + evolution_figure(joint, history);
  return "<article class=\"joint\">\n" + head(joint) + note +
         (figures.empty() ? "" : "<div class=\"pair\">\n" + figures + "</div>\n") + formula_line(joint) +
         "</article>\n";
}

std::string range_deg(const JointEntry& joint) {
  if (!joint.range_rad) return "–";
  return fixed(degrees(joint.range_rad->lower), 1) + " to " + fixed(degrees(joint.range_rad->upper), 1);
}

std::string mrad(std::optional<double> angle_rad) {
  return fixed(angle_rad ? std::optional(1e3 * *angle_rad) : std::nullopt, 3);
}

}  // namespace demecal
