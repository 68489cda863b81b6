#include "explanations/causes.hpp"
#include "explanations/error_budget.hpp"
#include "report/make_report.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "diagnosis/outcome.hpp"
#include "effects/catalogue.hpp"
#include "effects/effect.hpp"
#include "kinematics/units.hpp"
#include "next_measurement/effect_words.hpp"
#include "next_measurement/next_measurement.hpp"
#include "prediction/corrected_robot.hpp"
#include "report/figures.hpp"
#include "report/report.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline report {
namespace {

constexpr double kAsOne = 0.98;  ///< cosine above which an effect goes by the name of its class
/// The same of a formula and what the catalogue has: of the two a known cause is the likelier, however short the
/// formula.
constexpr double kAsKnown = 0.9;

bool is_of_catalogue(const std::string& kind) {
  return rarity(kind) < causes().size() && cause_of(kind).group != CauseGroup::formula;
}

/// The names and units of the coefficients; none for a kind that is not of the catalogue.
std::vector<CoefficientLabel> labels_of(const Effect& effect, const Robot& robot) {
  const EffectLaw* const law = find_law(effect.kind);
  return law == nullptr ? std::vector<CoefficientLabel>{} : law->coefficients(effect, robot);
}

/// How much of an effect there is: its one coefficient, or the root of the sum of squares of those that have the same
/// unit as the first (for a cosine and a sine that is the amplitude of the wave). Nothing without values.
std::optional<double> amplitude_of(const Effect& effect, const std::vector<CoefficientLabel>& labels) {
  const std::size_t count = std::min(effect.values.size(), labels.size());
  if (count == 0) return std::nullopt;
  double size = 0.0;
  std::size_t alike = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (labels[i].unit != labels[0].unit) continue;
    size = std::hypot(size, effect.values[i]);
    ++alike;
  }
  return alike == 1 ? effect.values[0] : size;
}

std::uint64_t as_count(int number) {
  return static_cast<std::uint64_t>(std::max(number, 0));
}

std::vector<NamedInterval> named_intervals(const Round& round, const Robot& robot) {
  const std::vector<CoefficientLabel> labels = labels_of(round.effect, robot);
  std::vector<NamedInterval> named;
  for (std::size_t i = 0; i < std::min(labels.size(), round.interval.size()); ++i)
    named.push_back({labels[i].name, if_finite(round.interval[i][0]), if_finite(round.interval[i][1])});
  return named;
}

RoundEntry round_entry(const Round& round, const Robot& robot) {
  RoundEntry entry{.round = as_count(round.number),
                   .group = as_count(round.group),
                   .verdict = to_string(round.verdict),
                   .effect = effect_entry(round.effect, robot),
                   .diagnosis = round.diagnosis,
                   .formula = round.formula,
                   .reason = round.reason,
                   .implausible = round.implausible,
                   .members = {},
                   .class_sentence = {},
                   .rivals = {},
                   .p_structure = if_finite(round.p_structure),
                   .p_family = if_finite(round.p_family),
                   .null_draws = as_count(round.null_draws),
                   .gain_nats = if_finite(round.gain_nats),
                   .confirmed = if_finite(round.confirmed),
                   .confirmed_lower = if_finite(round.confirmed_lower),
                   .sign_stability = if_finite(round.sign_stability),
                   .interval = named_intervals(round, robot),
                   .validation_before_mm = if_finite(round.validation_before_mm),
                   .validation_after_mm = if_finite(round.validation_after_mm),
                   .next_measurement = {}};
  for (const Rival& rival : round.rivals) {
    entry.rivals.push_back({effect_entry(rival.effect, robot), if_finite(rival.cosine), if_finite(rival.nats_behind)});
  }
  entry.members = effect_class(entry.effect, entry.rivals);
  entry.class_sentence = class_sentence(entry.members);
  if (const auto& next = round.next_measurement)
    entry.next_measurement = NextMeasurementEntry{next->sentence, as_count(next->poses)};
  return entry;
}

NotFoundEntry not_found_entry(const NotFound& missing, const Robot& robot) {
  NotFoundEntry entry{.effect = effect_entry(missing.effect, robot),
                      .smallest_detectable = {},
                      .unit = missing.unit,
                      .sentence = missing.testable ? "" : "not testable with these data"};
  entry.effect.amplitude.reset();  // whatever was fitted, it was not found
  entry.effect.unit.clear();
  if (missing.testable) entry.smallest_detectable = if_finite(missing.smallest_detectable);
  return entry;
}

NoiseEntry noise_entry(const LoopOutcome& loop) {
  const double independent_mm = millimetres(loop.independent_m);
  return {.independent_mm = if_finite(independent_mm),
          .estimated = loop.noise_estimated,
          .joint_repeatability_mrad = if_finite(1e3 * loop.noise.joint_rad),
          .shared_by_repeats_mm = if_finite(independent_mm * loop.noise.repeats),
          .shared_in_order_mm = if_finite(independent_mm * loop.noise.order),
          .correlation_in_order = if_finite(loop.noise.correlation)};
}

std::optional<double> if_any(const std::optional<double>& value) {
  return value ? if_finite(*value) : std::nullopt;
}

/// Other causes that effects in the class of one of these belong to.
std::vector<ErrorCause> alternatives_to(const ErrorCause& cause, const std::vector<std::string>& effects,
                                        const std::vector<RoundEntry>& rounds) {
  std::vector<ErrorCause> others;
  for (const RoundEntry& round : rounds) {
    if (!round.added() || std::ranges::find(effects, round.effect.name()) == effects.end()) continue;
    for (const ClassMember& member : round.members) {
      const ErrorCause other = cause_at(member.kind, member.joint ? static_cast<int>(*member.joint) - 1 : -1);
      const auto is_it = [&](const ErrorCause& one) { return one.is_same_as(other); };
      if (!other.is_same_as(cause) && std::ranges::none_of(others, is_it)) others.push_back(other);
    }
  }
  return others;
}

/// A formula that does what a known cause does goes by that one's name, if that is not among the causes itself.
void name_as_known(const ErrorBudget& budget, const CorrectedRobot& robot, std::vector<ErrorCause>& others,
                   CauseEntry& entry, ErrorCause formula) {
  if (formula.group != CauseGroup::formula || formula.effects.size() != 1 || others.empty()) return;
  const ErrorCause known = others.front();
  if (std::ranges::any_of(budget.causes, [&](const CauseCost& cost) { return cost.cause.is_same_as(known); })) return;
  others.front() = std::move(formula);
  entry.cause = std::string(to_string(known.group));
  entry.name = to_string(known);
  entry.advice = advice_on(known, robot) + " The model holds a formula that describes it a little better.";
  entry.joint = known.joint >= 0 ? std::optional(as_count(known.joint) + 1) : std::nullopt;
}

}  // namespace

std::string EffectEntry::full_name() const {
  std::vector<std::string> settings;
  for (const auto& [setting, value] : parameters)
    if (value && *value != 0.0)
      settings.push_back(setting == "gravity_turn" ? fmt::format("{}_{:g}", setting, *value) : setting);
  const std::string masses = masses_words(settings);
  if (masses.empty()) return name();
  const std::string which = distinction();
  return kind + " (" + which + (which.empty() ? "" : " ") + masses + ")" +
         (joint ? fmt::format(", joint {}", *joint) : "");
}

EffectEntry effect_entry(const Effect& effect, const Robot& robot) {
  EffectEntry entry;
  entry.kind = effect.kind;
  if (effect.joint >= 0) entry.joint = as_count(effect.joint) + 1;
  entry.form = effect.form;
  for (const auto& [name, value] : effect.settings) entry.parameters.push_back({name, if_finite(value)});
  const std::vector<CoefficientLabel> labels = labels_of(effect, robot);
  for (std::size_t i = 0; i < std::min(labels.size(), effect.values.size()); ++i) {
    entry.parameters.push_back({labels[i].name, if_finite(effect.values[i])});
    if (i < effect.standard_errors.size())
      entry.standard_errors.push_back({labels[i].name, if_finite(effect.standard_errors[i])});
  }
  if (const std::optional<double> amplitude = amplitude_of(effect, labels)) {
    entry.amplitude = if_finite(*amplitude);
    entry.unit = labels.front().unit;
  }
  return entry;
}

std::vector<ClassMember> effect_class(const EffectEntry& effect, const std::vector<RivalEntry>& rivals) {
  std::vector<ClassMember> members{{effect.kind, effect.joint}};
  for (const auto& [rival, cosine, nats_behind] : rivals) {
    const auto is_it = [&one = rival](const ClassMember& member) {
      return member.kind == one.kind && member.joint == one.joint;
    };
    const double least = !is_of_catalogue(effect.kind) && is_of_catalogue(rival.kind) ? kAsKnown : kAsOne;
    if (cosine > least && std::ranges::none_of(members, is_it)) members.push_back({rival.kind, rival.joint});
  }
  if (members.size() < 2) return {};
  std::ranges::stable_sort(members, [](const ClassMember& a, const ClassMember& b) {
    return std::pair(rarity(a.kind), a.joint) < std::pair(rarity(b.kind), b.joint);
  });
  return members;
}

/// Whether the cause may be lost motion in truth: without recorded sides that follows a joint's position, since high
/// values are come to from below, and the weight that the position gives it.
bool may_be_lost_motion(const ErrorCause& cause, const CorrectedRobot& robot, const Report& report) {
  const auto is_of_sides = [](const UntestableEntry& unseen) {
    const EffectLaw* const law = find_law(unseen.kind);
    return law != nullptr && law->prerequisite() == Circumstance::approach;
  };
  const auto follows_position = [&](std::size_t i) { return law_of(robot.effects[i]).is_smooth(robot.effects[i]); };
  return std::ranges::any_of(report.untestable, is_of_sides) &&
         (cause.group == CauseGroup::elasticity || std::ranges::any_of(cause.effects, follows_position));
}

void set_causes(const ErrorBudget& budget, const CorrectedRobot& robot, const Robot& described, Report& report) {
  for (const CauseCost& cost : budget.causes) {
    CauseEntry entry{.cause = std::string(to_string(cost.cause.group)),
                     .joint = {},
                     .name = to_string(cost.cause),
                     .effects = {},
                     .without_mm = if_finite(cost.without_mm),
                     .with_mm = if_finite(cost.with_mm),
                     .share_of_error = if_finite(cost.share),
                     .interval_mm = {cost.interval_mm.begin(), cost.interval_mm.end()},
                     .advice = advice_on(cost.cause, robot)};
    if (cost.cause.joint >= 0) entry.joint = as_count(cost.cause.joint) + 1;
    for (const std::size_t effect : cost.cause.effects)
      entry.effects.push_back(effect_entry(robot.effects[effect], described).name());
    std::vector<ErrorCause> others = alternatives_to(cost.cause, entry.effects, report.rounds);
    name_as_known(budget, robot, others, entry, cost.cause);
    for (const ErrorCause& other : others) entry.alternatives.push_back(to_string(other));
    if (may_be_lost_motion(cost.cause, robot, report)) {
      entry.alternatives.push_back(to_string(ErrorCause{.group = CauseGroup::lost_motion, .joint = cost.cause.joint}));
      entry.advice =
          "The sides that joints come from are not recorded, and lost motion looks like this then: record them "
          "(approach "
          "columns) before anything is done, and do not correct programs by it.";
    }
    report.causes.push_back(std::move(entry));
  }
  for (const FrontPoint& point : budget.front) {
    report.front.push_back(
        {point.causes, if_finite(point.validation_rms_mm), if_any(point.accept_rms_mm), point.chosen});
  }
}

void set_loop(const LoopOutcome& loop, const Robot& described, Report& report) {
  for (const Round& round : loop.rounds) report.rounds.push_back(round_entry(round, described));
  for (const Effect& effect : loop.dropped) report.dropped.push_back(effect_entry(effect, described));
  for (const NotFound& missing : loop.not_found) report.not_found.push_back(not_found_entry(missing, described));
  for (const UntestableKind& each : loop.untestable) report.untestable.push_back({each.kind, each.reason});
  report.considered = loop.considered;
  for (const Decoy& decoy : loop.decoys)
    report.decoys.push_back({decoy.name, if_finite(decoy.best_gain_nats), if_finite(decoy.p_left), decoy.won});
  report.stopped = to_string(loop.stopped);
  report.lack_of_fit_p = if_any(loop.lack_of_fit_p);
  report.explained_share = if_any(loop.explained_share);
  report.candidates = as_count(loop.candidates);
  report.null_draws = as_count(loop.null_draws);
  if (!report.loop_ran()) return;
  report.structure_left_p = if_finite(loop.p_structure_left);
  report.noise = noise_entry(loop);
}

}  // namespace demecal::inline report
