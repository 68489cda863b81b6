// The measurements that could be made next, each with stops it might consist of.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnosed_model.hpp"
#include "diagnosis/feasible_poses.hpp"
#include "random/random_stream.hpp"

namespace demecal {

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
std::vector<Experiment> experiments(const DiagnosisData& of, const std::vector<Effect>& asked, RandomStream random);

}  // namespace demecal
