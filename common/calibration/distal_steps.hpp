// Learning from the error of the whole model: what each joint learns from, and the steps that a model takes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "calibration/distal_index.hpp"
#include "calibration/selection.hpp"

namespace demecal {

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

/// The table of `like`'s joint against what all corrections leave: the squared rows of a pose are, as far as they are
/// linear in this joint's correction g, a (g - b)^2 + c with a = |J|^2 and b = present g + J' left / a, so that b is
/// the target and a the weight. Fitness is then the linearised index but for a constant and a factor. The unit of the
/// target is `scale_rad` or, where none is given, of the size of its weighted mean. Rows of `like` and `poses` belong
/// together.
JointTraining distal_training(const JointTraining& like, std::span<const LinearisedPose> poses,
                              std::optional<double> scale_rad = std::nullopt);

/// Gives every training the scale of its joint's correction, where it has one, for the unit of its targets: formulas
/// evolved for the joint change as what the model took was changed.
void follow_amplitudes(const CorrectedRobot& robot, std::span<JointTraining> trainings);

/// Has the model take one correction of the training's joint if the exact index falls, and adds a step. Whether it did.
bool take_correction(const DistalIndex& index, const JointTraining& training, const JointCorrection& correction,
                     std::uint32_t generation, DistalOutcome& outcome);

}  // namespace demecal
