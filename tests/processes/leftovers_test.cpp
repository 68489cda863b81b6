// What is stopped is gone: no process, no shared-memory file and no socket is left behind.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

constexpr std::chrono::seconds kSoon{10};  // two are promised, to an idle machine

std::set<std::string> shared_memory() {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator("/dev/shm")) names.insert(entry.path().filename());
  return names;
}

/// How many UDP sockets are bound to the ports that DDS gives to the domain.
int sockets_of(const std::string& domain) {
  const unsigned long first = 7400 + 250 * std::stoul(domain);
  int count = 0;
  for (const char* list : {"/proc/net/udp", "/proc/net/udp6"}) {
    std::ifstream lines(list);
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
      std::istringstream words(line);
      std::string slot, local;
      words >> slot >> local;
      const unsigned long port = std::stoul(local.substr(local.find(':') + 1), nullptr, 16);
      if (port >= first && port < first + 250) ++count;
    }
  }
  return count;
}

bool is_running(pid_t process) {
  return ::kill(process, 0) == 0;
}

bool end_soon(const std::vector<pid_t>& processes) {
  const auto deadline = std::chrono::steady_clock::now() + kSoon;
  while (std::ranges::any_of(processes, is_running)) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::yield();
  }
  return true;
}

/// A calibration that would go on for ever, with a worker from elsewhere.
class EndlessRun : public ::testing::Test {
 protected:
  EndlessRun() {
    EXPECT_TRUE(coordinator_.wait_for_err("generation"));
    local_workers_ = coordinator_.children();
    EXPECT_EQ(local_workers_.size(), 2U);
    EXPECT_GT(sockets_of(domain_), 0);
  }
  void expect_nothing_left() {
    EXPECT_TRUE(end_soon(local_workers_));
    worker_.signal(SIGTERM);
    EXPECT_TRUE(worker_.ends_within(kSoon));
    EXPECT_EQ(sockets_of(domain_), 0);
    EXPECT_EQ(shared_memory(), shared_before_);
  }

  const std::string domain_ = private_domain();
  const std::set<std::string> shared_before_ = shared_memory();
  SmallJob job_{1000000};
  StartedProgram worker_{"demecal-worker", {"--domain", domain_}};
  StartedProgram coordinator_{
      "demecal", {"calibrate", job_.job(), "--out", job_.path("out"), "--workers", "2", "--domain", domain_}};
  std::vector<pid_t> local_workers_;
};

TEST_F(EndlessRun, LeavesNothingBehindAfterCtrlC) {
  coordinator_.signal(SIGINT);
  EXPECT_EQ(coordinator_.wait().code, 130);
  expect_nothing_left();
}

TEST_F(EndlessRun, LeavesNothingBehindAfterTermination) {
  coordinator_.signal(SIGTERM);
  EXPECT_EQ(coordinator_.wait().code, 130);
  expect_nothing_left();
}

TEST_F(EndlessRun, LeavesNothingBehindWhenItsCoordinatorIsKilled) {
  ::kill(local_workers_.front(), SIGSTOP);  // not even a worker that hangs
  coordinator_.signal(SIGKILL);
  coordinator_.wait();
  expect_nothing_left();
}

}  // namespace
}  // namespace demecal
