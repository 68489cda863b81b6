#include "updating/unstated.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "kinematics/units.hpp"
#include "prediction/lacking_circumstances.hpp"

namespace demecal::inline updating {
namespace {

/// A stop at which a circumstance is so much more than what an effect takes where it is not stated.
struct Unstated {
  const Effect& effect;
  const Robot& robot;
  int joint = 0;  ///< whose side it is; of other circumstances without meaning
};

double setting_or(const Effect& effect, const std::string& name, double otherwise) {
  const auto found = effect.settings.find(name);
  return found == effect.settings.end() ? otherwise : found->second;
}

/// What arms are made to carry grows about with the square of their reach.
double usual_payload_kg(const Chain& chain) {
  constexpr double kKilogramsAtOneMetre = 5.0;
  double length_m = 0.0;
  for (const Joint& joint : chain.joints) length_m += std::hypot(joint.a_m, joint.d_m);
  return kKilogramsAtOneMetre * length_m * length_m;
}

/// How a circumstance varies: standard deviations of what all poses have in common, and of each by itself.
struct UsualSpread {
  bool Needs::*of;
  double shared, own;
  bool by_joint;
  void (*vary)(const Unstated& what, Stop& stop);
};

/// Torques are missing here: where none are stated, effects take the weight that was told of, which is known.
constexpr std::array<UsualSpread, 4> kUsualSpreads{
    {{&Needs::approach, 1.0, 1.0, true,
      [](const Unstated& what, Stop& stop) {
        stop.approach = ApproachSigns::Zero(stop.joints.size());
        stop.approach[what.joint] = 1.0;
      }},
     {&Needs::payload, 1.0, 0.5, false,
      [](const Unstated& what, Stop& stop) { stop.payload_kg = usual_payload_kg(what.robot.chain); }},
     {&Needs::temperature, 10.0, 5.0, false,  // K: from a cold hall in the morning to a warm arm
      [](const Unstated& what, Stop& stop) {
        stop.temperature_celsius = setting_or(what.effect, "reference_celsius", 20.0) + 1.0;
      }},
     {&Needs::time, 3600.0, 1800.0, false,  // s: of a session
      [](const Unstated& what, Stop& stop) { stop.time_s = setting_or(what.effect, "reference_time_s", 0.0) + 1.0; }}}};

bool is_recorded(bool Needs::*needed, const MeasuredPose& pose) {
  for (const CircumstanceWords& one : circumstances())
    if (one.needed == needed) return one.recorded(pose);
  return true;
}

/// What an effect does to a pose's rows at such a stop.
void add_rows(const Unstated& what, const ResidualField& field, std::size_t pose, const Stop& stop, double times,
              Eigen::VectorXd& rows) {
  ArmState state = arm_state(what.robot, stop);
  state.tool_in_sensor_m = field.states[pose].tool_in_sensor_m;
  std::vector<UnitMotion> motions;
  append_unit_motions(what.effect, what.robot, state, motions);
  for (const UnitMotion& one : motions)
    rows += times * what.effect.value(static_cast<std::size_t>(one.coefficient)) * one.size *
            field.motions.block(field.first_row[pose], motion_column(one.place, one.axis), field.rows_of_pose(pose), 1);
}

/// How a pose's rows change where the circumstance that it does not state is one more.
Eigen::VectorXd change_of_rows(const CorrectedRobot& robot, const DataSet& data, const ResidualField& field,
                               std::size_t pose, const UsualSpread& spread, int joint) {
  Eigen::VectorXd rows = Eigen::VectorXd::Zero(field.rows_of_pose(pose));
  for (const Effect& effect : robot.effects) {
    if (!(robot.needs(effect).*spread.of)) continue;
    const Unstated what{effect, data.robot, joint};
    Stop varied = field.states[pose].stop;
    spread.vary(what, varied);
    add_rows(what, field, pose, varied, 1.0, rows);
    add_rows(what, field, pose, field.states[pose].stop, -1.0, rows);
  }
  return rows;
}

}  // namespace

double add_unstated(const CorrectedRobot& robot, const DataSet& data, const ResidualField& field,
                    Eigen::MatrixXd& covariance) {
  double squares = 0.0;
  for (const UsualSpread& spread : kUsualSpreads) {
    const bool needed =
        std::ranges::any_of(robot.effects, [&](const Effect& effect) { return robot.needs(effect).*spread.of; });
    for (int joint = 0; needed && joint < (spread.by_joint ? data.robot.chain.size() : 1); ++joint) {
      Eigen::VectorXd together = Eigen::VectorXd::Zero(field.rows());
      for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
        if (is_recorded(spread.of, data.poses[field.poses[pose]])) continue;
        const Eigen::VectorXd rows = change_of_rows(robot, data, field, pose, spread, joint);
        const Eigen::Index first = field.first_row[pose], count = rows.size();
        together.segment(first, count) = spread.shared * rows;
        covariance.block(first, first, count, count) += spread.own * spread.own * rows * rows.transpose();
        squares += std::pow(std::max(spread.shared, spread.own), 2.0) * rows.squaredNorm();
      }
      covariance += together * together.transpose();
    }
  }
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, field.poses.size())));
}

std::vector<std::string> unstated_sentences(const CorrectedRobot& robot, const DataSet& data,
                                            std::span<const std::size_t> poses, double moved_m, double noise_m) {
  constexpr double kNotable = 0.1;  // of the noise
  std::vector<std::string> sentences;
  if (moved_m < kNotable * noise_m) return sentences;
  for (const LackingCircumstance& one : lacking_circumstances(robot, data, poses)) {
    if (one.words->needed != &Needs::torque) sentences.push_back(to_string(one) + '.');
  }
  if (!sentences.empty())
    sentences.back() += fmt::format(
        " What it may usually be moves the tool by {:.2g} mm (rms) and counts as noise: changes below "
        "that may be missed.",
        millimetres(moved_m));
  return sentences;
}

}  // namespace demecal::inline updating
