// What is known between contacts (lengths, parallel or square planes) as rows of a fit beside those measured.
#pragma once

#include <Eigen/Core>

#include "data/data_set.hpp"
#include "fitting/parameter_space.hpp"

namespace demecal::inline fitting {

/// Known minus placed, over what is known's own uncertainty: rows of unit variance. Derivative by the changes.
struct RelationRows {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;  ///< rows x parameters
};

/// The rows of all relations between contacts whose places are free in `space`, both of one set. A relation that
/// several sets have counts as one all the same: their rows share its uncertainty.
RelationRows relation_rows(const DataSet& data, const ParameterSpace& space, const ModelPoint& point);

}  // namespace demecal::inline fitting
