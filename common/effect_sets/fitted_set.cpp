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
  return moments_left({{0, problem_->moment.size()}});
}

Eigen::VectorXd FittedSet::moments_left(const std::vector<ColumnSpan>& spans) const {
  Eigen::VectorXd left = problem_->moment;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const double coefficient = coefficients_[static_cast<Eigen::Index>(i)];
    for (const ColumnSpan& span : spans)
      left.segment(span.first, span.count) -=
          coefficient * problem_->gram.col(columns_[i]).segment(span.first, span.count);
  }
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
  if (count == 1) return coefficients_[first] * coefficients_[first] / inverse_(first, first);
  const Eigen::VectorXd own = coefficients_.segment(first, count);
  const Eigen::MatrixXd inverse = inverse_.block(first, first, count, count);
  return own.dot(Cholesky(inverse).solve(own));
}

double FittedSet::gain_without(std::size_t place) const {
  return price_nats(effects_[place]) - saved_nats(1.0 + rise_without(place) / squares_);
}

std::optional<std::size_t> FittedSet::least_worth() const {
  std::optional<std::size_t> least;
  double most = 0.0;
  for (std::size_t place = 0; place < effects_.size(); ++place) {
    const double gain = gain_without(place);
    if (gain <= most) continue;
    most = gain;
    least = place;
  }
  return least;
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

FittedSet::Beside FittedSet::beside(const ColumnSpan& span) const {
  const auto held = static_cast<Eigen::Index>(columns_.size());
  Beside beside{Eigen::MatrixXd(held, span.count), Eigen::MatrixXd(span.count, span.count), {}, 0.0};
  if (span.count == 0) return beside;
  Eigen::MatrixXd products(held, span.count);
  for (Eigen::Index k = 0; k < span.count; ++k) {
    const auto column = problem_->gram.col(span.first + k);
    for (Eigen::Index i = 0; i < held; ++i) products(i, k) = column[columns_[static_cast<std::size_t>(i)]];
    beside.explained.col(k).noalias() = inverse_ * products.col(k);
  }
  Eigen::VectorXd left = problem_->moment.segment(span.first, span.count);
  Eigen::MatrixXd fresh = problem_->gram.block(span.first, span.first, span.count, span.count);
  for (Eigen::Index k = 0; k < span.count; ++k) {
    left[k] -= products.col(k).dot(coefficients_);
    for (Eigen::Index l = 0; l < span.count; ++l) fresh(l, k) -= products.col(l).dot(beside.explained.col(k));
  }
  beside.fresh_inverse = Cholesky(fresh).inverse();
  beside.coefficients = beside.fresh_inverse * left;
  beside.drop = left.dot(beside.coefficients);
  return beside;
}

void FittedSet::add(std::size_t effect) {
  add(effect, beside(problem_->spans[effect]));
}

bool FittedSet::add_if_shorter(std::size_t effect) {
  const Beside own = beside(problem_->spans[effect]);
  const double nats = saved_nats((squares_ - own.drop) / problem_->squares) + (price_ + price_nats(effect));
  if (nats >= description_nats()) return false;
  add(effect, own);
  return true;
}

void FittedSet::add(std::size_t effect, const Beside& beside) {
  const ColumnSpan& span = problem_->spans[effect];
  effects_.push_back(effect);
  price_ += price_nats(effect);
  if (span.count == 0) return;
  const auto held = static_cast<Eigen::Index>(columns_.size());
  Eigen::MatrixXd inverse(held + span.count, held + span.count);
  inverse.topLeftCorner(held, held) = inverse_;
  Eigen::MatrixXd turned = Eigen::MatrixXd::Zero(held, span.count);
  for (Eigen::Index k = 0; k < span.count; ++k) {
    for (Eigen::Index l = 0; l < span.count; ++l) turned.col(k) += beside.explained.col(l) * beside.fresh_inverse(l, k);
    for (Eigen::Index i = 0; i < held; ++i) inverse.col(i).head(held) += turned.col(k) * beside.explained(i, k);
    coefficients_ -= beside.explained.col(k) * beside.coefficients[k];
  }
  inverse.topRightCorner(held, span.count) = -turned;
  inverse.bottomLeftCorner(span.count, held) = -turned.transpose();
  inverse.bottomRightCorner(span.count, span.count) = beside.fresh_inverse;
  inverse_ = std::move(inverse);
  coefficients_.conservativeResize(held + span.count);
  coefficients_.tail(span.count) = beside.coefficients;
  squares_ -= beside.drop;
  for (Eigen::Index k = 0; k < span.count; ++k) columns_.push_back(span.first + k);
}

void FittedSet::remove(std::size_t place) {
  const auto [first, count] = span_at(place);
  price_ -= price_nats(effects_[place]);
  effects_.erase(effects_.begin() + static_cast<std::ptrdiff_t>(place));
  if (count == 0) return;
  const Eigen::Index after = inverse_.rows() - first - count;
  const Cholesky own(inverse_.block(first, first, count, count));
  const Eigen::VectorXd coefficients = coefficients_.segment(first, count), weighted = own.solve(coefficients);
  squares_ += coefficients.dot(weighted);
  columns_.erase(columns_.begin() + first, columns_.begin() + first + count);
  // Of a matrix or vector over the columns: without the rows of those that go.
  const auto without = [first = first, count = count, after](const auto& rows) {
    Eigen::MatrixXd left(first + after, rows.cols());
    left.topRows(first) = rows.topRows(first);
    left.bottomRows(after) = rows.bottomRows(after);
    return left;
  };
  const Eigen::MatrixXd beside = without(inverse_.middleCols(first, count)), turned = own.solve(beside.transpose());
  Eigen::MatrixXd inverse(first + after, first + after);
  for (Eigen::Index i = 0; i < inverse.cols(); ++i) {
    const auto present = inverse_.col(i < first ? i : i + count);
    inverse.col(i).head(first) = present.head(first);
    inverse.col(i).tail(after) = present.tail(after);
    for (Eigen::Index k = 0; k < count; ++k) inverse.col(i) -= beside.col(k) * turned(k, i);
  }
  inverse_ = std::move(inverse);
  coefficients_ = without(coefficients_);
  for (Eigen::Index k = 0; k < count; ++k) coefficients_ -= beside.col(k) * weighted[k];
}

void FittedSet::remove_cause(std::size_t cause) {
  for (std::size_t place = effects_.size(); place-- > 0;)
    if (problem_->cause[effects_[place]] == cause) remove(place);
}

}  // namespace demecal::inline effect_sets
