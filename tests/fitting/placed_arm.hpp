// An arm as a further station measures it: base and tool are its own.
#pragma once

#include <string>

#include "fitting/known_arm.hpp"

namespace demecal {

/// `arm` without poses, seen from another place, its tool mounted anew.
inline KnownArm placed_at(const KnownArm& arm, RandomStream& stream, const std::string& name) {
  KnownArm there = arm;
  there.data.name = name;
  there.data.file = name + ".csv";
  there.data.sha256 = "hash of " + name;
  there.truth.sensor_from_base = far_pose(stream);
  there.truth.tools[""].translation() += random_vector(stream, 0.01);
  return there;
}

}  // namespace demecal
