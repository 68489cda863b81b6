// Data sets with a mistake that a person could have made in them, and others that lack nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "data_check/finding.hpp"

namespace demecal::bench {

/// Never changed: figures of two builds are compared case by case.
inline constexpr std::uint64_t kMistakeSeed = 20261122;

struct MistakenCase {
  int number = 0;
  std::string arm;                   ///< "PUMA 761"
  std::string what;                  ///< "sign of joint 3"
  std::optional<FindingKind> kind;   ///< none: nothing is wrong with it
  std::vector<std::string> poses{};  ///< ids of those that are mistaken, where the mistake is of single poses
  DataSet data;
};

/// Four simulated arms, one of seven joints, each with links, tool, gears and compliance as real ones have them wrong.
std::vector<Robot> mistaken_arms(const std::string& robots_folder);

/// Every mistake on every arm, drawn from kMistakeSeed.
std::vector<MistakenCase> mistaken_cases(const std::vector<Robot>& arms);

/// `count` data sets without a mistake, each of another make: few poses, narrow ranges, several targets on a tool,
/// repeats, measured orientation, warmth and drift, large errors of the links, positions in the base's frame.
std::vector<MistakenCase> unmistaken_cases(const std::vector<Robot>& arms, int count);

/// `count` data sets drawn from a measured one: of its first poses, of every n-th, and at random.
std::vector<MistakenCase> drawn_cases(const DataSet& measured, int count);

}  // namespace demecal::bench
