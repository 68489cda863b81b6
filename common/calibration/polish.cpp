#include "calibration/polish.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace demecal {
namespace {

constexpr std::size_t kMostConstants = 8;
constexpr int kSteps = 30;
constexpr double kNear = 0.15;  ///< of a round number

std::vector<std::size_t> constants_of(const Tree& tree) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < tree.size() && places.size() < kMostConstants; ++i) {
    if (tree[i].primitive == Primitive::constant) places.push_back(i);
  }
  return places;
}

/// Least squares over the constants at `places`.
Tree fitted(Tree tree, const std::vector<std::size_t>& places, FormulaMisfit& misfit) {
  Eigen::VectorXd left = misfit.residual(tree);
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
      const Eigen::VectorXd there = misfit.residual(moved);
      if (there.size() == 0) return tree;
      jacobian.col(k) = (there - left) / by;
    }
    Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    normal.diagonal() *= 1.0 + damping;
    normal.diagonal().array() += 1e-12;
    const Eigen::VectorXd change = -normal.ldlt().solve(jacobian.transpose() * left);
    Tree next = tree;
    for (Eigen::Index k = 0; k < n; ++k) next[places[static_cast<std::size_t>(k)]].value += change[k];
    const Eigen::VectorXd there = misfit.residual(next);
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

}  // namespace

Tree polished(const Tree& tree, FormulaMisfit& misfit) {
  const double digits_nats = 0.5 * std::log(static_cast<double>(std::max<std::size_t>(misfit.poses(), 2)));
  std::vector<std::size_t> free = constants_of(tree);
  Tree best = fitted(tree, free, misfit);
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
    rounded = fitted(std::move(rounded), others, misfit);
    if (misfit.nats(rounded) - misfit.nats(best) < digits_nats) {
      best = std::move(rounded);
      free = std::move(others);
    } else {
      ++i;
    }
  }
  return best;
}

}  // namespace demecal
