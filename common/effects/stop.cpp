#include "effects/stop.hpp"

namespace demecal {

Stop::Stop(const MeasuredPose& pose)
    : joints(pose.joints),
      approach(pose.approach.value_or(ApproachSigns{})),
      payload_kg(pose.payload_kg.value_or(0.0)),
      temperature_celsius(pose.temperature_celsius),
      time_s(pose.time_s) {}

Stop Stop::with_joints(const JointVector& commanded) const {
  Stop stop = *this;
  stop.joints = commanded;
  return stop;
}

}  // namespace demecal
