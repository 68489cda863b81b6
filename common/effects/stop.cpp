#include "effects/stop.hpp"

namespace demecal {

Stop::Stop(const MeasuredPose& pose)
    : joints(pose.joints),
      approach(pose.approach.value_or(ApproachSigns{})),
      payload_kg(pose.payload_kg.value_or(0.0)),
      temperature_celsius(pose.temperature_celsius),
      time_s(pose.time_s) {}

}  // namespace demecal
