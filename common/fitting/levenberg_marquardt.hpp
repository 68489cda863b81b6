// The loop of Levenberg and Marquardt for small dense least squares: who fits says what a step is and what it costs.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>

namespace demecal::inline fitting {

struct LevenbergMarquardtOptions {
  int max_iterations = std::numeric_limits<int>::max();  ///< tries, successful or not
  int max_successful_steps = std::numeric_limits<int>::max();
  double initial_damping = 1e-3;
  double decrease_factor = 0.1;  ///< of the damping, after a successful step
  double increase_factor = 10.0;
  double min_increased_damping = 0.0;  ///< to which damping grows at least where a step fails
  double max_damping = 1e6;
  double function_tolerance = 1e-9;  ///< share of the cost; a step that lowers it by no more is the last
};

/// Steps until the cost settles, the damping is exhausted or nothing can be computed (Marquardt, 1963). A problem has
///   std::optional<double> linearize(double& damping)  makes ready for steps from where it stands, and gives its cost
///                                                     there; may set the damping to begin with
///   std::optional<double> try_step(double damping)    the cost behind the damped step
///   void accept()                                     goes where the last try was
template <typename Problem>
void levenberg_marquardt(Problem& problem, const LevenbergMarquardtOptions& options) {
  double damping = options.initial_damping;
  int successful = 0;
  bool linearized = false;
  double cost = 0.0;
  for (int i = 0; i < options.max_iterations && successful < options.max_successful_steps; ++i) {
    if (!linearized) {
      const std::optional<double> here = problem.linearize(damping);
      if (!here) return;
      cost = *here;
      linearized = true;
    }
    const std::optional<double> ahead = problem.try_step(damping);
    if (!ahead || !(*ahead < cost)) {
      damping = std::max(options.min_increased_damping, options.increase_factor * damping);
      if (damping > options.max_damping) return;
      continue;
    }
    problem.accept();
    ++successful;
    if (cost - *ahead <= options.function_tolerance * cost) return;
    damping *= options.decrease_factor;
    linearized = false;
  }
}

}  // namespace demecal::inline fitting
