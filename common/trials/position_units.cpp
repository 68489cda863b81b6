#include <fmt/format.h>
#include <string>
#include <utility>
#include <vector>

#include "trials/explanations.hpp"
#include "trials/finding.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline trials {
namespace {

Explanation position_unit(double factor, const std::string& words) {
  return {FindingKind::unit, -1, words, [factor](Trial& trial) {
            for (TrialRow& row : trial.rows) row.point_m *= factor;
          }};
}

Explanation column_unit(int axis, double factor, const std::string& words) {
  return {FindingKind::unit, -1,
          fmt::format("the column {} of the positions alone is {}", std::string(1, "xyz"[axis]), words),
          [=](Trial& trial) {
            for (TrialRow& row : trial.rows) row.point_m[axis] *= factor;
          }};
}

}  // namespace

std::vector<Explanation> position_unit_explanations() {
  std::vector<Explanation> all;
  for (const auto& [factor, words] : std::initializer_list<std::pair<double, const char*>>{
           {1e3,
            "positions are in metres where millimetres are stated (or the robot's lengths are 1000 times too long)"},
           {1e-3, "positions are in millimetres where metres are stated (or the robot's lengths are in metres)"},
           {25.4, "positions are in inches where millimetres are stated"},
           {0.0254, "positions are in inches where metres are stated"},
           {1 / 25.4, "positions are in millimetres, and the robot's lengths in inches"},
           {10.0, "positions are in centimetres where millimetres are stated"},
           {0.01, "positions are in centimetres where metres are stated"},
           {0.1, "positions are in millimetres, and the robot's lengths in centimetres"},
           {304.8, "positions are in feet where millimetres are stated"},
           {0.3048, "positions are in feet where metres are stated"}})
    all.push_back(position_unit(factor, words));
  return all;
}

std::vector<Explanation> column_unit_explanations() {
  std::vector<Explanation> all;
  for (const auto& [factor, words] : std::initializer_list<std::pair<double, const char*>>{
           {1e3, "in metres where millimetres are stated"},
           {1e-3, "in millimetres where metres are stated"},
           {25.4, "in inches where millimetres are stated"},
           {0.0254, "in inches where metres are stated"},
           {1 / 25.4, "25.4 times too large, as where millimetres are taken for inches"},
           {10.0, "in centimetres where millimetres are stated"},
           {0.01, "in centimetres where metres are stated"},
           {0.1, "10 times too large, as where millimetres are taken for centimetres"},
           {304.8, "in feet where millimetres are stated"},
           {0.3048, "in feet where metres are stated"}})
    for (int axis = 0; axis < 3; ++axis) all.push_back(column_unit(axis, factor, words));
  return all;
}

}  // namespace demecal::inline trials
