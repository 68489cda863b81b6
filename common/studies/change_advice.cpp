#include "studies/change_advice.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <functional>
#include <set>
#include <vector>

#include "effects/effect.hpp"
#include "kinematics/units.hpp"
#include "next_measurement/next_measurement.hpp"
#include "parameters/declared_model.hpp"
#include "updating/implausible_change.hpp"

namespace demecal::inline studies {
namespace {

constexpr double kMilliPerUnit = 1e3;

/// What the model corrects and what changed since, together.
Effect with_model(const ChangeCause& cause) {
  Effect both = cause.effect;
  if (!both.values.empty()) both.values.front() += cause.by_model.value_or(0.0);
  return both;
}

/// What of a joint may have become more or less, where the model has it already.
bool is_lost_motion(const ChangeCause& cause) {
  return cause.by_model && law_of(cause.effect).prerequisite() == Circumstance::approach;
}

/// Beyond what its uncertainty allows it is of the wrong sign: no lost motion.
bool stops_beyond(const ChangeCause& cause) {
  constexpr double kSure = 2.0;
  return is_lost_motion(cause) && *cause.by_model + cause.size < -kSure * cause.standard_error;
}

bool heats(const ChangeCause& cause) {
  return law_of(cause.effect).prerequisite() == Circumstance::temperature;
}

bool has_grown(const ChangeCause& cause) {
  return is_lost_motion(cause) && cause.size > 0.0;
}

bool has_fallen(const ChangeCause& cause) {
  return is_lost_motion(cause) && cause.size <= 0.0 && !stops_beyond(cause);
}

using IsOf = std::function<bool(const ChangeCause&)>;

bool any_is(const ChangeReport& change, const IsOf& is_of) {
  return std::ranges::any_of(change.found, is_of);
}

/// "joints 2 and 3"; empty where none is.
std::string named_joints(const ChangeReport& change, const IsOf& is_of) {
  std::set<int> joints;
  for (const ChangeCause& cause : change.found)
    if (law_of(cause.effect).subject() == Subject::joint && is_of(cause)) joints.insert(cause.effect.joint + 1);
  if (joints.empty()) return {};
  return fmt::format("joint{} {}", joints.size() > 1 ? "s" : "", fmt::join(joints, " and "));
}

/// About the joints, one sentence without its stop for each kind of change.
std::vector<std::string> advice_on_joints(const ChangeReport& change) {
  const auto is_zero = [](const ChangeCause& cause) {
    return declared_flag(cause.effect.kind) == &DeclaredModel::joint_offset;
  };
  std::vector<std::string> advice;
  const auto add = [&](const IsOf& is_of, const std::string& before, const std::string& after) {
    const std::string joints = named_joints(change, is_of);
    if (!joints.empty()) advice.push_back(before + joints + after);
  };
  const auto may_be_heat = [&](const ChangeCause& cause) {
    return is_zero(cause) && std::ranges::any_of(change.warmed, [&](const WarmedZero& one) {
             return one.may_be_heat && one.joint == cause.effect.joint;
           });
  };
  const auto may_be_tool = [&](const ChangeCause& cause) {
    return is_zero(cause) && std::ranges::any_of(change.tried, [&](const ChangeCause& tool) {
             return law_of(tool.effect).subject() == Subject::tool &&
                    std::ranges::count(cause.rivals, to_string(tool.effect)) > 0;
           });
  };
  add(may_be_heat, "Look at the temperature first: heat alone may do what was found of ",
      ", whose zero need not have moved. Check again at the temperature of the calibration, and master the joint only "
      "where its zero is off then, too");
  add(may_be_tool,
      "See first whether the target was turned or shifted on the flange, which these poses cannot tell from the zero "
      "of ",
      "");
  add([&](const ChangeCause& cause) { return is_zero(cause) && !may_be_heat(cause); }, "Look at ",
      ": where a zero has moved, master it again");
  add(has_grown, "Have the gear of ", " inspected, whose lost motion has grown");
  add(has_fallen, "The lost motion of ",
      " is less than the model corrects for, as after work on a gear: what was corrected by the "
      "model now goes too far");
  add(stops_beyond, "See whether the signs of approach of ",
      " are stated the right way round, and whether the controller makes up for more lost motion than there is");
  add([&](const ChangeCause& cause) { return !is_zero(cause) && !is_lost_motion(cause) && !heats(cause); }, "Look at ",
      "");
  add([&](const ChangeCause& cause) { return heats(cause); }, "Let a model correct what the temperature does to ",
      ", or have the arm as warm as it was at its calibration");
  return advice;
}

/// Nothing if the change is no larger than changes are.
std::string caution_on_size(const ChangeReport& change) {
  if (!is_far_beyond_usual(change)) return {};
  return "This is far more than wear or a usual collision leaves: no program may run before it is put right. Poses of "
         "another robot, a robot file of another version of this one, or the model of another arm can look like "
         "this, too: compare their serial numbers first. ";
}

/// Of everything that was found, the arm before its base.
std::string what_to_do_about_found(const ChangeReport& change, const std::string& model_file) {
  std::vector<std::string> advice = advice_on_joints(change);
  if (any_is(change, [](const ChangeCause& cause) { return law_of(cause.effect).subject() == Subject::tool; }))
    advice.push_back("Look at the tool and its target: straighten or exchange it, or measure its tool point again");
  if (advice.empty())
    advice.push_back("The robot itself is as it was: find the base's frame again where programs rely on it");
  return fmt::format("{}{}. {} the model up to date: demecal diagnose DATASET.yaml --prior {}.",
                     caution_on_size(change), fmt::join(advice, ". "),
                     any_is(change, has_fallen) ? "Bring" : "Or bring", model_file);
}

/// What was found is not all of it, and may be another thing altogether.
std::string what_to_do_about_more(const ChangeReport& change, const std::string& model_file) {
  const std::string joints = named_joints(change, [](const ChangeCause&) { return true; });
  return fmt::format(
      "What is named explains a part only: {:.2g} mm (rms) are left, more than noise. A link, a bearing or something "
      "else has changed beside it or in its place, or instrument, base or tool were moved between the poses: {}"
      "measure 30 poses or more and run demecal diagnose DATASET.yaml --prior {}.",
      millimetres(change.left_m), joints.empty() ? "" : "before work on " + joints + ", ", model_file);
}

std::string what_to_do_about_unnamed(const ChangeReport& change, const std::string& model_file) {
  constexpr double kMoreThanWear_m = 5e-3;
  std::string text = "The errors are larger than the model expects and none of the causes tried explains them: ";
  if (change.error_m > kMoreThanWear_m)
    text +=
        "so large, they are rather of the data than of the robot. Look at the rows first (signs and units of some of "
        "them, their order), and whether instrument, base or tool were moved between the poses; then ";
  else
    text +=
        "see whether instrument, base or tool were moved between the poses, whether joints were rounded when they were "
        "noted, and whether the instrument scatters more than the one that the model was measured with (where some "
        "poses are measured three times, check goes by these); ";
  return text + "measure 30 poses or more and run demecal diagnose DATASET.yaml --prior " + model_file + ".";
}

}  // namespace

std::pair<std::string, double> shown_unit(const std::string& unit) {
  if (unit == "rad") return {"mrad", kMilliPerUnit};
  if (unit == "m") return {"mm", kMilliPerUnit};
  return {unit, 1.0};
}

std::string sentence_on(const ChangeReport& change, const ChangeCause& cause, const Robot& robot) {
  std::string sentence = sentence_on(cause, robot);
  if (declared_flag(cause.effect.kind) != &DeclaredModel::joint_offset) return sentence;
  for (const WarmedZero& one : change.warmed) {
    if (one.joint != cause.effect.joint || !one.unmoved_celsius) continue;
    sentence.pop_back();
    sentence += fmt::format(" at {:.1f} °C, the mean of these poses; ", *one.found_celsius);
    if (one.may_be_heat)
      sentence += fmt::format("at {:.1f} °C it is where the model has it{}.", *one.unmoved_celsius,
                              one.by_model_celsius ? "" : ", which does not state at which temperature that holds");
    else if (one.by_model_celsius)
      sentence += fmt::format("at {:.1f} °C, the model's reference, it is off as well.", *one.by_model_celsius);
    else
      sentence += "at no usual temperature is it where the model has it.";
  }
  return sentence;
}

std::string sentence_on(const ChangeCause& cause, const Robot& robot) {
  const EffectLaw& law = law_of(cause.effect);
  if (!cause.by_model || *cause.by_model == 0.0) return law.diagnosis(cause.effect, robot);
  const double now = *cause.by_model + cause.size;
  if (stops_beyond(cause)) return law.diagnosis(with_model(cause), robot);
  const auto [unit, per_inside] = shown_unit(cause.unit);
  if (!is_lost_motion(cause))
    return fmt::format("{} By the model it was {:.2g} {}, now it is {:.2g}.", law.diagnosis(with_model(cause), robot),
                       *cause.by_model * per_inside, unit, now * per_inside);
  return fmt::format(
      "The lost motion of joint {}, from end to end, went from {:.2f} to {:.2f} {} (standard error {:.2g}).",
      cause.effect.joint + 1, *cause.by_model * per_inside, std::max(0.0, now) * per_inside, unit,
      cause.standard_error * per_inside);
}

std::string what_to_do(const ChangeReport& change, const std::string& model_file) {
  if (change.unnamed) return what_to_do_about_unnamed(change, model_file);
  if (change.found.empty() && change.set_up_anew)
    return "The robot itself is as it was; its base was found again in the instrument's new frame.";
  if (change.found.empty() && change.lacking.empty() && !change.unseen_zeros.empty())
    return "Nothing needs to be done about what these poses see.";
  if (change.found.empty())
    return change.lacking.empty()
               ? "Nothing needs to be done."
               : "To find smaller changes too, state with the poses what is missing and check again.";
  return change.more ? what_to_do_about_more(change, model_file) : what_to_do_about_found(change, model_file);
}

}  // namespace demecal::inline studies
