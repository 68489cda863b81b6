// What a model's effects may have done at poses that do not state what these depend on: the side that joints came from,
// the payload, the temperature, the time.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "prediction/corrected_robot.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline updating {

/// Adds the covariance of the field's rows that follows from circumstances as they usually vary: at all poses together,
/// and at each by itself. Returns how far they move a pose, rms over the poses, in the field's units.
double add_unstated(const CorrectedRobot& robot, const DataSet& data, const ResidualField& field,
                    Eigen::MatrixXd& covariance);

/// For people: which effects these are, and how far they may move the tool; none where that is next to nothing beside
/// the noise.
std::vector<std::string> unstated_sentences(const CorrectedRobot& robot, const DataSet& data,
                                            std::span<const std::size_t> poses, double moved_m, double noise_m);

}  // namespace demecal::inline updating
