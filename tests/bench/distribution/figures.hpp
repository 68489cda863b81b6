// The benchmark's figures, as a table for people and as JSON lines.
#pragma once

#include <iosfwd>
#include <vector>

#include "cost_model.hpp"
#include "measure.hpp"

namespace demecal::bench {

struct SpeedUp {
  double median = 0.0;                        ///< over pairs of runs, one worker's time over two workers'
  double least = 0.0, greatest = 0.0;         ///< of the pairs
  double allowed = 0.0;                       ///< median of what processor time alone allows on two cores
  std::vector<DistributionFigures> one, two;  ///< parallel
};
/// What other programs do on the machine hardly changes `allowed`, which counts no waiting: one worker's processor time
/// over that of the busier of two, or over half of all that two and the coordinator take.
SpeedUp speed_up(std::vector<DistributionFigures> one, std::vector<DistributionFigures> two);

/// Of all workers' processor time, what did not breed.
double middleware_share(const std::vector<DistributionFigures>& runs);

struct Sleeping {
  double work_s = 0.0;  ///< that an epoch of every island sleeps
  DistributionFigures run;

  double epoch_s() const { return run.wall_s / static_cast<double>(run.epochs - 1); }  ///< the first breeds nothing
  double efficiency() const { return work_s / epoch_s(); }
  /// Of the epochs from the third on, before which everybody has met everybody: the median.
  double settled_epoch_s() const;
  /// Of the coordinator's processor time, for what one island says in one epoch, s.
  double coordinator_s_per_checkpoint() const;
  double worker_s_per_checkpoint() const;  ///< of the workers' that breed what they sleep for besides
};

struct Distribution {
  SpeedUp speed_up;
  std::vector<Sleeping> sleeping;
  CostModel model() const;
};

void write_table(std::ostream& out, const Distribution& all);

/// Of the same number of islands, in the order of their times, the run in the middle.
Sleeping median_of(std::vector<Sleeping> runs);
/// Of worker processes on hosts of their own.
void write_hosts_table(std::ostream& out, int hosts, const std::vector<Sleeping>& runs);
void write_hosts_json(std::ostream& out, int hosts, const std::vector<Sleeping>& runs);
void write_json(std::ostream& out, const Distribution& all);

}  // namespace demecal::bench
