// One distributed run, measured: worker processes over DDS on this machine, the coordinator in this process.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

#include "counted_transport.hpp"
#include "dds/dds_transport.hpp"

namespace demecal::bench {

struct WorkerProcesses {
  std::string program;                 ///< of the workers
  std::vector<std::string> arguments;  ///< beside those of DDS and slots
  int processes = 1;
  int slots = 1;                  ///< of each process
  std::vector<pid_t> networks{};  ///< for each process one that sees the network that it is to see; empty: this one's
};

struct DistributionFigures {
  double wall_s = 0.0;             ///< from the run's beginning to its last outcome; the workers are there before
  double worker_s = 0.0;           ///< processor time of the workers
  double busiest_worker_s = 0.0;   ///< of it, that of the worker that took most
  double breeding_s = 0.0;         ///< of it, that of the threads that breed: the busiest of each process
  double coordinator_s = 0.0;      ///< processor time
  double idle_worker_share = 0.0;  ///< of one core, that a worker without work takes; NaN where not asked for
  std::size_t islands = 0, epochs = 0;
  std::vector<double> reached_s;  ///< since the run's beginning: when the last island reported that it had bred this
                                  ///< many epochs, from 1 on; where reports leave epochs out, fewer
  Traffic traffic;
};

/// Throws std::runtime_error where the workers do not come or the run does not finish.
DistributionFigures measure(const DdsOptions& dds, const WorkerProcesses& processes, const CalibrationData& data,
                            std::chrono::seconds idle = std::chrono::seconds(0));

}  // namespace demecal::bench
