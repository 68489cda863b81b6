#include "planning/assumptions.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "effects/effect.hpp"
#include "fitting/fit.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/parameter_space.hpp"
#include "planning/candidates.hpp"
#include "planning/way.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline planning {
namespace {

constexpr double kInstrument_m = 20e-6;             ///< a laser tracker's noise at a few metres
constexpr double kPlay_m = 50e-6;                   ///< of a ball in its socket
constexpr double kUnknownNoise_m = 50e-6;           ///< where the arm's repeatability is not known either
constexpr double kRepeatabilityToAxis = 1.0 / 3.6;  ///< ISO 9283: mean distance plus three deviations, of three axes

/// The noise of a measured position per axis, m: as the cell states it, or of a tracker (a ball in its socket, where
/// sockets are touched) and the arm's repeatability.
double planned_noise_m(const Robot& robot, const WorkCell& cell, bool by_touch) {
  if (cell.noise_m) return *cell.noise_m;
  if (!robot.repeatability_m) return kUnknownNoise_m;
  return std::hypot(by_touch ? kPlay_m : kInstrument_m, kRepeatabilityToAxis * *robot.repeatability_m);
}

std::string radii_sentence(const PlanRequest& request, const WorkCell& cell) {
  return fmt::format(
      "{}: links are taken to reach {:.0f} mm, the tool {:.0f} mm about the lines between the joints.",
      request.cell ? "The cell file states no link_radius_mm" : "No cell file states how thick the arm is",
      millimetres(cell.radii_m.front()), millimetres(cell.radii_m.back()));
}

void say_surroundings(const PlanRequest& request, const FeasibleSpace& space, Plan& plan) {
  const WorkCell& cell = space.cell();
  auto& say = plan.assumptions;
  if (!request.cell || request.cell->radii_m.empty()) say.push_back(radii_sentence(request, cell));
  if (!request.cell && !cell.half_spaces.empty())
    say.push_back("The arm is taken to stand on the plane z = 0 of its base frame and to keep above it.");
  if (cell.half_spaces.empty() && !cell.tool_box && cell.obstacles.empty())
    plan.warnings.push_back(fmt::format(
        "Nothing is known of what stands about the arm, not even where the floor is: state it with --cell CELL.yaml "
        "before you {}.",
        request.places ? "set up the sockets" : "run the programs"));
  else if (!request.cell)
    plan.warnings.push_back(fmt::format(
        "Nothing is known of walls and obstacles about the arm: state them with --cell CELL.yaml, or {}.",
        request.places ? "look whether the arm can be led to each posture" : "run the programs slowly first"));
  if (!cell.instrument && !request.places)
    say.push_back(
        "Where the instrument stands is not known: every pose is taken to be visible, positions alone are "
        "measured.");
}

void say_sockets(const PlanRequest& request, Plan& plan) {
  auto& say = plan.assumptions;
  if (!request.cell)
    say.emplace_back(
        "No cell file states from where the tool may come: its flange's z axis is kept within 60 deg of straight down, "
        "as for sockets on a table.");
  if (!request.cell || !request.cell->sockets.box)
    say.emplace_back(
        "No cell file states where sockets may stand (`sockets.box_mm`): they may be anywhere that the tool gets, at "
        "heights of their own.");
  if (plan.lengths.empty())
    plan.warnings.emplace_back(
        "No length between sockets is known: the arm's scale will be known from its drawing alone. Two sockets in one "
        "block (`sockets.length_mm` of a cell file) would tell it.");
  say.emplace_back(
      "No programs are written: the arm is wrong by more than a socket gives way. Guide it by hand, or let it comply, "
      "near the planned joints, and write down the joints where the ball sits.");
  say.emplace_back(
      "Sockets stand where you put them, within some 20 mm of the plan; nobody needs to measure where. The last place "
      "is "
      "for accept poses alone, and is never fitted.");
}

void say_ranges(const FeasibleSpace& space, Plan& plan) {
  std::string joints;
  for (std::size_t i = 0; i < space.ranges().size(); ++i) {
    const Joint& joint = space.robot().chain.joints[i];
    if (!is_revolute(joint) || joint.upper - joint.lower <= 2.0 * 3.2) continue;
    joints += (joints.empty() ? "" : ", ") + std::to_string(i + 1);
  }
  if (!joints.empty())
    plan.assumptions.push_back(
        "Joints that may turn more than once stay within one turn about the middle of their "
        "range (joint " +
        joints + "); `joint_ranges` of a cell file says otherwise.");
}

void say_limits(const PlanRequest& request, Plan& plan) {
  constexpr double kNarrow_rad = radians(7.0);  // 2 pi, and some more
  bool turns = false;
  for (const Joint& joint : request.robot.chain.joints) {
    if (!is_revolute(joint)) continue;
    if (std::max(std::abs(joint.lower), std::abs(joint.upper)) >= kNarrow_rad) return;
    turns = true;
  }
  if (turns)
    plan.warnings.push_back(
        "All joints of " + request.robot.name +
        " that turn have limits within 7 deg: if these are radians, state `limits_deg` in degrees.");
}

void say_tool(const PlanRequest& request, Plan& plan) {
  constexpr double kOnAxis_m = 5e-3;
  const Chain& chain = request.robot.chain;
  if (!request.tools_m.empty() || !is_revolute(chain, chain.size() - 1)) return;
  const JointVector middle = JointVector::Zero(chain.size());
  const Jacobian jacobian = joint_jacobian(chain, middle, chain.tool_m);
  const double lever_m = jacobian.col(chain.size() - 1).head<3>().norm();
  if (lever_m > kOnAxis_m) return;
  plan.warnings.push_back(
      fmt::format("The target is {:.1f} mm off the axis of joint {}: nothing can be known of that joint's zero. Mount "
                  "it, or a second one, 50 mm or more off the axis.",
                  millimetres(lever_m), chain.size()));
}

/// Without what effects of a kind do not show.
std::string lacking(const std::string& kind, const Robot& robot) {
  const Effect any{.kind = kind};
  const EffectLaw& law = law_of(any);
  if (law.takes_formula()) return "formulas are found in what was measured";
  const Needs needs = law.needs(any, robot);
  if (needs.temperature) return "it takes poses at several temperatures, which a plan does not know of";
  if (needs.time) return "it takes the times of the poses, which a plan does not know";
  if (needs.masses && robot.masses.empty()) return "the robot file states no masses of links (`links`)";
  return "by the robot file there is nothing on this arm that has it";
}

/// Whether one of these directions is of the same numbers.
bool is_among(const std::vector<UnidentifiedDirection>& directions, const UnidentifiedDirection& one) {
  const auto numbers = [](const UnidentifiedDirection& direction) {
    std::set<std::string> names;
    for (const auto& [id, share] : direction.parts) names.insert(id.name());
    return names;
  };
  return std::ranges::any_of(directions, [&](const auto& other) { return numbers(other) == numbers(one); });
}

bool is_held(const std::vector<UnidentifiedDirection>& directions, const ParameterId& id) {
  return std::ranges::any_of(directions, [&](const UnidentifiedDirection& direction) {
    return std::ranges::any_of(direction.parts, [&](const auto& part) { return part.first == id; });
  });
}

}  // namespace

PlannedModel model_of(const PlanRequest& request, const FeasibleSpace& space) {
  PlannedModel model;
  model.by_touch = request.places.has_value();
  model.nominal.robot = request.robot;
  model.nominal.tools_m = request.tools_m;
  model.declared = request.declared;
  model.orientation = space.cell().instrument && space.cell().instrument->measures_orientation;
  model.effects = effects_to_detect(request.robot, space.ranges(), request.detect, model.orientation);
  model.noise_m = planned_noise_m(request.robot, space.cell(), model.by_touch);
  return model;
}

int fewest_poses(const InformationModel& model) {
  return static_cast<int>(model.ids().size()) / model.rows_per_pose() + 1;
}

void describe_numbers(const InformationModel& model, const std::vector<PlannedPose>& poses,
                      const Eigen::MatrixXd& covariance, Plan& plan) {
  constexpr double kFoundNineInTen = 1.645 + 1.282;
  const FitOptions options;
  const Eigen::VectorXd& beliefs = model.beliefs();
  const Eigen::MatrixXd in_units = beliefs.asDiagonal() * covariance * beliefs.asDiagonal();
  const ScaledJacobian jacobian = model.jacobian(poses);
  Eigen::VectorXd precision = Eigen::VectorXd::Zero(beliefs.size());
  for (std::size_t i = 0; i < model.ids().size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (model.ids()[i].kind == ParameterId::Kind::link) precision[at] = 1.0 / beliefs[at];
  }
  plan.unidentified = identifiable_subspace(jacobian, model.ids(), options.rank_tolerance).held;
  for (UnidentifiedDirection& weak : weak_directions(jacobian, model.ids(), in_units, precision))
    if (!is_among(plan.unidentified, weak)) plan.unidentified.push_back(std::move(weak));
  leave_out_contacts(plan.unidentified);
  const CorrectedRobot nominal = nominal_robot(model.model().nominal);
  for (std::size_t i = 0; i < model.ids().size(); ++i) {
    const ParameterId& id = model.ids()[i];
    if (id.kind == ParameterId::Kind::contact) continue;
    const auto at = static_cast<Eigen::Index>(i);
    const double deviation = std::sqrt(std::max(0.0, in_units(at, at)));
    plan.numbers.push_back({id, parameter_value(nominal, id), deviation, !is_held(plan.unidentified, id)});
    if (id.kind == ParameterId::Kind::effect)
      plan.detectable.push_back(
          {model.model().effects[static_cast<std::size_t>(id.index)], id.coefficient, kFoundNineInTen * deviation});
  }
}

void describe_assumptions(const PlanRequest& request, const FeasibleSpace& space, const InformationModel& model,
                          Plan& plan) {
  if (!space.cell().noise_m)
    plan.assumptions.push_back(
        fmt::format("No cell file states the noise of a measured position: {:.3g} mm per axis is assumed ({}).",
                    millimetres(plan.noise_m),
                    !request.robot.repeatability_m ? "the robot file states no repeatability"
                    : request.places ? "play of a ball in its socket, and the repeatability in the robot file"
                                     : "a laser tracker, and the repeatability in the robot file"));
  say_surroundings(request, space, plan);
  if (request.places) say_sockets(request, plan);
  if (request.measured)
    plan.assumptions.push_back(
        "The plan goes on from " + request.measured->name +
        ": predicted errors count its poses too, and take the instrument and the targets to be where they were then.");
  say_ranges(space, plan);
  say_tool(request, plan);
  say_limits(request, plan);
  plan.assumptions.emplace_back(
      "Predicted errors are those of the numbers declared: what the arm does besides comes on top, and is what the "
      "validation poses will show.");
  const auto calibration = static_cast<int>(plan.counts[0]);
  if (calibration < fewest_poses(model) && !request.measured) {
    plan.has_too_few_poses = true;
    plan.warnings.insert(plan.warnings.begin(),
                         fmt::format("{} poses are too few for the {} numbers declared: it takes {} at least. The "
                                     "predicted errors rest on what makers' figures are believed to within.",
                                     calibration, model.ids().size(), fewest_poses(model)));
  }
  for (const std::string& kind : request.detect) {
    const bool found = std::ranges::any_of(plan.effects, [&](const Effect& effect) { return effect.kind == kind; });
    if (!found)
      plan.warnings.push_back("No measurement of this plan shows effects of the kind " + kind + ": " +
                              lacking(kind, request.robot) + ".");
  }
  if (!plan.way.blocked.empty())
    plan.warnings.push_back(
        fmt::format("No way that keeps to the cell was found to {} of {} poses: programs leave {} out. Drive there by "
                    "hand, measure without them, or widen the cell.",
                    plan.way.blocked.size(), plan.stops.size(), poses_by_hand(plan)));
}

}  // namespace demecal::inline planning
