// What may have changed, one cause at a time: how likely each is, and how much of it there is.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "data/data_set.hpp"
#include "effects/effect.hpp"
#include "prediction/corrected_robot.hpp"
#include "updating/change.hpp"
#include "updating/change_rows.hpp"

namespace demecal::inline updating {

/// What causes are tried on.
struct CauseTrial {
  const CorrectedRobot& robot;  ///< the model's
  const DataSet& data;
  const std::vector<std::size_t>& poses;
  const std::vector<Effect>& effects;
  double known_rows = 0.0;  ///< what is known of the noise's size counts as so many rows more
};

/// Every cause by itself, the likeliest first.
std::vector<ChangeCause> tested_causes(const ChangeRows& rows, const CauseTrial& trial);

/// Where among `effects` the law of this one is.
std::size_t place_of(const Effect& effect, const std::vector<Effect>& effects);

/// How much of several causes there is, by least squares over all of them together.
struct ChangeAmounts {
  Eigen::VectorXd values, variances;  ///< of all coefficients
  Eigen::MatrixXd basis;              ///< orthonormal: what the causes explain
  double left = 0.0;                  ///< sum of squares of what they leave
};

/// What a cause and those found before it do alike to these poses is of those: the lift of an arm with parallel axes
/// beside its tool, say, whose difference would be taken to metres.
ChangeAmounts amounts_on(const std::vector<ChangeCause>& found, const ChangeRows& rows,
                         const std::vector<Effect>& effects, double known_rows);

/// What the causes found leave of the rows, and of other causes what these poses tell from them.
ChangeRows left_by(const std::vector<ChangeCause>& found, const ChangeAmounts& amounts, const ChangeRows& rows,
                   const std::vector<Effect>& effects);

/// Of all coefficients, in the order of the causes.
void set_amounts(const Eigen::VectorXd& values, const Eigen::VectorXd& variances, const Robot& robot,
                 std::vector<ChangeCause>& found);

}  // namespace demecal::inline updating
