// The arms that planned poses, checks and fleets are tried on, and their measurements.
#pragma once

#include <vector>

#include "data/data_set.hpp"
#include "parameters/declared_model.hpp"
#include "planning/candidates.hpp"
#include "prediction/corrected_robot.hpp"
#include "random/random_stream.hpp"

namespace demecal::bench {

inline constexpr double kNoise_m = 3e-5;
inline constexpr DeclaredModel kLinks{.registration = true, .tool = true, .joint_offset = true, .geometry = true};

std::vector<Robot> arms();

/// The arm as it really is: a millimetre and a milliradian of error in every link.
CorrectedRobot truth_of(const Robot& robot, RandomStream& random);

/// Measured with noise of kNoise_m.
DataSet measured(const Robot& robot, const CorrectedRobot& truth, const std::vector<PlannedPose>& poses,
                 RandomStream& random);

/// Root mean square of the model's errors at `places`.
double true_error_m(const CorrectedRobot& model, const CorrectedRobot& truth, const std::vector<PlannedPose>& places);

/// Base, tool and links fitted to all poses.
CorrectedRobot fitted(const DataSet& data);

}  // namespace demecal::bench
