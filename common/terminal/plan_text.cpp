#include <fmt/format.h>
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "kinematics/units.hpp"
#include "planning/plan.hpp"
#include "studies/plan_report.hpp"
#include "terminal/report_text.hpp"
#include "terminal/text.hpp"

namespace demecal::inline terminal {
namespace {

constexpr std::size_t kHanging = 4;

/// `head` before each sentence, and how many more the plan's page has.
std::string first_few(const std::string& head, const std::vector<std::string>& sentences, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, sentences.size()); ++i) text += wrapped(head, sentences[i], kHanging);
  if (sentences.size() > most) text += fmt::format("{} {} more in plan.html\n", head, sentences.size() - most);
  return text;
}

}  // namespace

std::string to_terminal(const Plan& plan, const PlanRequest& request) {
  std::string text = fmt::format("{}: {} calibration, {} validation, {} accept poses\n", request.robot.name,
                                 plan.counts[0], plan.counts[1], plan.counts[2]);
  std::vector<std::string> warnings = plan.warnings;
  if (plan.has_too_few_poses) {
    text += wrapped("  !", warnings.front(), kHanging);
    warnings.erase(warnings.begin());
  }
  text += fmt::format(
      "  predicted error of the tool after calibration: rms {:.3g} mm, mean {:.3g} mm, 95 % below {:.3g} mm\n",
      millimetres(plan.predicted.rms_m), millimetres(plan.predicted.mean_m), millimetres(plan.predicted.p95_m));
  if (plan.random_rms_m > 0.0)
    text += fmt::format("  as many poses at random: rms {:.3g} mm\n", millimetres(plan.random_rms_m));
  text += fmt::format("  lower bound for any {} poses{}: rms {:.3g} mm\n", plan.counts[0],
                      plan.sockets.empty() ? " in this cell" : " at these sockets", millimetres(plan.bound_rms_m));
  if (!plan.by_places.empty()) text += fmt::format("  as many random poses at {} (rms)\n", places_sentence(plan));
  for (const std::string& sentence : socket_sentences(plan)) text += "  " + sentence + '\n';
  constexpr std::size_t kFew = 3;
  std::vector<std::string> sizes;
  for (const DetectableSize& one : plan.detectable) sizes.push_back(detectable_text(one, request.robot));
  text += first_few("  not identifiable:", unidentified_sentences(plan), kFew - 1);
  text += first_few("  would be found nine times in ten:", sizes, kFew);
  text += first_few("  !", warnings, warnings.size());
  text += first_few("  -", plan.assumptions, 1);
  return text;
}

}  // namespace demecal::inline terminal
