#include "explanations/error_budget.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <utility>

#include "data/data_set.hpp"
#include "effects/effect.hpp"
#include "explanations/set_models.hpp"
#include "parameters/parameter_space.hpp"
#include "pieces/pieces.hpp"
#include "prediction/corrected_robot.hpp"
#include "random/distributions.hpp"

namespace demecal::inline explanations {
namespace {

/// 95 % of the root of the fall of the mean square when poses are drawn anew.
std::array<double, 2> fall_interval(const SquaredErrors_mm2& without, const SquaredErrors_mm2& with,
                                    RandomStream& random) {
  constexpr std::size_t kDraws = 400;
  std::vector<double> falls_mm;
  for (std::size_t draw = 0; draw < kDraws; ++draw) {
    double fall_mm2 = 0.0;
    for (std::size_t i = 0; i < with.size(); ++i) {
      const std::size_t pose = random.index(with.size());
      fall_mm2 += (without[pose] - with[pose]) / static_cast<double>(with.size());
    }
    falls_mm.push_back(std::sqrt(std::max(fall_mm2, 0.0)));
  }
  std::ranges::sort(falls_mm);
  return {falls_mm[kDraws / 40], falls_mm[kDraws - 1 - kDraws / 40]};
}

/// The effects of the front's sets, the first `in_front`, then those of the model that are in none.
struct Considered {
  std::vector<PricedEffect> effects{};
  std::size_t in_front = 0;
  std::vector<std::vector<std::size_t>> sets{};  ///< of the front's points, as places among the effects
};

Considered considered_of(const ExplanationFront& front, const DiagnosedModel& model) {
  Considered considered;
  std::vector<std::size_t> place(front.effects.size(), front.effects.size());
  for (const ExplanationFront::Point& point : front.points) {
    std::vector<std::size_t>& set = considered.sets.emplace_back();
    for (const std::size_t effect : point.set) {
      if (place[effect] == front.effects.size()) {
        place[effect] = considered.effects.size();
        considered.effects.push_back(front.effects[effect]);
      }
      set.push_back(place[effect]);
    }
  }
  considered.in_front = considered.effects.size();
  for (PricedEffect& own : effects_of(model)) {
    const auto is_it = [&](const PricedEffect& one) { return one.effect.same_law_as(own.effect); };
    if (std::ranges::none_of(considered.effects, is_it)) considered.effects.push_back(std::move(own));
  }
  return considered;
}

/// What a model leaves at some poses, and to first order what it leaves with other effects: the mean square of a set is
/// the model's own and by how much that of the set, linearised about the model, exceeds that of the model's own set.
class ErrorsOfSets {
 public:
  /// Sets are of the considered effects.
  ErrorsOfSets(const DiagnosisProblem& problem, const DiagnosedModel& model, const Considered& considered,
               std::span<const std::size_t> poses)
      : data_(problem.data),
        poses_(poses),
        models_(problem, model, considered.effects),
        in_front_(considered.in_front),
        held_(of(models_.held())),
        own_mm2_(mean(squared_errors(data_, poses_, model.robot))) {
    for (const Effect& own : model.robot.effects) {
      const auto is_it = [&](const PricedEffect& one) { return one.effect.same_law_as(own); };
      const auto place = std::ranges::find_if(considered.effects, is_it);
      place_.push_back(static_cast<std::size_t>(place - considered.effects.begin()));
    }
  }

  double rms_of_model_mm() const { return std::sqrt(own_mm2_); }
  double rms_mm(const std::vector<std::size_t>& set) const {
    return std::sqrt(std::max(own_mm2_ + mean(of(set)) - mean(held_), 0.0));
  }
  SquaredErrors_mm2 of(const std::vector<std::size_t>& set) const {
    return squared_errors(data_, poses_, models_.with(set).robot);
  }
  const SquaredErrors_mm2& of_held() const { return held_; }
  /// A set of the front, with what the model holds beside all of them.
  std::vector<std::size_t> whole(std::vector<std::size_t> set) const {
    std::ranges::copy_if(models_.held(), std::back_inserter(set),
                         [this](std::size_t place) { return place >= in_front_; });
    return set;
  }
  std::vector<std::size_t> held_without(const ErrorCause& cause) const {
    std::vector<std::size_t> others = models_.held();
    for (const std::size_t effect : cause.effects) std::erase(others, place_[effect]);
    return others;
  }

 private:
  const DataSet& data_;
  std::span<const std::size_t> poses_;
  SetModels models_;
  std::size_t in_front_;
  std::vector<std::size_t> place_;  ///< of each of the model's effects
  SquaredErrors_mm2 held_;
  double own_mm2_;
};

/// The model without the cause that it misses least stands for as many causes where nothing else does that errs less:
/// the search goes by the fitted poses and may not have come by it. `last`: of the accept poses after the last fit.
void offer_without_one(const ErrorsOfSets& last, ErrorBudget& budget) {
  const CauseCost& least = budget.causes.back();
  const auto place = std::ranges::find(budget.front, budget.causes.size() - 1, &FrontPoint::causes);
  if (place == budget.front.end() || place->chosen || place->validation_rms_mm <= least.without_mm) return;
  place->validation_rms_mm = least.without_mm;
  if (place->accept_rms_mm) place->accept_rms_mm = last.rms_mm(last.held_without(least.cause));
}

}  // namespace

ErrorBudget error_budget(const DiagnosisProblem& problem, const DiagnosedModel& model, const ExplanationFront& front,
                         std::span<const std::size_t> last_fitted, const DiagnosedModel& last, RandomStream random) {
  ErrorBudget budget;
  const std::vector<ErrorCause> causes = causes_of(model.robot);
  const std::vector<std::size_t> judging = judging_poses(problem, model.robot);
  if (causes.empty() || judging.empty()) return budget;
  const DiagnosisProblem last_problem{problem.data, problem.declared, {last_fitted.begin(), last_fitted.end()}, {}};
  const std::vector<std::size_t> accept = poses_of(problem.data, PoseSet::accept);
  const Considered considered = considered_of(front, model);
  const ErrorsOfSets errors(problem, model, considered, judging);
  const ErrorsOfSets last_errors(last_problem, last, considered, accept);
  budget.front.resize(front.points.size());
  in_pieces(front.points.size(), [&](std::size_t i) {
    const ExplanationFront::Point& at = front.points[i];
    FrontPoint& point = budget.front[i];
    point = {.causes = at.causes, .chosen = i == front.chosen};
    point.validation_rms_mm = point.chosen ? errors.rms_of_model_mm() : errors.rms_mm(errors.whole(considered.sets[i]));
    if (!accept.empty())
      point.accept_rms_mm =
          point.chosen ? last_errors.rms_of_model_mm() : last_errors.rms_mm(last_errors.whole(considered.sets[i]));
  });
  const double with_mm = errors.rms_of_model_mm(), bare_mm = errors.rms_mm({});
  const std::uint64_t name = random.name();
  budget.causes.resize(causes.size());
  in_pieces(causes.size(), [&](std::size_t i) {
    const std::vector<std::size_t> others = errors.held_without(causes[i]);
    const double without_mm = errors.rms_mm(others);
    RandomStream own{name, i};
    budget.causes[i] = {
        .cause = causes[i],
        .without_mm = without_mm,
        .with_mm = with_mm,
        .share = std::clamp((without_mm * without_mm - with_mm * with_mm) / (bare_mm * bare_mm), 0.0, 1.0),
        .interval_mm = fall_interval(errors.of(others), errors.of_held(), own)};
  });
  std::ranges::stable_sort(budget.causes, std::greater{}, &CauseCost::without_mm);
  offer_without_one(last_errors, budget);
  return budget;
}

}  // namespace demecal::inline explanations
