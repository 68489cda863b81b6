// What one of several evolutions in a row has of its own.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "expression/shared_function.hpp"

namespace demecal {

/// Functions that joints share, where these are known, be they none.
using KnownFunctions = std::optional<std::vector<SharedFunction>>;

struct RoundTerms {
  std::uint64_t seed = 0;
  int generations = 0;
  std::vector<SharedFunction> functions{};  ///< that the joints share
};

/// The terms of round `number` (from 0) of `rounds` into which generations are divided as evenly as can be; rounds
/// differ in their random numbers as seeds do.
inline RoundTerms terms_of_round(std::uint64_t seed, int generations, int rounds, int number) {
  return {seed + (static_cast<std::uint64_t>(number) << 32U),
          generations / rounds + (number < generations % rounds ? 1 : 0),
          {}};
}

}  // namespace demecal
