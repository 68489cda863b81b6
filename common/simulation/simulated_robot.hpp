// A robot whose errors we chose: goes where it is commanded, wrongly, and is measured with noise.
#pragma once

#include "random/random_stream.hpp"
#include "simulation/scenario.hpp"

namespace demecal {

class SimulatedRobot {
 public:
  explicit SimulatedRobot(const Scenario& scenario);

  /// Where the joints really stand when commanded, coming from `approach`, under `payload_kg`.
  JointVector true_joints(const JointVector& commanded, const ApproachSigns& approach, double payload_kg) const;
  /// True pose of the tool in the sensor's frame.
  Eigen::Isometry3d true_pose(const JointVector& commanded, const ApproachSigns& approach, double payload_kg) const;
  /// One measurement of that pose: noise drawn from `random`.
  MeasuredPose measure(const JointVector& commanded, const ApproachSigns& approach, double payload_kg,
                       RandomStream& random) const;

 private:
  Scenario scenario_;
  Chain true_chain_;
};

/// The poses of the scenario, drawn from (scenario.seed), visited in order (their approach signs follow from it), and
/// measured. The data set's robot is nominal: nothing of the truth is in it.
DataSet simulate(const Scenario& scenario);

}  // namespace demecal
