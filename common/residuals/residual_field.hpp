// What the fitted model leaves unexplained at every pose, and how small motions of the arm and effects would change it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "data/data_set.hpp"
#include "effect_sets/fitted_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "fitting/fit.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/observation.hpp"
#include "parameters/parameter_space.hpp"
#include "prediction/corrected_robot.hpp"
#include "products/tall_products.hpp"
#include "shared_work/feature_blocks.hpp"

namespace demecal::inline residuals {

/// Two matrices of equally many rows as one.
RowMatrix beside(RowMatrix left, const RowMatrix& right);

/// How rows scatter beyond independent noise of unit variance, in the units of RowScales.
struct NoiseModel {
  double joint_rad = 0.0;    ///< standard deviation of revolute joints, new at every visit: root mean square over them
  double repeats = 0.0;      ///< of the error that repeats of one pose share, over that of independent noise
  double order = 0.0;        ///< the same of an error that poses measured one after another share
  double correlation = 0.0;  ///< of that error from one pose to the next (autoregressive of first order)
  double fast = 0.0;         ///< the part of order^2 at fitted poses that changes too fast to be followed: independent
  std::vector<double> joint_shares{};  ///< variance of each revolute joint over joint_rad^2; empty: one of all

  double joint_variance_rad2(std::size_t revolute) const {
    return joint_rad * joint_rad * (joint_shares.empty() ? 1.0 : joint_shares[revolute]);
  }
};

struct NoiseEstimate {
  NoiseModel model{};
  double scale = 1.0;  ///< of independent noise: what the scales of all rows are to be multiplied by
};

/// Rows are in units of what their kind scatters; those of one pose are made independent of unit variance where joints
/// scatter too, and those of poses far out are scaled down by the root of their weight (Huber's by
/// the pose's norm, none at all beyond rejection_norm). A model change `c` changes the residual to residual - columns *
/// c.
struct ResidualField {
  std::vector<std::size_t> poses;        ///< in the data set
  std::vector<std::size_t> group;        ///< per pose: the first of `poses` that has its id and target
  std::vector<Eigen::Index> first_row;   ///< of each pose, and one past the last: poses + 1
  std::vector<double> root_weight;       ///< one per pose
  Eigen::VectorXd residual;              ///< measured minus predicted
  RowMatrix declared;                    ///< rows x free parameters of the model
  RowMatrix motions;                     ///< rows x 6 (n + 2): per unit motion, see motion_column
  std::vector<ArmState> states;          ///< one per pose
  std::vector<Eigen::MatrixXd> within;   ///< per pose: root (lower) of the covariance of its scaled rows; empty: none
  std::vector<Eigen::Index> scattering;  ///< columns of `motions` of the joints that scatter by it
  /// Orthonormal columns: what moving the places does that these poses touch and nobody fits. Rows say nothing of it.
  RowMatrix places{};

  Eigen::Index rows() const { return residual.size(); }
  Eigen::Index rows_of_pose(std::size_t i) const { return first_row[i + 1] - first_row[i]; }
};

inline constexpr int kTurnAboutZ = 5;  ///< the axis of motion_column that a revolute joint turns about

/// The column of ResidualField::motions of a unit motion along or about `axis` of `place`.
inline Eigen::Index motion_column(int place, int axis) {
  return 6 * (place - kSensorPlace) + axis;
}

/// The norm of a pose with `rows` rows of unit variance at and beyond which it has no weight.
double rejection_norm(int rows);

/// Takes out of rows over the field what the places explain that its poses touch and nobody fits.
void leave_out_places(const ResidualField& field, RowMatrix& rows);

/// The field of poses that no fit is to learn from: contacts are where these poses themselves have them, and what
/// moving them there does is left out of residual and columns. `ids`: the free parameters that it has columns for.
ResidualField unseen_field(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot,
                           const std::vector<ParameterId>& ids, const RowScales& scales, const NoiseModel& noise = {});

/// How many poses of a field are not repeats of others.
std::size_t distinct_poses(const ResidualField& field);

/// The field of `robot` over `poses`, its free parameters those of `space` (whose reference is `robot`). Poses that
/// measured nothing in use are left out. `robust`: far poses are scaled down. Of `noise` the joints' scatter counts.
ResidualField residual_field(const DataSet& data, std::span<const std::size_t> poses, const ParameterSpace& space,
                             const RowScales& scales, bool robust, const NoiseModel& noise = {});

/// An effect and the states at which its features are wanted; both have to outlive it.
struct SampledEffect {
  const Effect& effect;
  const std::vector<ArmState>& states;
};

/// A column is a sum of features (one number a pose) times motions of the field (one row a measured number). Features
/// depend on the nominal arm alone: they serve every field over the same poses.
class EffectColumns {
 public:
  /// Columns of one effect after another, at one state a pose; equally many for every effect.
  void append(const std::vector<SampledEffect>& effects, const Robot& robot);
  /// The same of effects at the same states.
  void append(const std::vector<Effect>& effects, const Robot& robot, const std::vector<ArmState>& states);
  /// Makes the appended columns ready for use.
  void pack();

  Eigen::Index size() const { return columns_; }
  const std::vector<ColumnSpan>& spans() const { return spans_; }
  /// Of which the columns are made; `motion` is a column of ResidualField::motions.
  const std::vector<FeatureBlock>& blocks() const { return blocks_; }

  /// X^T Y (size() x Y's columns) of all columns X over the field's rows and a matrix over the same rows, done by
  /// `do_work`.
  Eigen::MatrixXd transposed_times(const ResidualField& field, const RowMatrix& rows,
                                   const DoWork& do_work = demecal::do_work) const;
  /// X^T X of every effect's own columns X over the field's rows.
  std::vector<Eigen::MatrixXd> squares(const ResidualField& field) const;
  /// The columns of one effect over the field's rows.
  RowMatrix dense(const ResidualField& field, std::size_t effect) const;
  /// Those of all effects: size() of them.
  RowMatrix dense(const ResidualField& field) const;

 private:
  /// The block that has all columns of an effect, where there is one: whose motion is one alone.
  const FeatureBlock* only_block(ColumnSpan span) const;

  std::vector<FeatureBlock> blocks_;
  std::map<Eigen::Index, std::map<Eigen::Index, Eigen::VectorXd>> loose_;  ///< motion -> column -> features
  std::vector<ColumnSpan> spans_;
  Eigen::Index columns_ = 0;
};

}  // namespace demecal::inline residuals
