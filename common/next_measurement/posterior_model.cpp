#include "next_measurement/posterior_model.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "effects/arm_state.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/parameter_space.hpp"
#include "prediction/corrected_robot.hpp"
#include "products/tall_products.hpp"
#include "residuals/residual_field.hpp"
#include "residuals/smooth_corrections.hpp"

namespace demecal::inline next_measurement {
namespace {

/// Squared noncentrality for a one-sided test at 5 % with power 0.9: normal quantiles of 0.95 and 0.9.
constexpr double kTold = (1.6449 + 1.2816) * (1.6449 + 1.2816);
/// Of a column's square: what is believed of it at least, so that hardly visible directions imitate nothing.
constexpr double kBelieved = 1e-5;

constexpr std::size_t kMostPosesKnown = 2000;  ///< more tell the same, weighed
constexpr double kNothing = 1e-12;             ///< of a correlation matrix's eigenvalues: rounding

/// At most kMostPosesKnown of the fitted poses, in their order, and no validation ones.
DiagnosisProblem sample(const DiagnosisProblem& problem, RandomStream random) {
  DiagnosisProblem some{problem.data, problem.declared, problem.fitted, {}};
  for (std::size_t i = 0; i < kMostPosesKnown && some.fitted.size() > kMostPosesKnown; ++i) {
    std::swap(some.fitted[i], some.fitted[i + random.index(some.fitted.size() - i)]);
  }
  if (some.fitted.size() > kMostPosesKnown) some.fitted.resize(kMostPosesKnown);
  std::ranges::sort(some.fitted);
  return some;
}

/// The model with laws that know no ranges.
DiagnosedModel everywhere(DiagnosedModel model) {
  for (Effect& effect : model.robot.effects) effect.ranges.clear();
  return model;
}

struct Spectrum {
  Eigen::VectorXd scale;
  Eigen::MatrixXd vectors;
  Eigen::VectorXd values;  ///< of the correlations; those that are rounding are zero
};

Spectrum spectrum(const Eigen::MatrixXd& covariance) {
  Eigen::VectorXd scale = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  if (scale.size() == 0) return {scale, covariance, scale};  // of a model without numbers
  Eigen::VectorXd inverse = scale;
  for (double& value : inverse) value = value > 0 ? 1 / value : 0.0;
  const auto eigen = eigen_system(inverse.asDiagonal() * covariance * inverse.asDiagonal());
  Eigen::VectorXd values = eigen.values;
  for (double& value : values) value = value > kNothing ? value : 0.0;
  return {std::move(scale), eigen.vectors, std::move(values)};
}

Eigen::MatrixXd scaled_pseudo_inverse(const Eigen::MatrixXd& covariance) {
  const Spectrum decomposed = spectrum(covariance);
  Eigen::VectorXd inverse = decomposed.values, scale = decomposed.scale;
  for (double& value : inverse) value = value > 0 ? 1 / value : 0.0;
  for (double& value : scale) value = value > 0 ? 1 / value : 0.0;
  return scale.asDiagonal() * decomposed.vectors * inverse.asDiagonal() * decomposed.vectors.transpose() *
         scale.asDiagonal();
}

/// The covariance of `kept` when the numbers `out` are held.
Eigen::MatrixXd conditional_covariance(const Eigen::MatrixXd& covariance, const std::vector<Eigen::Index>& kept,
                                       const std::vector<Eigen::Index>& out) {
  const Eigen::MatrixXd whole = covariance(kept, kept);
  if (out.empty()) return whole;
  const Eigen::MatrixXd across = covariance(kept, out);
  return whole - across * scaled_pseudo_inverse(covariance(out, out)) * across.transpose();
}

/// F (n x r) with F F^T the covariance.
Eigen::MatrixXd root(const Eigen::MatrixXd& covariance) {
  const Spectrum decomposed = spectrum(covariance);
  const Eigen::Index n = decomposed.values.size(), rank = (decomposed.values.array() > 0).count();
  const Eigen::MatrixXd whole =
      decomposed.scale.asDiagonal() * decomposed.vectors * decomposed.values.cwiseSqrt().asDiagonal();
  return whole.rightCols(std::min(n, rank));  // eigenvalues ascend
}

}  // namespace

AskedProducts asked_products(const RowMatrix& model, const RowMatrix& asked, double weight) {
  return {weight * transposed_product(model, asked), weight * square_product(asked)};
}

Separation::Separation(const AskedProducts& present, const AskedProducts& per_pose,
                       const Eigen::MatrixXd& model_per_pose, const Eigen::VectorXd& precision) {
  present_ = present.cross;
  per_pose_ = per_pose.cross;
  asked_ = present.asked;
  asked_per_pose_ = per_pose.asked;
  asked_.diagonal() += precision;
  if (model_per_pose.size() == 0) return;
  const auto eigen = eigen_system(model_per_pose);
  spread_ = eigen.values.cwiseMax(0.0);
  present_ = eigen.vectors.transpose() * present_;
  per_pose_ = eigen.vectors.transpose() * per_pose_;
}

double Separation::information(double poses, const std::vector<Eigen::Index>& others, Eigen::Index signal) const {
  std::vector<Eigen::Index> all = others;
  all.push_back(signal);
  const Eigen::MatrixXd along = (present_ + poses * per_pose_)(Eigen::all, all);
  const Eigen::VectorXd known = (1.0 + poses * spread_.array()).inverse();
  Eigen::MatrixXd left = (asked_ + poses * asked_per_pose_)(all, all);
  left -= along.transpose() * known.asDiagonal() * along;
  const auto count = static_cast<Eigen::Index>(others.size());
  if (count == 0) return left(0, 0);
  Eigen::MatrixXd rivals = left.topLeftCorner(count, count);
  Eigen::VectorXd scale(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index column = others[static_cast<std::size_t>(i)];
    const double square = asked_(column, column) + asked_per_pose_(column, column);
    rivals(i, i) += kBelieved * square;
    scale[i] = square > 0 ? 1 / std::sqrt(square) : 0.0;
  }
  const Eigen::VectorXd moment = scale.cwiseProduct(left.col(count).head(count));
  const Eigen::MatrixXd scaled = scale.asDiagonal() * rivals * scale.asDiagonal();
  return left(count, count) - moment.dot(least_norm_solution(scaled, moment));
}

std::optional<int> Separation::poses_needed(const std::vector<Eigen::Index>& others, Eigen::Index signal,
                                            int most) const {
  const double enough = information(0.0, others, signal) + kTold;
  const auto tells = [&](int poses) { return information(poses, others, signal) >= enough; };
  if (!tells(most)) return std::nullopt;
  int few = 0, many = 1;
  while (many < most && !tells(many)) {
    few = many;
    many = std::min(2 * many, most);
  }
  while (many - few > 1) {
    const int middle = few + (many - few) / 2;
    (tells(middle) ? many : few) = middle;
  }
  return many;
}

PosteriorModel::PosteriorModel(const DiagnosisProblem& problem, DiagnosedModel model, const std::vector<Effect>& asked,
                               RandomStream random)
    : problem_(problem),
      model_(everywhere(std::move(model))),
      linearization_(linearize(sample(problem, std::move(random)), model_)),
      weight_(static_cast<double>(problem.fitted.size()) /
              static_cast<double>(std::min(problem.fitted.size(), kMostPosesKnown))) {
  std::vector<Eigen::Index> out;
  for (Eigen::Index i = 0; i < linearization_.covariance.rows(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const bool coefficient = at < linearization_.ids.size() && linearization_.ids[at].kind == ParameterId::Kind::effect;
    const bool apart =
        coefficient && std::ranges::any_of(asked, [&](const Effect& effect) {
          return effect.same_law_as(model_.robot.effects[static_cast<std::size_t>(linearization_.ids[at].index)]);
        });
    (apart ? out : kept_).push_back(i);
  }
  to_units_ = root(conditional_covariance(linearization_.covariance, kept_, out)) / std::sqrt(weight_);
}

DataSet PosteriorModel::predicted(std::vector<MeasuredPose> stops) const {
  DataSet data;
  data.robot = problem_.data.robot;
  data.frame = problem_.data.frame;
  data.tools_m = problem_.data.tools_m;
  data.anchors_m = problem_.data.anchors_m;
  data.poses = std::move(stops);
  for (MeasuredPose& pose : data.poses) {
    const Eigen::Isometry3d tool = model_.robot.predict(Stop(pose), pose.target);
    if (pose.position_m) pose.position_m = tool.translation();
    if (pose.orientation) pose.orientation = Eigen::Quaterniond(tool.linear());
    for (std::size_t i = 0; i < pose.distances_m.size(); ++i) {
      pose.distances_m[i] = (tool.translation() - data.anchors_m[i]).norm();
    }
  }
  return data;
}

ResidualField PosteriorModel::field(const DataSet& predicted) const {
  std::vector<std::size_t> poses(predicted.poses.size());
  std::iota(poses.begin(), poses.end(), 0);
  return residual_field(predicted, poses, ParameterSpace(model_.robot, linearization_.ids), model_.scales, false,
                        model_.noise);
}

RowMatrix PosteriorModel::model_columns(const ResidualField& field) const {
  RowMatrix all(field.rows(), field.declared.cols() + model_.smooth.coefficients.size());
  all << field.declared, model_.smooth.columns(field);
  const RowMatrix kept = all(Eigen::all, kept_);
  return product(kept, to_units_);
}

RowMatrix PosteriorModel::effect_columns(const std::vector<Effect>& effects, const ResidualField& field) const {
  std::vector<Effect> everywhere = effects;
  for (Effect& effect : everywhere) effect.ranges.clear();
  EffectColumns columns;
  columns.append(everywhere, problem_.data.robot, field.states);
  columns.pack();
  return columns.dense(field);
}

}  // namespace demecal::inline next_measurement
