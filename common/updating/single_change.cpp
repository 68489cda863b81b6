#include "updating/single_change.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>

#include "effects/catalogue.hpp"
#include "effects/effect.hpp"
#include "errors/input_error.hpp"
#include "fitting/fit.hpp"
#include "kinematics/chain.hpp"
#include "parameters/declared_model.hpp"
#include "updating/change.hpp"

namespace demecal::inline updating {
namespace {

/// Takes a cause in, with its amount; whether it is of a kind that can be.
bool take_cause_in(const ChangeCause& cause, SingleChange& change) {
  bool DeclaredModel::*const kind = declared_flag(cause.effect.kind);
  if (kind == &DeclaredModel::registration) {
    change.moved.base = true;
  } else if (kind == &DeclaredModel::tool) {
    change.moved.tool = true;
  } else if (kind == &DeclaredModel::joint_offset) {
    Joint& joint = change.placed.chain.joints[static_cast<std::size_t>(cause.effect.joint)];
    joint.parameter(moving_parameter(joint)) += cause.effect.value(0);
    change.moved.zeros.push_back(cause.effect.joint);
  } else {
    return false;
  }
  return true;
}

/// The catalogue's word for what a declared joint offset is.
std::string kind_of_zero() {
  const auto is_it = [](const EffectLaw* law) { return declared_flag(law->kind()) == &DeclaredModel::joint_offset; };
  return std::string((*std::ranges::find_if(catalogue(), is_it))->kind());
}

std::optional<ChangeReport> checked(const CalibratedModel& model, const DataSet& data,
                                    const std::vector<std::size_t>& poses) {
  DataSet some = data;
  some.poses.clear();
  for (const std::size_t pose : poses) some.poses.push_back(data.poses[pose]);
  try {
    return find_change(model, some);
  } catch (const InputError&) {
    return std::nullopt;  // too few poses for the check are not too few for an update
  }
}

}  // namespace

std::optional<SingleChange> single_change(const CalibratedModel& model, const DataSet& data,
                                          const std::vector<std::size_t>& poses) {
  if (model.fleet || !model.posterior || !data.stations.empty() || has_contacts(data)) return std::nullopt;
  const std::optional<ChangeReport> report = checked(model, data, poses);
  if (!report || report->unnamed) return std::nullopt;
  SingleChange change{model.robot, {.base = report->set_up_anew, .tool = false}};
  change.placed.described = data.robot;
  for (const ChangeCause& cause : report->found)
    if (!take_cause_in(cause, change)) return std::nullopt;
  if (!change.moved.base && !change.moved.tool) return change;
  const Fit fit =
      fit_registration(data, poses, {.registration = change.moved.base, .tool = change.moved.tool}, change.placed);
  if (fit.status != FitStatus::converged) return std::nullopt;
  change.placed = fit.robot;
  return change;
}

std::string sentence_of(const Moved& moved, const CorrectedRobot& before, const CorrectedRobot& after, bool as_known) {
  std::string found;
  std::vector<std::string> changed, kept;
  for (const int joint : moved.zeros) {
    const ParameterId zero = zero_of(before.chain, joint);
    Effect effect{.kind = kind_of_zero(), .joint = joint};
    effect.values = {parameter_value(after, zero) - parameter_value(before, zero)};
    found += law_of(effect).diagnosis(effect, before.described) + ' ';
    changed.push_back(fmt::format("the zero of joint {}", joint + 1));
  }
  (moved.base ? changed : kept).emplace_back("the base");
  (moved.tool ? changed : kept).emplace_back("the tool");
  if (as_known) kept.emplace_back("everything else");
  found += changed.empty() ? "The new poses show no change of the robot."
                           : fmt::format("Changed in the old model: {}.", fmt::join(changed, ", "));
  if (!kept.empty()) found += fmt::format(" Kept, within what the old model leaves open: {}.", fmt::join(kept, ", "));
  if (!as_known) found += " Everything else follows the new poses within the drift that is usual between measurements.";
  return found;
}

}  // namespace demecal::inline updating
