// What a job asks of joint corrections besides the parameters of evolution.
#pragma once

#include <limits>
#include <vector>

#include "expression/tree.hpp"

namespace demecal {

/// A correction to begin with, such as a user's guess or an earlier run's result.
struct SeedFormula {
  static constexpr int kEveryJoint = -1;
  int joint = kEveryJoint;  ///< from 0
  Tree formula;             ///< of theta, rad

  bool operator==(const SeedFormula&) const = default;
};

/// Whether joints are to share functions (thesis 7.1 ii): how many, and into how many stages the generations are
/// divided, between which these are found.
struct SharingOptions {
  int functions = 0;  ///< at most; 0: none, and no stages
  int stages = 4;

  bool operator==(const SharingOptions&) const = default;
};

struct CorrectionOptions {
  double largest_rad = std::numeric_limits<double>::infinity();  ///< that any correction may become in its range
  std::vector<SeedFormula> seeds;
  SharingOptions sharing{};

  bool operator==(const CorrectionOptions&) const = default;
};

}  // namespace demecal
