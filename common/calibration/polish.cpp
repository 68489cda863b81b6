#include "calibration/polish.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>

namespace demecal {
namespace {

constexpr std::size_t kMostConstants = 8;
constexpr int kSteps = 30;
constexpr double kNear = 0.15;         ///< of a round number
constexpr double kRoundingNats = 1.0;  ///< what a round constant may cost: it is worth more than that

std::vector<std::size_t> constants_of(const Tree& tree) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < tree.size() && places.size() < kMostConstants; ++i) {
    if (tree[i].primitive == Primitive::constant) places.push_back(i);
  }
  return places;
}

bool is_round(double value) {
  return std::abs(2.0 * value - std::round(2.0 * value)) < 1e-12;
}

/// Weighted residuals of the scaled formula: its best amplitude is taken along, so that constants need not carry it.
class Problem {
 public:
  explicit Problem(const TrainingTable& table) : table_(table), evaluate_(table.variables) {}

  /// Root of weight times (target - amplitude * value), with the least-squares amplitude; empty where not finite.
  Eigen::VectorXd residual(const Tree& tree) {
    const auto values = evaluate_(tree);
    const auto rows = static_cast<Eigen::Index>(values.size());
    Eigen::VectorXd column(rows), target(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const auto row = static_cast<std::size_t>(i);
      const double root = std::sqrt(table_.weight[row]);
      column[i] = root * values[row];
      target[i] = root * table_.target[row];
    }
    const double square = column.squaredNorm();
    if (!std::isfinite(square)) return {};
    if (square > 0) target -= column * (column.dot(target) / square);
    return target;
  }

 private:
  const TrainingTable& table_;
  ColumnEvaluator evaluate_;
};

/// Least squares over the constants at `places`.
Tree fitted(Tree tree, const std::vector<std::size_t>& places, Problem& problem) {
  Eigen::VectorXd left = problem.residual(tree);
  if (left.size() == 0 || places.empty()) return tree;
  const auto n = static_cast<Eigen::Index>(places.size());
  double damping = 1e-3;
  for (int step = 0; step < kSteps; ++step) {
    Eigen::MatrixXd jacobian(left.size(), n);
    for (Eigen::Index k = 0; k < n; ++k) {
      Tree moved = tree;
      double& constant = moved[places[static_cast<std::size_t>(k)]].value;
      const double by = 1e-6 * (1.0 + std::abs(constant));
      constant += by;
      const Eigen::VectorXd there = problem.residual(moved);
      if (there.size() == 0) return tree;
      jacobian.col(k) = (there - left) / by;
    }
    Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    normal.diagonal() *= 1.0 + damping;
    normal.diagonal().array() += 1e-12;
    const Eigen::VectorXd change = -normal.ldlt().solve(jacobian.transpose() * left);
    Tree next = tree;
    for (Eigen::Index k = 0; k < n; ++k) next[places[static_cast<std::size_t>(k)]].value += change[k];
    const Eigen::VectorXd there = problem.residual(next);
    if (there.size() == 0 || !(there.squaredNorm() < left.squaredNorm())) {
      damping *= 10.0;
      if (damping > 1e6) break;
      continue;
    }
    const bool done = left.squaredNorm() - there.squaredNorm() < 1e-9 * left.squaredNorm();
    tree = std::move(next);
    left = there;
    damping *= 0.1;
    if (done) break;
  }
  return tree;
}

double nats_of(const Eigen::VectorXd& left) {
  return 0.5 * static_cast<double>(left.size()) * std::log(std::max(left.squaredNorm(), 1e-300));
}

}  // namespace

Tree polished(const Tree& tree, const TrainingTable& table) {
  Problem problem(table);
  std::vector<std::size_t> free = constants_of(tree);
  Tree best = fitted(tree, free, problem);
  for (std::size_t i = 0; i < free.size();) {
    const double value = best[free[i]].value, round = 0.5 * std::round(2.0 * value);
    if (std::abs(value - round) > kNear) {
      ++i;
      continue;
    }
    std::vector<std::size_t> others = free;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    Tree rounded = best;
    rounded[free[i]].value = round;
    rounded = fitted(std::move(rounded), others, problem);
    const Eigen::VectorXd before = problem.residual(best), after = problem.residual(rounded);
    if (after.size() > 0 && nats_of(after) - nats_of(before) < kRoundingNats) {
      best = std::move(rounded);
      free = std::move(others);
    } else {
      ++i;
    }
  }
  return best;
}

double description_nats(const Tree& tree, int variables, std::size_t rows) {
  const double word = std::log(static_cast<double>(kPrimitives.size()) - 1.0 + variables);
  double nats = 0.0;
  for (const Node& node : tree) {
    nats += word;
    if (node.primitive == Primitive::constant && !is_round(node.value)) {
      nats += 0.5 * std::log(static_cast<double>(std::max<std::size_t>(rows, 2)));
    }
  }
  return nats;
}

}  // namespace demecal
