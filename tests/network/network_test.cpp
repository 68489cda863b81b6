// A calibration over several hosts: they find each other in every way there is, and links that break and heal leave the
// model as it is, to the byte.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <optional>

#include "hosts.hpp"
#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Shorter than the lease of a participant (5 s), but longer than that of a worker's liveliness.
constexpr seconds kShortCut{3};

/// Longer than any lease; DEMECAL_LONG_CUT_S makes it longer still.
seconds long_cut() {
  const char* wanted = std::getenv("DEMECAL_LONG_CUT_S");
  return seconds(wanted == nullptr ? 8 : std::atoi(wanted));
}

int count(const std::string& text, const std::string& word) {
  int found = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

/// A coordinator on host 0 and a worker on each of hosts 1 and 2.
class Calibration {
 public:
  Calibration(const Hosts& hosts, const SmallJob& job, const std::vector<std::string>& discovery)
      : job_(job),
        coordinator_("demecal",
                     with({"calibrate", job.job(), "--out", job.path("out"), "--workers", "0", "--max-effects", "0",
                           "--worker-timeout-s", "100"},
                          discovery),
                     hosts.at(0)) {
    for (const int host : {1, 2})
      workers_.push_back(std::make_unique<StartedProgram>("demecal-worker", with({}, discovery), hosts.at(host)));
  }

  /// Whether it goes on for that long.
  bool goes_on_for(milliseconds time) { return !coordinator_.ends_within(time); }
  /// Waits until the coordinator has said the word that often.
  bool hears(const std::string& word, int times) {
    constexpr int kLooks = 600;
    for (int look = 0; look < kLooks && count(coordinator_.err_so_far(), word) < times; ++look)
      if (!goes_on_for(milliseconds(50))) break;
    return count(coordinator_.err_so_far(), word) >= times;
  }
  std::string err() const { return coordinator_.err_so_far(); }
  /// The model, when it has come to its end; empty where that is none.
  std::string model() { return coordinator_.wait(seconds(100)).code == 0 ? job_.text("out/model.yaml") : ""; }

 private:
  static std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), {"--domain", "7"});  // theirs alone: no other test sees their network
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  const SmallJob& job_;
  StartedProgram coordinator_;
  std::vector<std::unique_ptr<StartedProgram>> workers_;
};

class Network : public testing::Test {
 protected:
  void SetUp() override try { hosts_.emplace(3); } catch (const std::runtime_error& error) {
    GTEST_SKIP() << "several hosts take root and the program ip: " << error.what();
  }

  /// What the job gives on one machine, undisturbed.
  static std::string calm_model(const SmallJob& job) {
    const Ended ended = run("demecal", {"calibrate", job.job(), "--out", job.path("calm"), "--workers", "2", "--domain",
                                        private_domain(), "--max-effects", "0"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    return job.text("calm/model.yaml");
  }

  /// Of a job that takes this machine, undisturbed, longer than a worker needs to be missed and found again: a run that
  /// ends before says nothing.
  static int enough_generations() {
    constexpr int kTried = 2000;
    constexpr seconds kNeeded{8};
    const SmallJob job(kTried);
    const auto start = std::chrono::steady_clock::now();
    calm_model(job);
    const auto taken = std::chrono::steady_clock::now() - start;
    return kTried * static_cast<int>(1 + kNeeded / taken);
  }

  /// Starts a calibration, cuts one worker off for a while, then the coordinator for longer than any lease.
  void expect_the_model_of_a_calm_run(const std::vector<std::string>& discovery) {
    const SmallJob job(enough_generations());
    const std::string calm = calm_model(job);
    ASSERT_FALSE(calm.empty());
    Calibration calibration(*hosts_, job, discovery);
    ASSERT_TRUE(calibration.hears("joined", 2)) << calibration.err();
    hosts_->cut(1);
    EXPECT_TRUE(calibration.goes_on_for(kShortCut)) << calibration.err();
    EXPECT_TRUE(calibration.hears(" left", 1)) << calibration.err();
    hosts_->heal(1);
    EXPECT_TRUE(calibration.hears("joined", 3)) << calibration.err();
    hosts_->cut(0);
    EXPECT_TRUE(calibration.goes_on_for(long_cut())) << calibration.err();
    EXPECT_TRUE(calibration.hears(" left", 3)) << calibration.err();
    hosts_->heal(0);
    EXPECT_EQ(calibration.model(), calm) << calibration.err();
  }

  std::optional<Hosts> hosts_;
};

TEST_F(Network, BrokenLinksHealAndLeaveTheSameModelByMulticast) {
  expect_the_model_of_a_calm_run({"--network"});
}

TEST_F(Network, BrokenLinksHealAndLeaveTheSameModelByADiscoveryServer) {
  const std::string configuration = std::string(DEMECAL_SOURCE_DIR) + "/configs/dds/discovery-server.xml";
  const StartedProgram server("/usr/bin/fast-discovery-server",
                              {"-x", configuration, "-i", "0", "-l", Hosts::address(0), "-p", "11811"}, hosts_->at(0));
  expect_the_model_of_a_calm_run({"--discovery-server", Hosts::address(0) + ":11811"});
}

TEST_F(Network, HostsMeetByNamedPeersAndShowCertificates) {
  const SmallJob job;
  const std::string script = std::string(DEMECAL_SOURCE_DIR) + "/scripts/security";
  ASSERT_EQ(StartedProgram(script, {job.path("certificates")}).wait().code, 0);
  std::vector<std::string> discovery{"--security", job.path("certificates")};
  for (int host = 0; host < 3; ++host) discovery.insert(discovery.end(), {"--peer", Hosts::address(host)});
  Calibration calibration(*hosts_, job, discovery);
  const std::string model = calibration.model();
  EXPECT_FALSE(model.empty()) << calibration.err();
  EXPECT_EQ(model, calm_model(job));
}

}  // namespace
}  // namespace demecal
