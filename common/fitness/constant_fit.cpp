#include "fitness/constant_fit.hpp"

#include <algorithm>
#include <cmath>

#include "primitives/elementary.hpp"

namespace demecal::inline fitness {
namespace {

constexpr std::size_t kMostUnknowns = 24;  // further constants stay as they are
constexpr double kFirstDamping = 1e-3, kLeastDamping = 1e-9, kMostDamping = 1e6;
constexpr double kLeastLossGain = 1e-5;  // of the loss, by a step that is worth another
constexpr double kSmallError = 0.02;     // of the mean: smaller ones count as this large in their weights
constexpr int kSearchCalls = 4;          // of the simplex, for each step

// Errors and the weights of their squares. A least size above 0 makes the sum of squares that of absolute errors.
DEMECAL_FOR_EACH_VECTOR_UNIT
void weigh_errors(const double* target, const double* weight, const double* values, double least_size, double* error,
                  double* square_weight, std::size_t rows) {
  if (least_size > 0.0) {
    DEMECAL_ROWS_APART
    for (std::size_t i = 0; i < rows / kLanes * kLanes; ++i) {
      const double left = target[i] - values[i], size = std::abs(left);
      error[i] = left;
      square_weight[i] = weight[i] / (size > least_size ? size : least_size);
    }
  } else {
    DEMECAL_ROWS_APART
    for (std::size_t i = 0; i < rows / kLanes * kLanes; ++i) {
      error[i] = target[i] - values[i];
      square_weight[i] = weight[i];
    }
  }
}

double sum_of_squares(const double* target, const double* weight, const double* values, std::size_t rows) {
  std::array<double, kLanes> sums{};
  for (std::size_t row = 0; row < rows; row += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double error = target[row + lane] - values[row + lane];
      sums[lane] += weight[row + lane] * error * error;
    }
  double sum = 0.0;
  for (const double lane : sums) sum += lane;
  return sum;
}

bool all_finite(std::span<const double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
}

AlignedColumn padded_column(const std::vector<double>& column) {
  AlignedColumn all(column.begin(), column.end());
  all.resize(padded(column.size()), 0.0);
  return all;
}

}  // namespace

ConstantFit::ConstantFit(const TrainingTable& table, const GpParameters& parameters)
    : target_(padded_column(table.target)),
      weight_(padded_column(table.weight)),
      errors_(table.target, table.weight, table.loss),
      parameters_(parameters),
      model_(table.variables),
      own_loss_(table.loss),
      loss_kind_(table.loss) {
  for (const double weight : table.weight) weights_ += weight;
}

// A formula that is one number is not scaled: that number is its constant.
ConstantModel::Scaling ConstantFit::scaling_for(const NodeStore& store, NodeId root) const {
  using Scaling = ConstantModel::Scaling;
  if (!parameters_.linear_scaling || store[root].is_constant) return Scaling::none;
  const TreeExtent extent = ConstantModel::extent(store, root, Scaling::linear);
  const bool fits = extent.depth <= parameters_.max_tree_depth &&
                    (parameters_.max_tree_nodes == 0 || extent.nodes <= parameters_.max_tree_nodes);
  return fits ? Scaling::linear : Scaling::none;
}

double ConstantFit::loss_at(std::span<const double> constants) {
  model_.set(constants);
  ErrorSum::Lanes sums{};
  double squares = 0.0;
  for (std::size_t begin = 0; begin < model_.padded_rows(); begin += model_.rows_at(begin)) {
    const std::size_t rows = model_.rows_at(begin);
    const double* const values = model_.values(begin);
    if (loss_kind_ == own_loss_)
      errors_.add(sums, begin, values, rows);
    else
      squares += sum_of_squares(target_.data() + begin, weight_.data() + begin, values, rows);
  }
  return loss_kind_ == own_loss_ ? ErrorSum::total(sums) : squares;
}

// The straight line from the formula's values to the targets, by weighted least squares.
void ConstantFit::scale() {
  double values_sum = 0.0, targets_sum = 0.0;
  const auto each_row = [&](const auto& add) {
    for (std::size_t begin = 0; begin < model_.padded_rows(); begin += model_.rows_at(begin)) {
      const double* const values = model_.values(begin);
      for (std::size_t i = 0; i < model_.rows_at(begin); ++i) add(weight_[begin + i], values[i], target_[begin + i]);
    }
  };
  each_row([&](double weight, double value, double target) {
    values_sum += weight * value;
    targets_sum += weight * target;
  });
  const double mean_value = values_sum / weights_, mean_target = targets_sum / weights_;
  double spread = 0.0, together = 0.0;
  each_row([&](double weight, double value, double target) {
    spread += weight * (value - mean_value) * (value - mean_value);
    together += weight * (value - mean_value) * (target - mean_target);
  });
  const double factor = together / spread, offset = mean_target - factor * mean_value;
  if (!std::isfinite(factor) || !std::isfinite(offset)) return;
  constants_[0] = offset;
  constants_[1] = factor;
}

// Of the formula at constants_. The model's values are those at constants_ where there is one strip of rows.
void ConstantFit::sum_products() {
  alignas(64) DampedNormalEquations::Strip error, square_weight;
  equations_.clear(unknowns_);
  const double least_size = loss_kind_ == Loss::squared ? 0.0 : kSmallError * loss_ / weights_;
  for (std::size_t begin = 0; begin < model_.padded_rows(); begin += model_.rows_at(begin)) {
    const std::size_t rows = model_.rows_at(begin);
    const double* const values = model_.values(begin);
    model_.find_slopes();
    weigh_errors(target_.data() + begin, weight_.data() + begin, values, least_size, error.data(), square_weight.data(),
                 rows);
    for (std::size_t i = 0; i < unknowns_; ++i) slopes_[i] = model_.slope(i);
    equations_.add({slopes_.data(), unknowns_}, error.data(), square_weight.data(), rows);
  }
}

// Whether another step is worth its while.
bool ConstantFit::step(double& damping) {
  if (!products_known_) {
    if (!at_constants_) model_.set(constants_);
    at_constants_ = true;
    sum_products();
    if (!equations_.finish()) return false;
    products_known_ = true;
  }
  trial_ = constants_;
  const bool solved = equations_.solve(damping, {step_.data(), unknowns_});
  for (std::size_t i = 0; solved && i < unknowns_; ++i) trial_[i] += step_[i];
  const double loss = solved && all_finite(trial_) ? loss_at(trial_) : INFINITY;
  at_constants_ = loss < loss_;
  if (!at_constants_) {
    damping *= 10.0;
    return damping <= kMostDamping;
  }
  const double gain = loss_ - loss;
  std::swap(constants_, trial_);
  loss_ = loss;
  products_known_ = false;
  damping = std::max(0.1 * damping, kLeastDamping);
  return gain > kLeastLossGain * loss;
}

void ConstantFit::fit() {
  unknowns_ = std::min(constants_.size(), kMostUnknowns);
  step_.resize(std::max(step_.size(), unknowns_));
  slopes_.resize(std::max(slopes_.size(), unknowns_));
  products_known_ = at_constants_ = false;
  double damping = kFirstDamping;
  bool worth_it = unknowns_ > 0 && loss_ > 0.0 && weights_ > 0.0;
  for (int i = 0; worth_it && i < parameters_.constant_steps; ++i) worth_it = step(damping);
  if (model_.jumps()) search_jumps();
}

void ConstantFit::search_jumps() {
  loss_ = simplex_(
      [this](std::span<const double> constants) { return all_finite(constants) ? loss_at(constants) : INFINITY; },
      constants_, loss_, kSearchCalls * parameters_.constant_steps);
}

FittedFormula ConstantFit::operator()(NodeStore& store, NodeId root, double fitness) {
  loss_kind_ = own_loss_;
  const ConstantModel::Scaling scaling = scaling_for(store, root);
  model_.bind(store, root, scaling);
  constants_.assign(model_.constants().begin(), model_.constants().end());
  if (constants_.empty()) return {root, fitness};
  if (scaling == ConstantModel::Scaling::linear) scale();
  loss_ = loss_at(constants_);
  if (!std::isfinite(loss_)) return {root, fitness};
  if (parameters_.constants != ConstantPolicy::none) fit();
  if (!(loss_ <= fitness)) return {root, fitness};
  return {model_.rebuilt(store, constants_), loss_};
}

FittedFormula ConstantFit::by_squares(NodeStore& store, NodeId root) {
  loss_kind_ = Loss::squared;
  model_.bind(store, root);
  constants_.assign(model_.constants().begin(), model_.constants().end());
  loss_ = loss_at(constants_);
  if (std::isfinite(loss_)) fit();
  return {model_.rebuilt(store, constants_), loss_};
}

}  // namespace demecal::inline fitness
