// How much of a prior model has changed: what new poses multiply each part of the belief by, and each joint's waves.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "parameters/observation.hpp"
#include "products/tall_products.hpp"
#include "residuals/residual_field.hpp"
#include "updating/prior_model.hpp"

namespace demecal::inline updating {

std::string_view to_string(BeliefPart part);

/// The new poses' rows about the present model, in units of their scatter.
struct NewRows {
  ResidualField field;
  RowMatrix columns;
  Eigen::VectorXd values;  ///< what the columns times the whole change are to explain
};

NewRows rows_about(const PriorModel& prior, const DataSet& data, const std::vector<std::size_t>& poses,
                   const RowScales& scales, const Eigen::VectorXd& change, bool robust);

/// Factors of variances.
struct BeliefSizes {
  PartFactors factors{1.0, 1.0, 1.0, 1.0};
  Eigen::VectorXd of_joint;  ///< of its waves, besides
  double noise = 1.0;
};

/// A fleet states how much each joint of its robots differs; of one old model nothing is known of that.
enum class JointSizes { alike, each };

/// The sizes that make the new rows likeliest, each believed to be one within a factor of some ten. One joint may have
/// changed much and the others not: a wrist of which the old model saw few angles.
BeliefSizes likeliest_sizes(const PriorModel& prior, const NewRows& rows, JointSizes joints);

}  // namespace demecal::inline updating
