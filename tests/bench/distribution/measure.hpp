// One distributed run, measured: worker processes over DDS on this machine, the coordinator in this process.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "counted_transport.hpp"
#include "dds/dds_transport.hpp"

namespace demecal::bench {

struct WorkerProcesses {
  std::string program;                 ///< of the workers
  std::vector<std::string> arguments;  ///< beside domain and slots
  int processes = 1;
  int slots = 1;  ///< of each process
};

struct DistributionFigures {
  double wall_s = 0.0;             ///< from the run's beginning to its last outcome; the workers are there before
  double worker_s = 0.0;           ///< processor time of the workers
  double busiest_worker_s = 0.0;   ///< of it, that of the worker that took most
  double breeding_s = 0.0;         ///< of it, that of the threads that breed: the busiest of each process
  double coordinator_s = 0.0;      ///< processor time
  double idle_worker_share = 0.0;  ///< of one core, that a worker without work takes; NaN where not asked for
  std::size_t islands = 0, epochs = 0;
  Traffic traffic;
};

/// Throws std::runtime_error where the workers do not come or the run does not finish.
DistributionFigures measure(const DdsOptions& dds, const WorkerProcesses& processes, const CalibrationData& data,
                            std::chrono::seconds idle = std::chrono::seconds(0));

}  // namespace demecal::bench
