#include "measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <thread>

#include "coordinator/workers.hpp"
#include "hosts_of_workers.hpp"
#include "processor_time.hpp"
#include "scheduling/evolution_run.hpp"

namespace demecal::bench {
namespace {

constexpr std::chrono::seconds kPatience{60};

using Reading = std::map<std::string, std::map<pid_t, double>>;

Reading read(const std::map<std::string, WorkerStatus>& workers) {
  Reading reading;
  for (const auto& [name, status] : workers) reading[name] = thread_seconds(static_cast<pid_t>(status.process));
  return reading;
}

/// Of each worker.
std::vector<Split> used(const Reading& before, const Reading& after) {
  std::vector<Split> all;
  for (const auto& [name, threads] : after) all.push_back(used_between(before.at(name), threads));
  return all;
}

double total_s(const std::vector<Split>& workers) {
  double total_s = 0.0;
  for (const Split& worker : workers) total_s += worker.total_s;
  return total_s;
}

using StartedWorkers = std::vector<std::unique_ptr<LocalWorkers>>;

StartedWorkers started(const DdsOptions& dds, const WorkerProcesses& workers) {
  std::vector<std::string> arguments = workers.arguments;
  for (const std::string& word : dds_arguments(dds)) arguments.push_back(word);
  arguments.insert(arguments.end(), {"--slots", std::to_string(workers.slots)});
  StartedWorkers all;
  for (const pid_t network : workers.networks) all.push_back(started_in_network(network, workers.program, arguments));
  if (workers.networks.empty())
    all.push_back(std::make_unique<LocalWorkers>(workers.program, arguments, workers.processes));
  return all;
}

double idle_share(const std::map<std::string, WorkerStatus>& workers, std::chrono::seconds idle) {
  if (idle.count() == 0) return std::numeric_limits<double>::quiet_NaN();
  const Reading before = read(workers);
  std::this_thread::sleep_for(idle);
  const double seconds = total_s(used(before, read(workers)));
  return seconds / static_cast<double>(idle.count()) / static_cast<double>(workers.size());
}

/// Notes when all islands have bred so many epochs.
class EpochClock final : public RunObserver {
 public:
  void on_progress(const Progress& progress) override {
    reached_s_[progress.epoch] = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  std::vector<double> reached_s() const {
    std::vector<double> all;
    for (const auto& [epoch, time_s] : reached_s_) all.push_back(time_s);
    return all;
  }

 private:
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::map<std::uint32_t, double> reached_s_;
};

}  // namespace

DistributionFigures measure(const DdsOptions& dds, const WorkerProcesses& processes, const CalibrationData& data,
                            std::chrono::seconds idle) {
  CountedTransport transport(join_dds(dds, Role::coordinator, ""));
  const StartedWorkers workers = started(dds, processes);
  if (!transport.await_workers(static_cast<std::size_t>(processes.processes), kPatience))
    throw std::runtime_error("not all workers came within a minute");
  DistributionFigures figures;
  figures.idle_worker_share = idle_share(transport.workers(), idle);
  figures.islands = islands(data.archipelago).size();
  figures.epochs = epochs_of(data);
  EpochClock clock;
  EvolutionRun run(transport, data, clock);
  const std::atomic<bool> interrupt{false};
  const Reading before = read(transport.workers());
  const double own_before = own_seconds();
  const auto begin = std::chrono::steady_clock::now();
  const RunResult result = run.run(interrupt, {.worker = kPatience});
  figures.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  figures.coordinator_s = own_seconds() - own_before - transport.counting_s();
  if (result.end != RunEnd::finished) throw std::runtime_error("the run did not finish");
  const std::vector<Split> split = used(before, read(transport.workers()));
  figures.worker_s = total_s(split);
  for (const Split& worker : split) {
    figures.busiest_worker_s = std::max(figures.busiest_worker_s, worker.total_s);
    figures.breeding_s += worker.busiest_thread_s;
  }
  figures.reached_s = clock.reached_s();
  figures.traffic = transport.traffic(data);
  return figures;
}

}  // namespace demecal::bench
