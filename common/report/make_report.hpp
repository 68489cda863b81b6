// From what a run concluded to the document of it, with joint corrections as formulas that people read: a wave, a slope
// or an offset in the angle's own units.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/selection.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "diagnosis/outcome.hpp"
#include "distal/steps.hpp"
#include "effects/effect.hpp"
#include "explanations/error_budget.hpp"
#include "fitting/fit.hpp"
#include "prediction/corrected_robot.hpp"
#include "report/pose_places.hpp"
#include "report/report.hpp"
#include "structure/structure_fit.hpp"
#include "trials/finding.hpp"

namespace demecal::inline report {

struct RunFacts {
  double wall_s = 0.0;
  std::size_t workers = 0;
  std::size_t islands = 0;
  std::uint64_t generations = 0;
  std::uint64_t evaluations = 0;
  std::uint64_t migrations = 0;
  std::uint64_t evolved_sets = 0;  ///< of effects, that workers made and judged in search of explanations
  bool interrupted = false;
  bool asynchronous = false;          ///< islands waited for no neighbour: the result depends on timing
  std::uint64_t dropped_samples = 0;  ///< of the network, not acted on since they could not be believed
  bool resumed = false;               ///< part of it comes from a journal; wall_s and workers are of the last process
  std::map<std::string, double> waited_share;  ///< of each worker: of its slots' time while it had islands to breed,
                                               ///< the share without work
};

/// What a finished calibration leaves to report on.
struct Conclusions {
  const DataSet& data;
  const CalibratedModel&
      model;  ///< as it was written to the model file, so that evaluating that gives the same figures
  const CorrectedRobot& before;  ///< what the closed loop started from
  const LoopOutcome& loop;       ///< what the loop made of it
  const Preparation& preparation;
  const Calibration& calibration;
  const DataCheck& check;
  const std::vector<JointCandidates>& candidates;  ///< that joint corrections were chosen from
  const std::vector<DistalStep>& distal;
  const std::vector<FoundTransform>& structure;
  const RunFacts& runtime;
};
Report make_report(const Conclusions& run);

/// Of data that contradict the robot: what was found, the errors of the nominal robot, and nothing fitted.
Report refusal_report(const DataSet& data, const std::string& job, const DataCheck& check);

/// The figures of every station by itself; nothing where all was measured from one place.
std::vector<StationEntry> station_entries(const Conclusions& run);

/// The standard deviation per axis of position about the mean of its repeats, mm; nothing where no pose is repeated.
std::optional<double> noise_floor_mm(const DataSet& data);

/// Of a pose that `before` and `after` predict.
PosePlace pose_place(const DataSet& data, const MeasuredPose& pose, const CorrectedRobot& before,
                     const CorrectedRobot& after);

/// With the tool of `target`.
ArmEntry arm_entry(const CorrectedRobot& robot, const std::string& target);

/// In the unit that its name ends with.
ParameterEntry parameter_entry(const ParameterEstimate& estimate);

EffectEntry effect_entry(const Effect& effect, const Robot& robot);

/// The effect and its rivals at a cosine above 0.98, one of a kind and joint, the most common cause first; empty where
/// the effect has no such rival.
std::vector<ClassMember> effect_class(const EffectEntry& effect, const std::vector<RivalEntry>& rivals);

/// Sets causes and front, after set_loop(). `robot` holds the effects that the budget speaks of.
void set_causes(const ErrorBudget& budget, const CorrectedRobot& robot, const Robot& described, Report& report);

/// Sets rounds, dropped, not_found, unseen, decoys, stopped, the tests of the whole model, noise (nothing where the
/// loop did not run), candidates and draws of the noise. `described` is the arm that the effects stand by.
void set_loop(const LoopOutcome& loop, const Robot& described, Report& report);

struct ShortForm {
  std::string text;            ///< "0.31 mrad sin(q2 + 14 deg)"; joints count from 1
  std::size_t nodes = 0;       ///< at most 30, numbers and the joint's angle included
  JointCorrection correction;  ///< with the digits of the text
};

/// Of every joint's correction the shortest sum of waves, a slope and an offset that takes its place: with the forms of
/// all joints in theirs, with the digits that they show, the rms error of the validation poses (without any, of the
/// calibration poses) is at most 5 % above that of `robot`, where all are of at most 20 nodes, and at most 2 % by those
/// of up to 30. Nothing for joints without correction, prismatic ones, and where no such formula does.
std::vector<std::optional<ShortForm>> short_forms(const DataSet& data, const CorrectedRobot& robot);

}  // namespace demecal::inline report
