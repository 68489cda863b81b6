// How surely a fitted model knows where the tool goes: the covariance of its numbers, carried over to poses.
#pragma once

#include <vector>

#include "effects/corrected_robot.hpp"
#include "fitting/parameter_space.hpp"

namespace demecal {

/// A shape that a joint's correction could hold more or less of, in rad of theta in rad.
struct CorrectionTerm {
  int joint = 0;  ///< from 0
  JointCorrection shape;
};

/// The covariance of a model's numbers after a fit, wide along what the poses did not show: factor * factor^T.
struct Posterior {
  std::vector<ParameterId> ids;       ///< of the model's base, links, tools and effects
  std::vector<CorrectionTerm> terms;  ///< of its joint corrections
  Eigen::MatrixXd factor;             ///< (ids, then terms) x any number; SI units and rad

  /// Without the numbers that `leave_out` names.
  template <typename LeaveOut>
  Posterior without(const LeaveOut& leave_out) const;
};

/// Covariance of a tool's pose: position (m) first, then orientation (rad), in the frame of predictions.
using PoseCovariance = Eigen::Matrix<double, 6, 6>;

/// Of the pose that `robot`, whose numbers `posterior` is about, predicts for the tool of `target` (empty: its own) at
/// `stop`.
PoseCovariance pose_covariance(const Posterior& posterior, const CorrectedRobot& robot, const Stop& stop,
                               const std::string& target = "");

template <typename LeaveOut>
Posterior Posterior::without(const LeaveOut& leave_out) const {
  Posterior rest{{}, terms, {}};
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (leave_out(ids[i])) continue;
    rest.ids.push_back(ids[i]);
    rows.push_back(static_cast<Eigen::Index>(i));
  }
  for (std::size_t i = 0; i < terms.size(); ++i) rows.push_back(static_cast<Eigen::Index>(ids.size() + i));
  rest.factor = factor(rows, Eigen::all);
  return rest;
}

}  // namespace demecal
