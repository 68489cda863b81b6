// A server of jobs, what its users ask of it, and a small job to upload.
#pragma once

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {

using Answered = nlohmann::json;

inline const std::string kAnn = "0123456789abcdef-ann", kBob = "0123456789abcdef-bob";

/// A running server of jobs, and what its users do.
class Serving {
 public:
  Serving(const std::string& folder, const std::vector<std::string>& more = {})
      : program_("demecal", arguments(folder, more)) {
    if (!program_.wait_for_out("/\n")) return;
    const std::string out = program_.out_so_far();
    const std::size_t begin = out.find("http://");
    url_ = out.substr(begin, out.find('\n') - begin);
  }

  const std::string& url() const { return url_; }
  StartedProgram& program() { return program_; }

  /// What a program of the user gets; the last line is the status.
  std::string get(const std::string& path, const std::string& token = "") const { return curl({url_ + path}, token); }
  std::string post(const std::string& path, const std::string& token = "",
                   const std::string& file = "/dev/null") const {
    return curl({"--header", "Demecal-Request: 1", "--header", "Content-Type: application/octet-stream",
                 "--data-binary", "@" + file, url_ + path},
                token);
  }
  Answered job(const std::string& name, const std::string& token = "") const {
    const std::string text = get("api/jobs", token);
    const Answered answered = Answered::parse(text.substr(0, text.rfind('\n')));
    for (const Answered& one : answered["jobs"]) {
      if (one["name"] == name) return one;
    }
    return {};
  }
  /// Waits until the job is in that state.
  bool becomes(const std::string& name, const std::string& state, const std::string& token = "") const {
    for (int i = 0; i < 1200; ++i) {
      const Answered found = job(name, token);
      if (found.is_object() && found["state"] == state) return true;
      ::usleep(50'000);
    }
    return false;
  }

 private:
  static std::vector<std::string> arguments(const std::string& folder, const std::vector<std::string>& more) {
    std::vector<std::string> all{"serve", "--dir", folder, "--port", "0", "--workers", "in-process:2"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  static std::string curl(std::vector<std::string> words, const std::string& token) {
    if (!token.empty()) words.insert(words.begin(), {"--header", "Authorization: Bearer " + token});
    words.insert(words.begin(),
                 {"--silent", "--show-error", "--path-as-is", "--max-time", "60", "--write-out", "\n%{http_code}"});
    const Ended ended = run("/usr/bin/curl", words);
    EXPECT_EQ(ended.code, 0) << ended.err;
    return ended.out;
  }

  StartedProgram program_;
  std::string url_;
};

inline bool succeeds(const std::string& answer) {
  return answer.ends_with("\n200");
}

/// The job and its data as they are uploaded, in one folder.
inline void write_uploads(const SmallJob& job) {
  std::filesystem::create_directory(job.path("up"));
  std::ofstream(job.path("up/JOB.yaml")) << std::regex_replace(job.text("job.yaml"), std::regex("data/dataset"),
                                                               "dataset");
  for (const char* const name : {"dataset.yaml", "robot.yaml", "poses.csv"})
    std::filesystem::copy(job.path("data/" + std::string(name)), job.path("up/" + std::string(name)));
}

inline void upload(const Serving& serving, const SmallJob& job, const std::string& name,
                   const std::string& token = "") {
  EXPECT_TRUE(succeeds(serving.post("api/jobs/" + name + "/make", token)));
  for (const char* const file : {"JOB.yaml", "dataset.yaml", "robot.yaml", "poses.csv"}) {
    const std::string answer =
        serving.post("api/jobs/" + name + "/files/" + file, token, job.path("up/" + std::string(file)));
    EXPECT_TRUE(succeeds(answer)) << file << answer;
  }
}

inline std::string tokens_of(const SmallJob& job) {
  std::ofstream(job.path("tokens")) << "ann " << kAnn << "\nbob " << kBob << "\n";
  ::chmod(job.path("tokens").c_str(), 0600);
  return job.path("tokens");
}

}  // namespace demecal
