// How much of a cause a model has itself, to which what changed since then adds.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "data/data_set.hpp"
#include "effects/effect.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline updating {

/// In the unit of the cause's one coefficient: of what depends on the side that a joint comes from, all that the
/// model's effects move the joint by it at `poses`, on average; of what depends on the temperature, what effects of the
/// same kind and joint have. Nothing of other causes.
std::optional<double> amount_by_model(const CorrectedRobot& robot, const DataSet& data,
                                      std::span<const std::size_t> poses, const Effect& cause);

}  // namespace demecal::inline updating
