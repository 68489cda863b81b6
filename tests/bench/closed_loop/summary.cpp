#include "summary.hpp"

#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace demecal::bench {
namespace {

std::string bound_text(const Bound& bound) {
  if (bound.at_least && bound.at_most) return fmt::format("{:.2f} .. {:.2f}", *bound.at_least, *bound.at_most);
  if (bound.at_least) return fmt::format(">= {:.2f}", *bound.at_least);
  return bound.at_most ? fmt::format("<= {:.2f}", *bound.at_most) : "";
}

}  // namespace

void Summary::take(const LoopFigures& figures, const LoopFigures& clean) {
  const Score& score = figures.score;
  ++cases;
  eligible += score.eligible ? 1 : 0;
  named_eligible += score.eligible && score.named ? 1 : 0;
  named += score.named ? 1 : 0;
  in_class += score.in_class ? 1 : 0;
  with_false += score.false_additions > 0 ? 1 : 0;
  false_additions += score.false_additions;
  accept += figures.accept;
  within += figures.within;
  before_over_floor.push_back(figures.before_over_floor);
  after_over_floor.push_back(figures.after_over_floor);
  after_over_clean.push_back(figures.after_over_floor / clean.before_over_floor);
}

void Summary::take(const Summary& other) {
  cases += other.cases;
  eligible += other.eligible;
  named_eligible += other.named_eligible;
  named += other.named;
  in_class += other.in_class;
  with_false += other.with_false;
  false_additions += other.false_additions;
  accept += other.accept;
  within += other.within;
  before_over_floor.insert(before_over_floor.end(), other.before_over_floor.begin(), other.before_over_floor.end());
  after_over_floor.insert(after_over_floor.end(), other.after_over_floor.begin(), other.after_over_floor.end());
  after_over_clean.insert(after_over_clean.end(), other.after_over_clean.begin(), other.after_over_clean.end());
}

std::vector<Summary> summaries(const std::vector<CaseFigures>& cases) {
  std::vector<Summary> all;
  Summary clean{.kind = kClean}, single{.kind = "single"};
  for (const KindRow& row : kind_table()) {
    Summary summary{.kind = row.kind};
    for (const CaseFigures& one : cases) {
      if (one.plan.kind == row.kind && !one.truths.empty()) summary.take(one.run, one.clean);
    }
    if (summary.cases == 0) continue;
    if (row.kind != kPair && row.kind != kOutside) single.take(summary);
    all.push_back(std::move(summary));
  }
  for (const CaseFigures& one : cases) clean.take(one.clean, one.clean);
  if (clean.cases > 0) all.push_back(std::move(clean));
  if (single.cases > 0) all.push_back(std::move(single));
  return all;
}

double share(int part, int whole) {
  return whole == 0 ? 1.0 : static_cast<double>(part) / whole;
}

double quantile(std::vector<double> values, double share_below) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::ranges::sort(values);
  const double rank = share_below * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], rank - static_cast<double>(below));
}

bool Bound::kept_by(double value) const {
  return (!at_least || value >= *at_least) && (!at_most || value <= *at_most);
}

void write_bound(std::ostream& out, const std::string& name, double value, const Bound& bound) {
  const char* verdict = !bound.holds() ? "" : bound.kept_by(value) ? "kept" : "MISSED";
  fmt::print(out, "{:<64}{:>9.3f}   {:<13}{}\n", name, value, bound_text(bound), verdict);
}

}  // namespace demecal::bench
