// How measurements of one arm scatter together: not every pose is measured independently and equally well.
#pragma once

#include <vector>

#include "diagnosis/residual_field.hpp"

namespace demecal {

/// What an estimate of the noise is made from: rows before any whitening.
struct NoiseRows {
  RowMatrix columns;  ///< rows x numbers of the model
  Eigen::VectorXd residual;
  RowMatrix joint_motions;              ///< rows x revolute joints, per rad
  std::vector<Eigen::Index> first_row;  ///< of each pose, and one past the last
  std::vector<std::size_t> group;       ///< per pose: repeats of one pose have the same
  std::vector<double> order;            ///< per pose: its place in the order of measuring
  bool drift_is_rival = false;          ///< of what is asked: what neighbours share counts however little shows it
};

struct NoiseEstimate {
  NoiseModel model;
  double scale = 1.0;  ///< of independent noise: what the scales of all rows are to be multiplied by
};

/// The components of variance of which the residuals are likeliest, the model's numbers integrated out (restricted
/// maximum likelihood; Patterson and Thompson, 1971). A component is zero where it makes the residuals hardly likelier.
/// At most some 360 rows take part, in three runs of poses.
NoiseEstimate estimate_noise(const NoiseRows& rows);

}  // namespace demecal
