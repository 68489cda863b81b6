// The folder of served jobs: JOBS/USER/JOB with what was uploaded (input/), what a run leaves (results/), what it said
// (terminal.log) and how the job stands (job.json). Every name is a plain one, no symbolic link is followed, and
// nothing above JOBS is touched.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "http/user_server.hpp"
#include "serving/job_queue.hpp"

namespace demecal {

/// A file descriptor that is closed when this goes; -1: none.
class OwnedDescriptor {
 public:
  explicit OwnedDescriptor(int number = -1) : number_(number) {}
  ~OwnedDescriptor();
  OwnedDescriptor(OwnedDescriptor&& other) noexcept : number_(other.release()) {}
  OwnedDescriptor& operator=(OwnedDescriptor&& other) noexcept;
  OwnedDescriptor(const OwnedDescriptor&) = delete;
  OwnedDescriptor& operator=(const OwnedDescriptor&) = delete;

  int get() const { return number_; }
  int release();

 private:
  int number_;
};

struct ListedFile {
  std::string name;
  std::uint64_t bytes = 0;
};

/// Names are checked by whoever calls; that they are plain ones is an assumption of the program.
class JobFolders {
 public:
  /// Makes the folder where it is missing. Throws InputError where it cannot be used.
  explicit JobFolders(const std::string& root);

  /// A lock of the folder that goes with this process, where the file system has any. Throws InputError where another
  /// has it.
  OwnedDescriptor lock() const;

  /// All jobs that stand there.
  std::vector<JobId> jobs() const;
  void make(const JobId& id) const;
  void remove(const JobId& id) const;
  /// For programs that run there.
  std::string path_of(const JobId& id) const;

  std::vector<ListedFile> inputs(const JobId& id) const;
  std::string input(const JobId& id, const std::string& name) const;
  void put_input(const JobId& id, const std::string& name, std::string_view bytes) const;
  /// What a program that was killed while it wrote left half done.
  void remove_unfinished(const JobId& id) const;
  /// Whether there was such a file.
  bool remove_input(const JobId& id, const std::string& name) const;

  /// Those of the files that a run leaves which users get.
  std::vector<ListedFile> results(const JobId& id) const;
  static bool is_offered(const std::string& name);
  /// Nothing where there is no such file.
  std::shared_ptr<AnsweredFile> open_result(const JobId& id, const std::string& name) const;
  /// The text of a file of results of at most `most` bytes; nothing where there is none, or it is larger.
  std::optional<std::string> result(const JobId& id, const std::string& name, std::uint64_t most) const;
  /// Those of the files that a run leaves whose names begin so.
  void remove_results(const JobId& id, std::string_view beginning) const;
  bool can_go_on(const JobId& id) const;  ///< a run was broken off, and left its journal

  /// What the last run said, open to be written to; emptied unless `keep`.
  OwnedDescriptor open_terminal(const JobId& id, bool keep) const;
  /// Its last bytes.
  std::string terminal(const JobId& id, std::uint64_t most) const;

  JobRecord record(const JobId& id) const;
  void save(const JobId& id, const JobRecord& record) const;

 private:
  OwnedDescriptor folder(const JobId& id) const;

  std::string root_;
  OwnedDescriptor descriptor_;
};

}  // namespace demecal
