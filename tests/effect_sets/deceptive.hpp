// A small problem of explanation whose answer is known.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "effect_sets/fitted_set.hpp"
#include "random/random_stream.hpp"

namespace demecal {

inline constexpr Eigen::Index kRows = 200;

inline Eigen::VectorXd drawn(RandomStream& random) {
  Eigen::VectorXd column(kRows);
  for (double& value : column) value = random.normal();
  return column.normalized();
}

/// Effects of one column each, `causes` of them one after another.
inline ExplanationProblem made_of(const Eigen::MatrixXd& columns, const Eigen::VectorXd& residual, std::size_t causes) {
  ExplanationProblem problem;
  problem.gram = columns.transpose() * columns;
  problem.moment = columns.transpose() * residual;
  problem.squares = residual.squaredNorm();
  problem.rows = problem.freedom = static_cast<double>(kRows);
  problem.poses = problem.rows / 3.0;
  for (Eigen::Index i = 0; i < columns.cols(); ++i) {
    problem.spans.push_back({i, 1});
    problem.naming_costs_nats.push_back(2.0);
    problem.cause.push_back(static_cast<std::size_t>(i) % causes);
  }
  for (std::size_t i = 0; i < causes; ++i) problem.cause_names.push_back("cause " + std::to_string(i));
  return problem;
}

/// Forty effects, three of which make the residual. Number 0 lies between 1 and 2, which cancel but for a little.
inline ExplanationProblem deceptive(std::uint64_t seed) {
  RandomStream random{seed, 1};
  Eigen::MatrixXd columns(kRows, 40);
  for (Eigen::Index i = 0; i < columns.cols(); ++i) columns.col(i) = drawn(random);
  columns.col(0) = (columns.col(1) + columns.col(2) + 0.25 * columns.col(0)).normalized();
  const Eigen::VectorXd residual =
      45.0 * columns.col(1) + 25.0 * columns.col(2) + 12.0 * columns.col(7) + 12.0 * drawn(random);
  return made_of(columns, residual, 10);
}

}  // namespace demecal
