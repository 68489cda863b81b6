#include "draw_truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/scan.hpp"
#include "truth.hpp"

namespace demecal::bench {
namespace {

constexpr int kLowestRatio = 10, kHighestRatio = 160;
constexpr double kLargestTurn_rad = 0.01, kLargestShift_m = 0.01;
constexpr double kLargestGrowth_per_kelvin = 100e-6;  // of what links are made of, plastics grow most

bool is_simple_form(const Effect& effect) {
  if (effect.kind == "compliance") return effect.form == "masses";
  return effect.kind != "backlash" || effect.form == "approach";
}

/// Those of a kind in a random order.
std::vector<NotFound> shuffled(const std::string& kind, const std::vector<NotFound>& detectable, RandomStream& random) {
  std::vector<NotFound> all;
  std::ranges::copy_if(detectable, std::back_inserter(all),
                       [&](const NotFound& one) { return one.effect.kind == kind && is_simple_form(one.effect); });
  for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[random.index(i)]);
  return all;
}

int another_joint(int joint, int joints, RandomStream& random) {
  return (joint + 1 + static_cast<int>(random.index(static_cast<std::size_t>(joints - 1)))) % joints;
}

void draw_settings(Effect& effect, const Robot& robot, RandomStream& random) {
  effect.ranges.clear();
  if (effect.kind == "gear_harmonic") {
    const int ratio = kLowestRatio + static_cast<int>(random.index(kHighestRatio - kLowestRatio + 1));
    effect.settings["ratio"] = ratio;
  }
  if (effect.kind == "eccentricity" || effect.kind == "axis_wobble") {
    effect.settings["order"] = random.chance(0.5) ? 1.0 : 2.0;
  }
  if (effect.kind != "coupling") return;
  effect.settings["from"] = another_joint(effect.joint, robot.chain.size(), random) + 1.0;
  effect.form = random.chance(0.5) ? "linear" : "harmonic";
}

/// Friction that half again to one and a half times as much of its own comes on top of under a typical load.
std::vector<double> friction_direction(const Effect& effect, const Robot& robot, const std::vector<ArmState>& states,
                                       RandomStream& random) {
  std::vector<double> torques;
  for (const ArmState& state : states) torques.push_back(std::abs(state.torque(robot.chain, effect.joint)));
  std::ranges::sort(torques);
  const double sign = random.chance(0.5) ? 1.0 : -1.0;
  return {sign, sign * random.real(0.5, 1.5) / torques[torques.size() / 2]};
}

std::vector<double> direction(const Effect& effect, const Robot& robot, const std::vector<ArmState>& states,
                              RandomStream& random) {
  if (effect.kind == "hysteresis") return friction_direction(effect, robot, states, random);
  std::vector<double> values(law_of(effect).coefficients(effect, robot).size());
  double square = 0.0;
  for (double& value : values) {
    value = random.normal();
    square += value * value;
  }
  for (double& value : values) value /= std::sqrt(square);
  return values;
}

void scale(Effect& effect, double factor) {
  for (double& value : effect.values) value *= factor;
}

bool is_possible(const Effect& effect, const Robot& robot, const std::vector<ArmState>& states) {
  if (effect.kind == "thermal_length" && std::abs(effect.value(0)) > kLargestGrowth_per_kelvin) return false;
  std::vector<UnitMotion> units;
  for (const ArmState& state : states) {
    units.clear();
    append_unit_motions(effect, robot, state, units);
    for (const UnitMotion& unit : units) {
      const double size = std::abs(unit.size * effect.value(static_cast<std::size_t>(unit.coefficient)));
      if (size > (unit.axis < 3 ? kLargestShift_m : kLargestTurn_rad)) return false;
    }
  }
  return true;
}

/// Formulas of the joint's own value and another's that no law of the catalogue writes.
Effect draw_formula(int joint, const Robot& robot, RandomStream& random) {
  const std::string own = 'q' + std::to_string(joint + 1);
  const std::string other = 'q' + std::to_string(another_joint(joint, robot.chain.size(), random) + 1);
  const std::array<std::string, 6> texts{
      "SIN(" + other + " + 2 * " + own + ')',   own + " * COS(" + other + ')', "SIN(" + own + ") * SIN(" + other + ')',
      "COS(" + own + " - " + other + " + 0.7)", "s * COS(" + other + ')',      own + " * " + other};
  Effect effect{.kind = "symbolic", .joint = joint};
  effect.formula = parse(texts[random.index(texts.size())], symbolic_variables(robot.chain));
  effect.values = {random.chance(0.5) ? 1.0 : -1.0};
  return effect;
}

/// Of the size 1.
Effect draw_at(const std::string& kind, const NotFound& measure, const Robot& robot,
               const std::vector<ArmState>& states, RandomStream& random) {
  if (kind == kOutside) return draw_formula(measure.effect.joint, robot, random);
  Effect effect = measure.effect;
  draw_settings(effect, robot, random);
  effect.values = direction(effect, robot, states, random);
  return effect;
}

}  // namespace

std::optional<Effect> draw_truth(const std::string& kind, const std::vector<NotFound>& detectable, const Robot& robot,
                                 const std::vector<ArmState>& states, const JustDetectable& just, RandomStream& random,
                                 const SizeRange& sizes) {
  for (const NotFound& measure : shuffled(kind == kOutside ? "coupling" : kind, detectable, random)) {
    Effect effect = draw_at(kind, measure, robot, states, random);
    scale(effect, random.real(sizes.least, sizes.most) * just(measure, effect));
    if (is_possible(effect, robot, states)) return effect;
  }
  return std::nullopt;
}

std::vector<Effect> draw_truths(const std::string& kind, const std::vector<NotFound>& detectable, const Robot& robot,
                                const std::vector<ArmState>& states, const JustDetectable& just, RandomStream& random) {
  std::vector<std::string> kinds{kind};
  if (kind == kPair) {
    kinds.clear();
    for (const KindRow& row : kind_table()) {
      if (row.in_pairs) kinds.push_back(row.kind);
    }
    for (std::size_t i = kinds.size(); i > 1; --i) std::swap(kinds[i - 1], kinds[random.index(i)]);
  }
  std::vector<Effect> truths;
  for (const std::string& one : kinds) {
    if (truths.size() == (kind == kPair ? 2u : 1u)) break;
    if (auto truth = draw_truth(one, detectable, robot, states, just, random)) truths.push_back(std::move(*truth));
  }
  return truths;
}

DetectionLimit::DetectionLimit(const DiagnosisProblem& problem, const DiagnosedModel& model)
    : problem_(problem), linearization_(linearize(problem, model)) {}

double DetectionLimit::detectable(const NotFound& measure, const Effect& effect) const {
  EffectColumns columns;
  columns.append({measure.effect, effect}, problem_.data.robot, linearization_.fitted.states);
  columns.pack();
  const Scan scan(columns, {0.0, 0.0}, linearization_.fitted, linearization_.projection);
  const double needed = measure.smallest_detectable * std::sqrt(scan.scores()[0].visible.mean());
  const auto values = Eigen::Map<const Eigen::VectorXd>(effect.values.data(), std::ssize(effect.values));
  const Projection::Trial trial = linearization_.projection.trial(columns.dense(linearization_.fitted, 1) * values,
                                                                  RowMatrix::Zero(linearization_.validation.rows(), 1));
  return needed / trial.fitted.norm();
}

}  // namespace demecal::bench
