#include "diagnosis/group.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "diagnosis/implausible.hpp"
#include "diagnosis/rivals.hpp"
#include "effects/law_terms.hpp"

namespace demecal {
namespace {

constexpr int kMostRejections = 12;
constexpr double kLeastFreedom = 12.0;  ///< measured numbers that a model must leave to be judged by
constexpr double kAlike = 0.9;          ///< cosine
constexpr double kSame = 0.995;         ///< cosine
constexpr double kNatsToTell = 5.0;
constexpr double kNatsAbout = 3.0;
constexpr double kStable = 0.95;  ///< share of resamples that must agree with a sign
constexpr double kGains = 0.5;    ///< share of a change borne out: errors fall above it
constexpr double kEvident = 2.0;  ///< times the largest fall by luck: no need to draw again

double mean(const std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

double family_p_value(const std::vector<double>& null_maxima, double fall_nats) {
  const auto beyond = null_maxima.end() - std::lower_bound(null_maxima.begin(), null_maxima.end(), fall_nats);
  return (1.0 + static_cast<double>(beyond)) / (1.0 + static_cast<double>(null_maxima.size()));
}

Group::Group(const DiagnosisData& of, const DiagnosedModel& model, const Linearised& at,
             const std::vector<Candidate>& candidates, const EffectColumns& columns, std::vector<bool> out,
             std::vector<double>& null_maxima, const GroupRules& rules)
    : of_(of),
      model_(model),
      at_(at),
      candidates_(candidates),
      columns_(columns),
      out_(std::move(out)),
      null_maxima_(null_maxima),
      rules_(rules),
      projection_(at.projection),
      scan_(columns, prices_nats(candidates), at.fitted, projection_),
      scores_(scan_.scores()),
      sure_left_(projection_.judging_left()) {
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].disguise != Disguise::none) decoy_falls_.push_back(scores_[i].fall_nats);
  }
}

std::vector<double> Group::decoys_p_left() const {
  std::vector<double> all;
  for (std::size_t i = 0; i < candidates_.size(); ++i)
    if (candidates_[i].disguise != Disguise::none) all.push_back(family_p_value(null_maxima_, scores_[i].fall_nats));
  return all;
}

RandomStream Group::random(RandomPurpose purpose) const {
  return RandomStream{rules_.seed, number_of(purpose), static_cast<std::uint64_t>(rules_.group),
                      outcome_.rounds.size()};
}

std::optional<std::size_t> Group::best() const {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < scores_.size(); ++i) {
    if (out_[i] || scores_[i].rank == 0) continue;
    if (!best || scores_[i].fall_nats > scores_[*best].fall_nats) best = i;
  }
  if (!best) return best;
  return simplest_like(is_symbolic(candidates_[*best].effect) ? by_name(*best) : *best);
}

/// Of candidates that explain the same and are as good a description, but for a little, the one with the fewest
/// numbers.
std::size_t Group::simplest_like(std::size_t index) const {
  std::size_t simplest = index;
  const Projection::Trial trial = projection_.trial(columns_.dense(at_.fitted, index),
                                                    RowMatrix::Zero(at_.judging.rows(), columns_.spans()[index].count));
  for (const Rival& rival : rivals_of(index, trial, candidates_, scores_, scan_, columns_, at_.fitted)) {
    if (rival.cosine < kAlike || rival.nats_behind > kNatsAbout) continue;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (out_[i] || candidates_[i].disguise != Disguise::none || scores_[i].rank >= scores_[simplest].rank) continue;
      if (candidates_[i].effect.same_law_as(rival.effect)) simplest = i;
    }
  }
  return simplest;
}

/// The catalogue's effect that a formula is in disguise: as good a description, or all but the same columns.
std::size_t Group::by_name(std::size_t formula) const {
  const Projection::Trial trial = projection_.trial(
      columns_.dense(at_.fitted, formula), RowMatrix::Zero(at_.judging.rows(), columns_.spans()[formula].count));
  std::size_t named = formula;
  for (const Rival& rival : rivals_of(formula, trial, candidates_, scores_, scan_, columns_, at_.fitted)) {
    if (is_symbolic(rival.effect) || (rival.cosine < kSame && rival.nats_behind > kNatsToTell)) continue;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (candidates_[i].disguise != Disguise::none) continue;
      const bool better = named == formula || scores_[i].fall_nats > scores_[named].fall_nats;
      if (!out_[i] && better && candidates_[i].effect.same_law_as(rival.effect)) named = i;
    }
  }
  return named;
}

/// Whether the candidate came from a search of these data, so that only the same search tells what luck finds.
bool Group::searched(std::size_t index) const {
  return candidates_[index].evolved && !rules_.evolved_luck.empty();
}

void Group::renew_null(std::size_t index) {
  const bool evident = !null_maxima_.empty() && scores_[index].fall_nats > kEvident * null_maxima_.back();
  const bool first = outcome_.rounds.empty();
  if (!null_maxima_.empty() && (evident || !first)) return;
  null_maxima_ = scan_.null_maxima(columns_, at_.fitted, projection_, rules_.permutations,
                                   random(RandomPurpose::null_distribution));
}

Round Group::judge(std::size_t index, Projection::Trial& trial) {
  const Effect& effect = candidates_[index].effect;
  EffectColumns judging;
  judging.append(effect, of_.data.robot, at_.judging.states);
  judging.pack();
  trial = projection_.trial(columns_.dense(at_.fitted, index), judging.dense(at_.judging, 0));
  const auto before = tool_errors_mm(at_.judging, projection_.judging_left(), model_.scales, of_.data);
  const auto after = tool_errors_mm(at_.judging, trial.judging_left, model_.scales, of_.data);
  const Resampled draws =
      resampled(at_.fitted, trial, projection_.left(), rules_.resamples, random(RandomPurpose::resampled_effect));
  Round round;
  round.number = rules_.first_round + static_cast<int>(outcome_.rounds.size());
  round.group = rules_.group;
  round.effect = effect;
  round.effect.values.assign(trial.coefficients.begin(), trial.coefficients.end());
  round.p_structure = rules_.p_structure;
  const std::vector<double>& luck = searched(index) ? rules_.evolved_luck : null_maxima_;
  round.p_family = family_p_value(luck, scores_[index].fall_nats);
  round.permutations = static_cast<int>(luck.size());
  round.fall_nats = scores_[index].fall_nats;
  round.validation_before_mm = mean(before);
  round.validation_after_mm = mean(after);
  const Confirmation borne_out =
      confirmed(projection_.judging_left(), trial.judging_left, RandomPurpose::gain_of_effect);
  round.confirmed = borne_out.share;
  round.confirmed_lower = borne_out.lower;
  round.sign_stability = draws.sign_stability;
  round.interval = draws.interval;
  round.rivals = rivals_of(index, trial, candidates_, scores_, scan_, columns_, at_.fitted);
  round.diagnosis = law_of(effect).diagnosis(round.effect, of_.data.robot);
  round.formula = law_of(effect).formula(round.effect, of_.data.robot);
  return round;
}

/// What the validation poses say of a change of their residual rows.
Confirmation Group::confirmed(const Eigen::VectorXd& before, const Eigen::VectorXd& after,
                              RandomPurpose purpose) const {
  return confirmation(whole_errors_mm(at_.judging, before, model_.scales),
                      whole_errors_mm(at_.judging, after, model_.scales),
                      whole_errors_mm(at_.judging, before - after, model_.scales), at_.judging.group, random(purpose));
}

std::string Group::objection(const Round& round, const Projection::Trial& trial) const {
  if (round.p_family > rules_.family_error) return "not significant (p = " + rounded_text(round.p_family) + ")";
  if (round.fall_nats <= 0.0) return "the description grows longer by it";
  if (projection_.freedom() - static_cast<double>(trial.rank) < kLeastFreedom)
    return "too few measured numbers are left";
  if (!at_.judging.poses.empty() && round.confirmed <= kGains) return "no gain on the validation poses";
  if (round.sign_stability < kStable) return "unstable under bootstrap resampling";
  return {};
}

void Group::take(Round round, const Projection::Trial& trial) {
  round.verdict = Verdict::added;
  outcome_.rounds.push_back(std::move(round));
  projection_.add(trial);
  scan_.follow(columns_, at_.fitted, projection_);
  scores_ = scan_.scores();
  const Eigen::VectorXd& left = projection_.judging_left();
  const Confirmation since = confirmed(sure_left_, left, RandomPurpose::gain_of_group);
  if (!at_.judging.poses.empty() && (since.share <= kGains || since.lower <= 0.0)) return;
  sure_left_ = left;
  sure_rounds_ = outcome_.rounds.size();
}

/// What explains the same as a rejected effect would be rejected too.
void Group::leave_out_alike(const Round& round) {
  for (const Rival& rival : round.rivals) {
    if (rival.cosine < kAlike) continue;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const bool real = candidates_[i].disguise == Disguise::none;
      out_[i] = out_[i] || (real && candidates_[i].effect.same_law_as(rival.effect));
    }
  }
}

/// Rounds after the last that was confirmed are not believed.
void Group::drop_unsure() {
  for (std::size_t i = 0; i < outcome_.rounds.size(); ++i) {
    Round& round = outcome_.rounds[i];
    if (round.verdict != Verdict::added) continue;
    if (i < sure_rounds_) {
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
    const auto index = best();
    if (!index) break;
    renew_null(*index);
    Projection::Trial trial;
    Round round = judge(*index, trial);
    out_[*index] = true;
    // Beside effects just added the noise is not yet what it will be: the next group judges decoys again.
    if (candidates_[*index].disguise != Disguise::none && added > 0) break;
    if (candidates_[*index].disguise != Disguise::none && round.p_family <= rules_.family_error) {
      outcome_.winning_decoy = decoy_name(candidates_[*index]);
      round.verdict = Verdict::rejected;
      round.reason = "a decoy, " + *outcome_.winning_decoy + ", explains more than any real effect";
      outcome_.rounds.push_back(std::move(round));
      break;
    }
    round.reason = objection(round, trial);
    if (round.reason.empty()) {
      round.reason = implausibility(round.effect, of_, model_, at_.fitted.states);
      round.implausible = !round.reason.empty();
    }
    outcome_.luck = round.p_family > rules_.family_error && !searched(*index);
    if (round.reason.empty()) {
      take(std::move(round), trial);
      ++added;
    } else {
      round.verdict = outcome_.luck ? Verdict::none : Verdict::rejected;
      // An effect that leans too far is another one in disguise: what needs no such lean is still to be judged.
      if (law_of(round.effect).implausibility(round.effect).empty()) leave_out_alike(round);
      outcome_.rounds.push_back(std::move(round));
      ++rejected;
    }
    if (watch && !watch(outcome_.rounds.back())) outcome_.stopped = true;
    if (outcome_.luck) break;
  }
  drop_unsure();
  return std::move(outcome_);
}

}  // namespace demecal
