#include "parameters/posterior.hpp"
#include "programs/correct_program.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "data/text.hpp"
#include "effects/effect.hpp"
#include "expression/bound.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/inverse.hpp"
#include "kinematics/units.hpp"
#include "parsed_programs/orientation.hpp"
#include "parsed_programs/program.hpp"
#include "prediction/corrected_robot.hpp"
#include "programs/command_model.hpp"
#include "programs/followed_motions.hpp"
#include "programs/nominal_joints.hpp"
#include "programs/target_correction.hpp"

namespace demecal::inline programs {
namespace {

constexpr double kLimitRounding = 1e-4;  ///< rad or m: files round, and the ends of ranges are poses themselves
constexpr double kLargestUsual = 0.05;   ///< rad or m: errors of arms are a tenth of it

void check_limits(int joint, const Joint& link, const CorrectedTarget& corrected, std::vector<std::string>& sentences) {
  const std::string limits = joint_amount(link, link.lower) + " .. " + joint_amount(link, link.upper);
  if (beyond_limits(link, corrected.nominal[joint]) > kLimitRounding) {
    sentences.push_back(joint_label(joint) + " is sent to " + joint_amount(link, corrected.nominal[joint]) +
                        ", outside its limits " + limits);
  } else if (beyond_limits(link, corrected.command[joint]) > kLimitRounding) {
    sentences.push_back("the correction takes " + joint_label(joint) + " to " +
                        joint_amount(link, corrected.command[joint]) + ", outside its limits " + limits);
  }
}

void check_range(int joint, const Joint& link, const CorrectedTarget& corrected, const CommandModel& model,
                 std::vector<std::string>& sentences) {
  const double value = corrected.nominal[joint];
  const bool corrected_range = distance_outside_calibrated(model.robot, joint, value) > kLimitRounding;
  const std::optional<Interval> range =
      corrected_range ? calibrated_range(model.robot, joint) : outside_measured(model, joint, value);
  if (const std::optional<Interval> gap = inside_gap(model, joint, value))
    sentences.push_back(joint_label(joint) + " is sent to " + joint_amount(link, value) +
                        ", inside a stretch without any measured pose, " + joint_amount(link, gap->lower) + " .. " +
                        joint_amount(link, gap->upper) + ": what the joint does there was not seen");
  if (!range) return;
  sentences.push_back(joint_label(joint) + " is sent to " + joint_amount(link, value) +
                      ", outside the calibrated range " + joint_amount(link, range->lower) + " .. " +
                      joint_amount(link, range->upper));
}

/// What the model would ask for without its joint corrections: their bounds speak of the rest.
JointVector without_formulas(const CorrectedTarget& corrected, const CommandModel& model) {
  CorrectedRobot robot = model.robot;
  for (JointCorrection& correction : robot.corrections) correction = {};
  return command_reaching(robot, corrected.goal, corrected.stop, {.held = corrected.held}).q;
}

void check_bounds(const CorrectedTarget& corrected, const CommandModel& model, std::vector<std::string>& sentences) {
  const JointVector change = corrected.inverse - corrected.nominal;
  std::optional<JointVector> rest;
  for (int joint = 0; joint < change.size(); ++joint) {
    const double bound = model.bounds[static_cast<std::size_t>(joint)];
    const Joint& link = model.nominal.chain.joints[static_cast<std::size_t>(joint)];
    double allowed = bound * (1.0 + 1e-6) + 1e-9;
    if (std::isfinite(bound) && std::abs(change[joint]) > allowed) {
      if (!rest) rest = without_formulas(corrected, model);
      allowed += std::abs((*rest)[joint] - corrected.nominal[joint]);
      if (std::abs(change[joint]) > allowed) {
        sentences.push_back("the correction of " + joint_label(joint) + ", " + joint_amount(link, change[joint]) +
                            ", is larger than the bound that the model states, " + joint_amount(link, bound));
        continue;
      }
    }
    if (std::abs(change[joint]) <= kLargestUsual) continue;
    sentences.push_back("the correction of " + joint_label(joint) + ", " + joint_amount(link, change[joint]) +
                        ", is larger than errors of arms are; is the pose near a singularity?");
  }
}

/// What should be known of a tool that the user names for this program.
void check_given_tool(const Program& program, const Eigen::Vector3d& tool_m, std::vector<std::string>& sentences) {
  constexpr double kAnother = 1e-4;  ///< m
  const auto another = [&](const Target& target) {
    return target.frames.tool && (target.frames.tool->translation() - tool_m).norm() > kAnother;
  };
  if (std::any_of(program.targets.begin(), program.targets.end(), another)) {
    sentences.emplace_back(
        "the program states a tool that is not the one given with --tool-mm; where it states one, that one is "
        "corrected");
  }
  if (untold_tools(program).size() != 1) return;
  sentences.emplace_back(
      "the tool given with --tool-mm stands in for one that the file does not give; its axes are taken to be those of "
      "the flange");
}

/// "compliance of joint 2", or how many effects there are.
std::string names_of(const std::vector<const Effect*>& effects) {
  if (effects.size() > 2) return std::to_string(effects.size()) + " effects";
  std::string names;
  for (const Effect* const effect : effects) {
    names += (names.empty() ? "" : " and ") + effect->kind;
    if (effect->joint >= 0) names += " of joint " + std::to_string(effect->joint + 1);
  }
  return names;
}

/// "line 3, 5 and 2 more": of these statements.
std::string statement_lines(const Program& program, const std::vector<const PayloadStatement*>& statements) {
  constexpr std::size_t kNamed = 3;
  std::string places = statements.size() == 1 ? "line " : "lines ";
  for (std::size_t i = 0; i < std::min(statements.size(), kNamed); ++i) {
    const TextPlace& place = statements[i]->place;
    places += (i == 0 ? "" : ", ") + std::to_string(place.line) +
              (program.further.empty() ? "" : " of " + program.file_name(place.file));
  }
  return places + (statements.size() > kNamed ? " and " + std::to_string(statements.size() - kNamed) + " more" : "");
}

/// Of a program whose statements set the payload, some of its targets being reached with one that is not told.
std::string set_payload_sentence(const Program& program, const Circumstances& given) {
  std::vector<const PayloadStatement*> all, unread;
  for (const PayloadStatement& one : program.payload_statements) {
    all.push_back(&one);
    if (!one.kg) unread.push_back(&one);
  }
  const auto is_untold = [](const Target& target) { return !target.payload_kg; };
  const auto untold = static_cast<std::size_t>(std::ranges::count_if(program.targets, is_untold));
  const std::string why =
      unread.empty() ? "ways on which it is not set, or set otherwise, lead to them"
                     : statement_lines(program, unread) + (unread.size() == 1 ? " names" : " name") +
                           " it by a number of the controller's, together with the tool's, or by what is computed";
  const std::string taken =
      given.payload_kg ? number_text(*given.payload_kg) + " kg, of --payload-kg, is" : "an empty hand is";
  return "the payload, which the program sets in " + statement_lines(program, all) + "; of " +
         counted(untold, "target") + " it is not told (" + why + "), and " + taken + " taken there" +
         (given.payload_kg ? ""
                           : ", with a radius that allows for what the arm was measured with; --payload-kg tells it");
}

/// What the model's effects depend on and nobody states; the side of approach follows from the motions.
void check_circumstances(const Program& program, const CommandModel& model, const Circumstances& given,
                         std::vector<std::string>& sentences) {
  const auto stated = [&](const CircumstanceWords& one) {
    const auto by_all = [&](auto member) {
      return std::ranges::all_of(program.targets, [=](const Target& target) { return (target.*member).has_value(); });
    };
    if (one.needed == &Needs::payload)
      return by_all(&Target::payload_kg) || (given.payload_kg.has_value() && program.payload_statements.size() < 2);
    if (one.needed == &Needs::temperature)
      return given.temperature_celsius.has_value() || by_all(&Target::temperature_celsius);
    return one.needed == &Needs::approach || one.needed == &Needs::time;
  };
  for (const CircumstanceWords& one : circumstances()) {
    if (stated(one)) continue;
    std::vector<const Effect*> depending;
    for (const Effect& effect : model.robot.effects) {
      if (model.robot.needs(effect).*one.needed) depending.push_back(&effect);
    }
    if (depending.empty()) continue;
    std::string option;
    if (one.needed == &Needs::payload) option = "; --payload-kg tells it";
    if (one.needed == &Needs::temperature) option = "; --temperature-celsius tells it";
    const std::string depend = names_of(depending) + (depending.size() == 1 ? " depends on " : " depend on ");
    if (one.needed == &Needs::payload && !program.payload_statements.empty()) {
      sentences.push_back(depend + set_payload_sentence(program, given));
      continue;
    }
    sentences.push_back(depend + std::string(one.words) +
                        ", which the program does not state: " + std::string(one.instead) + " is taken" + option);
  }
}

}  // namespace

std::vector<std::string> warnings_of(const CorrectedTarget& corrected, const CommandModel& model) {
  if (corrected.outcome == CorrectionOutcome::no_joints) {
    return {"the nominal robot does not reach the pose; it is left as it is"};
  }
  std::vector<std::string> sentences = corrected.remarks;
  if (corrected.outcome == CorrectionOutcome::uncorrected) return sentences;
  for (int joint = 0; joint < model.nominal.chain.size(); ++joint) {
    const Joint& link = model.nominal.chain.joints[static_cast<std::size_t>(joint)];
    check_limits(joint, link, corrected, sentences);
    check_range(joint, link, corrected, model, sentences);
  }
  check_bounds(corrected, model, sentences);
  if (corrected.outcome == CorrectionOutcome::nearest) {
    sentences.push_back("the model has no exact inverse here; " + fixed_text(millimetres(corrected.residual_m), 4) +
                        " mm of position error and " + fixed_text(degrees(corrected.residual_rad), 4) +
                        " deg of orientation error remain");
  }
  return sentences;
}

namespace {

/// Where targets carry what the arm was not measured with, or are warmer or colder than it was then.
class UnmeasuredCircumstances {
 public:
  UnmeasuredCircumstances(std::string subject, std::string unit, const std::optional<Interval>& measured)
      : subject_(std::move(subject)), unit_(std::move(unit)), measured_(measured) {}

  void see(const std::optional<double>& value) {
    constexpr double kSame = 1e-9;
    if (!value || !measured_) return;
    const double outside = std::max(*value - measured_->upper, measured_->lower - *value);
    if (outside <= std::max(outside_, kSame)) return;
    outside_ = outside;
    farthest_ = *value;
  }

  void say(std::vector<std::string>& sentences) const {
    if (outside_ <= 0.0) return;
    sentences.push_back("the " + subject_ + " of " + number_text(farthest_) + " " + unit_ + " is outside the " +
                        number_text(measured_->lower) + " .. " + number_text(measured_->upper) + " " + unit_ +
                        " that the arm was measured with: how it errs there was not seen, and the radii (± ... mm) are "
                        "widened by judgement; measure some poses at that " +
                        subject_);
  }

 private:
  std::string subject_, unit_;
  std::optional<Interval> measured_;
  double outside_ = 0.0, farthest_ = 0.0;
};

void check_unmeasured(const Program& program, const CommandModel& model, const Circumstances& given,
                      std::vector<std::string>& sentences) {
  UnmeasuredCircumstances payload("payload", "kg", model.robot.payloads_kg);
  UnmeasuredCircumstances temperature("temperature", "°C", model.robot.temperatures_celsius);
  payload.see(given.payload_kg);
  temperature.see(given.temperature_celsius);
  for (const Target& target : program.targets) {
    payload.see(target.payload_kg);
    temperature.see(target.temperature_celsius);
  }
  payload.say(sentences);
  temperature.say(sentences);
}

/// Poses that leave the arm's joints to its controller.
void check_redundancy(const Program& program, const Chain& arm, std::vector<std::string>& sentences) {
  const auto leaves = [&](const Target& one) { return one.is_pose() && arm.size() - std::ssize(one.carried) > 6; };
  if (std::ranges::none_of(program.targets, leaves)) return;
  sentences.push_back("poses do not say at which angles of its " + std::to_string(arm.size()) +
                      " joints the arm reaches them: they are corrected for angles near those before (or --near), and "
                      "where the controller takes another elbow another correction is due; targets by joints tell");
}

}  // namespace

std::vector<std::string> warnings_of(const Program& program, const CommandModel& model,
                                     const Circumstances& circumstances) {
  std::vector<std::string> sentences = model.notes;
  const auto takes_models_tool = [](const Target& target) { return !target.frames.tool; };
  if (!model.tool_note.empty() && std::ranges::any_of(program.targets, takes_models_tool))
    sentences.push_back(model.tool_note);
  if (model.posterior && model.interval && model.interval->fitted)
    sentences.emplace_back(
        "the radii that hold 95 % (± ... mm) come from the poses to which the model was fitted, since it had no "
        "validation poses: they may be too small");
  if (model.posterior && model.interval && model.interval->along_path)
    sentences.emplace_back("the radii that hold 95 % (± ... mm): " + std::string(kAlongPathRemark));
  if (program.targets.empty()) {
    const bool moves = !program.uncorrected.empty() || !program.joints_lost_at.empty();
    sentences.emplace_back(
        moves ? "no targets were found that can be corrected"
              : "it holds no motion and no point: there is nothing to correct, and it is written as it was");
  }
  const auto unknown = [](const Target& target) { return target.is_pose() && target.form == OrientationForm::unknown; };
  if (std::any_of(program.targets.begin(), program.targets.end(), unknown)) {
    sentences.emplace_back(
        "positions without orientation: they are corrected for the joints nearest to those of the target before");
  }
  check_redundancy(program, model.nominal.chain, sentences);
  check_circumstances(program, model, circumstances, sentences);
  check_unmeasured(program, model, circumstances, sentences);
  for (const Effect& effect : model.robot.effects)
    if (const std::string_view reversal = law_of(effect).reversal(effect); !reversal.empty())
      sentences.push_back(names_of({&effect}) + ": " + std::string(reversal));
  if (circumstances.tool_given) check_given_tool(program, model.nominal.chain.tool_m, sentences);
  return sentences;
}

}  // namespace demecal::inline programs
