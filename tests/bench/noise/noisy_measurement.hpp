// The measurement of a case: the arm and what is wrong with it, poses with the condition's noise, and fresh poses
// without any noise, by which alone models are judged.
#pragma once

#include "data/data_set.hpp"
#include "noise_case.hpp"
#include "prediction/corrected_robot.hpp"
#include "simulation/scenario.hpp"

namespace demecal::bench {

/// The arm of a case with smooth errors of every joint (up to 1 mrad), a tool that is 1 mm off and, where it is
/// declared, geometry that is 1 mrad and 0.3 mm off. A function of the case.
Scenario noisy_scene(const NoiseCase& one, const std::vector<Robot>& arms);

/// 100 calibration, 50 validation and 50 accept poses (25, 13 and 13 of four rows each where poses are repeated) with
/// the condition's noise, dealt to the sets at random; nothing of the fault. Approach and payload recorded.
DataSet measured_noisily(const NoiseCase& one, const Scenario& scenario);

/// By how much the joints of the case's arm stop beside where they are sent (standard deviations); empty: not at all.
JointVector repeatability_rad(const NoiseCase& one, Eigen::Index joints);

/// 200 poses without noise, drift or faults, from the same distribution of joints and circumstances. Joints stop by
/// `stops_beside_rad` beside where they are sent (standard deviations); empty: there.
DataSet fresh_poses(const NoiseCase& one, const Scenario& scenario, const JointVector& stops_beside_rad = {});

/// Root mean square, mm, of the robot's errors on `fresh`; after the rigid motion of its predictions that makes them
/// least, where the condition drifts, so that only the instrument's place is unknown.
double clean_error_mm(const NoiseCase& one, const CorrectedRobot& robot, const DataSet& fresh);

}  // namespace demecal::bench
