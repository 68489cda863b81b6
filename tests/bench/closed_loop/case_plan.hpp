// What every case of the benchmark is: which effect, on which arm, and what the model is told beforehand.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "parameters/declared_model.hpp"

namespace demecal::bench {

/// The seed of case 0; others follow by their number. Never changed: figures of two builds are compared case by case.
inline constexpr std::uint64_t kBaseSeed = 20261121;
inline constexpr int kCases = 240;
/// Cases whose clean twin alone is asked for.
inline constexpr const char* kClean = "clean";
/// Two undeclared effects at once, and formulas that no law of the catalogue writes.
inline constexpr const char* kPair = "pair";
inline constexpr const char* kOutside = "outside";

/// What a kind's cases hold beside the effect.
struct KindRow {
  std::string kind;
  DeclaredModel declared;
  bool smooth_errors = true;  ///< on every joint; joint corrections are declared with them
  bool in_pairs = false;
};

/// One row a kind, in the order of reports.
const std::vector<KindRow>& kind_table();
/// The row of a kind, which must be of the table.
const KindRow& row_of(const std::string& kind);

struct CasePlan {
  int number = 0;
  std::string kind;
  std::string robot_file;  ///< "puma761.yaml"

  std::uint64_t seed() const { return kBaseSeed + static_cast<std::uint64_t>(number); }
};

/// Kinds follow each other in turn (pairs and formulas twice), and arms change from turn to turn.
CasePlan plan_of(int number);

/// The cases with numbers 0 .. cases - 1 of a benchmark of all kinds; with a kind named, the first `cases` of that
/// kind.
std::vector<CasePlan> plans(int cases, const std::string& kind);

}  // namespace demecal::bench
