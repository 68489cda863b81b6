#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "errors/check.hpp"
#include "kinematics/chain.hpp"
#include "preparation/joint_log.hpp"
#include "random/distributions.hpp"

namespace demecal::inline preparation {
namespace {

constexpr double kHalfWindow_s = 0.1;  ///< of a slope
constexpr double kFloor = 1e-3;        ///< rad/s or m/s: slower than that nobody moves an arm on purpose
constexpr double kSureSigmas = 5.0;
constexpr double kLongestBreak_s = 0.15;  ///< too short to leave a place and come back
constexpr double kSamePlace = 3e-4;       ///< rad or m
constexpr double kSettled = 1e-5;         ///< rad or m
constexpr double kLeastMotion = 1e-3;     ///< rad or m: less may leave a gear where it was

/// The samples whose times are near that of one, and its neighbours in any case.
std::pair<std::size_t, std::size_t> window_about(const LogSamples& samples, std::size_t sample) {
  const double time_s = samples.times_s[sample];
  std::size_t from = sample > 0 ? sample - 1 : 0, end = std::min(sample + 2, samples.size());
  while (from > 0 && time_s - samples.times_s[from - 1] <= kHalfWindow_s) --from;
  while (end < samples.size() && samples.times_s[end] - time_s <= kHalfWindow_s) ++end;
  return {from, end};
}

using Range = std::pair<std::size_t, std::size_t>;  ///< of samples, the second not among them

class Search {
 public:
  Search(const JointLog& log, const StandingRule& rule, const Chain& arm)
      : log_(log), rule_(rule), samples_(samples_of(log)), sigma_(sample_noise(samples_, kSamePlace)) {
    floor_ = JointVector::Constant(arm.size(), kFloor);
    told_.assign(static_cast<std::size_t>(arm.size()), false);
    for (int joint = 0; joint < arm.size(); ++joint) {
      const auto& told = is_revolute(arm, joint) ? rule.fastest_rad_per_s : rule.fastest_m_per_s;
      if (!told) continue;
      floor_[joint] = *told;
      told_[static_cast<std::size_t>(joint)] = true;
    }
  }

  StandstillSearch run() {
    StandstillSearch search;
    for (const Range& run : joined_runs()) {
      const Range range = with_ends(run), settled = without_settling(range);
      const bool enough = duration_s(settled) >= rule_.least_s && settled.second - settled.first >= 3;
      if (enough)
        search.found.push_back(standstill(settled));
      else if (duration_s(range) >= 0.5 * rule_.least_s)
        search.too_short.push_back(standstill(range));
    }
    search.noise.sigma = sigma_;
    search.noise.fastest = fastest_ / static_cast<double>(samples_.size());
    std::vector<double> steps_s{0.0};
    for (std::size_t row = 1; row < log_.times_s.size(); ++row)
      steps_s.push_back(log_.times_s[row] - log_.times_s[row - 1]);
    search.noise.step_s = median(std::move(steps_s));
    return search;
  }

 private:
  double duration_s(const Range& range) const {
    return range.second > range.first ? samples_.times_s[range.second - 1] - samples_.times_s[range.first] : 0.0;
  }

  bool stands(std::size_t sample) {
    const auto [from, end] = window_about(samples_, sample);
    const JointLine line = line_through(samples_, from, end);
    bool slow = true;
    for (Eigen::Index joint = 0; joint < sigma_.size(); ++joint) {
      const double noise = line.squares_s2 > 0.0 ? kSureSigmas * sigma_[joint] / std::sqrt(line.squares_s2) : 0.0;
      const double limit = told_[static_cast<std::size_t>(joint)] ? floor_[joint] : std::max(noise, floor_[joint]);
      fastest_[joint] += limit;
      slow = slow && std::abs(line.slope[joint]) <= limit;
    }
    return slow;
  }

  JointVector mean(const Range& range) const { return line_through(samples_, range.first, range.second).mean; }

  bool same_place(const Range& one, const Range& other) const {
    const double parts = std::sqrt(1.0 / static_cast<double>(one.second - one.first)) +
                         std::sqrt(1.0 / static_cast<double>(other.second - other.first));
    const JointVector apart = (mean(one) - mean(other)).cwiseAbs();
    return (apart.array() <= kSamePlace + kSureSigmas * parts * sigma_.array()).all();
  }

  /// Runs of samples that stand; a run that noise breaks in two is one.
  std::vector<Range> joined_runs() {
    fastest_ = JointVector::Zero(sigma_.size());
    std::vector<Range> runs;
    for (std::size_t sample = 0; sample < samples_.size(); ++sample) {
      if (!stands(sample)) continue;
      if (!runs.empty() && runs.back().second == sample) {
        ++runs.back().second;
        continue;
      }
      runs.emplace_back(sample, sample + 1);
    }
    std::vector<Range> joined;
    for (const Range& run : runs) {
      const bool close = !joined.empty() &&
                         samples_.times_s[run.first] - samples_.times_s[joined.back().second - 1] <= kLongestBreak_s;
      if (close && same_place(joined.back(), run))
        joined.back().second = run.second;
      else
        joined.push_back(run);
    }
    return joined;
  }

  /// With the samples at either end that are in the same place: a slope there is already that of the motion beside it.
  Range with_ends(Range range) const {
    const JointVector stood = mean(range);
    const auto is_there = [&](std::size_t sample) {
      return ((samples_.joints[sample] - stood).array().abs() <= kSureSigmas * sigma_.array() + kSettled).all();
    };
    const double start_s = samples_.times_s[range.first], end_s = samples_.times_s[range.second - 1];
    while (range.first > 0 && start_s - samples_.times_s[range.first - 1] <= kHalfWindow_s && is_there(range.first - 1))
      --range.first;
    while (range.second < samples_.size() && samples_.times_s[range.second] - end_s <= kHalfWindow_s &&
           is_there(range.second))
      ++range.second;
    return range;
  }

  /// From the first third to the last, and the standard deviation of that by the samples' noise.
  std::pair<JointVector, JointVector> drift(const Range& range) const {
    const std::size_t third = std::max<std::size_t>(1, (range.second - range.first) / 3);
    const JointVector change = mean({range.second - third, range.second}) - mean({range.first, range.first + third});
    return {change, sigma_ * std::sqrt(2.0 / static_cast<double>(third))};
  }

  bool drifts(const Range& range) const {
    const auto [change, sigma] = drift(range);
    return (change.array().abs() > kSureSigmas * sigma.array() + kSettled).any();
  }

  /// Without its beginning, where the rest then is settled and long enough; else as it is.
  Range without_settling(const Range& range) const {
    constexpr int kMost = 4;
    Range rest = range;
    for (int round = 0; round < kMost && drifts(rest); ++round) rest.first += (rest.second - rest.first + 3) / 4;
    const bool enough = duration_s(rest) >= rule_.least_s && rest.second - rest.first >= 3;
    return enough && !drifts(rest) ? rest : range;
  }

  ApproachSigns approach(std::size_t first, const JointVector& stood) const {
    ApproachSigns signs = ApproachSigns::Zero(stood.size());
    for (Eigen::Index joint = 0; joint < stood.size(); ++joint) {
      const double least = kLeastMotion + kSureSigmas * sigma_[joint];
      for (std::size_t sample = first; sample > 0; --sample) {
        const double move = stood[joint] - samples_.joints[sample - 1][joint];
        if (std::abs(move) <= least) continue;
        signs[joint] = move > 0.0 ? 1.0 : -1.0;
        break;
      }
    }
    return signs;
  }

  Standstill standstill(const Range& range) const {
    Standstill found;
    found.first_line = log_.lines[samples_.first_row[range.first]];
    found.last_line = log_.lines[samples_.last_row[range.second - 1]];
    found.start_s = samples_.times_s[range.first];
    found.duration_s = duration_s(range);
    found.joints = mean(range);
    std::tie(found.drift, found.drift_sigma) = drift(range);
    found.approach = approach(range.first, found.joints);
    return found;
  }

  const JointLog& log_;
  StandingRule rule_;
  LogSamples samples_;
  JointVector sigma_, floor_, fastest_;
  std::vector<bool> told_;
};

}  // namespace

StandstillSearch find_standstills(const JointLog& log, const StandingRule& rule, const Chain& arm) {
  DEMECAL_CHECK(!log.times_s.empty() && log.times_s.size() == log.joints.size(), log.times_s.size());
  return Search(log, rule, arm).run();
}

}  // namespace demecal::inline preparation
