#include "trials/explanations.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

#include "data/spread_poses.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/units.hpp"
#include "trials/sign_sets.hpp"

namespace demecal::inline trials {
namespace {

constexpr std::size_t kRefined = 6;         ///< explanations whose links are fitted too
constexpr std::size_t kPairRows = 60;       ///< rows that pairs of explanations are tried on
constexpr double kEqual = 1.1;              ///< ratio of medians up to which explanations are equals
constexpr double kToolDifference_m = 5e-3;  ///< by which the tool nearer to its description decides between equals
constexpr int kMostTogether = 4;

void scale_joint(Trial& trial, int joint, double factor) {
  for (TrialRow& row : trial.rows) row.joints[joint] *= factor;
}

void shift_joint(Trial& trial, int joint, double by) {
  for (TrialRow& row : trial.rows) row.joints[joint] += by;
}

Explanation sign(int joint) {
  return {FindingKind::joint_sign, joint, fmt::format("joint {} is taken with the other sign", joint + 1),
          [joint](Trial& trial) { scale_joint(trial, joint, -1.0); }};
}

Explanation offset(int joint, double offset_deg) {
  return {FindingKind::joint_offset, joint, fmt::format("{:+g} deg are added to joint {}", offset_deg, joint + 1),
          [=](Trial& trial) { shift_joint(trial, joint, radians(offset_deg)); }};
}

Explanation sign_and_offset(int joint, double offset_deg) {
  return {FindingKind::joint_sign, joint,
          fmt::format("joint {} is taken with the other sign, and {:+g} deg are added to it", joint + 1, offset_deg),
          [=](Trial& trial) {
            scale_joint(trial, joint, -1.0);
            shift_joint(trial, joint, radians(offset_deg));
          }};
}

Explanation exchanged(int one, int other) {
  return {FindingKind::joints_exchanged, one,
          fmt::format("the columns of joints {} and {} are exchanged", one + 1, other + 1), [=](Trial& trial) {
            for (TrialRow& row : trial.rows) std::swap(row.joints[one], row.joints[other]);
          }};
}

Explanation joint_unit(int joint, double factor, const std::string& unit) {
  return {FindingKind::unit, joint, fmt::format("joint {} is in {}", joint + 1, unit),
          [=](Trial& trial) { scale_joint(trial, joint, factor); }};
}

Explanation all_angles(double factor, const std::string& units) {
  return {FindingKind::unit, -1, "joint angles are in " + units, [factor](Trial& trial) {
            for (int joint = 0; joint < trial.chain.size(); ++joint)
              if (is_revolute(trial.chain, joint)) scale_joint(trial, joint, factor);
          }};
}

Explanation other_convention(Convention given) {
  const bool standard = given == Convention::standard_dh;
  return {FindingKind::convention, -1,
          fmt::format("the robot's table is read as {} (convention: {})",
                      standard ? "modified Denavit-Hartenberg" : "standard Denavit-Hartenberg",
                      standard ? "modified_dh" : "standard_dh"),
          [standard](Trial& trial) {
            trial.chain.convention = standard ? Convention::modified_dh : Convention::standard_dh;
          }};
}

/// Some controllers report a joint against the ground, so that it moves with the joint before.
Explanation reported_as_sum(int joint, int with, double factor) {
  return {FindingKind::convention, joint,
          fmt::format("joint {} is taken as q{} {} q{}, as where a controller reports it against the ground", joint + 1,
                      joint + 1, factor > 0 ? "+" : "-", with + 1),
          [=](Trial& trial) {
            for (TrialRow& row : trial.rows) row.joints[joint] += factor * row.joints[with];
          }};
}

Explanation mirrored() {
  return {FindingKind::mirrored, -1, "one axis of the positions is negated", [](Trial& trial) {
            for (TrialRow& row : trial.rows) row.point_m.y() = -row.point_m.y();
          }};
}

std::vector<Explanation> joint_explanations(const Chain& chain) {
  std::vector<Explanation> all;
  for (int joint = 0; joint < chain.size(); ++joint) all.push_back(sign(joint));
  for (int joint = 0; joint < chain.size(); ++joint)
    for (const double by_deg : {90.0, -90.0, 180.0})
      if (is_revolute(chain, joint)) all.push_back(offset(joint, by_deg));
  for (int one = 0; one < chain.size(); ++one)
    for (int other = one + 1; other < chain.size(); ++other) all.push_back(exchanged(one, other));
  return all;
}

std::vector<Explanation> unit_explanations(const Chain& chain) {
  std::vector<Explanation> all{all_angles(degrees(1.0), "radians, not in degrees"),
                               all_angles(radians(1.0), "degrees, not in radians")};
  std::ranges::move(position_unit_explanations(), std::back_inserter(all));
  for (int joint = 0; joint < chain.size(); ++joint) {
    const bool angle = is_revolute(chain, joint);
    all.push_back(joint_unit(joint, angle ? degrees(1.0) : 1e3, angle ? "radians" : "metres"));
    all.push_back(joint_unit(joint, angle ? radians(1.0) : 1e-3, angle ? "degrees" : "millimetres"));
  }
  return all;
}

struct Tried {
  std::vector<Explanation> explanations;
  Trial trial;
  TrialFit fit;
};

Tried attempt(Trial trial, const std::vector<Explanation>& explanations) {
  for (const Explanation& one : explanations) one.apply(trial);
  TrialFit fit = fit_base_and_tools(trial);
  return {explanations, std::move(trial), std::move(fit)};
}

double tool_change_m(const Tried& tried) {
  double largest = 0.0;
  for (std::size_t i = 0; i < tried.fit.tools_m.size(); ++i)
    largest = std::max(largest, (tried.fit.tools_m[i] - tried.trial.tools_m[i]).norm());
  return largest;
}

/// The likeliest of those that fit alike: that whose tools are nearer to their description, then the first.
std::size_t likeliest(const std::vector<Tried>& all) {
  double least = all.front().fit.median_m;
  for (const Tried& one : all) least = std::min(least, one.fit.median_m);
  std::size_t chosen = all.size();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].fit.median_m > kEqual * least) continue;
    if (chosen == all.size() || tool_change_m(all[i]) < tool_change_m(all[chosen]) - kToolDifference_m) chosen = i;
  }
  return chosen;
}

/// Those that fit like the chosen one, their tools as near to their description.
std::vector<Explanation> equals_of(const std::vector<Tried>& all, std::size_t chosen) {
  std::vector<Explanation> equals;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i == chosen || all[i].fit.median_m > kEqual * all[chosen].fit.median_m) continue;
    if (std::abs(tool_change_m(all[i]) - tool_change_m(all[chosen])) < kToolDifference_m)
      equals.push_back(all[i].explanations.front());
  }
  return equals;
}

/// Those with the least medians, in their order, their links fitted.
std::vector<Tried> refined(std::vector<Tried> all) {
  std::vector<double> medians;
  for (const Tried& one : all) medians.push_back(one.fit.median_m);
  std::ranges::sort(medians);
  const double limit = kEqual * medians[std::min(kRefined, medians.size()) - 1];
  std::erase_if(all, [limit](const Tried& one) { return one.fit.median_m > limit; });
  for (Tried& one : all) one.fit = fit_arm(one.trial, one.fit);
  return all;
}

Trial fewer_rows(const Trial& trial, std::size_t count) {
  Trial fewer{trial.chain, trial.tools_m, {}, trial.stations};
  for (const std::size_t i : spread_indices(trial.rows.size(), count)) fewer.rows.push_back(trial.rows[i]);
  return fewer;
}

/// The pair of explanations of two joints that fits best on few rows.
std::vector<Explanation> best_pair(const Trial& trial) {
  const Trial fewer = fewer_rows(trial, kPairRows);
  const std::vector<Explanation> all = joint_explanations(trial.chain);
  std::vector<Explanation> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t one = 0; one < all.size(); ++one) {
    for (std::size_t other = one + 1; other < all.size(); ++other) {
      if (all[one].joint == all[other].joint) continue;
      const double median_m = attempt(fewer, {all[one], all[other]}).fit.median_m;
      if (median_m >= least) continue;
      least = median_m;
      best = {all[one], all[other]};
    }
  }
  return best;
}

/// Adds one explanation of a joint after the other while each takes a fifth of the median away.
Tried greedily_extended(const Trial& trial, Tried best) {
  const std::vector<Explanation> all = joint_explanations(trial.chain);
  while (std::ssize(best.explanations) < kMostTogether) {
    std::optional<Tried> next;
    for (const Explanation& one : all) {
      std::vector<Explanation> together = best.explanations;
      together.push_back(one);
      Tried tried = attempt(trial, together);
      if (!next || tried.fit.median_m < next->fit.median_m) next = std::move(tried);
    }
    if (!next || next->fit.median_m > 0.8 * best.fit.median_m) break;
    best = std::move(*next);
  }
  return best;
}

/// A mirrored frame may be signs of several joints: that which leaves the described tools alone comes first.
void set_signs_beside(const Trial& trial, const Explanation& signs, Tried& best, std::vector<Explanation>& equals) {
  Tried tried = attempt(trial, {signs});
  tried.fit = fit_arm(tried.trial, tried.fit);
  if (tried.fit.median_m > kEqual * best.fit.median_m) return;
  if (tool_change_m(tried) > tool_change_m(best) - kToolDifference_m) return equals.push_back(signs);
  equals.insert(equals.begin(), best.explanations.front());
  best = std::move(tried);
}

}  // namespace

std::vector<Explanation> whole_set_explanations(const Chain& chain) {
  std::vector<Explanation> all = joint_explanations(chain);
  for (Explanation& one : unit_explanations(chain)) all.push_back(std::move(one));
  all.push_back(other_convention(chain.convention));
  all.push_back(mirrored());
  for (int joint = 1; joint < chain.size(); ++joint)
    for (const double factor : {1.0, -1.0})
      if (is_revolute(chain, joint) && is_revolute(chain, joint - 1))
        all.push_back(reported_as_sum(joint, joint - 1, factor));
  for (int joint = 0; joint < chain.size(); ++joint)
    for (const double by_deg : {90.0, -90.0, 180.0})
      if (is_revolute(chain, joint)) all.push_back(sign_and_offset(joint, by_deg));
  return all;
}

std::optional<BestExplanation> best_explanation(const Trial& trial, const TrialFit& placed, double good_m,
                                                bool right_handed) {
  std::vector<Tried> all;
  std::vector<Explanation> readings = whole_set_explanations(trial.chain);
  std::ranges::move(column_unit_explanations(), std::back_inserter(readings));
  for (const Explanation& one : readings) {
    if (right_handed && one.kind == FindingKind::mirrored) continue;
    all.push_back(attempt(trial, {one}));
    all.back().trial.rows.shrink_to_fit();
  }
  all = refined(std::move(all));
  const std::size_t chosen = likeliest(all);
  std::vector<Explanation> equals = equals_of(all, chosen);
  Tried best = all[chosen];
  const bool mirrors = best.explanations.front().kind == FindingKind::mirrored;
  const auto signs = mirrors || best.fit.median_m > good_m ? best_sign_set(trial, {}) : std::nullopt;
  if (mirrors && signs) set_signs_beside(trial, signs->best, best, equals);
  if (best.fit.median_m > good_m) {
    std::vector<std::vector<Explanation>> starts{best.explanations, best_pair(trial)};
    if (signs) starts.push_back({signs->best});
    for (const std::vector<Explanation>& start : starts) {
      Tried tried = greedily_extended(trial, attempt(trial, start));
      tried.fit = fit_arm(tried.trial, tried.fit);
      if (tried.fit.median_m >= 0.5 * best.fit.median_m) continue;
      best = std::move(tried);
      equals.clear();
    }
  }
  if (best.fit.median_m >= placed.median_m) return std::nullopt;
  return BestExplanation{std::move(best.explanations), std::move(best.fit), std::move(equals)};
}

}  // namespace demecal::inline trials
