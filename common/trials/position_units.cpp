#include <fmt/format.h>
#include <vector>

#include "trials/explanations.hpp"
#include "trials/finding.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline trials {
namespace {

/// A mistake in a unit of length, undone by a factor.
struct LengthMistake {
  double factor;
  const char* of_positions;  ///< positions ...
  const char* of_column;     ///< the column x of the positions alone is ...
};

constexpr LengthMistake kLengthMistakes[] = {
    {1e3, "are in metres where millimetres are stated (or the robot's lengths are 1000 times too long)",
     "in metres where millimetres are stated"},
    {1e-3,
     "are in millimetres where metres are stated, or in micrometres where millimetres are (or the robot's lengths are "
     "in "
     "metres)",
     "in millimetres where metres are stated"},
    {25.4, "are in inches where millimetres are stated", "in inches where millimetres are stated"},
    {0.0254, "are in inches where metres are stated", "in inches where metres are stated"},
    {1 / 25.4, "are in millimetres, and the robot's lengths in inches",
     "25.4 times too large, as where millimetres are taken for inches"},
    {10.0, "are in centimetres where millimetres are stated", "in centimetres where millimetres are stated"},
    {0.01, "are in centimetres where metres are stated", "in centimetres where metres are stated"},
    {0.1, "are in millimetres, and the robot's lengths in centimetres",
     "10 times too large, as where millimetres are taken for centimetres"},
    {304.8, "are in feet where millimetres are stated", "in feet where millimetres are stated"},
    {0.3048, "are in feet where metres are stated", "in feet where metres are stated"}};

}  // namespace

std::vector<Explanation> position_unit_explanations() {
  std::vector<Explanation> all;
  for (const LengthMistake& mistake : kLengthMistakes)
    all.push_back({FindingKind::unit, -1, fmt::format("positions {}", mistake.of_positions),
                   [factor = mistake.factor](Trial& trial) {
                     for (TrialRow& row : trial.rows) row.point_m *= factor;
                   }});
  return all;
}

std::vector<Explanation> column_unit_explanations() {
  std::vector<Explanation> all;
  for (const LengthMistake& mistake : kLengthMistakes)
    for (int axis = 0; axis < 3; ++axis)
      all.push_back({FindingKind::unit, -1,
                     fmt::format("the column {} of the positions alone is {}", "xyz"[axis], mistake.of_column),
                     [axis, factor = mistake.factor](Trial& trial) {
                       for (TrialRow& row : trial.rows) row.point_m[axis] *= factor;
                     }});
  return all;
}

}  // namespace demecal::inline trials
