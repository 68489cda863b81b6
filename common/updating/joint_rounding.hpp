// How coarsely the joints of poses are written, where that is notable beside the noise.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "data/data_set.hpp"
#include "data/written_steps.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline updating {

struct JointRounding {
  JointSteps steps;
  std::string sentence;  ///< for people: how far it moves the tool, and what to do
};

/// Of the joints of `poses`; `noise_m`: that of the tool, per axis. Nothing where joints are written finely enough.
std::optional<JointRounding> notable_rounding(const Chain& chain, const DataSet& data,
                                              std::span<const std::size_t> poses, double noise_m);

}  // namespace demecal::inline updating
