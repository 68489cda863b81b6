// Arms to correct, and joints at which they are well away from singularities.
#pragma once

#include <limits>

#include "decompositions/decompositions.hpp"
#include "prediction/random_effects.hpp"
#include "programs/correct_program.hpp"

namespace demecal {

/// The elbow arm with weight and with limits wide enough for any target here.
inline Robot elbow_arm(RandomStream& stream) {
  Robot robot = heavy(stream, wrist_arm());
  robot.chain.tool_m = {0.15, 0.002, 0.056};
  return robot;
}

inline CommandModel unbounded_model(const Robot& nominal, CorrectedRobot identified) {
  identified.described = nominal;
  return command_model(nominal, identified,
                       std::vector<double>(nominal.chain.joints.size(), std::numeric_limits<double>::infinity()));
}

/// Effects as arms have them: none of which it is said that it cannot be believed.
inline std::vector<Effect> believable(std::vector<Effect> effects) {
  for (Effect& effect : effects)
    if (!law_of(effect).reversal(effect).empty())
      for (double& value : effect.values) value = -value;
  return effects;
}

/// Wrong in links, joints, tool and by effects, seen from an instrument somewhere.
inline CommandModel erring_model(RandomStream& stream, const Robot& nominal) {
  CorrectedRobot identified = random_robot(stream, nominal.chain, 1e-3, 2e-3);
  identified.tools[""].translation() += Eigen::Vector3d(4e-4, -7e-4, 2e-4);
  identified.effects = believable(random_effects(nominal, stream, 2e-4, 1));
  return unbounded_model(nominal, identified);
}

/// Nothing identified but where the instrument stands.
inline CommandModel neutral_model(RandomStream& stream, const Robot& nominal) {
  CorrectedRobot identified = random_robot(stream, nominal.chain, 0.0, 0.0);
  identified.corrections.assign(nominal.chain.joints.size(), {});
  identified.effects = random_effects(nominal, stream, 0.0, 2);
  return unbounded_model(nominal, identified);
}

inline bool is_regular(const Chain& chain, const JointVector& joints) {
  const Jacobian jacobian = joint_jacobian(chain, joints, chain.tool_m);
  return singular_system(jacobian).values.minCoeff() > 0.1;
}

inline JointVector regular_joints(RandomStream& stream, const Chain& chain) {
  while (true) {
    const JointVector joints = 0.8 * random_joints(stream, chain);
    if (is_regular(chain, joints)) return joints;
  }
}

}  // namespace demecal
