#include "terminal/plan_text.hpp"

#include <fmt/format.h>

#include "kinematics/units.hpp"
#include "report/plan_report.hpp"
#include "terminal/text.hpp"

namespace demecal::inline terminal {

std::string to_terminal(const Plan& plan, const PlanRequest& request) {
  constexpr std::size_t kIndent = 4;
  std::string text = fmt::format("{}: {} calibration, {} validation, {} accept poses\n", request.robot.name,
                                 plan.counts[0], plan.counts[1], plan.counts[2]);
  text += fmt::format(
      "  predicted error of the tool after calibration: rms {:.3g} mm, mean {:.3g} mm, 95 % below {:.3g} mm\n",
      millimetres(plan.predicted.rms_m), millimetres(plan.predicted.mean_m), millimetres(plan.predicted.p95_m));
  if (plan.random_rms_m > 0.0)
    text += fmt::format("  as many poses at random: rms {:.3g} mm\n", millimetres(plan.random_rms_m));
  if (!plan.by_places.empty()) text += fmt::format("  as many random poses at {} (rms)\n", places_sentence(plan));
  for (const std::string& sentence : socket_sentences(plan)) text += "  " + sentence + '\n';
  for (const std::string& warning : plan.warnings) text += wrapped("  !", warning, kIndent);
  for (const std::string& sentence : unidentified_sentences(plan))
    text += wrapped("  not identifiable:", sentence, kIndent);
  for (const DetectableSize& one : plan.detectable)
    text += wrapped("  would be found nine times in ten:", detectable_text(one, request.robot), kIndent);
  for (const std::string& assumption : plan.assumptions) text += wrapped("  -", assumption, kIndent);
  return text;
}

}  // namespace demecal::inline terminal
