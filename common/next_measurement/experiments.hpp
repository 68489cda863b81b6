// The measurements that could be made next, each with stops where the arm meets neither floor nor limits nor itself.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "effects/effect.hpp"
#include "expression/bound.hpp"
#include "kinematics/chain.hpp"
#include "random/random_stream.hpp"
#include "residuals/diagnosed_model.hpp"

namespace demecal::inline next_measurement {

/// Joint values at which the nominal arm keeps to where it has been: no tool point more than 50 mm below the lowest one
/// measured, no joint of it more than that below everything measured, and the tool point no farther from the base than
/// 110 % of the farthest and no nearer than 90 % of the nearest. Nothing else is known of what stands about it.
class FeasiblePoses {
 public:
  /// From the commanded joints of `poses`, of which there must be one at least.
  FeasiblePoses(const DataSet& data, std::span<const std::size_t> poses);

  /// What each joint was sent through, rad or m.
  const std::vector<Interval>& measured() const { return measured_; }
  /// What each joint may go through: its limits less 2 % at either end; where none are known, the measured range.
  const std::vector<Interval>& allowed() const { return allowed_; }

  bool contains(const JointVector& joints) const;
  /// Joints uniform in `ranges` (one per joint) among those that are feasible; measured ones where none is found.
  JointVector draw(const std::vector<Interval>& ranges, RandomStream& random) const;

 private:
  const DataSet& data_;
  std::vector<JointVector> joints_;
  std::vector<Interval> measured_, allowed_;
  Eigen::Vector3d up_;
  double lowest_tool_m_, lowest_m_, nearest_m_, farthest_m_;
};

/// A kind of measurement, and a sample of its stops.
struct Experiment {
  std::string before;               ///< words before "poses": "more "
  std::string after;                ///< and after it: " approached from both sides of joint 2"
  int stops_per_pose = 1;           ///< those of one pose follow each other
  int widened = -1;                 ///< the joint (from 0) that goes beyond its measured range; -1: none does
  std::vector<MeasuredPose> stops;  ///< what they measure is what one of the poses at hand measured
};

/// What can be done about effects such as `asked`, the simplest first: more poses; the same from both sides of a joint;
/// with and without a payload; a joint out to its limits; a step of temperature. Joints are drawn independently of each
/// other within their measured ranges, circumstances are together those of a pose at hand.
std::vector<Experiment> experiments(const DiagnosisProblem& problem, const std::vector<Effect>& asked,
                                    RandomStream random);

}  // namespace demecal::inline next_measurement
