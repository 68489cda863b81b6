// What users of `demecal serve` ask for: their jobs, files, runs and results; and the runs themselves, one at a time.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "coordinator/child_process.hpp"
#include "coordinator/jobs/job_folders.hpp"
#include "http/user_server.hpp"
#include "serving/job_files.hpp"
#include "serving/job_queue.hpp"

namespace demecal {

struct JobServiceOptions {
  std::string folder;
  std::string program;                     ///< that runs: `demecal`
  std::vector<std::string> run_arguments;  ///< of `demecal calibrate`, besides job and folder
  bool signs_in = false;                   ///< users show tokens
  std::chrono::seconds longest_run{24 * 3600};
  QueueLimits queue;
  std::size_t files_each = 32;              ///< of one job
  std::uint64_t bytes_each = 64 << 20;      ///< of one job
  std::uint64_t yaml_bytes = 1 << 20;       ///< of one YAML file
  std::uint64_t yaml_bytes_each = 4 << 20;  ///< of one job
  std::chrono::seconds saving{60};          ///< what an interrupted run has to save what it reached
};

class JobService {
 public:
  /// Takes up the jobs that stand in the folder. Throws InputError where it cannot be used.
  explicit JobService(JobServiceOptions options);

  /// From any thread.
  ServiceAnswer answer(const ServiceRequest& request);

  /// Begins and ends runs; to be called some times a second, always by the same thread.
  void tick();
  /// Interrupts what runs and waits until it has saved what it reached; what waits is interrupted.
  void shut_down();

 private:
  using Clock = std::chrono::steady_clock;

  /// The command lines of a run, one after the other.
  struct RunOrder {
    std::vector<std::vector<std::string>> commands;
    bool goes_on = false;  ///< where a run before it was broken off
  };

  ServiceAnswer answer_checked(const ServiceRequest& request);
  std::string list(const std::string& user) const;
  std::string comparison(const std::string& user) const;
  ServiceAnswer result(const JobId& id, const ServiceRequest& request) const;
  void change(const JobId& id, const ServiceRequest& request);
  void put(const JobId& id, const std::string& file, const std::string& bytes);
  void remove_file(const JobId& id, const std::string& file);
  void ask_to_run(const JobId& id, const ServiceRequest& request);
  /// Saves how the job stands. Where that fails, it is said, and the job stands so until this process ends.
  void save_or_say(const JobId& id);
  /// On standard error, unless it was the last thing said there.
  void say(const std::string& trouble);
  JobFiles checked_files(const JobId& id) const;
  void begin(const JobId& id);
  void begin_command(const JobId& id, bool keep_terminal);
  void watch();
  void end(int exit_code);

  JobServiceOptions options_;
  JobFolders folders_;
  OwnedDescriptor lock_;  ///< of the folder: jobs of two servers would overwrite each other
  std::mutex mutex_;
  JobQueue queue_;
  std::map<JobId, RunOrder> orders_;
  std::string said_;
  bool is_stopping_ = false;  ///< the run
  std::optional<ChildProcess> child_;
  std::size_t command_ = 0;
  std::optional<Clock::time_point> interrupted_;
  Clock::time_point began_;
};

}  // namespace demecal
