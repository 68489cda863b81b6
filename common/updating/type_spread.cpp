#include "decompositions/decompositions.hpp"
#include "updating/fleet_numbers.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <span>
#include <type_traits>
#include <vector>

namespace demecal::inline updating {
namespace {

constexpr double kRobotsOfBelief = 4.0;  ///< robots that the belief in groups counts as
constexpr double kLeastSpread = 1e-5;    ///< in sizes of about 1

/// What is expected of robots and mean, the variances being as given.
struct Expected {
  Eigen::VectorXd mean;
  Eigen::MatrixXd mean_covariance;
  Eigen::VectorXd squares;  ///< of the robots' ways from the mean, summed
  Eigen::VectorXd known;    ///< share of each number's variance that the robots tell
};

Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& information) {
  return Cholesky(information).inverse();
}

Expected expected(std::span<const KnownNumbers> robots, const Eigen::VectorXd& variance,
                  const Eigen::VectorXd& mean_precision) {
  const Eigen::Index n = variance.size();
  Eigen::MatrixXd information = mean_precision.asDiagonal();
  Eigen::VectorXd weighted = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::MatrixXd> own, shrunk;  // a robot's covariance about the type; that times its information
  for (const KnownNumbers& robot : robots) {
    Eigen::MatrixXd sum = robot.information;
    sum.diagonal() += variance.cwiseInverse();
    own.push_back(inverse_of(sum));
    shrunk.push_back(own.back() * robot.information);
    information += robot.information - robot.information * shrunk.back();
    weighted += robot.weighted - robot.information * (own.back() * robot.weighted);
  }
  Expected result{{}, inverse_of(information), Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  result.mean = result.mean_covariance * weighted;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const Eigen::VectorXd way = own[i] * (robots[i].weighted - robots[i].information * result.mean);
    const Eigen::MatrixXd moved = shrunk[i] * result.mean_covariance;
    result.known += (1.0 - own[i].diagonal().cwiseQuotient(variance).array()).matrix() / std::ssize(robots);
    result.squares += way.cwiseAbs2() + own[i].diagonal() + moved.cwiseProduct(shrunk[i]).rowwise().sum();
  }
  return result;
}

/// Of each number, the mean variance of its group, as far as each is known.
Eigen::VectorXd pooled(const Eigen::VectorXd& variance, const Eigen::VectorXd& known, std::span<const int> groups) {
  constexpr double kLeast = 1e-6;
  const int most = groups.empty() ? -1 : *std::ranges::max_element(groups);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(most + 1), count = sum;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double share = std::clamp(known[at], kLeast, 1.0);
    sum[groups[i]] += share * variance[at];
    count[groups[i]] += share;
  }
  Eigen::VectorXd result(variance.size());
  for (std::size_t i = 0; i < groups.size(); ++i)
    result[static_cast<Eigen::Index>(i)] = sum[groups[i]] / count[groups[i]];
  return result;
}

}  // namespace

TypeSpread type_spread(std::span<const KnownNumbers> robots, std::span<const int> groups,
                       const Eigen::VectorXd& mean_precision) {
  constexpr int kMostRounds = 300;
  constexpr double kSettled = 1e-3;
  const auto count = static_cast<double>(robots.size());
  Eigen::VectorXd variance = Eigen::VectorXd::Ones(mean_precision.size());
  for (int round = 0; round < kMostRounds; ++round) {
    const Expected now = expected(robots, variance, mean_precision);
    const Eigen::VectorXd alike = pooled(variance, now.known, groups);
    const Eigen::VectorXd next =
        ((kRobotsOfBelief * alike + now.squares) / (kRobotsOfBelief + count)).cwiseMax(kLeastSpread * kLeastSpread);
    const double moved = (next - variance).cwiseAbs().cwiseQuotient(variance).maxCoeff();
    variance = next;
    if (moved < kSettled) break;
  }
  Expected last = expected(robots, variance, mean_precision);
  const double freedom = kRobotsOfBelief + count - 1.0;
  return {last.mean, last.mean_covariance, variance.cwiseSqrt(), freedom / (freedom - 2.0)};
}

Eigen::VectorXd group_spread(std::span<const KnownNumbers> models, std::span<const int> groups,
                             const Eigen::VectorXd& mean_precision) {
  constexpr int kMostRounds = 300;
  constexpr double kNumbersOfBelief = 4.0, kSettled = 1e-3;
  const auto of_numbers = [&](const Eigen::VectorXd& of_groups) {
    Eigen::VectorXd result(mean_precision.size());
    for (std::size_t i = 0; i < groups.size(); ++i) result[static_cast<Eigen::Index>(i)] = of_groups[groups[i]];
    return result;
  };
  const int count = groups.empty() ? 0 : *std::ranges::max_element(groups) + 1;
  Eigen::VectorXd variance = Eigen::VectorXd::Ones(count);
  for (int round = 0; round < kMostRounds; ++round) {
    const Expected now = expected(models, of_numbers(variance), mean_precision);
    Eigen::VectorXd squares = Eigen::VectorXd::Constant(count, kNumbersOfBelief), weights = squares;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      squares[groups[i]] += now.squares[static_cast<Eigen::Index>(i)];
      weights[groups[i]] += static_cast<double>(models.size());
    }
    const Eigen::VectorXd next = squares.cwiseQuotient(weights);
    const bool settled = (next - variance).cwiseAbs().cwiseQuotient(variance).maxCoeff() < kSettled;
    variance = next;
    if (settled) break;
  }
  return variance.cwiseSqrt();
}

}  // namespace demecal::inline updating
