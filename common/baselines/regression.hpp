// Regression on functions of the joints, under a ridge that cross-validation within the calibration poses chooses: the
// shape of most models of the literature.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "baselines/baseline.hpp"
#include "data/data_set.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline baselines {

/// For each of the poses, the fold (from 0) in which it is left out: repeats of a pose together, the folds in turn.
std::vector<int> assign_folds(const DataSet& data, std::span<const std::size_t> poses, int folds);

/// Sums over rows of a linear problem residual = jacobian * change: J^T J, J^T r, r^T r.
struct RidgeSums {
  Eigen::MatrixXd square;
  Eigen::MatrixXd linear;  ///< a column for each column of residuals
  double residual = 0.0;

  RidgeSums(Eigen::Index parameters, Eigen::Index columns);
  void add(const Eigen::Ref<const Eigen::MatrixXd>& jacobian, const Eigen::Ref<const Eigen::MatrixXd>& residuals);
  void add(const RidgeSums& other);
  RidgeSums without(const RidgeSums& part) const;
  /// The sum of squares that `change` leaves of these rows.
  double residual_squares(const Eigen::MatrixXd& change) const;
};

/// Sums of rows that come a few at a time, taken in many at once.
class BufferedRidgeSums {
 public:
  BufferedRidgeSums(Eigen::Index parameters, Eigen::Index columns);
  void add(const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& residuals);
  /// The sums of all rows so far.
  const RidgeSums& sums();

 private:
  RidgeSums sums_;
  Eigen::MatrixXd jacobian_, residuals_;
  Eigen::Index buffered_ = 0;
};

/// The change with the least sum of squares plus ridge * weight_k * (J^T J)_kk * (offset_k + change_k)^2, so that the
/// units of a parameter do not matter; parameters without any effect stay as they are. `offset` is parameters x
/// columns.
Eigen::MatrixXd ridge_solution(const RidgeSums& sums, const Eigen::VectorXd& weight, double ridge,
                               const Eigen::MatrixXd& offset);

/// Ridges that cross-validation chooses from, ascending.
std::span<const double> ridges();

/// The sums of all parts.
RidgeSums sum_of_parts(const std::vector<RidgeSums>& parts);

/// How well a ridge does on poses left out.
struct RidgeChoice {
  double ridge = 0.0;
  double cost = 0.0;  ///< sum of squares over all folds' left-out rows
};
RidgeChoice choose_ridge(const std::vector<RidgeSums>& by_fold, const Eigen::VectorXd& weight);

class ScaledJoints {
 public:
  /// By the joints of these poses; a joint that did not move is always 0.
  ScaledJoints(const DataSet& data, std::span<const std::size_t> poses) {
    lower_ = upper_ = data.poses[poses.front()].joints;
    for (const std::size_t pose : poses) {
      lower_ = lower_.cwiseMin(data.poses[pose].joints);
      upper_ = upper_.cwiseMax(data.poses[pose].joints);
    }
  }

  Eigen::VectorXd operator()(const JointVector& q) const {
    Eigen::VectorXd scaled = Eigen::VectorXd::Zero(q.size());
    for (Eigen::Index i = 0; i < q.size(); ++i) scaled[i] = one(q, static_cast<int>(i));
    return scaled;
  }
  double one(const JointVector& q, int joint) const {
    const double half = 0.5 * (upper_[joint] - lower_[joint]);
    return half > 0.0 ? (q[joint] - 0.5 * (upper_[joint] + lower_[joint])) / half : 0.0;
  }

 private:
  JointVector lower_, upper_;
};

/// One function of the joints, whose coefficient adds to a link parameter (rad or m).
struct LinkFunction {
  int joint = 0;
  LinkParameter parameter = LinkParameter::theta;
  std::function<double(const JointVector&)> value;
};

/// Base, tool where declared, and the coefficients of the functions, fitted together from the registered arm by
/// Gauss-Newton steps. The coefficients are held near zero by a ridge that cross-validation chooses.
struct VaryingFit {
  BaselineFit fit;
  double cost = 0.0;   ///< of the cross-validation
  double ridge = 0.0;  ///< chosen
};
VaryingFit fit_varying_links(const RegisteredArm& arm, const std::vector<LinkFunction>& functions);

/// Gaussians about some of the calibration poses, spread as far apart as can be, in joints scaled to what was measured;
/// their number, width and ridge by cross-validation. Orientations are those of the registered arm.
BaselineFit fit_radial_basis(const RegisteredArm& arm);

}  // namespace demecal::inline baselines
