// The rows of a log as few enough samples, straight lines through them, and their noise.
#pragma once

#include <cstddef>
#include <vector>

#include "kinematics/chain.hpp"
#include "preparation/joint_log.hpp"

namespace demecal::inline preparation {

/// Rows of a log, those that are very close averaged.
struct LogSamples {
  std::vector<double> times_s;
  std::vector<JointVector> joints;
  std::vector<std::size_t> first_row, last_row;

  std::size_t size() const { return times_s.size(); }
};

LogSamples samples_of(const JointLog& log);

/// A straight line through the samples of a range, joint by joint.
struct JointLine {
  JointVector slope, mean;
  double squares_s2 = 0.0;  ///< of the times about their mean
};

JointLine line_through(const LogSamples& samples, std::size_t from, std::size_t end);

/// By what single samples are off a line, in the quietest fifth of short windows; at least what rounding explains, but
/// no more of it than `most_rounding`.
JointVector sample_noise(const LogSamples& samples, double most_rounding);

}  // namespace demecal::inline preparation
