#include "kinematics/chain.hpp"
#include "preparation/joint_log.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "random/distributions.hpp"

namespace demecal::inline preparation {
namespace {

constexpr double kSample_s = 0.01;      ///< rows closer than this are averaged
constexpr double kNoiseWindow_s = 0.3;  ///< in which an arm that stands, or moves evenly, shows its noise
constexpr std::size_t kNoiseRows = 5;

/// The least step that a joint's readings differ by, other than 0: of encoders that stand between two counts.
double smallest_step(const LogSamples& samples, Eigen::Index joint) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double step = std::abs(samples.joints[i][joint] - samples.joints[i - 1][joint]);
    if (step > 0.0) least = std::min(least, step);
  }
  return std::isfinite(least) ? least : 0.0;
}

}  // namespace

LogSamples samples_of(const JointLog& log) {
  LogSamples samples;
  for (std::size_t row = 0; row < log.times_s.size();) {
    std::size_t end = row;
    double time_s = 0.0;
    JointVector sum = JointVector::Zero(log.joints[row].size());
    for (; end < log.times_s.size() && log.times_s[end] - log.times_s[row] < kSample_s; ++end) {
      time_s += log.times_s[end];
      sum += log.joints[end];
    }
    const double count = static_cast<double>(end - row);
    samples.times_s.push_back(time_s / count);
    samples.joints.push_back(sum / count);
    samples.first_row.push_back(row);
    samples.last_row.push_back(end - 1);
    row = end;
  }
  return samples;
}

JointLine line_through(const LogSamples& samples, std::size_t from, std::size_t end) {
  const double count = static_cast<double>(end - from);
  double time_s = 0.0;
  JointVector mean = JointVector::Zero(samples.joints[from].size());
  for (std::size_t i = from; i < end; ++i) {
    time_s += samples.times_s[i] / count;
    mean += samples.joints[i] / count;
  }
  JointLine line{JointVector::Zero(mean.size()), mean, 0.0};
  for (std::size_t i = from; i < end; ++i) {
    const double off_s = samples.times_s[i] - time_s;
    line.squares_s2 += off_s * off_s;
    line.slope += off_s * (samples.joints[i] - mean);
  }
  if (line.squares_s2 > 0.0) line.slope /= line.squares_s2;
  return line;
}

JointVector sample_noise(const LogSamples& samples, double most_rounding) {
  constexpr double kShare = 0.2;
  const Eigen::Index joints = samples.joints.front().size();
  std::vector<std::vector<double>> found(static_cast<std::size_t>(joints));
  for (std::size_t from = 0; from < samples.size();) {
    std::size_t end = from;
    while (end < samples.size() &&
           (end - from < kNoiseRows || samples.times_s[end] - samples.times_s[from] < kNoiseWindow_s))
      ++end;
    if (end - from < kNoiseRows) break;
    const JointLine line = line_through(samples, from, end);
    const int freedoms = static_cast<int>(end - from) - 2;
    const double expected = normal_length_quantile(freedoms, kShare);
    for (Eigen::Index joint = 0; joint < joints; ++joint) {
      double squares = -line.slope[joint] * line.slope[joint] * line.squares_s2;
      for (std::size_t i = from; i < end; ++i) {
        const double off = samples.joints[i][joint] - line.mean[joint];
        squares += off * off;
      }
      found[static_cast<std::size_t>(joint)].push_back(std::sqrt(std::max(0.0, squares)) / expected);
    }
    from = end;
  }
  JointVector noise = JointVector::Zero(joints);
  for (Eigen::Index joint = 0; joint < joints; ++joint) {
    const auto& values = found[static_cast<std::size_t>(joint)];
    const double rounding = smallest_step(samples, joint) / std::sqrt(12.0);
    noise[joint] = std::max(values.empty() ? 0.0 : quantile(values, kShare), std::min(rounding, most_rounding));
  }
  return noise;
}

}  // namespace demecal::inline preparation
