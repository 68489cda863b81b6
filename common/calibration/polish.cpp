#include "calibration/polish.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "fitting/levenberg_marquardt.hpp"

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

/// Least squares over the constants of a formula at `places`, by differences.
class ConstantsProblem {
 public:
  ConstantsProblem(Tree tree, const std::vector<std::size_t>& places, FormulaMisfit& misfit)
      : tree_(std::move(tree)), places_(places), misfit_(misfit), residual_(misfit.residual(tree_)) {}

  const Tree& tree() const { return tree_; }

  std::optional<double> linearize(double& /*damping*/) {
    if (residual_.size() == 0 || places_.empty()) return std::nullopt;
    jacobian_.resize(residual_.size(), static_cast<Eigen::Index>(places_.size()));
    for (std::size_t k = 0; k < places_.size(); ++k) {
      Tree moved = tree_;
      double& constant = moved[places_[k]].value;
      const double by = 1e-6 * (1.0 + std::abs(constant));
      constant += by;
      const Eigen::VectorXd there = misfit_.residual(moved);
      if (there.size() == 0) return std::nullopt;
      jacobian_.col(static_cast<Eigen::Index>(k)) = (there - residual_) / by;
    }
    return residual_.squaredNorm();
  }

  std::optional<double> try_step(double damping) {
    Eigen::MatrixXd normal = jacobian_.transpose() * jacobian_;
    normal.diagonal() *= 1.0 + damping;
    normal.diagonal().array() += 1e-12;
    const Eigen::VectorXd change = -normal.ldlt().solve(jacobian_.transpose() * residual_);
    tried_ = tree_;
    for (std::size_t k = 0; k < places_.size(); ++k) tried_[places_[k]].value += change[static_cast<Eigen::Index>(k)];
    tried_residual_ = misfit_.residual(tried_);
    if (tried_residual_.size() == 0) return std::nullopt;
    return tried_residual_.squaredNorm();
  }

  void accept() {
    tree_ = tried_;
    residual_ = tried_residual_;
  }

 private:
  Tree tree_, tried_;
  const std::vector<std::size_t>& places_;
  FormulaMisfit& misfit_;
  Eigen::VectorXd residual_, tried_residual_;
  Eigen::MatrixXd jacobian_;
};

Tree fitted(Tree tree, const std::vector<std::size_t>& places, FormulaMisfit& misfit) {
  ConstantsProblem problem(std::move(tree), places, misfit);
  levenberg_marquardt(problem, {.max_iterations = kSteps, .initial_damping = 1e-3, .max_damping = 1e6});
  return problem.tree();
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
