// Which of the evolved corrections the model keeps: those that earn their place on the validation poses.
#pragma once

#include <span>
#include <vector>

#include "calibration/training.hpp"
#include "evolution/parameters.hpp"
#include "evolution/population.hpp"

namespace demecal {

/// The evolved candidates of one joint: best of each length, gathered over its islands.
struct JointCandidates {
  JointTraining training;
  Population front;
  std::vector<Tree> brief{};              ///< what the front comes to, written down briefly
  std::vector<JointCorrection> others{};  ///< corrections from elsewhere, the same place of every joint's belonging
                                          ///< together
};

/// What became of one joint's candidates.
struct JointChoice {
  int joint = 0;      ///< from 0
  bool kept = false;  ///< false: left neutral
  std::size_t candidates = 0;
  double gain_mm2 = 0.0;        ///< fall of the mean squared tool error on the deciding poses when it was chosen
  double gain_error_mm2 = 0.0;  ///< standard error of that fall
};

struct Selection {
  CorrectedRobot robot;
  std::vector<JointChoice> choices;  ///< one per candidate list, in its order
};

/// Fills in the front's brief forms: simplified, and with constants fitted to the training by least squares.
void write_briefly(JointCandidates& candidates, const GpParameters& parameters);

/// Whether interval arithmetic holds a correction within its limit (see correction_limit_rad) over its range. What is
/// not (a pole, most often) is not considered (thesis 6.2.2).
bool is_bounded(const JointCorrection& correction, const JointTraining& training);

/// Joint by joint, in sweeps until nothing changes: once from all joints neutral, once from all joints with what fits
/// their own targets best (the targets of a pose belong together), and once from every set of corrections from
/// elsewhere; whichever ends best. Of a joint's candidates, with the other joints as they stand, that is taken which,
/// with the tool errors it leaves at the `deciding` poses, is described in the fewest nats (see
/// description_length_nats); where joints learnt together (tables of squared errors) the shortest that is at most half
/// a standard error worse than the best. It is kept only if it beats the neutral correction by more than two standard
/// errors on these poses and on the `fitted` ones too, and the whole never does worse on the deciding poses than no
/// correction. A candidate that is not bounded is not considered. `deciding` holds validation poses; the calibration
/// poses where there are none.
Selection select_corrections(const DataSet& data, std::span<const std::size_t> fitted,
                             std::span<const std::size_t> deciding, const CorrectedRobot& declared,
                             std::span<const JointCandidates> candidates);

}  // namespace demecal
