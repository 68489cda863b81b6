#include "explanations/explanation_front.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "data/data_set.hpp"
#include "effects/effect.hpp"
#include "explanations/causes.hpp"
#include "kinematics/units.hpp"
#include "pieces/pieces.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"

namespace demecal::inline explanations {
namespace {

/// The mean of the differences by pose over its standard error, and more than that where they hardly differ.
bool is_within_one_standard_error(const SquaredErrors_mm2& errors, const SquaredErrors_mm2& best) {
  const auto count = static_cast<double>(errors.size());
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double more = errors[i] - best[i];
    sum += more;
    squares += more * more;
  }
  const double mean = sum / count;
  const double variance = std::max(squares / count - mean * mean, 0.0) * count / std::max(count - 1.0, 1.0);
  return mean <= std::sqrt(variance / count);
}

struct JudgedSet {
  ExplanationFront::Point point;
  SquaredErrors_mm2 errors;
};

/// The best set for every number of causes by its errors at the judging poses.
class JudgedSets {
 public:
  using ErrorsOfSet = std::function<SquaredErrors_mm2(const std::vector<std::size_t>&)>;
  explicit JudgedSets(ErrorsOfSet errors_of) : errors_of_(std::move(errors_of)) {}

  /// Of sets of as many causes the best stays, or the last where nothing judges.
  void offer(const std::vector<EffectSet>& sets, bool last) { offer(sets, last, 1.0); }

  /// What each set is without one of its causes. Sets were searched for by the fitted poses, in which some causes
  /// hardly show: such a set may judge far better than what was found of as many causes. Where it does a little
  /// better, that may be chance.
  void offer_without_causes(const ExplanationProblem& problem) {
    constexpr double kFarBetter = 0.8;  ///< ratio of rms errors
    for (std::size_t count = kReadableCauses; count > 0; --count) {
      const auto from = std::ranges::lower_bound(all_, count, {}, causes_of_set);
      if (from == all_.end() || from->point.causes != count) continue;
      const auto cause_of_effect = [&](std::size_t effect) { return problem.cause[effect]; };
      std::set<std::size_t> causes;
      for (const std::size_t effect : from->point.set) causes.insert(cause_of_effect(effect));
      std::vector<EffectSet> smaller;
      for (const std::size_t cause : causes) {
        smaller.push_back({.effects = from->point.set, .causes = count - 1});
        std::erase_if(smaller.back().effects, [&](std::size_t effect) { return cause_of_effect(effect) == cause; });
      }
      offer(smaller, false, kFarBetter);
    }
  }

  const std::vector<JudgedSet>& all() const { return all_; }

 private:
  static std::size_t causes_of_set(const JudgedSet& one) { return one.point.causes; }

  /// The same; what stands there gives way to less than `share` of its error, and below a share of 1 a number of
  /// causes that nothing stands for yet is taken only where it errs less than fewer causes do.
  void offer(const std::vector<EffectSet>& sets, bool last, double share) {
    std::vector<SquaredErrors_mm2> errors(sets.size());
    in_pieces(sets.size(), [&](std::size_t i) { errors[i] = errors_of_(sets[i].effects); });
    for (std::size_t i = 0; i < sets.size(); ++i) {
      JudgedSet one{{sets[i].effects, sets[i].causes, std::sqrt(mean(errors[i]))}, std::move(errors[i])};
      const auto place = std::ranges::lower_bound(all_, one.point.causes, {}, causes_of_set);
      if (place == all_.end() || place->point.causes != one.point.causes) {
        const bool gains =
            place == all_.begin() || one.point.validation_rms_mm < std::prev(place)->point.validation_rms_mm;
        if (share == 1.0 || gains) all_.insert(place, std::move(one));
      } else if (last || one.point.validation_rms_mm < share * place->point.validation_rms_mm) {
        *place = std::move(one);
      }
    }
  }

  ErrorsOfSet errors_of_;
  std::vector<JudgedSet> all_;  ///< by number of causes
};

/// Whether a model's errors are hardly larger than the best ones, and by less than one standard error. Of more causes
/// than a person acts on, a further one has to earn more.
bool are_nearly_as_small(const SquaredErrors_mm2& errors, std::size_t causes, const SquaredErrors_mm2& best) {
  constexpr std::size_t kManyCauses = 10;
  constexpr double kHardlyMore = 1.02;  ///< of the rms error: few poses tell even large differences not surely
  constexpr double kMoreOfMany = 1.05;
  const double ratio = std::sqrt(mean(errors) / std::max(mean(best), 1e-300));
  if (causes >= kManyCauses) return ratio <= kMoreOfMany;
  return ratio <= kHardlyMore && is_within_one_standard_error(errors, best);
}

/// Models of sets, and how they are judged.
struct Judge {
  const DiagnosisProblem& problem;
  const SetModels& models;
  std::vector<std::size_t> poses;

  SquaredErrors_mm2 to_first_order(const std::vector<std::size_t>& set) const {
    return squared_errors(problem.data, poses, models.with(set).robot);
  }
  /// Gives the model's errors where its numbers are those that the fitted poses want, if these are smaller.
  void refine(JudgedSet& one) const {
    one.point.refined = model_of(problem, models, one.point);
    SquaredErrors_mm2 errors = squared_errors(problem.data, poses, one.point.refined->robot);
    if (mean(errors) >= mean(one.errors)) return;
    one.errors = std::move(errors);
    one.point.validation_rms_mm = std::sqrt(mean(one.errors));
  }
};

/// Chooses of `sets`, which are the front's points, as judged_front() says; not before `first`.
void choose_fewest(const Judge& judge, std::vector<JudgedSet> sets, std::size_t first, ExplanationFront& front) {
  constexpr double kLittle = 1.25;  ///< ratio of rms errors to first order that a refinement may change
  JudgedSet& best = sets[front.best];
  bool is_best_refined = false;
  for (front.chosen = first; front.chosen < front.best; ++front.chosen) {
    JudgedSet& one = sets[front.chosen];
    const auto does_as_well = [&] { return are_nearly_as_small(one.errors, one.point.causes, best.errors); };
    if (does_as_well()) return;
    if (one.point.validation_rms_mm > kLittle * best.point.validation_rms_mm) continue;
    if (!std::exchange(is_best_refined, true)) judge.refine(best);
    judge.refine(one);
    front.points[front.chosen] = one.point;
    front.points[front.best] = best.point;
    if (!does_as_well()) continue;
    if (one.point.validation_rms_mm < best.point.validation_rms_mm) front.best = front.chosen;
    return;
  }
}

/// Whether there is a cause by the loop's tests and by the validation poses: the choice is then of how many.
bool is_told_by_all(const DiagnosedModel& model, const ExplanationFront& front) {
  return !causes_of(model.robot).empty() && front.points.size() > 1 && front.points.front().causes == 0 &&
         front.points[1].validation_rms_mm < front.points.front().validation_rms_mm;
}

/// In the place of the one of as many causes.
void insert_chosen(ExplanationFront::Point point, ExplanationFront& front) {
  std::erase_if(front.points, [&](const ExplanationFront::Point& one) { return one.causes == point.causes; });
  const auto place = std::ranges::lower_bound(front.points, point.causes, {}, &ExplanationFront::Point::causes);
  front.chosen = static_cast<std::size_t>(place - front.points.begin());
  front.points.insert(place, std::move(point));
  const auto best = std::ranges::min_element(front.points, {}, &ExplanationFront::Point::validation_rms_mm);
  front.best = static_cast<std::size_t>(best - front.points.begin());
}

}  // namespace

SquaredErrors_mm2 squared_errors(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot) {
  SquaredErrors_mm2 errors;
  for (const double error_m : tool_errors_m(robot, data, poses)) errors.push_back(std::pow(millimetres(error_m), 2));
  return errors;
}

std::vector<std::size_t> judging_poses(const DiagnosisProblem& problem, const CorrectedRobot& robot) {
  std::vector<std::size_t> poses = problem.validation.empty() ? problem.fitted : problem.validation;
  const std::vector<double> errors_m = tool_errors_m(robot, problem.data, poses);
  const double limit_m = gross_error_limit(errors_m);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (errors_m[i] <= limit_m) kept.push_back(poses[i]);
  return kept;
}

std::vector<PricedEffect> effects_of(const DiagnosedModel& model) {
  std::vector<PricedEffect> effects;
  for (const Effect& effect : model.robot.effects) effects.push_back({effect, 0.0});
  return effects;
}

DiagnosedModel model_of(const DiagnosisProblem& problem, const SetModels& models,
                        const ExplanationFront::Point& point) {
  constexpr int kSteps = 3;
  return point.refined ? *point.refined : refined(problem, models.with(point.set), kSteps);
}

ExplanationFront judged_front(const DiagnosisProblem& problem, const DiagnosedModel& model, const SetModels& models,
                              std::vector<PricedEffect> effects, const std::vector<EffectSet>& sets) {
  ExplanationFront front;
  front.effects = std::move(effects);
  if (sets.empty()) return front;
  const Judge judge{problem, models, judging_poses(problem, model.robot)};
  JudgedSets judged([&](const std::vector<std::size_t>& set) { return judge.to_first_order(set); });
  judged.offer(sets, problem.validation.empty());
  if (!problem.validation.empty()) judged.offer_without_causes(models.problem());
  for (const JudgedSet& one : judged.all()) front.points.push_back(one.point);
  const auto best = std::ranges::min_element(front.points, {}, &ExplanationFront::Point::validation_rms_mm);
  front.best = static_cast<std::size_t>(best - front.points.begin());
  if (problem.validation.empty()) front.best = front.points.size() - 1;
  front.chosen = front.best;
  if (!problem.validation.empty()) choose_fewest(judge, judged.all(), is_told_by_all(model, front) ? 1 : 0, front);
  return front;
}

bool does_as_well(const DiagnosisProblem& problem, const DiagnosedModel& model, const DiagnosedModel& other) {
  if (problem.validation.empty()) return true;
  const std::vector<std::size_t> judging = judging_poses(problem, other.robot);
  return are_nearly_as_small(squared_errors(problem.data, judging, model.robot), causes_of(model.robot).size(),
                             squared_errors(problem.data, judging, other.robot));
}

void choose_set(const DiagnosisProblem& problem, const DiagnosedModel& model, const SetModels& models,
                std::vector<std::size_t> set, ExplanationFront& front) {
  const Judge judge{problem, models, judging_poses(problem, model.robot)};
  ExplanationFront::Point point{.set = std::move(set)};
  point.causes = FittedSet(models.problem(), point.set).causes().size();
  point.validation_rms_mm = std::sqrt(mean(judge.to_first_order(point.set)));
  insert_chosen(std::move(point), front);
}

void choose(const DiagnosisProblem& problem, const DiagnosedModel& model, ExplanationFront& front) {
  ExplanationFront::Point point;
  for (std::size_t i = 0; i < front.effects.size(); ++i)
    for (const Effect& effect : model.robot.effects)
      if (effect.same_law_as(front.effects[i].effect)) point.set.push_back(i);
  point.causes = causes_of(model.robot).size();
  point.validation_rms_mm =
      std::sqrt(mean(squared_errors(problem.data, judging_poses(problem, model.robot), model.robot)));
  if (!front.points.empty()) front.points.erase(front.points.begin() + static_cast<std::ptrdiff_t>(front.chosen));
  insert_chosen(std::move(point), front);
}

ExplanationFront pruned_front(const DiagnosisProblem& problem, const DiagnosedModel& model) {
  std::vector<PricedEffect> effects = effects_of(model);
  const SetModels models(problem, model, effects);
  ExplanationFront front =
      judged_front(problem, model, models, std::move(effects), prunings(models.problem(), models.held()));
  front.chosen = front.best = front.points.size() - 1;
  return front;
}

}  // namespace demecal::inline explanations
