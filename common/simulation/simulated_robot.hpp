// A robot whose errors we chose: goes where it is commanded, wrongly, and is measured with noise; and where it is sent.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "random/random_stream.hpp"
#include "simulation/scenario.hpp"
#include "simulation/stance.hpp"
#include "simulation/truth.hpp"

namespace demecal::inline simulation {
/// One stop of the robot: the command and its circumstances.
struct Visit {
  JointVector commanded;  ///< rad or m
  ApproachSigns approach;
  double payload_kg = 0.0;
  double time_s = 0.0;  ///< since the first pose
};

class SimulatedRobot {
 public:
  /// Throws InputError where the scenario contradicts itself.
  explicit SimulatedRobot(const Scenario& scenario);

  /// Where the joints really stand (rad or m): the command plus what every error adds to it, each taken at the
  /// commanded joints of the nominal arm.
  JointVector true_joints(const Visit& visit) const;
  /// True pose of the tool in the sensor's frame.
  Eigen::Isometry3d true_pose(const Visit& visit) const;
  /// One measurement of that pose, without set and pose id: noise drawn from `random`, 3 normals for the position and,
  /// where it is measured, 3 for the orientation; one a joint where torques are logged.
  MeasuredPose measure(const Visit& visit, RandomStream& random) const;

  JointVector true_joints(const JointVector& commanded, const ApproachSigns& approach, double payload_kg) const {
    return true_joints({commanded, approach, payload_kg});
  }
  Eigen::Isometry3d true_pose(const JointVector& commanded, const ApproachSigns& approach, double payload_kg) const {
    return true_pose({commanded, approach, payload_kg});
  }
  MeasuredPose measure(const JointVector& commanded, const ApproachSigns& approach, double payload_kg,
                       RandomStream& random) const {
    return measure({commanded, approach, payload_kg}, random);
  }

 private:
  Situation situation(const Visit& visit) const;
  JointVector logged_torque(const Visit& visit, RandomStream& random) const;
  JointVector joints_in(const Situation& circumstances) const;
  std::vector<Eigen::Vector3d> axis_tilts(const Situation& circumstances) const;

  Scenario scenario_;
  Chain true_chain_;
};

/// The poses of the scenario, drawn from (scenario.seed), visited in order (their approach signs follow from it), and
/// measured; repeats of a pose follow it at once, each coming from another pose. The data set's robot is nominal:
/// nothing of the truth is in it. Its frame is `base` where sensor_from_base is the identity.
/// Throws InputError where the scenario contradicts itself or its poses cannot be reached.
DataSet simulate(const Scenario& scenario);

/// Joint values (rad or m) of `count` random poses, all within the robot's limits. By joints: uniform within the
/// ranges. In the cuboid: the nominal tool point is uniform in it and the orientation that of `home`, tilted at random,
/// among those that the arm reaches away from singularities; arms of fewer than 6 joints cannot hold an orientation,
/// and stand at random joints that bring their tool point into the cuboid. Throws InputError where no pose was found in
/// a bounded number of attempts.
std::vector<JointVector> draw_poses(const Scenario& scenario, int count, RandomStream& random);

}  // namespace demecal::inline simulation
