// What several robots of one type have in common, and how far one of them is from it: a normal law of each number whose
// mean and spread are told by what every robot's model knows of its own.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace demecal::inline updating {

/// What measurements of one robot say of its numbers, and nothing that was believed before them.
struct KnownNumbers {
  Eigen::MatrixXd information;  ///< inverse covariance; none of numbers that they do not speak of
  Eigen::VectorXd weighted;     ///< information * numbers
};

struct TypeSpread {
  Eigen::VectorXd mean;
  Eigen::MatrixXd mean_covariance;
  Eigen::VectorXd spread;  ///< standard deviations of robots about the mean
  double widening = 1.0;   ///< of a further robot's variance: few robots tell the spread, and it might be larger
};

/// Expectation maximisation of restricted likelihood (the mean counts as unknown). So few robots tell a variance badly:
/// those of one group (numbers from 0, one each) are believed to be alike, as much as four further robots would tell.
/// `mean_precision`: how precisely each mean is believed to be zero before. Numbers should be of size about 1, those of
/// a group in one unit.
TypeSpread type_spread(std::span<const KnownNumbers> robots, std::span<const int> groups,
                       const Eigen::VectorXd& mean_precision);

}  // namespace demecal::inline updating
