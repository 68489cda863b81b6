#include "data/payload.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "data/text.hpp"

namespace demecal::inline data {

double most_payload_kg(const Robot& robot) {
  if (robot.payload_kg) return *robot.payload_kg;
  const auto is_known = [](const LinkMass& link) { return link.mass_kg > 0.0; };
  if (robot.masses.empty() || !std::ranges::all_of(robot.masses, is_known)) return kMostPayload_kg;
  const double links_kg = std::accumulate(robot.masses.begin(), robot.masses.end(), 0.0,
                                          [](double sum_kg, const LinkMass& link) { return sum_kg + link.mass_kg; });
  return std::min(kMostPayload_kg, links_kg);
}

std::string above_most_payload(const Robot& robot) {
  if (robot.payload_kg) return "more than this arm carries (" + number_text(*robot.payload_kg) + " kg, `payload_kg`)";
  const double most_kg = most_payload_kg(robot);
  const std::string amount = " (" + number_text(std::round(most_kg)) + " kg)";
  return most_kg < kMostPayload_kg ? "more than all links of this arm weigh" + amount
                                   : "more than any robot carries" + amount;
}

}  // namespace demecal::inline data
