// scripts/workers and the systemd unit: they start workers here and, over ssh, on the hosts of a list.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

const std::string kRoot = DEMECAL_SOURCE_DIR;
const std::string kPrograms = std::string(DEMECAL_BINARY_DIR) + "/bin";

/// Stands for ssh: notes what it was given, and does the command here with another home, as another host would.
constexpr const char* kSsh = R"sh(#!/bin/bash
while [[ $1 == -o ]]; do shift 2; done
echo "$1" >>"$CALLS"
[[ $1 != down ]] || exit 255
mkdir -p "$HOME/$1"
HOME=$HOME/$1 exec bash -c "$2"
)sh";

class Workers : public testing::Test {
 protected:
  Workers() {
    std::filesystem::create_directory(job_.path("bin"));
    std::ofstream(job_.path("bin/ssh")) << kSsh;
    std::filesystem::permissions(job_.path("bin/ssh"), std::filesystem::perms::owner_all);
  }
  ~Workers() override { workers("stop"), workers("stop --hosts " + job_.path("hosts")); }

  void list_hosts(const std::string& lines) { std::ofstream(job_.path("hosts")) << lines; }

  Ended workers(const std::string& arguments) {
    return shell("export HOME=" + job_.path("") + " CALLS=" + job_.path("calls") + " PATH=" + job_.path("bin") +
                 ":$PATH; " + kRoot + "/scripts/workers " + arguments);
  }
  static Ended shell(const std::string& line) { return StartedProgram("/bin/bash", {"-c", line}).wait(); }

  std::unique_ptr<StartedProgram> coordinator() {
    return std::make_unique<StartedProgram>(
        "demecal", std::vector<std::string>{"calibrate", endless_.job(), "--out", job_.path("out"), "--workers", "0",
                                            "--domain", kDomain});
  }

  const std::string kDomain = private_domain(400);
  const std::string kHere = " --programs " + kPrograms + " --domain " + kDomain;
  const SmallJob job_, endless_{1000000};
};

/// Numbers of the processes of which the script says that they run.
std::vector<pid_t> processes_in(const std::string& text) {
  static const std::regex worker("worker ([0-9]+)[, ]");
  std::vector<pid_t> found;
  for (std::sregex_iterator match(text.begin(), text.end(), worker), end; match != end; ++match)
    found.push_back(std::stoi((*match)[1]));
  return found;
}

TEST_F(Workers, StartHereWithASlotPerCoreAreListedAndStop) {
  const Ended started = workers("start" + kHere);
  ASSERT_EQ(started.code, 0) << started.err;
  const std::vector<pid_t> processes = processes_in(started.out);
  ASSERT_EQ(processes.size(), 1u) << started.out;
  const std::string listed = workers("status").out;
  EXPECT_EQ(processes_in(listed), processes) << listed;
  EXPECT_NE(listed.find("--slots " + std::to_string(std::strtol(shell("nproc").out.c_str(), nullptr, 10))),
            std::string::npos)
      << listed;
  EXPECT_EQ(workers("stop").code, 0);
  EXPECT_NE(::kill(processes[0], 0), 0);
  EXPECT_TRUE(processes_in(workers("status").out).empty());
}

TEST_F(Workers, StartOnEveryHostOfAListServeACoordinatorAndStop) {
  list_hosts("# those in the hall\nalpha --slots 3\n\nuser@beta --slots 4\n");
  const auto calibration = coordinator();
  const Ended started = workers("start --hosts " + job_.path("hosts") + kHere);
  ASSERT_EQ(started.code, 0) << started.err;
  EXPECT_NE(started.out.find("alpha: worker "), std::string::npos) << started.out;
  EXPECT_NE(started.out.find("user@beta: worker "), std::string::npos) << started.out;
  EXPECT_TRUE(calibration->wait_for_err("joined with 3 slots"));
  EXPECT_TRUE(calibration->wait_for_err("joined with 4 slots"));
  EXPECT_EQ(processes_in(workers("status --hosts " + job_.path("hosts")).out), processes_in(started.out));
  EXPECT_EQ(workers("stop --hosts " + job_.path("hosts")).code, 0);
  EXPECT_TRUE(processes_in(workers("status --hosts " + job_.path("hosts")).out).empty());
}

TEST_F(Workers, GoOnWithTheOtherHostsWhereOneFailsAndNameIt) {
  list_hosts("down\nalpha\n");
  const Ended started = workers("start --hosts " + job_.path("hosts") + kHere);
  EXPECT_EQ(started.code, 21);
  EXPECT_NE(started.err.find("down: ended with 255"), std::string::npos) << started.err;
  EXPECT_EQ(processes_in(started.out).size(), 1u) << started.out;
}

TEST_F(Workers, ADryRunPrintsCommandsOnePerCoreWhereAskedAndDoesNothing) {
  list_hosts("alpha --slots 3\n");
  const Ended remote = workers("start --dry-run --network --hosts " + job_.path("hosts"));
  EXPECT_EQ(remote.code, 0) << remote.err;
  EXPECT_NE(remote.out.find("ssh -o BatchMode=yes alpha "), std::string::npos) << remote.out;
  EXPECT_TRUE(job_.text("calls").empty());
  const Ended local = workers("start --dry-run --per-core" + kHere);
  EXPECT_NE(local.out.find(kPrograms + "/demecal-worker --slots 1"), std::string::npos) << local.out;
  EXPECT_EQ(std::count(local.out.begin(), local.out.end(), '\n'), std::strtol(shell("nproc").out.c_str(), nullptr, 10));
  EXPECT_TRUE(processes_in(workers("status").out).empty());
}

TEST_F(Workers, WhatIsWrongIsSaidWithItsExitCode) {
  EXPECT_EQ(workers("fly").code, 10);
  EXPECT_EQ(workers("stop --network").code, 10);
  EXPECT_EQ(workers("start --hosts " + job_.path("nowhere")).code, 11);
  EXPECT_EQ(workers("start --programs /nowhere").code, 11);
  const Ended options = workers("start --slots 0" + kHere);
  EXPECT_EQ(options.code, 21);
  EXPECT_NE(options.err.find("--slots: Value 0 not in range"), std::string::npos) << options.err;
}

TEST_F(Workers, TheSystemdUnitStartsAWorkerWithTheOptionsOfItsFile) {
  const std::string unit_file = std::string(DEMECAL_BINARY_DIR) + "/demecal-worker.service";
  std::ifstream file(unit_file);
  std::stringstream unit;
  unit << file.rdbuf();
  const std::string text = unit.str();
  std::smatch line;
  ASSERT_TRUE(std::regex_search(text, line, std::regex("ExecStart=/bin/sh -c '(.*)'\n")));
  // What systemd makes of it, and where the program is in this build.
  std::string command = std::regex_replace(line[1].str(), std::regex("\\$\\$"), "$$");
  command = std::regex_replace(command, std::regex("[^ ]*/demecal-worker"), kPrograms + "/demecal-worker");
  const auto calibration = coordinator();
  const StartedProgram service("/bin/sh", {"-c", "SLOTS=5 OPTIONS='--domain " + kDomain + "'; " + command});
  EXPECT_TRUE(calibration->wait_for_err("joined with 5 slots"));
  if (shell("command -v systemd-analyze").code != 0) GTEST_SKIP() << "there is no systemd here to ask about the unit";
  const Ended verified = shell("systemd-analyze verify --man=no " + unit_file);
  EXPECT_EQ(verified.code, 0) << verified.err;
}

}  // namespace
}  // namespace demecal
