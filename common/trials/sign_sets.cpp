#include "trials/sign_sets.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "data/spread_poses.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline trials {
namespace {

constexpr std::size_t kSignRows = 30;      ///< rows that sets are tried on
constexpr double kFitAlike = 1.2;          ///< ratio of medians up to which sets fit alike
constexpr double kAlikeDistance_m = 2e-3;  ///< up to which sets leave the description alike
constexpr double kQuarters[] = {0.0, 90.0, -90.0, 180.0};

struct SignSet {
  std::vector<double> factors, zeros_deg;  ///< of each joint
  double median_m = std::numeric_limits<double>::infinity();
  double distance_m = std::numeric_limits<double>::infinity();

  void apply(Trial& trial) const {
    for (TrialRow& row : trial.rows)
      for (std::size_t joint = 0; joint < factors.size(); ++joint) {
        double& q = row.joints[static_cast<Eigen::Index>(joint)];
        q = factors[joint] * q + radians(zeros_deg[joint]);
      }
  }

  long changes() const {
    return std::ranges::count(factors, -1.0) + std::ssize(zeros_deg) - std::ranges::count(zeros_deg, 0.0);
  }
};

std::string listed_parts(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return text;
}

std::string signs_clause(const SignSet& set) {
  std::vector<std::string> negated, shifted;
  for (std::size_t joint = 0; joint < set.factors.size(); ++joint) {
    if (set.factors[joint] < 0.0) negated.push_back(std::to_string(joint + 1));
    if (set.zeros_deg[joint] != 0.0)
      shifted.push_back(fmt::format("{:+g} deg are added to joint {}", set.zeros_deg[joint], joint + 1));
  }
  std::string clause;
  if (negated.size() == 1) clause = "joint " + negated.front() + " is taken with the other sign";
  if (negated.size() > 1) clause = "joints " + listed_parts(negated) + " are taken with the other sign";
  if (!shifted.empty()) clause += (clause.empty() ? "" : ", and then ") + listed_parts(shifted);
  return clause;
}

void try_set(const Trial& trial, bool in_base, SignSet& set) {
  Trial read = trial;
  set.apply(read);
  const TrialFit fit = fit_base_and_tools(read);
  set.median_m = fit.median_m;
  set.distance_m = distance_from_description_m(read, fit, in_base);
}

/// The zeros to try with every set of signs. Those of the first and the last joint go with base and tool.
std::vector<std::vector<double>> zeros_tried(const Chain& chain, bool zeros) {
  const auto n = static_cast<std::size_t>(chain.size());
  std::vector<std::vector<double>> all{std::vector<double>(n, 0.0)};
  if (!zeros) return all;
  const auto turns = [&](std::size_t joint) { return is_revolute(chain, static_cast<int>(joint)); };
  for (std::size_t one = 1; one + 1 < n; ++one) {
    for (const double by_deg : kQuarters) {
      if (by_deg == 0.0 || !turns(one)) continue;
      std::vector<double> with = all.front();
      with[one] = by_deg;
      all.push_back(with);
      for (std::size_t other = one + 1; other + 1 < n; ++other) {
        for (const double other_deg : kQuarters) {
          if (other_deg == 0.0 || !turns(other)) continue;
          all.push_back(with);
          all.back()[other] = other_deg;
        }
      }
    }
  }
  return all;
}

/// The quarter turns of first and last joint that leave base and tools nearest to their description.
SignSet with_outer_zeros(const Trial& trial, bool in_base, const SignSet& set) {
  SignSet best = set;
  for (const double first_deg : kQuarters) {
    for (const double last_deg : kQuarters) {
      SignSet turned = set;
      if ((first_deg != 0.0 && (!in_base || !is_revolute(trial.chain, 0))) ||
          (last_deg != 0.0 && !is_revolute(trial.chain, trial.chain.size() - 1)))
        continue;
      turned.zeros_deg.front() += first_deg;
      turned.zeros_deg.back() += last_deg;
      try_set(trial, in_base, turned);
      if (turned.median_m < kFitAlike * set.median_m && turned.distance_m < best.distance_m - kAlikeDistance_m)
        best = std::move(turned);
    }
  }
  return best;
}

}  // namespace

double distance_from_description_m(const Trial& trial, const TrialFit& fit, bool in_base) {
  constexpr double kLever_m = 0.5;
  double distance_m = 0.0;
  for (std::size_t i = 0; i < fit.tools_m.size(); ++i)
    distance_m = std::max(distance_m, (fit.tools_m[i] - trial.tools_m[i]).norm());
  if (!in_base) return distance_m;
  const Eigen::Isometry3d& base = fit.sensor_from_base.front();
  return distance_m + base.translation().norm() + kLever_m * vector_of(base.linear()).norm();
}

std::vector<std::string> alike_sentences(const SignSetChoice& choice) {
  constexpr std::size_t kNamed = 5;
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < std::min(choice.alike.size(), kNamed); ++i) {
    const SignSetChoice::Alike& other = choice.alike[i];
    sentences.push_back(fmt::format(
        "Fits alike: {}; tool and base then stand {:.1f} mm from their description, with the set above {:.1f} mm.",
        other.clause.empty() ? "joints are taken as they are" : other.clause, millimetres(other.distance_m),
        millimetres(choice.distance_m)));
  }
  if (choice.alike.size() > kNamed)
    sentences.push_back(fmt::format("Fits alike: {} sets of signs more.", choice.alike.size() - kNamed));
  return sentences;
}

std::optional<SignSetChoice> best_sign_set(const Trial& trial, SignSetSearch search) {
  const int n = trial.chain.size();
  if (n > kMostSigned || n < 2 || trial.rows.empty()) return std::nullopt;
  Trial fewer{trial.chain, trial.tools_m, {}, trial.stations};
  for (const std::size_t i : spread_indices(trial.rows.size(), kSignRows)) fewer.rows.push_back(trial.rows[i]);
  std::vector<SignSet> sets;
  double least_m = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& zeros_deg : zeros_tried(trial.chain, search.zeros)) {
    for (unsigned signs = 0; signs < 1U << static_cast<unsigned>(n); ++signs) {
      SignSet set{std::vector<double>(static_cast<std::size_t>(n), 1.0), zeros_deg};
      for (std::size_t joint = 0; joint < set.factors.size(); ++joint)
        if (((signs >> joint) & 1U) != 0) set.factors[joint] = -1.0;
      try_set(fewer, search.in_base, set);
      least_m = std::min(least_m, set.median_m);
      sets.push_back(std::move(set));
    }
  }
  std::optional<SignSet> best;
  std::vector<SignSet> alike;
  for (const SignSet& set : sets) {
    if (set.median_m > kFitAlike * least_m) continue;
    alike.push_back(with_outer_zeros(fewer, search.in_base, set));
    const SignSet& turned = alike.back();
    const double nearer_m = best ? best->distance_m - turned.distance_m : 1.0;
    if (!best || nearer_m > kAlikeDistance_m || (nearer_m > -kAlikeDistance_m && turned.changes() < best->changes()))
      best = turned;
  }
  if (!best || best->changes() == 0) return std::nullopt;
  const SignSet& set = *best;
  const bool negates = std::ranges::count(set.factors, -1.0) > 0;
  SignSetChoice choice{{negates ? FindingKind::joint_sign : FindingKind::joint_offset, -1, signs_clause(set),
                        [set](Trial& read) { set.apply(read); }},
                       set.distance_m};
  std::ranges::stable_sort(alike, {}, &SignSet::changes);
  for (const SignSet& other : alike)
    if (const std::string clause = signs_clause(other); clause != choice.best.clause)
      choice.alike.push_back({clause, other.distance_m});
  return choice;
}

}  // namespace demecal::inline trials
