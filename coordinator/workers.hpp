// Where a command's workers come from: the options that say so, processes of this machine over DDS, or threads.
#pragma once

#include <sys/types.h>
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "dds/dds_transport.hpp"
#include "protocol/messages.hpp"
#include "scheduling/island_evolver.hpp"
#include "scheduling/worker_pool.hpp"
#include "transport/transport.hpp"

namespace demecal {

struct WorkerArguments {
  int count = static_cast<int>(std::thread::hardware_concurrency());  ///< processes, or threads where `in_process`
  bool in_process = false;
  std::shared_ptr<DdsOptions> dds;
};
/// Adds --workers and those of add_dds_arguments(); `workers` outlives the command.
void add_worker_arguments(CLI::App& command, WorkerArguments& workers);

/// What makes the pools that the arguments ask for; they outlive it.
MakeWorkerPool worker_pool_maker(const WorkerArguments& arguments);
/// What publishes a calibration to watchers: on the network, or where nobody listens, if no socket is to be opened.
std::unique_ptr<Transport> join_as_reporter(const WorkerArguments& arguments);
/// For people: "DDS domain 0, 2 local workers"; `worker_timeout_s` is how long workers are waited for.
std::string to_string(const WorkerArguments& arguments, double worker_timeout_s);

/// The worker processes a coordinator starts on its own machine, and stops when it is done.
class LocalWorkers {
 public:
  /// Starts `count` times the program `path` with `arguments`. They share the coordinator's standard error; they get no
  /// terminal signals (Ctrl-C is the coordinator's to handle) and are killed when the coordinator dies. Throws
  /// std::runtime_error where a process cannot be started.
  LocalWorkers(const std::string& path, const std::vector<std::string>& arguments, int count);
  /// Asks them to end, waits two seconds, and kills those that have not.
  ~LocalWorkers();
  LocalWorkers(const LocalWorkers&) = delete;
  LocalWorkers& operator=(const LocalWorkers&) = delete;

  /// Whether at least one is still running.
  bool any_alive();

 private:
  std::vector<pid_t> processes_;
};

/// The path of a program that stands beside the running one.
std::string beside_this_program(const std::string& name);

/// The pool over DDS: the coordinator's participant, and the local worker processes it starts.
class DdsWorkerPool final : public WorkerPool {
 public:
  /// Joins the domain; will start `local_workers` processes, each with one slot, that serve this coordinator alone; or,
  /// where certificates are shown, one process with as many slots: handshakes grow with the square of the processes.
  DdsWorkerPool(const DdsOptions& options, int local_workers);

  Transport& transport() override { return *transport_; }
  void launch(RunId run) override;

 private:
  DdsOptions options_;
  int local_workers_;
  std::unique_ptr<Transport> transport_;
  std::optional<LocalWorkers> workers_;
};

}  // namespace demecal
