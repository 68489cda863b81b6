// Which jobs there are, who they belong to, how they stand, and which runs next: one at a time, in the order in which
// they were asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace demecal::inline serving {

/// What a user asked for and does not get, in a sentence.
class Refusal : public std::runtime_error {
 public:
  enum class Kind { unknown, conflict, limit, invalid };

  Refusal(Kind kind, const std::string& why) : std::runtime_error(why), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

/// Whether users, jobs and files may be called so: up to 64 letters (a to z), digits, '.', '_' and '-', with a letter
/// or digit first. So a name is never a path, nor the name of a hidden file, nor an option.
bool is_plain_name(std::string_view name);

enum class JobState {
  ready,    ///< not asked to run since its files were uploaded
  waiting,  ///< for those before it
  running,
  done,
  failed,
  interrupted  ///< what was reached is saved
};

std::string to_string(JobState state);

struct JobRecord {
  JobState state = JobState::ready;
  int exit_code = 0;                      ///< of the last run that ended
  std::int64_t began_s = 0, ended_s = 0;  ///< of the last run, since 1970; 0: not yet
};

/// As it stands in a job's folder.
std::string record_text(const JobRecord& record);
/// Back again; a job that was waiting or running when the server ended is interrupted. Anything else than such a text
/// is a job that did not run.
JobRecord parse_record(const std::string& text);

struct JobId {
  std::string user, job;
  auto operator<=>(const JobId&) const = default;
};

struct QueueLimits {
  std::size_t jobs_each = 32;    ///< of one user
  std::size_t waiting = 32;      ///< of all
  std::size_t waiting_each = 8;  ///< of one user
};

/// Each function that is told a job throws Refusal where there is none or its state forbids what is asked.
class JobQueue {
 public:
  explicit JobQueue(QueueLimits limits) : limits_(limits) {}

  void restore(const JobId& id, const JobRecord& record) { records_[id] = record; }
  void add(const JobId& id);
  void remove(const JobId& id);

  /// Its files are about to change: what ran before was of others.
  void change_files(const JobId& id);
  void ask_to_run(const JobId& id);
  /// Where it waits, it no longer does. Whether it runs, and is to be interrupted.
  bool ask_to_stop(const JobId& id);

  /// The job that begins to run now, if none runs and one waits.
  std::optional<JobId> begin_next(std::int64_t now_s);
  /// How the one that runs ended, in the exit codes of `demecal`.
  void end(int exit_code, std::int64_t now_s);

  const std::optional<JobId>& running() const { return running_; }
  const JobRecord& record(const JobId& id) const;
  std::vector<std::string> jobs_of(const std::string& user) const;
  /// How many jobs run or wait before it; 0 where it does not wait.
  std::size_t before(const JobId& id) const;

 private:
  JobRecord& idle(const JobId& id);

  QueueLimits limits_;
  std::map<JobId, JobRecord> records_;
  std::deque<JobId> waiting_;
  std::optional<JobId> running_;
};

}  // namespace demecal::inline serving
