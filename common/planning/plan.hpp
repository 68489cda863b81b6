// A measurement planned before its first pose: which poses, in which order, and what they will tell.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "effects/effect.hpp"
#include "errors/input_error.hpp"
#include "fitting/fit.hpp"
#include "parameters/declared_model.hpp"
#include "planning/cell.hpp"
#include "planning/information.hpp"
#include "planning/sockets.hpp"
#include "planning/way.hpp"

namespace demecal::inline planning {

/// Where a rule of the cell is stated.
struct StatedRule {
  InputError::Where where;
  std::string key;
};

struct PlanRequest {
  Robot robot;
  std::map<std::string, Eigen::Vector3d> tools_m{};  ///< of several targets; empty: the robot's tool
  std::optional<WorkCell> cell{};                    ///< none: assumed_cell()
  std::map<Obstruction, StatedRule> stated{};        ///< by what a pose is refused for; as far as a file states it
  DeclaredModel declared{.registration = true, .tool = true, .joint_offset = true, .geometry = true};
  std::vector<std::string> detect{};   ///< words of the catalogue: effects to be told apart beside what is declared
  std::optional<int> poses{};          ///< for calibration
  std::optional<double> accuracy_m{};  ///< in place of `poses`: the predicted rms error to reach
  std::optional<int> validation{}, accept{};  ///< none: 3 for every 10 that calibrate, 10
                                              ///< at least, those measured before included
  std::optional<DataSet> measured{};          ///< what was measured before: the plan goes on from there
  std::optional<int> places{};                ///< of sockets that the tool touches in place of an instrument
  std::uint64_t seed = 1;
};

struct PlannedStop {
  std::string id;  ///< "P1" onwards in the order of measuring; behind the highest number measured before
  PoseSet set = PoseSet::calibration;
  PlannedPose pose;
};

/// What so many poses are predicted to reach, planned and drawn at random.
struct CurvePoint {
  int poses = 0;
  PredictedError planned;
  double random_rms_m = 0.0;
};

/// A number of the model after the measurement.
struct PredictedNumber {
  ParameterId id;
  double nominal = 0.0;
  double standard_error = 0.0;  ///< rad or m, SI of effects
  bool identifiable = false;
};

/// The smallest coefficient of an effect that a test at 5 % finds nine times in ten, all else being fitted beside it.
struct DetectableSize {
  Effect effect;
  int coefficient = 0;
  double size = 0.0;  ///< SI
};

struct Plan {
  std::vector<PlannedStop> stops;       ///< in the order of measuring
  MeasuringWay way;                     ///< `pose` of its stops: of `stops`, those it does not reach are the last of
                                        ///< them; empty where sockets are touched
  double travel_rad = 0.0;              ///< of the joint that moves most, summed up along the way
  std::array<std::size_t, 3> counts{};  ///< of stops by PoseSet
  double noise_m = 0.0;                 ///< of a measured position, per axis, as the predictions take it
  PredictedError predicted;             ///< of the tool, without what measuring adds
  double random_rms_m = 0.0;            ///< of as many poses drawn at random
  double bound_rms_m = 0.0;             ///< no poses of this space leave less, as many as these
  std::vector<CurvePoint> curve;
  std::vector<PlannedSocket> sockets;    ///< as poses count them: those of accept poses last
  std::vector<KnownDistance> lengths;    ///< between two of them
  std::vector<ErrorByPlaces> by_places;  ///< where sockets are touched
  std::vector<PredictedNumber> numbers;
  std::vector<UnidentifiedDirection> unidentified;
  std::vector<DetectableSize> detectable;
  std::vector<std::string> assumptions;  ///< sentences: what nobody stated, and what was taken instead
  std::vector<std::string> warnings;     ///< sentences: what may be wrong with the plan
  bool has_too_few_poses = false;        ///< for the numbers declared; the first warning says how many it takes
  std::size_t drawn = 0, feasible = 0;   ///< random joints tried, and how many of them were
  std::array<std::size_t, kObstructions> refused{};
  std::vector<Effect> effects;  ///< that it can tell apart
};

/// The ids of the poses that no free way was found to: "P64, P65"; empty where there are none.
std::string poses_by_hand(const Plan& plan);

/// The plan of a request; a function of its arguments. Throws InputError where the cell leaves fewer feasible poses
/// than are asked for, naming what refuses most, and where no number of poses is predicted to reach the accuracy.
Plan make_plan(const PlanRequest& request);

}  // namespace demecal::inline planning
