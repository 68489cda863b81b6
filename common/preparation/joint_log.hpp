// A recording of an arm's joints, where in it the arm stood still, and its rows as few enough samples, straight lines
// through them, and their noise.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"

namespace demecal::inline preparation {

struct JointLog {
  std::string file;
  std::optional<PoseSet> set{};     ///< what its poses are for; nothing: they are divided
  std::vector<double> times_s;      ///< ascending
  std::vector<JointVector> joints;  ///< one a time; rad, m
  std::vector<std::size_t> lines;   ///< in the file
};

/// What standing is; without speeds they come from the log's own noise.
struct StandingRule {
  double least_s = 0.5;
  std::optional<double> fastest_rad_per_s{}, fastest_m_per_s{};
};

/// How a log's joints read while they stand.
struct LogNoise {
  double step_s = 0.0;  ///< median time between rows
  JointVector sigma;    ///< of one row, rad or m; rows closer than 10 ms are averaged first
  JointVector fastest;  ///< a joint that is slower stands, rad/s or m/s
};

struct Standstill {
  std::size_t log = 0;                        ///< among those of a preparation
  std::size_t first_line = 0, last_line = 0;  ///< in its file
  double start_s = 0.0, duration_s = 0.0;
  JointVector joints;       ///< mean, rad or m
  JointVector drift;        ///< from its first third to its last
  JointVector drift_sigma;  ///< of that, by the rows' noise
  ApproachSigns approach;   ///< of each joint's last motion; 0 where the log shows none
};

struct StandstillSearch {
  LogNoise noise;
  std::vector<Standstill> found;      ///< in their order
  std::vector<Standstill> too_short;  ///< of half the least time at least
};

/// Where every joint is slower than its noise and a floor of 1 mrad/s or 1 mm/s explain, for the least time. Speeds are
/// slopes over a fifth of a second. What the arm settles by at first is left out where enough is left.
StandstillSearch find_standstills(const JointLog& log, const StandingRule& rule, const Chain& arm);

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
