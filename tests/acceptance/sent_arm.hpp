// An arm whose measured positions are where it was sent, plus errors that the test chooses.
#pragma once

#include <gtest/gtest.h>

#include <numeric>

#include "acceptance/iso9283.hpp"
#include "kinematics/random_arm.hpp"

namespace demecal {

/// An arm, and measured positions where it is sent plus what the test adds.
class SentArm {
 public:
  explicit SentArm(std::uint64_t seed) : random_{seed} {
    data_.robot.chain = random_arm(random_, 6, Convention::standard_dh);
    data_.file = "sent.csv";
  }

  JointVector somewhere() { return random_joints(random_, data_.robot.chain); }

  MeasuredPose& add(const std::string& id, const JointVector& joints, const Eigen::Vector3d& error_m) {
    MeasuredPose pose;
    pose.joints = joints;
    pose.pose_id = id;
    pose.set = PoseSet::accept;
    pose.position_m = nominal_robot(data_).predict(joints, "").translation() + error_m;
    data_.poses.push_back(pose);
    return data_.poses.back();
  }

  std::vector<AttainedPose> poses() const {
    std::vector<std::size_t> rows(data_.poses.size());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    return attained_poses(data_, rows, nominal_robot(data_));
  }

  Characteristic criterion(const std::string& symbol) const {
    for (const Characteristic& one : characteristics(data_, poses(), nominal_robot(data_))) {
      if (one.symbol == symbol) return one;
    }
    ADD_FAILURE() << symbol;
    return {};
  }

  DataSet& data() { return data_; }
  const DataSet& data() const { return data_; }

 private:
  RandomStream random_;
  DataSet data_;
};

}  // namespace demecal
