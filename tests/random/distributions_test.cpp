// Shares and quantiles against closed forms and sums, and the small loop of Levenberg and Marquardt.
#include "random/distributions.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "fitting/levenberg_marquardt.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

TEST(Distributions, KnowFishersFByItsClosedFormAndItsInverse) {
  RandomStream stream{71};
  for (int trial = 0; trial < 200; ++trial) {
    const double below = 1.0 + 40.0 * stream.real(), ratio = 0.05 + 4.0 * stream.real();
    // With two degrees of freedom above the share has a closed form.
    EXPECT_NEAR(fisher_p_value(ratio, 2.0, below), std::pow(1.0 + 2.0 * ratio / below, -0.5 * below), 1e-12);
    const double above = 1.0 + 9.0 * stream.real(), share = 0.5 + 0.49 * stream.real();
    EXPECT_NEAR(fisher_p_value(fisher_quantile(share, above, below), above, below), 1.0 - share, 1e-10);
  }
}

TEST(Distributions, KnowTheLengthsOfNormalVectors) {
  for (double share = 0.05; share < 1.0; share += 0.05) {
    EXPECT_NEAR(normal_length_quantile(2, share), std::sqrt(-2.0 * std::log1p(-share)), 1e-12);
    const double x = normal_length_quantile(3, share);  // Maxwell's distribution
    EXPECT_NEAR(std::erf(x / std::numbers::sqrt2) - std::sqrt(2.0 / std::numbers::pi) * x * std::exp(-0.5 * x * x),
                share, 1e-12);
  }
}

TEST(Distributions, KeepTheLengthsOfNormalVectors) {
  for (const double share : {0.5, 0.95, 1 - 1e-7}) {
    const NormalLengths lengths(share);
    for (int axes = 1; axes <= 20; ++axes) {
      const double length = normal_length_quantile(axes, share);
      EXPECT_NEAR(lengths(axes), length, 1e-7 * length) << axes;
      EXPECT_EQ(lengths(axes), static_cast<float>(lengths(axes)));
    }
  }
}

TEST(Distributions, CountValuesBelowAMedian) {
  for (std::size_t count = 2; count <= 20; ++count) {
    double ways = 1.0, below = 0.0;  // of exactly `rank` values below, and of as many at most
    for (std::size_t rank = 0; 2 * rank + 1 < count; ++rank) {
      below += ways;
      EXPECT_NEAR(median_coverage(count, rank), 1.0 - 2.0 * below * std::pow(0.5, static_cast<double>(count)), 1e-13);
      ways *= static_cast<double>(count - rank) / static_cast<double>(rank + 1);
    }
  }
}

TEST(Quantile, IsAValueWithAsLargeAShareBelowInWhateverOrder) {
  RandomStream stream{73};
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> values(1 + stream.index(30));
    for (double& value : values) value = std::floor(10.0 * stream.real());
    const double share = trial % 10 == 0 ? 1.0 : stream.real(), found = quantile(values, share);
    const double place = share * static_cast<double>(values.size() - 1);
    EXPECT_LE(static_cast<double>(std::ranges::count_if(values, [&](double value) { return value < found; })), place);
    EXPECT_GT(static_cast<double>(std::ranges::count_if(values, [&](double value) { return value <= found; })), place);
    const std::vector<double> turned(values.rbegin(), values.rend());
    EXPECT_EQ(quantile(turned, share), found);
  }
}

/// Rosenbrock's valley as two residuals: 10 (y - x^2) and 1 - x.
struct Valley {
  Eigen::Vector2d at{-1.2, 1.0}, tried;
  int tries = 0;

  static Eigen::Vector2d residual(const Eigen::Vector2d& p) { return {10.0 * (p.y() - p.x() * p.x()), 1.0 - p.x()}; }

  std::optional<double> linearize(double& /*damping*/) const { return residual(at).squaredNorm(); }
  std::optional<double> try_step(double damping) {
    ++tries;
    Eigen::Matrix2d jacobian;
    jacobian << -20.0 * at.x(), 10.0, -1.0, 0.0;
    Eigen::Matrix2d normal = jacobian.transpose() * jacobian;
    normal.diagonal() *= 1.0 + damping;
    tried = at - normal.inverse() * jacobian.transpose() * residual(at);
    return residual(tried).squaredNorm();
  }
  void accept() { at = tried; }
};

TEST(LevenbergMarquardt, FindsTheEndOfACurvedValley) {
  Valley valley;
  levenberg_marquardt(valley, {.max_iterations = 200, .function_tolerance = 1e-12});
  EXPECT_LT((valley.at - Eigen::Vector2d::Ones()).norm(), 1e-6);
}

TEST(LevenbergMarquardt, StopsAtItsLimits) {
  Valley few;
  levenberg_marquardt(few, {.max_iterations = 3});
  EXPECT_EQ(few.tries, 3);
  Valley one;
  levenberg_marquardt(one, {.max_successful_steps = 1});
  EXPECT_GT((one.at - Eigen::Vector2d(-1.2, 1.0)).norm(), 0.0);
}

}  // namespace
}  // namespace demecal
