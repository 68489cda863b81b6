// Calibration by contacts that all lie at one place: whether they do, what effects found there are worth elsewhere, and
// what a second place would add.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "diagnosis/loop.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline closed_calibration {

/// Where calibration poses touch something, by the model: planes, lines and wires where the tool point then is.
std::vector<Eigen::Vector3d> touched_places_m(const DataSet& data, const CorrectedRobot& robot);

/// How far apart those places are at most, where that is less than 200 mm and no instrument measured anything.
std::optional<double> one_place_m(const DataSet& data, const CorrectedRobot& robot);

/// Takes back the effects that the loop added where contacts alone, all at one place, judged them, unless they explain
/// half of the squared error of the validation poses (of the calibration poses, where there are none): what they do
/// elsewhere nothing there tells, and the links that are fitted beside them change with them.
void take_back_unjudged(const DataSet& data, LoopResult& found);

/// What as many poses at the same contacts in a second place are predicted to leave of the error over the workspace.
struct SecondPlace {
  Eigen::Vector3d away_m = Eigen::Vector3d::Zero();  ///< in the arm's base frame: best of six along its axes
  double one_place_m = 0.0, both_m = 0.0;            ///< root mean square with the first alone, and with both
  std::vector<ParameterId> links{};                  ///< known twice as well then, and better: most gained first
};

/// Nothing where few postures reach such a place. `poses` are those of the last fit.
std::optional<SecondPlace> second_place(const DataSet& data, const CalibratedModel& model,
                                        const std::vector<std::size_t>& poses);

}  // namespace demecal::inline closed_calibration
