// Learning from the error of the whole model: what each joint learns from, and which corrections the model takes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "calibration/job.hpp"
#include "calibration/selection.hpp"
#include "calibration/training.hpp"
#include "distal/index.hpp"
#include "expression/shared_function.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline distal {

inline constexpr double kLeastFall = 1e-6;  ///< of the index, by a step that counts

/// The model took a correction, or another amplitude of one: a row of the thesis's Table 4-1.
struct DistalStep {
  int joint = 0;                 ///< from 0
  std::uint32_t generation = 0;  ///< when it emerged, counted over the whole learning
  JointCorrection correction;
  double index_mm2 = 0.0;  ///< of the model with it, and with whatever was taken together with it
};

/// What distal learning made of a model.
struct DistalOutcome {
  CorrectedRobot robot;
  double index_mm2 = 0.0;
  std::vector<DistalStep> steps{};            ///< of falling index; those taken together have the same
  std::vector<JointCandidates> candidates{};  ///< for conclude(): the last fronts, and the model's own corrections
  std::vector<SharedFunction> functions{};    ///< that joints shared in the last round
  bool is_complete = true;                    ///< false: learning was cut off
};

/// The table of `previous`'s joint against what all corrections leave: the squared rows of a pose are, as far as they
/// are linear in this joint's correction g, a (g - b)^2 + c with a = |J|^2 and b = present g + J' residual / a, so that
/// b is the target and a the weight. Fitness is then the linearized index but for a constant and a factor. The unit of
/// the target is `scale_rad` or, where none is given, of the size of its weighted mean. Rows of `previous` and `poses`
/// belong together.
JointTraining distal_training(const JointTraining& previous, std::span<const LinearizedPose> poses,
                              std::optional<double> scale_rad = std::nullopt);

/// Gives every training the scale of its joint's correction, where it has one, for the unit of its targets: formulas
/// evolved for the joint change as what the model took was changed.
void rescale_trainings(const CorrectedRobot& robot, std::span<JointTraining> trainings);

/// Has the model take one correction of the training's joint if the exact index falls, and adds a step. Whether it did.
bool accept_correction(const DistalIndex& index, const JointTraining& training, const JointCorrection& correction,
                       std::uint32_t generation, DistalOutcome& outcome);

/// Has the model take those candidates of all joints together that lower the index most: of whichever joint, one after
/// another, as long as the linearized index falls. Joints that evolved side by side have all learnt to make up for the
/// same errors, and what is taken for one joint makes another's too large or too small: with Amplitudes::fitted,
/// every correction is multiplied by the factor that suits it to the others (see AmplitudeFit), for each choice anew,
/// and so are those that stay. Nothing is taken whose factor is beyond 0.1 to 10, or that is not bounded, and all of it
/// only if the exact index falls. Adds a step for every joint whose correction changed, each with the index of all
/// together. Without any candidates the model's own corrections are fitted to one another. Whether the index fell.
bool accept_candidates(const DistalIndex& index, std::span<const JointCandidates> candidates, Amplitudes amplitudes,
                       std::uint32_t generation, DistalOutcome& outcome);

}  // namespace demecal::inline distal
