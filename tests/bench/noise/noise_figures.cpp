#include "noise_figures.hpp"

#include <algorithm>
#include <functional>
#include <limits>

#include "closed_loop/summary.hpp"

namespace demecal::bench {
namespace {

using Cases = std::vector<NoisyCaseFigures>;

/// The figures of one condition while they are taken.
class Taking {
 public:
  explicit Taking(const Cases& cases) : cases_(cases) {}

  void add(std::string name, int of, double value, const Bound& bound = {}) {
    figures_.push_back({cases_.front().plan.condition.name, std::move(name), of, value, bound});
  }
  /// The share of all cases for which `holds`.
  void add_share(std::string name, const std::function<bool(const NoisyCaseFigures&)>& holds, const Bound& bound = {}) {
    const auto part = static_cast<int>(std::ranges::count_if(cases_, holds));
    add(std::move(name), size(), share(part, size()), bound);
  }
  int size() const { return static_cast<int>(cases_.size()); }
  std::vector<NoiseFigure> take() { return std::move(figures_); }

 private:
  const Cases& cases_;
  std::vector<NoiseFigure> figures_;
};

double usable_error_mm(const DiagnosisFigures& run) {
  return run.failed || run.refused ? std::numeric_limits<double>::infinity() : run.clean_after_mm;
}

double largest(const std::vector<double>& values) {
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : std::ranges::max(values);
}

void take_false_effects(const Cases& cases, Taking& taking) {
  taking.add_share("cases with a false effect", [](const auto& one) { return one.false_effects > 0; },
                   {.at_most = 0.05});
  taking.add_share("first-round p <= .05", [](const auto& one) { return one.clean.first_p <= 0.05; },
                   {.at_most = 0.08});
  taking.add_share("first-round p <= .2", [](const auto& one) { return one.clean.first_p <= 0.2; });
  taking.add_share("first-round p <= .5", [](const auto& one) { return one.clean.first_p <= 0.5; });
  std::vector<double> ratios, errors_mm;
  for (const NoisyCaseFigures& one : cases) {
    ratios.push_back(usable_error_mm(one.clean) / one.clean.clean_before_mm);
    errors_mm.push_back(usable_error_mm(one.clean));
  }
  taking.add("clean error with / without effects, 95 %", taking.size(), quantile(ratios, 0.95), {.at_most = 1.02});
  taking.add("clean error with / without effects, max", taking.size(), largest(ratios));
  taking.add("clean error, mm, median", taking.size(), quantile(errors_mm, 0.5));
}

void take_bad_poses(const Cases& cases, Taking& taking) {
  const Fault fault = cases.front().plan.condition.fault;
  std::vector<double> ratios;
  for (const NoisyCaseFigures& one : cases) ratios.push_back(usable_error_mm(*one.bad) / one.clean.clean_after_mm);
  taking.add("clean error / twin's, median", taking.size(), quantile(ratios, 0.5));
  taking.add("clean error / twin's, 95 %", taking.size(), quantile(ratios, 0.95),
             {.at_most = fault == Fault::gross ? 1.15 : 1.2});
  taking.add("clean error / twin's, max", taking.size(), largest(ratios));
  Bound named;
  if (fault == Fault::exchanged) named.at_least = 1.0;
  if (fault == Fault::typing) named.at_least = 0.9;
  taking.add_share(
      "cases with all bad poses named", [](const auto& one) { return *one.bad_poses_named; }, named);
}

void take_power(const Cases& cases, Taking& taking) {
  const auto add = [&](std::string name, double at, const Bound& bound) {
    int of = 0, named = 0;
    for (const NoisyCaseFigures& one : cases) {
      for (const InjectedEffect& injected : one.injected) {
        if (injected.share_of_limit != at) continue;
        ++of;
        named += injected.named ? 1 : 0;
      }
    }
    taking.add(std::move(name), of, share(named, of), bound);
  };
  add("named at the stated limit", 1.0, {.at_least = 0.85});
  add("named at half of it", 0.5, {.at_most = 0.2});
}

void take_intervals(const Cases& cases, Taking& taking) {
  int of = 0, named = 0, stated = 0, covered = 0;
  for (const NoisyCaseFigures& one : cases) {
    for (const InjectedEffect& injected : one.injected) {
      ++of;
      named += injected.named ? 1 : 0;
      stated += injected.covered ? 1 : 0;
      covered += injected.covered.value_or(false) ? 1 : 0;
    }
  }
  taking.add("named at 3 times the stated limit", of, share(named, of));
  taking.add("intervals of them that cover the truth", stated, share(covered, stated),
             {.at_least = 0.92, .at_most = 0.98});
}

/// Accept poses of the runs without bad poses or effects put in, whose errors are within what is to hold 95 % of them.
void take_prediction_intervals(const Cases& cases, Taking& taking) {
  int accept = 0, within = 0;
  for (const NoisyCaseFigures& one : cases) {
    accept += one.clean.accept;
    within += one.clean.within;
  }
  taking.add("accept poses within their 95 %", accept, share(within, accept), {.at_least = 0.93, .at_most = 0.97});
}

std::vector<double> seconds_of(const Cases& cases) {
  std::vector<double> seconds;
  for (const NoisyCaseFigures& one : cases) {
    double sum = one.clean.seconds + (one.bad ? one.bad->seconds : 0.0);
    for (const InjectedEffect& injected : one.injected) sum += injected.run.seconds;
    seconds.push_back(sum);
  }
  return seconds;
}

}  // namespace

std::vector<NoiseFigure> noise_figures(const std::vector<NoisyCaseFigures>& cases) {
  Taking taking(cases);
  switch (cases.front().plan.condition.question) {
    case Question::false_effects:
      take_false_effects(cases, taking);
      take_prediction_intervals(cases, taking);
      break;
    case Question::bad_poses:
      take_bad_poses(cases, taking);
      break;
    case Question::power:
      take_power(cases, taking);
      break;
    case Question::intervals:
      take_intervals(cases, taking);
      take_prediction_intervals(cases, taking);
      break;
  }
  taking.add_share("cases refused, or without a model", [](const auto& one) {
    return one.clean.refused || one.clean.failed || (one.bad && (one.bad->refused || one.bad->failed));
  });
  taking.add("processor seconds a case, median", taking.size(), quantile(seconds_of(cases), 0.5));
  return taking.take();
}

}  // namespace demecal::bench
