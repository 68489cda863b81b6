// What the fitted model leaves unexplained at every pose, and how every small motion of the arm would change it.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "effects/arm_state.hpp"
#include "fitting/fit.hpp"
#include "fitting/observation.hpp"

namespace demecal {

/// Matrices whose rows are the measured numbers, pose by pose.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Two matrices of equally many rows as one.
RowMatrix beside(const RowMatrix& left, const RowMatrix& right);

/// Rows are in units of what their kind scatters, and those of poses far out are scaled down by the root of their Huber
/// weight. A model change `c` changes the residual to residual - columns * c.
struct ResidualField {
  std::vector<std::size_t> poses;       ///< in the data set
  std::vector<Eigen::Index> first_row;  ///< of each pose, and one past the last: poses + 1
  std::vector<double> root_weight;      ///< one per pose
  Eigen::VectorXd residual;             ///< measured minus predicted
  RowMatrix declared;                   ///< rows x free parameters of the model
  RowMatrix motions;                    ///< rows x 6 (n + 2): per unit motion, see motion_column
  std::vector<ArmState> states;         ///< one per pose

  Eigen::Index rows() const { return residual.size(); }
  Eigen::Index rows_of_pose(std::size_t i) const { return first_row[i + 1] - first_row[i]; }
};

inline constexpr int kTurnAboutZ = 5;  ///< the axis of motion_column that a revolute joint turns about

/// The column of ResidualField::motions of a unit motion along or about `axis` of `place`.
inline Eigen::Index motion_column(int place, int axis) {
  return 6 * (place - kSensorPlace) + axis;
}

/// The field of `robot` over `poses`, its free parameters those of `space` (whose reference is `robot`). Poses that
/// measured nothing in use are left out. `robust`: far poses are scaled down.
ResidualField residual_field(const DataSet& data, std::span<const std::size_t> poses, const ParameterSpace& space,
                             const RowScales& scales, bool robust);

}  // namespace demecal
