// How fast an evolution gets on, and how long it will take.
#pragma once

#include <optional>

#include "monitor/watched.hpp"

namespace demecal {

/// Evaluations of all workers together: as many as were seen to be done in the last ten seconds or, before one can
/// tell, of each worker its islands' mean speed, times as many as it computes at once. 0 where nothing is left to breed
/// or nothing is known.
double evaluations_per_s(const Watched& watched, const WatchedRun& run, double now_s);

/// The part of one worker in that, by what it tells of its islands.
double evaluations_per_s(const Watched& watched, const WatchedRun& run, const WatchedWorker& worker, double now_s);

/// Generations bred of those to be bred, over all islands; 0 to 1.
double share_done(const WatchedRun& run);

/// Seconds until all islands have bred their generations, at the present speed; nothing where that is not known.
std::optional<double> time_left_s(const Watched& watched, const WatchedRun& run, double now_s);

}  // namespace demecal
