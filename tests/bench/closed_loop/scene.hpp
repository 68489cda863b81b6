// A case's measurement: the arm, its poses and circumstances, and the noise that no model can remove.
#pragma once

#include "case_plan.hpp"
#include "data/data_set.hpp"
#include "simulation/scenario.hpp"

namespace demecal::bench {

/// A simulated arm with smooth errors of every joint: random joints within 120 deg of the middle of their ranges, 100
/// calibration, 60 validation and 200 accept poses, 0.05 mm of noise per axis; approach, payload (0 or 3 kg),
/// temperature and time recorded, all varied. A function of the seed and the robot.
Scenario varied_scene(std::uint64_t seed, const Robot& robot);

/// The case without its effect: varied_scene(), without the smooth errors where the kind's row says so.
Scenario clean_scene(const CasePlan& plan, const Robot& robot);

/// The measurement of a scenario with its poses dealt to the three sets at random, so that no set is measured later or
/// warmer than another.
DataSet measured(const Scenario& scenario);

/// Root mean square, mm, of what is measured of the accept poses less what is true of them.
double error_of_truth_mm(const Scenario& scenario, const DataSet& data);

}  // namespace demecal::bench
