// Data sets with a mistake that a person could have made in them, and others that lack nothing.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "trials/finding.hpp"

namespace demecal::bench {

/// How cases are drawn. The seed is never changed: figures of two builds are compared case by case.
struct MistakeDraw {
  std::uint64_t seed = 20261122;
  std::array<int, 3> poses{50, 25, 25};  ///< of mistaken data sets: calibration, validation, accept
};

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

/// Every mistake on every arm.
std::vector<MistakenCase> mistaken_cases(const std::vector<Robot>& arms, const MistakeDraw& draw = {});

/// `count` data sets without a mistake, each of another make: few poses, narrow ranges, several targets on a tool,
/// repeats, measured orientation, warmth and drift, large errors of the links, positions in the base's frame.
std::vector<MistakenCase> unmistaken_cases(const std::vector<Robot>& arms, int count, const MistakeDraw& draw = {});

/// `count` data sets of 40 to 200 poses of a measured one, at random.
std::vector<MistakenCase> drawn_cases(const DataSet& measured, int count, const MistakeDraw& draw = {});

}  // namespace demecal::bench
