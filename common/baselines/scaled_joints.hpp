// Joints as numbers within -1 and 1 over what was measured, for functions that know no units.
#pragma once

#include <span>

#include "data/data_set.hpp"

namespace demecal {

class ScaledJoints {
 public:
  /// By the joints of these poses; a joint that did not move is always 0.
  ScaledJoints(const DataSet& data, std::span<const std::size_t> poses) {
    lower_ = upper_ = data.poses[poses.front()].joints;
    for (const std::size_t pose : poses) {
      lower_ = lower_.cwiseMin(data.poses[pose].joints);
      upper_ = upper_.cwiseMax(data.poses[pose].joints);
    }
  }

  Eigen::VectorXd operator()(const JointVector& q) const {
    Eigen::VectorXd scaled = Eigen::VectorXd::Zero(q.size());
    for (Eigen::Index i = 0; i < q.size(); ++i) scaled[i] = one(q, static_cast<int>(i));
    return scaled;
  }
  double one(const JointVector& q, int joint) const {
    const double half = 0.5 * (upper_[joint] - lower_[joint]);
    return half > 0.0 ? (q[joint] - 0.5 * (upper_[joint] + lower_[joint])) / half : 0.0;
  }

 private:
  JointVector lower_, upper_;
};

}  // namespace demecal
