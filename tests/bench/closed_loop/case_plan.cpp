#include "case_plan.hpp"

#include <algorithm>
#include <array>

#include "errors/check.hpp"

namespace demecal::bench {
namespace {

constexpr std::array<const char*, 3> kRobots{"puma761.yaml", "ur10.yaml", "elbow-offset.yaml"};

DeclaredModel declared(bool tool, bool joint_offset, bool corrections) {
  return {.registration = true,
          .tool = tool,
          .joint_offset = joint_offset,
          .geometry = false,
          .joint_corrections = corrections};
}

/// Every kind once, pairs and formulas twice.
const std::vector<std::string>& turn() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> all;
    for (const KindRow& row : kind_table()) {
      all.push_back(row.kind);
      if (row.kind == kPair || row.kind == kOutside) all.push_back(row.kind);
    }
    return all;
  }();
  return kinds;
}

}  // namespace

// Smooth errors of a joint hold its offset, gain and eccentricity: these are undeclared only where the arm has no such
// errors and no corrections are declared. Geometry is never declared, so that it competes everywhere, and the
// instrument's scale shows beside it.
const std::vector<KindRow>& kind_table() {
  static const DeclaredModel bare = declared(true, false, false), full = declared(true, true, true);
  static const std::vector<KindRow> rows{
      // kind, declared, smooth errors, in pairs
      {"joint_offset", bare, false, false}, {"geometry", full, true, true},
      {"gain", bare, false, false},         {"eccentricity", bare, false, false},
      {"gear_harmonic", full, true, true},  {"compliance", full, true, true},
      {"link_bending", full, true, true},   {"coupling", full, true, true},
      {"backlash", full, true, true},       {"hysteresis", full, true, true},
      {"axis_wobble", full, true, true},    {"thermal_offset", full, true, true},
      {"thermal_length", full, true, true}, {"drift", full, true, true},
      {"sensor_scale", full, true, true},   {"tool", declared(false, true, true), true, false},
      {kPair, full, true, false},           {kOutside, full, true, false},
  };
  return rows;
}

const KindRow& row_of(const std::string& kind) {
  const auto row = std::ranges::find(kind_table(), kind, &KindRow::kind);
  DEMECAL_CHECK(row != kind_table().end(), kind);
  return *row;
}

CasePlan plan_of(int number) {
  const auto place = static_cast<std::size_t>(number);
  const std::vector<std::string>& kinds = turn();
  return {number, kinds[place % kinds.size()], kRobots[place / kinds.size() % kRobots.size()]};
}

std::vector<CasePlan> plans(int cases, const std::string& kind) {
  std::vector<CasePlan> all;
  for (int number = 0; static_cast<int>(all.size()) < cases; ++number) {
    CasePlan plan = plan_of(number);
    if (kind.empty() || kind == kClean || plan.kind == kind) all.push_back(std::move(plan));
  }
  return all;
}

}  // namespace demecal::bench
