#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "baselines/baseline.hpp"
#include "baselines/regression.hpp"
#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "fitting/fit.hpp"
#include "kinematics/chain.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/observation.hpp"
#include "parameters/parameter_space.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline baselines {
namespace {

constexpr int kFoldsOfLinks = 5;
constexpr int kMostRelinearizations = 6;
constexpr double kSmallStep = 1e-9;  // of the rows' norm: nothing is left to gain

/// The model: every parameter of base and tool is a coefficient of its own, every function's coefficient adds to a link
/// parameter as the joints have it.
class VaryingModel {
 public:
  VaryingModel(const RegisteredArm& arm, const std::vector<LinkFunction>& functions)
      : functions_(functions), space_(arm.robot, ids_of(arm, functions, fixed_, columns_)) {}

  Eigen::Index size() const { return fixed_ + static_cast<Eigen::Index>(functions_.size()); }
  /// 1 for what a ridge holds: the functions' coefficients.
  Eigen::VectorXd weight() const {
    Eigen::VectorXd weight = Eigen::VectorXd::Ones(size());
    weight.head(fixed_).setZero();
    return weight;
  }
  const ParameterSpace& space() const { return space_; }

  /// The derivative by the coefficients at these joints, from that by the parameters of the space.
  Eigen::MatrixXd by_coefficients(const Eigen::MatrixXd& by_parameters, const JointVector& q) const {
    Eigen::MatrixXd result(by_parameters.rows(), size());
    result.leftCols(fixed_) = by_parameters.leftCols(fixed_);
    for (std::size_t k = 0; k < functions_.size(); ++k) {
      result.col(fixed_ + static_cast<Eigen::Index>(k)) = functions_[k].value(q) * by_parameters.col(columns_[k]);
    }
    return result;
  }
  Eigen::VectorXd change_at(const JointVector& q, const Eigen::VectorXd& coefficients) const {
    Eigen::VectorXd change = Eigen::VectorXd::Zero(space_.size());
    change.head(fixed_) = coefficients.head(fixed_);
    for (std::size_t k = 0; k < functions_.size(); ++k) {
      change[columns_[k]] += functions_[k].value(q) * coefficients[fixed_ + static_cast<Eigen::Index>(k)];
    }
    return change;
  }

 private:
  /// Base and tool, then each link parameter that a function adds to, once; and where each function's stands.
  static std::vector<ParameterId> ids_of(const RegisteredArm& arm, const std::vector<LinkFunction>& functions,
                                         Eigen::Index& fixed, std::vector<Eigen::Index>& columns) {
    std::vector<ParameterId> ids = free_parameters(arm.data, arm.base_and_tool);
    fixed = static_cast<Eigen::Index>(ids.size());
    for (const LinkFunction& function : functions) {
      const ParameterId id{ParameterId::Kind::link, function.joint, function.parameter, {}};
      const auto known = std::ranges::find(ids, id);
      columns.push_back(known - ids.begin());
      if (known == ids.end()) ids.push_back(id);
    }
    return ids;
  }

  std::vector<LinkFunction> functions_;
  Eigen::Index fixed_ = 0;
  std::vector<Eigen::Index> columns_;
  ParameterSpace space_;
};

RowScales registered_scales(const RegisteredArm& arm, const std::vector<Observation>& observations) {
  RowScales scales = root_mean_squares(arm.data, arm.robot, observations);
  if (!arm.base_and_tool.tool && scales[kOrientation] > kMountedOtherwise_rad) scales[kOrientation] = 0.0;
  return scales;
}

/// The rows of all observations about the coefficients, summed by the fold that leaves them out.
std::vector<RidgeSums> sums_at(const RegisteredArm& arm, const VaryingModel& model, const RowScales& scales,
                               const std::vector<Observation>& observations, const std::vector<int>& folds,
                               const Eigen::VectorXd& coefficients) {
  std::vector<BufferedRidgeSums> sums(kFoldsOfLinks, BufferedRidgeSums(model.size(), 1));
  ScaledRows rows;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const JointVector& q = observations[i].corrected;
    const ModelPoint point = model.space().at(model.change_at(q, coefficients));
    scaled_rows(arm.data, model.space(), point, observations[i], scales, rows);
    sums[static_cast<std::size_t>(folds[i])].add(-model.by_coefficients(rows.jacobian, q), rows.residual);
  }
  std::vector<RidgeSums> by_fold;
  for (BufferedRidgeSums& fold : sums) by_fold.push_back(fold.sums());
  return by_fold;
}

}  // namespace

VaryingFit fit_varying_links(const RegisteredArm& arm, const std::vector<LinkFunction>& functions) {
  const auto model = std::make_shared<const VaryingModel>(arm, functions);
  const std::vector<Observation> observations = observe(arm.data, arm.poses, arm.robot);
  const std::vector<int> folds = assign_folds(arm.data, arm.poses, kFoldsOfLinks);
  const RowScales scales = registered_scales(arm, observations);
  Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(model->size());
  std::vector<RidgeSums> sums = sums_at(arm, *model, scales, observations, folds, coefficients);
  const RidgeChoice choice = choose_ridge(sums, model->weight());
  for (int step = 0; step < kMostRelinearizations; ++step) {
    const RidgeSums all = sum_of_parts(sums);
    const Eigen::VectorXd change = ridge_solution(all, model->weight(), choice.ridge, coefficients);
    coefficients += change;
    if (std::abs(change.dot(all.square * change)) < kSmallStep * kSmallStep * static_cast<double>(arm.poses.size())) {
      break;
    }
    if (step + 1 < kMostRelinearizations) sums = sums_at(arm, *model, scales, observations, folds, coefficients);
  }
  VaryingFit result{{}, choice.cost, choice.ridge};
  result.fit.parameters = static_cast<int>(model->size());
  result.fit.predict = [model, coefficients](const MeasuredPose& pose) {
    return model->space().at(model->change_at(pose.joints, coefficients)).robot.predict(Stop(pose), pose.target);
  };
  return result;
}

}  // namespace demecal::inline baselines
