#include "programs/command_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "effects/effect.hpp"
#include "errors/check.hpp"
#include "fitting/base_search.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"

namespace demecal::inline programs {
namespace {

bool is_of_instrument(const Effect& effect) {
  return law_of(effect).subject() == Subject::instrument;
}

constexpr double kLargestToolTurn = 0.05;  ///< rad

bool is_of_tool(const Effect& effect) {
  return law_of(effect).subject() == Subject::tool;
}

/// Leaves out the numbers of effects that are `gone`, and counts those that stay anew.
template <typename Gone>
void leave_out_effects(Posterior& posterior, const std::vector<Effect>& effects, const Gone& gone) {
  std::vector<int> place_of(effects.size(), -1);
  int kept = 0;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (!gone(effects[i])) place_of[i] = kept++;
  }
  const auto place = [&](const ParameterId& id) { return place_of[static_cast<std::size_t>(id.index)]; };
  posterior =
      posterior.without([&](const ParameterId& id) { return id.kind == ParameterId::Kind::effect && place(id) < 0; });
  for (ParameterId& id : posterior.ids) {
    if (id.kind == ParameterId::Kind::effect) id.index = place(id);
  }
}

/// Takes the tool point as it stands: nothing of it is wrong.
void take_tool(CommandModel& model, const Eigen::Vector3d& tool_m) {
  model.nominal.chain.tool_m = tool_m;
  model.robot.tools[""] = Eigen::Isometry3d(Eigen::Translation3d(tool_m));
  const std::vector<Effect> before = model.robot.effects;
  std::erase_if(model.robot.effects, is_of_tool);
  model.tool_identified = false;
  if (!model.posterior) return;
  model.posterior = model.posterior->without(std::mem_fn(&ParameterId::is_of_tool));
  leave_out_effects(*model.posterior, before, is_of_tool);
}

bool is_mounted_turned(const Eigen::Isometry3d& tool) {
  return vector_of(tool.linear()).norm() > kLargestToolTurn;
}

std::string point_text(const Eigen::Vector3d& point_m) {
  std::string text;
  for (const double coordinate : point_m) text += (text.empty() ? "" : " ") + fixed_text(millimetres(coordinate), 1);
  return text;
}

/// Leaves out what is not the described tool in error.
void check_tool(CommandModel& model) {
  const Eigen::Vector3d described_m = model.nominal.chain.tool_m;
  // A model of several targets on the tool need not hold the robot's own.
  if (!model.robot.tools.contains("")) return take_tool(model, described_m);
  Eigen::Isometry3d& tool = model.robot.tools.at("");
  const double error_m = (tool.translation() - described_m).norm();
  const bool turned = is_mounted_turned(tool);
  if (error_m > kOtherTool_m) {
    model.tool_note =
        "the model has its tool point " + std::to_string(std::lround(millimetres(error_m))) +
        " mm from where the robot's description has it, as if another tool was measured; nothing of "
        "the tool is corrected where the program states none, and the described one is taken (--tool-mm " +
        point_text(tool.translation()) + " says that it is the measured one)";
    if (turned) tool.linear().setIdentity();
    model.measured_tool = MeasuredTool{tool, model.robot.effects, {}};
    return take_tool(model, described_m);
  }
  if (turned) {
    model.notes.push_back("the model has its tool turned by " +
                          std::to_string(std::lround(degrees(vector_of(tool.linear()).norm()))) +
                          " deg, as instruments' targets are mounted; that turn is not corrected");
    tool.linear().setIdentity();
  }
}

/// Whether a fit cannot tell this number from where the base stands: how the two share it out says nothing of the arm.
/// What a slide carries may be shifted as a whole or the base be shifted the other way, so that behind leading
/// prismatic joints the next length is the base's too.
bool is_bound_to_base(const Chain& arm, int joint, LinkParameter which) {
  const bool along = which == LinkParameter::theta || which == LinkParameter::d;
  const bool modified = arm.convention == Convention::modified_dh;
  if (joint == 0 && (along || modified)) return true;
  int slides = 0;
  while (slides < arm.size() && !is_revolute(arm, slides)) ++slides;
  if (which == LinkParameter::d) return joint <= slides && slides > 0;
  return which == LinkParameter::a && slides > 0 && (modified ? joint <= slides : joint < slides);
}

/// The numbers of a model whose tool is `tool`, or none of whose tools' numbers count.
Posterior counted_numbers(const CommandModel& model, const CorrectedRobot& identified, const Posterior& posterior,
                          const Eigen::Isometry3d* tool, bool registration) {
  const bool turned = tool != nullptr && !tool->linear().isIdentity(0.0);
  Posterior kept = posterior.without([&](const ParameterId& id) {
    using Kind = ParameterId::Kind;
    if (id.kind == Kind::effect) return false;
    if (id.kind == Kind::base_translation || id.kind == Kind::base_rotation) return true;
    if (id.is_of_tool()) return tool == nullptr || (id.kind == Kind::tool_rotation && !turned);
    return registration && is_bound_to_base(model.nominal.chain, id.index, id.link);
  });
  leave_out_effects(kept, identified.effects, [&](const Effect& effect) {
    return is_of_instrument(effect) || (tool == nullptr && is_of_tool(effect));
  });
  return kept;
}

void narrow(std::optional<Interval>& range, const Interval& by) {
  if (!range) {
    range = by;
    return;
  }
  range->lower = std::max(range->lower, by.lower);
  range->upper = std::min(range->upper, by.upper);
}

/// How far `value` stands outside the range, whole turns aside where the joint is revolute and the range less than one.
double beyond(const Interval& range, double value, bool revolute) {
  const int most = revolute && range.upper - range.lower < kTurn_rad ? 2 : 0;
  double least = std::numeric_limits<double>::infinity();
  for (int turns = -most; turns <= most; ++turns) {
    const double turned = value + turns * 2.0 * std::numbers::pi;
    least = std::min(least, std::max({0.0, range.lower - turned, turned - range.upper}));
  }
  return least;
}

/// Less beyond what was measured (rad or m) is not worth saying.
double margin_of(bool revolute) {
  return revolute ? 0.035 : 0.02;
}

}  // namespace

Eigen::Isometry3d CommandModel::nominal_tool(const JointVector& joints) const {
  return forward(nominal.chain, joints) * Eigen::Isometry3d(Eigen::Translation3d(nominal.chain.tool_m));
}

Eigen::Isometry3d believed_tool(const Eigen::Vector3d& described_m, const Eigen::Isometry3d& identified) {
  if ((identified.translation() - described_m).norm() > kOtherTool_m) return identified;
  Eigen::Isometry3d believed(Eigen::Translation3d{described_m});
  if (vector_of(identified.linear()).norm() > kLargestToolTurn) believed.linear() = identified.linear();
  return believed;
}

CommandModel command_model(const Robot& nominal, const CorrectedRobot& identified, std::vector<double> bounds) {
  CommandModel model{nominal, identified, std::move(bounds), {}};
  DEMECAL_CHECK(std::ssize(model.bounds) == nominal.chain.size(), model.bounds.size() << " bounds");
  model.robot.sensor_from_base.setIdentity();
  std::erase_if(model.robot.effects, is_of_instrument);
  check_tool(model);
  return model;
}

CommandModel with_posterior(CommandModel model, const CorrectedRobot& identified,
                            const std::optional<Posterior>& posterior, std::vector<Interval> measured,
                            bool registration) {
  model.measured = std::move(measured);
  if (!posterior) return model;
  const Eigen::Isometry3d own = model.robot.tool("");
  model.posterior =
      counted_numbers(model, identified, *posterior, model.tool_identified ? &own : nullptr, registration);
  if (model.measured_tool)
    model.measured_tool->posterior =
        counted_numbers(model, identified, *posterior, &model.measured_tool->pose, registration);
  return model;
}

CommandModel with_stated_tool(CommandModel model, const Eigen::Vector3d& tool_m) {
  constexpr double kWorthSaying_m = 1e-3;
  const Eigen::Vector3d described_m = model.nominal.chain.tool_m;
  const auto is_at = [&tool_m](const Eigen::Vector3d& point_m) { return (tool_m - point_m).norm() <= kSameTool_m; };
  model.tool_note.clear();
  if (model.measured_tool && is_at(model.measured_tool->pose.translation())) {
    MeasuredTool measured = std::move(*model.measured_tool);
    model.measured_tool.reset();
    model.robot.tools[""] = measured.pose;
    model.robot.effects = std::move(measured.effects);
    model.posterior = std::move(measured.posterior);
    model.tool_identified = true;
  }
  const Eigen::Vector3d measured_m = model.robot.tool("").translation();
  if (!model.tool_identified || !(is_at(described_m) || is_at(measured_m))) {
    take_tool(model, tool_m);
    return model;
  }
  model.nominal.chain.tool_m = tool_m;
  const double apart_m = (tool_m - measured_m).norm();
  if (!is_at(described_m) && apart_m > kWorthSaying_m)
    model.tool_note = "the tool at " + point_text(tool_m) + " mm is taken for the measured one, " +
                      fixed_text(millimetres(apart_m), 2) +
                      " mm from it, which is corrected as that tool's error; calibrate with its tool_mm in the robot's "
                      "file to be sure";
  return model;
}

CorrectedRobot without_base(CorrectedRobot identified, const Chain& nominal) {
  for (int joint = 0; joint < nominal.size(); ++joint) {
    for (int which = 0; which < kLinkParameters; ++which) {
      const auto parameter = static_cast<LinkParameter>(which);
      const auto at = static_cast<std::size_t>(joint);
      if (is_bound_to_base(nominal, joint, parameter))
        identified.chain.joints[at].parameter(parameter) = nominal.joints[at].parameter(parameter);
    }
  }
  return identified;
}

std::optional<Interval> calibrated_range(const CorrectedRobot& robot, int joint) {
  std::optional<Interval> range;
  const JointCorrection& correction = robot.corrections[static_cast<std::size_t>(joint)];
  if (!correction.is_neutral()) range = correction.range_rad();
  for (const Effect& effect : robot.effects) {
    const auto measured = effect.ranges.find(joint);
    if (measured != effect.ranges.end()) narrow(range, measured->second);
  }
  return range;
}

std::optional<Interval> outside_measured(const CommandModel& model, int joint, double value) {
  if (model.measured.empty()) return std::nullopt;
  const Interval& range = model.measured[static_cast<std::size_t>(joint)];
  const bool revolute = is_revolute(model.nominal.chain, joint);
  return beyond(range, value, revolute) > margin_of(revolute) ? std::optional(range) : std::nullopt;
}

std::optional<Interval> inside_gap(const CommandModel& model, int joint, double value) {
  const auto gaps = model.gaps.find(joint);
  if (gaps == model.gaps.end()) return std::nullopt;
  const double margin = margin_of(is_revolute(model.nominal.chain, joint));
  for (const Interval& gap : gaps->second)
    if (value > gap.lower + margin && value < gap.upper - margin) return gap;
  return std::nullopt;
}

double distance_outside_calibrated(const CorrectedRobot& robot, int joint, double value) {
  const std::optional<Interval> range = calibrated_range(robot, joint);
  if (!range) return 0.0;
  const bool revolute = is_revolute(robot.chain, joint);
  return beyond(*range, value, revolute);
}

JointVector middle_joints(const CommandModel& model) {
  JointVector middle(model.nominal.chain.size());
  for (int joint = 0; joint < middle.size(); ++joint) {
    const Joint& link = model.nominal.chain.joints[static_cast<std::size_t>(joint)];
    const Interval range = calibrated_range(model.robot, joint).value_or(Interval{link.lower, link.upper});
    middle[joint] = 0.5 * (range.lower + range.upper);
  }
  return middle;
}

}  // namespace demecal::inline programs
