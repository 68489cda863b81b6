#include "diagnosis/group.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "data/data_set.hpp"
#include "diagnosis/judgement.hpp"
#include "diagnosis/scan.hpp"
#include "effects/law_terms.hpp"
#include "products/tall_products.hpp"
#include "random/distributions.hpp"

namespace demecal::inline diagnosis {
namespace {

constexpr int kMostRejections = 12;
constexpr double kLeastFreedom = 12.0;      ///< measured numbers that a model must leave over
constexpr double kEquivalentCosine = 0.9;   ///< cosine
constexpr double kIdenticalCosine = 0.995;  ///< cosine
constexpr double kNatsAboutEqual = 3.0;
constexpr double kGains = 0.5;    ///< share of a change borne out: errors decrease above it
constexpr double kEvident = 2.0;  ///< times the largest gain from noise alone: no need to draw again

}  // namespace

double family_p_value(const std::vector<double>& null_maxima, double gain_nats) {
  const auto beyond = null_maxima.end() - std::lower_bound(null_maxima.begin(), null_maxima.end(), gain_nats);
  return (1.0 + static_cast<double>(beyond)) / (1.0 + static_cast<double>(null_maxima.size()));
}

Group::Group(const DiagnosisProblem& problem, const DiagnosedModel& model, const Linearization& linearization,
             const std::vector<Candidate>& candidates, const EffectColumns& columns, std::vector<bool> excluded,
             std::vector<double>& null_maxima, const GroupRules& rules)
    : problem_(problem),
      model_(model),
      linearization_(linearization),
      candidates_(candidates),
      columns_(columns),
      excluded_(std::move(excluded)),
      null_maxima_(null_maxima),
      rules_(rules),
      projection_(linearization.projection),
      scan_(columns, naming_costs_nats(candidates), linearization.fitted, projection_, rules.do_work),
      scores_(scan_.scores()),
      confirmed_residual_(projection_.validation_residual()) {
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].decoy_kind != DecoyKind::none) decoy_gains_.push_back(scores_[i].gain_nats);
  }
}

std::vector<double> Group::decoy_p_values() const {
  std::vector<double> all;
  for (std::size_t i = 0; i < candidates_.size(); ++i)
    if (candidates_[i].decoy_kind != DecoyKind::none) all.push_back(family_p_value(null_maxima_, scores_[i].gain_nats));
  return all;
}

void Group::record_decoys(const GroupOutcome& outcome, std::vector<Decoy>& decoys) const {
  const std::vector<double> p_left = decoy_p_values();
  for (std::size_t i = 0; i < decoys.size(); ++i) {
    decoys[i].best_gain_nats = std::max(decoys[i].best_gain_nats, decoy_gains_[i]);
    decoys[i].won = decoys[i].won || outcome.winning_decoy == decoys[i].name;
    decoys[i].p_left = p_left[i];
  }
}

RandomStream Group::random(RandomPurpose purpose) const {
  return RandomStream{rules_.seed, number_of(purpose), static_cast<std::uint64_t>(rules_.group),
                      outcome_.rounds.size()};
}

std::optional<std::size_t> Group::best_candidate() {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < scores_.size(); ++i) {
    if (excluded_[i] || scores_[i].rank == 0) continue;
    if (!best || scores_[i].gain_nats > scores_[*best].gain_nats) best = i;
  }
  if (!best) return best;
  return simplest_equivalent(is_symbolic(candidates_[*best].effect) ? named_equivalent(*best) : *best);
}

const Group::Tried& Group::tried(std::size_t index) {
  if (tried_ && tried_->candidate == index) return *tried_;
  EffectColumns validation;
  validation.append({candidates_[index].effect}, problem_.data.robot, linearization_.validation.states);
  validation.pack();
  Projection::Trial trial =
      projection_.trial(columns_.dense(linearization_.fitted, index), validation.dense(linearization_.validation, 0));
  Eigen::MatrixXd products = columns_.transposed_times(linearization_.fitted, trial.columns());
  tried_ = Tried{index, std::move(trial), std::move(products)};
  return *tried_;
}

std::vector<Rival> Group::rivals(std::size_t index) {
  const Tried& own = tried(index);
  return rivals_of(index, own.trial, own.products, candidates_, scores_, scan_);
}

/// Of candidates that explain the same and are as good a description, but for a little, the one with the fewest
/// numbers.
std::size_t Group::simplest_equivalent(std::size_t index) {
  std::size_t simplest = index;
  for (const Rival& rival : rivals(index)) {
    if (rival.cosine < kEquivalentCosine || rival.nats_behind > kNatsAboutEqual) continue;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (excluded_[i] || candidates_[i].decoy_kind != DecoyKind::none || scores_[i].rank >= scores_[simplest].rank)
        continue;
      if (candidates_[i].effect.same_law_as(rival.effect)) simplest = i;
    }
  }
  return simplest;
}

/// The catalogue's effect that a formula amounts to: as good a description, or all but the same columns.
std::size_t Group::named_equivalent(std::size_t formula) {
  std::size_t named = formula;
  for (const Rival& rival : rivals(formula)) {
    if (is_symbolic(rival.effect) || (rival.cosine < kIdenticalCosine && rival.nats_behind > kNatsToDistinguish))
      continue;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (candidates_[i].decoy_kind != DecoyKind::none) continue;
      const bool better = named == formula || scores_[i].gain_nats > scores_[named].gain_nats;
      if (!excluded_[i] && better && candidates_[i].effect.same_law_as(rival.effect)) named = i;
    }
  }
  return named;
}

/// Whether the candidate came from a search of these data, so that only the same search tells what noise alone gives.
bool Group::found_by_search(std::size_t index) const {
  return candidates_[index].evolved && !rules_.evolved_null_gains.empty();
}

void Group::update_null_maxima(std::size_t index) {
  const bool evident = !null_maxima_.empty() && scores_[index].gain_nats > kEvident * null_maxima_.back();
  const bool first = outcome_.rounds.empty();
  if (!null_maxima_.empty() && (evident || !first)) return;
  null_maxima_ = scan_.null_maxima(columns_, linearization_.fitted, projection_, rules_.null_draws,
                                   random(RandomPurpose::null_distribution), rules_.do_work);
}

Round Group::evaluate(std::size_t index) {
  const Effect& effect = candidates_[index].effect;
  const Projection::Trial& trial = tried(index).trial;
  const auto before =
      tool_errors_mm(linearization_.validation, projection_.validation_residual(), model_.scales, problem_.data);
  const auto after = tool_errors_mm(linearization_.validation, trial.validation_residual, model_.scales, problem_.data);
  const Resampled draws = resampled(linearization_.fitted, trial, projection_.residual(), rules_.resamples,
                                    random(RandomPurpose::effect_scatter), rules_.do_work);
  Round round;
  round.number = rules_.first_round + static_cast<int>(outcome_.rounds.size());
  round.group = rules_.group;
  round.effect = effect;
  round.effect.values.assign(trial.coefficients.begin(), trial.coefficients.end());
  round.p_structure = rules_.p_structure;
  const std::vector<double>& null = found_by_search(index) ? rules_.evolved_null_gains : null_maxima_;
  round.p_family = family_p_value(null, scores_[index].gain_nats);
  round.null_draws = static_cast<int>(null.size());
  round.gain_nats = scores_[index].gain_nats;
  round.validation_before_mm = mean(before);
  round.validation_after_mm = mean(after);
  const Confirmation borne_out =
      confirmation_of(projection_.validation_residual(), trial.validation_residual, RandomPurpose::effect_gain);
  round.confirmed = borne_out.share;
  round.confirmed_lower = borne_out.lower;
  round.sign_stability = draws.sign_stability;
  round.interval = draws.interval;
  round.rivals = rivals(index);
  round.diagnosis = law_of(effect).diagnosis(round.effect, problem_.data.robot);
  round.formula = law_of(effect).formula(round.effect, problem_.data.robot);
  return round;
}

/// What the validation poses say of a change of their residual rows.
Confirmation Group::confirmation_of(const Eigen::VectorXd& before, const Eigen::VectorXd& after,
                                    RandomPurpose purpose) const {
  return confirmation(pose_errors_mm(linearization_.validation, before, model_.scales),
                      pose_errors_mm(linearization_.validation, after, model_.scales),
                      pose_errors_mm(linearization_.validation, before - after, model_.scales),
                      linearization_.validation.group, random(purpose), rules_.do_work);
}

std::string Group::rejection_reason(const Round& round, const Projection::Trial& trial) const {
  if (round.p_family > rules_.family_error) return "not significant (p = " + rounded_text(round.p_family) + ")";
  if (round.gain_nats <= 0.0) return "the description grows longer by it";
  if (projection_.freedom() - static_cast<double>(trial.rank) < kLeastFreedom)
    return "too few measured numbers are left";
  if (!linearization_.validation.poses.empty() && round.confirmed <= kGains) return "no gain on the validation poses";
  if (round.sign_stability < kStableSign) return "unstable under bootstrap resampling";
  return {};
}

void Group::add(Round round, const Tried& chosen) {
  round.verdict = Verdict::added;
  outcome_.rounds.push_back(std::move(round));
  projection_.add(chosen.trial);
  scan_.follow(chosen.products, chosen.trial, projection_);
  tried_.reset();
  scores_ = scan_.scores();
  const Eigen::VectorXd& left = projection_.validation_residual();
  const Confirmation since = confirmation_of(confirmed_residual_, left, RandomPurpose::group_gain);
  if (!linearization_.validation.poses.empty() && (since.share <= kGains || since.lower <= 0.0)) return;
  confirmed_residual_ = left;
  confirmed_rounds_ = outcome_.rounds.size();
}

/// What explains the same as a rejected effect would be rejected too.
void Group::exclude_equivalents(const Round& round) {
  for (const Rival& rival : round.rivals) {
    if (rival.cosine < kEquivalentCosine) continue;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const bool real = candidates_[i].decoy_kind == DecoyKind::none;
      excluded_[i] = excluded_[i] || (real && candidates_[i].effect.same_law_as(rival.effect));
    }
  }
}

/// Rounds after the last that was confirmed are not believed.
void Group::drop_unconfirmed() {
  for (std::size_t i = 0; i < outcome_.rounds.size(); ++i) {
    Round& round = outcome_.rounds[i];
    if (round.verdict != Verdict::added) continue;
    if (i < confirmed_rounds_) {
      outcome_.added.push_back(round.effect);
    } else {
      round.verdict = Verdict::rejected;
      round.reason = "the validation poses do not confirm it";
    }
  }
}

GroupOutcome Group::run(const std::function<bool(const Round&)>& watch) {
  int added = 0, rejected = 0;
  while (added < rules_.most && rejected < kMostRejections && !outcome_.stopped) {
    const auto index = best_candidate();
    if (!index) break;
    update_null_maxima(*index);
    Round round = evaluate(*index);
    excluded_[*index] = true;
    // Beside effects just added the noise is not yet what it will be: the next group tries decoys again.
    if (candidates_[*index].decoy_kind != DecoyKind::none && added > 0) break;
    if (candidates_[*index].decoy_kind != DecoyKind::none && round.p_family <= rules_.family_error) {
      outcome_.winning_decoy = decoy_name(candidates_[*index]);
      round.verdict = Verdict::rejected;
      round.reason = "a decoy, " + *outcome_.winning_decoy + ", explains more than any real effect";
      outcome_.rounds.push_back(std::move(round));
      break;
    }
    round.reason = rejection_reason(round, tried(*index).trial);
    if (round.reason.empty()) {
      round.reason = implausibility(round.effect, problem_, model_, linearization_.fitted.states);
      round.implausible = !round.reason.empty();
    }
    outcome_.not_significant = round.p_family > rules_.family_error && !found_by_search(*index);
    if (round.reason.empty()) {
      add(std::move(round), tried(*index));
      ++added;
    } else {
      round.verdict = outcome_.not_significant ? Verdict::none : Verdict::rejected;
      if (!has_impossible_coefficients(round.effect))
        exclude_equivalents(round);  // what is like it but possible is still to be tried
      outcome_.rounds.push_back(std::move(round));
      ++rejected;
    }
    if (watch && !watch(outcome_.rounds.back())) outcome_.stopped = true;
    if (outcome_.not_significant) break;
  }
  drop_unconfirmed();
  return std::move(outcome_);
}

double validation_gain(const GroupOutcome& outcome) {
  double before_mm = std::numeric_limits<double>::quiet_NaN(), after_mm = before_mm;
  for (const Round& round : outcome.rounds) {
    if (std::isnan(before_mm)) before_mm = round.validation_before_mm;
    if (round.verdict == Verdict::added) after_mm = round.validation_after_mm;
  }
  return (before_mm - after_mm) / before_mm;
}

}  // namespace demecal::inline diagnosis
