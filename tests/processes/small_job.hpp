// A job small enough for tests of processes: its data, simulated, in a folder of its own.
#pragma once

#include <filesystem>
#include <string>

namespace demecal {

/// Writes a scenario and a job, simulates the data with the real program, and removes everything when it goes.
class SmallJob {
 public:
  /// `generations` and `demes` set how long the evolution takes; `errors` are lines of YAML that the scenario has
  /// besides.
  explicit SmallJob(int generations = 20, int demes = 2, const std::string& errors = "");
  ~SmallJob();
  SmallJob(const SmallJob&) = delete;
  SmallJob& operator=(const SmallJob&) = delete;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string job() const { return path("job.yaml"); }
  std::string data() const { return path("data/dataset.yaml"); }
  /// The bytes of a file in the folder; empty where it is not there.
  std::string text(const std::string& name) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace demecal
