#include "effect_sets/fitted_set.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "primitives/elementary.hpp"

namespace demecal::inline effect_sets {

FittedSet::FittedSet(const ExplanationProblem& problem, std::vector<std::size_t> effects)
    : problem_(&problem), effects_(std::move(effects)), squares_(problem.squares) {
  for (const std::size_t effect : effects_) {
    price_ += price_nats(effect);
    const ColumnSpan& span = problem.spans[effect];
    for (Eigen::Index k = 0; k < span.count; ++k) columns_.push_back(span.first + k);
  }
  if (columns_.empty()) return;
  inverse_ = Cholesky(problem.gram(columns_, columns_)).inverse();
  const Eigen::VectorXd moment = problem.moment(columns_);
  coefficients_ = inverse_ * moment;
  squares_ -= moment.dot(coefficients_);
}

bool FittedSet::holds(std::size_t effect) const {
  return std::ranges::count(effects_, effect) > 0;
}

std::vector<std::size_t> FittedSet::causes() const {
  std::set<std::size_t> different;
  for (const std::size_t effect : effects_) different.insert(problem_->cause[effect]);
  return {different.begin(), different.end()};
}

double FittedSet::price_nats(std::size_t effect) const {
  return problem_->naming_costs_nats[effect] +
         0.5 * static_cast<double>(problem_->spans[effect].count) * protected_logarithm(problem_->poses);
}

/// Of the residual's description, where so much is left of its squares: the same bits on every machine.
double FittedSet::saved_nats(double share) const {
  constexpr double kLeast = 1e-30;  // below it the fit is exact but for rounding
  return 0.5 * problem_->rows * protected_logarithm(std::max(share, kLeast));
}

Eigen::VectorXd FittedSet::moments_left() const {
  Eigen::VectorXd left = problem_->moment;
  for (std::size_t i = 0; i < columns_.size(); ++i)
    left -= coefficients_[static_cast<Eigen::Index>(i)] * problem_->gram.col(columns_[i]);
  return left;
}

std::pair<Eigen::Index, Eigen::Index> FittedSet::span_at(std::size_t place) const {
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < place; ++i) first += problem_->spans[effects_[i]].count;
  return {first, problem_->spans[effects_[place]].count};
}

double FittedSet::rise_without(std::size_t place) const {
  const auto [first, count] = span_at(place);
  if (count == 0) return 0.0;
  const Eigen::VectorXd own = coefficients_.segment(first, count);
  const Eigen::MatrixXd inverse = inverse_.block(first, first, count, count);
  return own.dot(Cholesky(inverse).solve(own));
}

double FittedSet::gain_without(std::size_t place) const {
  return price_nats(effects_[place]) - saved_nats(1.0 + rise_without(place) / squares_);
}

std::vector<Alike> FittedSet::alike(std::size_t place) const {
  const std::size_t present = effects_[place];
  const ColumnSpan own = problem_->spans[present];
  const Eigen::VectorXd coefficients = coefficients_.segment(span_at(place).first, own.count);
  FittedSet others = *this;
  others.remove(place);
  // What the present one explains beyond the others, and every column beyond them.
  const Eigen::MatrixXd beside = problem_->gram(others.columns_, Eigen::all);
  const Eigen::MatrixXd explained = others.inverse_ * beside;
  const Eigen::VectorXd share = (problem_->gram.middleCols(own.first, own.count) -
                                 explained.transpose() * beside.middleCols(own.first, own.count)) *
                                coefficients;
  const double square = coefficients.dot(share.segment(own.first, own.count));
  const Eigen::VectorXd left = others.moments_left();
  std::vector<Alike> all;
  for (std::size_t i = 0; i < problem_->spans.size(); ++i) {
    const ColumnSpan span = problem_->spans[i];
    if (span.count == 0 || holds(i)) continue;
    const Eigen::MatrixXd fresh =
        problem_->gram.block(span.first, span.first, span.count, span.count) -
        beside.middleCols(span.first, span.count).transpose() * explained.middleCols(span.first, span.count);
    const Cholesky solver(fresh);
    const Eigen::VectorXd moment = left.segment(span.first, span.count), along = share.segment(span.first, span.count);
    const double squares = others.squares_ - moment.dot(solver.solve(moment));
    const double nats = saved_nats(squares / squares_) + price_nats(i) - price_nats(present);
    const double cosine = std::sqrt(std::clamp(along.dot(solver.solve(along)) / square, 0.0, 1.0));
    all.push_back({i, cosine, nats});
  }
  return all;
}

void FittedSet::add(std::size_t effect) {
  const ColumnSpan& span = problem_->spans[effect];
  effects_.push_back(effect);
  price_ += price_nats(effect);
  if (span.count == 0) return;
  const auto held = static_cast<Eigen::Index>(columns_.size());
  Eigen::MatrixXd beside(held, span.count);
  for (Eigen::Index i = 0; i < held; ++i)
    beside.row(i) = problem_->gram.block(columns_[static_cast<std::size_t>(i)], span.first, 1, span.count);
  const Eigen::MatrixXd explained = inverse_ * beside;
  const Eigen::MatrixXd fresh =
      problem_->gram.block(span.first, span.first, span.count, span.count) - beside.transpose() * explained;
  const Eigen::MatrixXd fresh_inverse = Cholesky(fresh).inverse();
  const Eigen::VectorXd left = problem_->moment.segment(span.first, span.count) - beside.transpose() * coefficients_;
  const Eigen::VectorXd own = fresh_inverse * left;
  const Eigen::MatrixXd turned = explained * fresh_inverse;
  inverse_ += turned * explained.transpose();
  inverse_.conservativeResize(held + span.count, held + span.count);
  inverse_.topRightCorner(held, span.count) = -turned;
  inverse_.bottomLeftCorner(span.count, held) = -turned.transpose();
  inverse_.bottomRightCorner(span.count, span.count) = fresh_inverse;
  coefficients_ -= explained * own;
  coefficients_.conservativeResize(held + span.count);
  coefficients_.tail(span.count) = own;
  squares_ -= left.dot(own);
  for (Eigen::Index k = 0; k < span.count; ++k) columns_.push_back(span.first + k);
}

void FittedSet::remove(std::size_t place) {
  const auto [first, count] = span_at(place);
  price_ -= price_nats(effects_[place]);
  effects_.erase(effects_.begin() + static_cast<std::ptrdiff_t>(place));
  if (count == 0) return;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < inverse_.rows(); ++i)
    if (i < first || i >= first + count) kept.push_back(i);
  const Cholesky own(inverse_.block(first, first, count, count));
  const Eigen::VectorXd weighted = own.solve(coefficients_.segment(first, count));
  squares_ += coefficients_.segment(first, count).dot(weighted);
  columns_.erase(columns_.begin() + first, columns_.begin() + first + count);
  if (kept.empty()) {
    coefficients_.resize(0);
    inverse_.resize(0, 0);
    return;
  }
  const Eigen::MatrixXd beside = inverse_.middleCols(first, count)(kept, Eigen::all);
  coefficients_ = (coefficients_(kept) - beside * weighted).eval();
  inverse_ = (inverse_(kept, kept) - beside * own.solve(beside.transpose())).eval();
}

void FittedSet::remove_cause(std::size_t cause) {
  for (std::size_t place = effects_.size(); place-- > 0;)
    if (problem_->cause[effects_[place]] == cause) remove(place);
}

}  // namespace demecal::inline effect_sets
