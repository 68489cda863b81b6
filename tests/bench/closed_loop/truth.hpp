// True effects of a case: how they are put into the simulated arm, and whether a found effect is one of them.
#pragma once

#include <vector>

#include "effects/effect.hpp"
#include "simulation/scenario.hpp"

namespace demecal::bench {

/// Puts an effect with its coefficients into the scenario's truth.
void inject(Scenario& scenario, const Effect& truth);

/// Whether `found` is `truth`: the same kind and joint; of couplings and backlash also the same other joint (none), of
/// gear harmonics the same ratio; of formulas the same joint and values that go together over `states` (correlation
/// beyond 0.95), however they are written.
bool is_truth(const Effect& found, const Effect& truth, const Robot& robot, const std::vector<ArmState>& states);

/// Whether two motions over the same states are correlated beyond 0.95.
bool go_together(const Eigen::VectorXd& one, const Eigen::VectorXd& other);

/// The nominal arm at every pose of a set, the tool point where it was measured.
std::vector<ArmState> states_of(const DataSet& data, PoseSet set);

/// How a joint effect moves its joint at every state, rad or m.
Eigen::VectorXd joint_motion(const Effect& effect, const Robot& robot, const std::vector<ArmState>& states);

/// Root mean square of the values about their mean.
double spread(const Eigen::VectorXd& values);

}  // namespace demecal::bench
