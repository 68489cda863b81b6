#include "programs/correct_program.hpp"

#include <algorithm>
#include <cmath>

#include "effects/command.hpp"
#include "programs/concerns.hpp"
#include "programs/nominal_joints.hpp"
#include "programs/orientation.hpp"
#include "programs/replace.hpp"

namespace demecal {
namespace {

constexpr double kMoved = 2e-3;  ///< rad or m: a joint that changes by less has not moved
constexpr double kExact = 1e-9;  ///< m
constexpr int kMostRepetitions = 10;

std::vector<double> inside(const std::vector<Cell>& cells) {
  std::vector<double> values;
  for (const Cell& cell : cells) values.push_back(cell.inside());
  return values;
}

Eigen::Vector3d point_of(const Target& target) {
  return {target.position[0].inside(), target.position[1].inside(), target.position[2].inside()};
}

class Corrector {
 public:
  Corrector(const CommandModel& model, const Circumstances& circumstances)
      : model_(model), circumstances_(circumstances), last_(middle_joints(model)) {
    signs_.setZero(last_.size());
  }

  CorrectedTarget correct(const Target& target) {
    CorrectedTarget corrected;
    const std::optional<JointVector> nominal = joints_of(target);
    if (!nominal) return corrected;
    corrected.nominal = *nominal;
    note_motion(*nominal);
    corrected.nominal_tool = model_.nominal_tool(*nominal);
    command(target, corrected);
    corrected.command_tool = model_.nominal_tool(corrected.command);
    if (target.is_pose()) settle_position(target, corrected);
    write(target, corrected);
    return corrected;
  }

 private:
  std::optional<JointVector> joints_of(const Target& target) const {
    if (!target.is_pose()) {
      JointVector joints(std::ssize(target.joints));
      for (Eigen::Index i = 0; i < joints.size(); ++i) joints[i] = target.joints[static_cast<std::size_t>(i)].inside();
      return joints;
    }
    if (target.form == OrientationForm::unknown) return joints_at_point(model_.nominal.chain, point_of(target), last_);
    Eigen::Isometry3d tool(rotation_from(target.form, inside(target.orientation)));
    tool.translation() = point_of(target);
    return nominal_joints(model_.nominal.chain, tool, target.hint, last_);
  }

  /// Takes the signs of the motion to here.
  void note_motion(const JointVector& joints) {
    for (Eigen::Index i = 0; i < joints.size() && started_; ++i) {
      const double change = joints[i] - last_[i];
      if (std::abs(change) >= kMoved) signs_[i] = change > 0.0 ? 1.0 : -1.0;
    }
    last_ = joints;
    started_ = true;
  }

  Stop stop_at(const Target& target, const JointVector& joints) const {
    Stop stop(joints);
    stop.approach = target.approach.value_or(signs_);
    stop.payload_kg = target.payload_kg.value_or(circumstances_.payload_kg);
    stop.temperature_celsius =
        target.temperature_celsius ? target.temperature_celsius : circumstances_.temperature_celsius;
    stop.time_s = target.time_s;
    return stop;
  }

  void command(const Target& target, CorrectedTarget& corrected) const {
    corrected.stop = stop_at(target, corrected.nominal);
    const InverseSolution solution = command_reaching(model_.robot, corrected.nominal_tool, corrected.stop);
    corrected.inverse = corrected.command = solution.q;
    corrected.outcome = solution.status == InverseStatus::converged ? Correctedness::corrected : Correctedness::nearest;
    corrected.left_m = solution.position_residual_m;
  }

  /// Where the orientation is kept, moves the position until the model predicts the tool point at the target's.
  void settle_position(const Target& target, CorrectedTarget& corrected) const {
    const bool kept = target.form == OrientationForm::columns || target.form == OrientationForm::unknown;
    if (!kept || corrected.command == corrected.nominal) return;
    Eigen::Isometry3d tool(corrected.nominal_tool.linear());
    tool.translation() = corrected.command_tool.translation();
    JointVector joints = corrected.command;
    for (int repetition = 0; repetition < kMostRepetitions; ++repetition) {
      const auto solved = nominal_joints(model_.nominal.chain, tool, {.near = joints}, joints);
      if (!solved) return;
      joints = *solved;
      const Eigen::Vector3d error = corrected.nominal_tool.translation() -
                                    model_.robot.predict(corrected.stop.with_joints(joints), "").translation();
      const bool first = repetition == 0;
      if (first || error.norm() <= corrected.left_m) {
        corrected.command = joints;
        corrected.command_tool = tool;
        corrected.left_m = error.norm();
      }
      if (error.norm() < kExact) {
        corrected.outcome = Correctedness::corrected;
        return;
      }
      tool.translation() += error;
    }
  }

  void write(const Target& target, CorrectedTarget& corrected) const {
    const bool changed = corrected.command != corrected.nominal;
    const auto add = [&](const Cell& cell, double value) {
      corrected.texts.push_back(changed ? rewritten(cell, value).value_or("") : "");
    };
    for (std::size_t i = 0; i < target.joints.size(); ++i) {
      add(target.joints[i], corrected.command[static_cast<Eigen::Index>(i)]);
    }
    for (std::size_t i = 0; i < target.position.size(); ++i) {
      add(target.position[i], corrected.command_tool.translation()[static_cast<Eigen::Index>(i)]);
    }
    if (target.form == OrientationForm::columns || target.form == OrientationForm::unknown) return;
    const std::vector<double> numbers =
        numbers_of(corrected.command_tool.linear(), target.form, inside(target.orientation));
    for (std::size_t i = 0; i < numbers.size(); ++i) add(target.orientation[i], numbers[i]);
  }

  const CommandModel& model_;
  Circumstances circumstances_;
  JointVector last_;
  ApproachSigns signs_;
  bool started_ = false;
};

}  // namespace

CorrectedProgram correct_program(std::string_view text, Program program, const CommandModel& model,
                                 const Circumstances& circumstances) {
  CorrectedProgram result{std::move(program), {}, {}, {}};
  Corrector corrector(model, circumstances);
  for (std::string& sentence : concerns(result.program, model)) {
    result.warnings.push_back({kWholeProgram, "", std::move(sentence)});
  }
  result.warnings.insert(result.warnings.end(), result.program.left.begin(), result.program.left.end());
  for (const Target& target : result.program.targets) {
    result.targets.push_back(corrector.correct(target));
    for (std::string& sentence : concerns(target, result.targets.back(), model)) {
      result.warnings.push_back({target.place, target.name, std::move(sentence)});
    }
  }
  std::stable_sort(result.warnings.begin(), result.warnings.end(), [](const Remark& one, const Remark& other) {
    return one.place.line != other.place.line ? one.place.line < other.place.line
                                              : one.place.column < other.place.column;
  });
  result.text = replaced(text, result.program, result.targets);
  return result;
}

}  // namespace demecal
