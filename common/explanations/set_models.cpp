#include "explanations/set_models.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "data/data_set.hpp"
#include "decompositions/decompositions.hpp"
#include "explanations/causes.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/parameter_space.hpp"
#include "prediction/corrected_robot.hpp"
#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"
#include "residuals/smooth_corrections.hpp"

namespace demecal::inline explanations {
namespace {

/// Which effects of the robot are among those.
std::vector<bool> among(const std::vector<PricedEffect>& effects, const CorrectedRobot& robot) {
  std::vector<bool> flags;
  for (const Effect& one : robot.effects)
    flags.push_back(
        std::ranges::any_of(effects, [&](const PricedEffect& other) { return other.effect.same_law_as(one); }));
  return flags;
}

/// Numbers the causes in the order in which they first come.
void number_causes(const std::vector<Effect>& effects, ExplanationProblem& problem) {
  std::vector<ErrorCause> causes;
  for (const Effect& effect : effects) {
    const ErrorCause own = cause_at(effect.kind, effect.joint);
    const auto known = std::ranges::find_if(causes, [&](const ErrorCause& one) { return one.is_same_as(own); });
    problem.cause.push_back(static_cast<std::size_t>(known - causes.begin()));
    if (known != causes.end()) continue;
    causes.push_back(own);
    problem.cause_names.push_back(to_string(own));
  }
}

}  // namespace

SetModels::SetModels(const DiagnosisProblem& problem, const DiagnosedModel& model,
                     const std::vector<PricedEffect>& effects)
    : bare_(model),
      left_out_(among(effects, model.robot)),
      linearization_(linearize_without(problem, model, left_out_)) {
  bare_.robot = with_contacts_of(std::move(bare_.robot), linearization_.ids, problem.data);
  std::vector<SampledEffect> sampled;
  for (const PricedEffect& one : effects) {
    const auto held =
        std::ranges::find_if(model.robot.effects, [&](const Effect& other) { return other.same_law_as(one.effect); });
    if (held != model.robot.effects.end()) held_.push_back(effects_.size());
    effects_.push_back(held == model.robot.effects.end() ? one.effect : *held);
    problem_.naming_costs_nats.push_back(one.naming_cost_nats);
    sampled.push_back({one.effect, linearization_.fitted.states});
  }
  EffectColumns columns;
  columns.append(sampled, problem.data.robot);
  columns.pack();
  number_causes(effects_, problem_);
  problem_.squares = linearization_.projection.squares();
  problem_.rows = static_cast<double>(linearization_.fitted.rows());
  problem_.freedom = linearization_.projection.freedom();
  problem_.poses = static_cast<double>(distinct_poses(linearization_.fitted));
  std::vector<double> precision;
  for (const std::vector<double>& own : precisions_of(effects_, problem.data.robot, linearization_.fitted.states))
    std::ranges::copy(own, std::back_inserter(precision));
  project(columns.dense(linearization_.fitted), columns.spans(),
          Eigen::VectorXd::Map(precision.data(), std::ssize(precision)));
}

/// Makes each effect's own columns orthonormal beyond the declared model; directions that it explains are dropped, and
/// coefficients believed to be small as the model's are.
void SetModels::project(const RowMatrix& columns, const std::vector<ColumnSpan>& spans,
                        const Eigen::VectorXd& precision) {
  if (columns.cols() == 0) return;
  const Projection& projection = linearization_.projection;
  const Eigen::MatrixXd along = transposed_product(columns, projection.basis());
  Eigen::MatrixXd gram = square_product(columns) - square_product(along.transpose());
  Eigen::Index found = 0;
  for (const ColumnSpan& span : spans) {
    const Eigen::MatrixXd own = gram.block(span.first, span.first, span.count, span.count);
    Eigen::VectorXd scale = columns.middleCols(span.first, span.count).colwise().norm().transpose();
    for (double& value : scale) value = value > kNoColumn ? 1.0 / value : 0.0;
    const auto eigen = eigen_system(scale.asDiagonal() * own * scale.asDiagonal());
    Eigen::MatrixXd turned(span.count, span.count);
    Eigen::Index rank = 0;
    for (Eigen::Index i = 0; i < span.count; ++i) {
      const double share = eigen.values[i];
      if (share >= kNewShare) turned.col(rank++) = scale.cwiseProduct(eigen.vectors.col(i)) / std::sqrt(share);
    }
    to_coefficients_.emplace_back(turned.leftCols(rank));
    problem_.spans.push_back({found, rank});
    found += rank;
  }
  gram.diagonal() += precision.cwiseAbs2();
  Eigen::MatrixXd half(columns.cols(), found);
  for (std::size_t i = 0; i < spans.size(); ++i)
    half.middleCols(problem_.spans[i].first, problem_.spans[i].count) =
        gram.middleCols(spans[i].first, spans[i].count) * to_coefficients_[i];
  problem_.gram.resize(found, found);
  along_.resize(found, along.cols());
  problem_.moment.resize(found);
  const Eigen::VectorXd moment = columns.transpose() * projection.residual();
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const auto [first, count] = problem_.spans[i];
    const Eigen::MatrixXd turn = to_coefficients_[i].transpose();
    problem_.gram.middleRows(first, count) = turn * half.middleRows(spans[i].first, spans[i].count);
    along_.middleRows(first, count) = turn * along.middleRows(spans[i].first, spans[i].count);
    problem_.moment.segment(first, count) = turn * moment.segment(spans[i].first, spans[i].count);
  }
  problem_.gram.diagonal().array() += kNewShare;
}

DiagnosedModel SetModels::with(const std::vector<std::size_t>& set) const {
  const FittedSet fitted(problem_, set);
  Eigen::VectorXd changes = linearization_.changes;
  DiagnosedModel model = bare_;
  std::vector<Effect> added;
  Eigen::Index first = 0;
  for (const std::size_t place : set) {
    const ColumnSpan span = problem_.spans[place];
    const Eigen::VectorXd own = fitted.coefficients().segment(first, span.count);
    first += span.count;
    const Eigen::VectorXd along = along_.middleRows(span.first, span.count).transpose() * own;
    changes -= linearization_.projection.changes_along(along).head(changes.size());
    const Eigen::VectorXd values = to_coefficients_[place] * own;
    added.push_back(effects_[place]);
    added.back().values.assign(values.begin(), values.end());
  }
  const ParameterSpace space(model.robot, linearization_.ids);
  model.robot = space.at(changes.head(space.size())).robot;
  model.smooth.coefficients += changes.tail(model.smooth.coefficients.size());
  model.robot.corrections = model.smooth.corrections();
  std::vector<Effect> effects;
  for (std::size_t i = 0; i < model.robot.effects.size(); ++i)
    if (!left_out_[i]) effects.push_back(std::move(model.robot.effects[i]));
  std::ranges::move(added, std::back_inserter(effects));
  model.robot.effects = std::move(effects);
  return model;
}

}  // namespace demecal::inline explanations
