// The live page over real DDS and HTTP and in a real browser: it is there before, during and after a run, and nothing
// depends on it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using Json = nlohmann::json;

/// Domains of this file alone.
std::string page_domain(int which) {
  return private_domain(160 + which);
}

std::vector<std::string> calibrate_watched(const SmallJob& job, const std::string& out, int which) {
  return {"calibrate", job.job(), "--out", job.path(out), "--workers", "2", "--domain", page_domain(which), "--quiet"};
}

/// The address that a monitor printed, whole.
std::string address_of(StartedProgram& monitor) {
  if (!monitor.wait_for_out("/\n")) return "";
  const std::string out = monitor.out_so_far();
  const std::size_t begin = out.find("http://");
  return out.substr(begin, out.find('\n') - begin);
}

std::string fetched(const std::string& url) {
  return run("/usr/bin/curl", {"--silent", "--show-error", "--max-time", "20", url}).out;
}

/// What a browser finds at `url` once the stage holds `word`.
Json seen_by_browser(const std::string& url, const std::string& word) {
  StartedProgram node("/usr/bin/node", {std::string(DEMECAL_SOURCE_DIR) + "/tests/browser/live_page.mjs", url, word});
  const Ended ended = node.wait(std::chrono::seconds(240));
  EXPECT_EQ(ended.code, 0) << ended.err;
  return ended.code == 0 ? Json::parse(ended.out) : Json();
}

TEST(LivePage, ShowsARunInABrowserAndAnyMomentOfItAgain) {
  const SmallJob job(200, 2);
  StartedProgram monitor("demecal", {"monitor", "--domain", page_domain(1), "--http", "0"});
  const std::string url = address_of(monitor);
  ASSERT_TRUE(url.starts_with("http://127.0.0.1:")) << monitor.out_so_far() << monitor.err_so_far();
  StartedProgram coordinator("demecal", calibrate_watched(job, "out", 1));
  const Json seen = seen_by_browser(url, "finished");
  EXPECT_EQ(coordinator.wait().code, 0);
  ASSERT_TRUE(seen.contains("phone")) << seen.dump();
  EXPECT_TRUE(seen["faults"].empty()) << seen["faults"];
  EXPECT_TRUE(seen["elsewhere"].empty()) << seen["elsewhere"];
  const Json& now = seen["now"];
  EXPECT_EQ(now["islands"].size(), 12u);
  EXPECT_EQ(now["formulas"].size(), 6u);
  EXPECT_EQ(now["workers"], 2);
  EXPECT_GE(now["rounds"], 1);
  EXPECT_TRUE(now["inked"]["error"]);
  EXPECT_TRUE(now["inked"]["front"]);
  // The last figures of every island stand there as they are told to programs.
  const Json state = Json::parse(fetched(url + "api/state"));
  std::set<std::string> shown;
  for (const Json& island : now["islands"])
    shown.insert(island["key"].get<std::string>() + ' ' + island["title"].get<std::string>().substr(0, 14));
  for (const Json& island : state["run"]["islands"]) {
    EXPECT_EQ(island["generation"], 200);
    EXPECT_FALSE(island["best_formula"].get<std::string>().empty());
    EXPECT_TRUE(shown.contains(std::to_string(island["joint"].get<int>()) + '/' +
                               std::to_string(island["island"].get<int>()) + " generation 200"));
  }
  const Json& causes = state["calibration"]["causes"];
  ASSERT_EQ(now["causes"].size(), causes.size());
  for (std::size_t i = 0; i < causes.size(); ++i)
    EXPECT_TRUE(now["causes"][i].get<std::string>().starts_with(causes[i]["label"].get<std::string>()));
  EXPECT_NE(now["final"].get<std::string>().find("rms error on"), std::string::npos) << now["final"];
  EXPECT_TRUE(seen["begin"]["final"].get<std::string>().empty());
  EXPECT_TRUE(seen["begin"]["islands"].empty());
  EXPECT_NE(seen["before"]["stage"], now["stage"]);
  EXPECT_EQ(seen["again"]["islands"], now["islands"]);
  EXPECT_EQ(seen["phone"]["islands"], now["islands"]);
  EXPECT_FALSE(now["wide"]);
  EXPECT_FALSE(seen["phone"]["wide"]);
  monitor.signal(SIGINT);
  EXPECT_EQ(monitor.wait(std::chrono::seconds(20)).code, 0);
}

TEST(LivePage, ShowsARecordedRun) {
  const SmallJob job;
  ASSERT_EQ(run("demecal", calibrate_watched(job, "out", 2)).code, 0);
  StartedProgram monitor("demecal", {"monitor", "--replay", job.path("out"), "--speed", "1000", "--http", "0"});
  const std::string url = address_of(monitor);
  Json state;
  const auto is_over = [&] {
    return !state.is_null() && !state["run"].is_null() && state["run"]["share_done"] >= 1.0 &&
           state["calibration"]["stage"] == "finished";
  };
  for (int i = 0; i < 200 && !is_over(); ++i) {
    state = Json::parse(fetched(url + "api/state"));
    ::usleep(100'000);
  }
  EXPECT_EQ(state["calibration"]["stage"], "finished");
  EXPECT_EQ(state["run"]["islands"].size(), 12u);
  monitor.signal(SIGINT);
  EXPECT_EQ(monitor.wait(std::chrono::seconds(20)).code, 0);
}

TEST(LivePage, DrawsTheArmOfADataSetAndWhereItWasMeasured) {
  const SmallJob job;
  ASSERT_EQ(run("demecal", calibrate_watched(job, "out", 6)).code, 0);
  StartedProgram monitor("demecal", {"monitor", "--replay", job.path("out"), "--speed", "1000", "--http", "0", "--data",
                                     job.data(), "--model", job.path("out/model.yaml")});
  const std::string url = address_of(monitor);
  Json arm;
  std::istringstream events(fetched(url + "api/events"));
  for (std::string line; std::getline(events, line);) {
    if (line.starts_with("{\"event\":\"arm\"")) arm = Json::parse(line);
  }
  ASSERT_FALSE(arm.is_null());
  const std::size_t count = arm["poses_mm"].size();
  EXPECT_GT(count, 0u);
  EXPECT_EQ(arm["before_mm"].size(), count);
  EXPECT_EQ(arm["after_mm"].size(), count);
  const auto mean_size = [&](const Json& errors) {
    double sum = 0.0;
    for (std::size_t i = 0; i < count; i += 3)
      sum += std::hypot(errors[i].get<double>(), errors[i + 1].get<double>(), errors[i + 2].get<double>());
    return 3.0 * sum / static_cast<double>(count);
  };
  EXPECT_GT(mean_size(arm["before_mm"]), mean_size(arm["after_mm"]));
  // Each arm ends near a measured point.
  for (const Json& line : arm["arms_mm"]) {
    double nearest_mm = 1e9;
    for (std::size_t i = 0; i < count; i += 3) {
      const auto apart = [&](std::size_t axis) {
        return line[line.size() - 3 + axis].get<double>() - arm["poses_mm"][i + axis].get<double>();
      };
      nearest_mm = std::min(nearest_mm, std::hypot(apart(0), apart(1), apart(2)));
    }
    EXPECT_LT(nearest_mm, 20.0);
  }
  const Json seen = seen_by_browser(url, "finished");
  EXPECT_TRUE(seen["faults"].empty()) << seen["faults"];
  EXPECT_TRUE(seen["now"]["inked"]["arm"]);
  EXPECT_EQ(run("demecal", {"monitor", "--http", "0", "--data", job.path("nothing.yaml")}).code, 11);
}

TEST(LivePage, ChangesNothingOfTheModelThoughABrowserIsStopped) {
  const SmallJob job(1000, 2);
  ASSERT_EQ(run("demecal", calibrate_watched(job, "alone", 3)).code, 0);
  StartedProgram monitor("demecal", {"monitor", "--domain", page_domain(3), "--http", "0"});
  const std::string url = address_of(monitor);
  StartedProgram reading("/usr/bin/curl", {"--silent", "--no-buffer", url + "api/stream"});
  StartedProgram stopped("/usr/bin/curl", {"--silent", "--no-buffer", "--limit-rate", "100", url + "api/stream"});
  StartedProgram coordinator("demecal", calibrate_watched(job, "watched", 3));
  ASSERT_TRUE(reading.wait_for_out("\"progress\""));
  stopped.signal(SIGSTOP);
  EXPECT_EQ(coordinator.wait().code, 0);
  EXPECT_TRUE(reading.wait_for_out("\"finished\""));
  const std::string alone = job.text("alone/model.yaml");
  ASSERT_FALSE(alone.empty());
  EXPECT_EQ(job.text("watched/model.yaml"), alone);
  monitor.signal(SIGINT);
  EXPECT_EQ(monitor.wait(std::chrono::seconds(20)).code, 0);
}

TEST(LivePage, WantsATokenElsewhere) {
  StartedProgram monitor("demecal", {"monitor", "--domain", page_domain(4), "--http", "0.0.0.0:0"});
  ASSERT_TRUE(monitor.wait_for_out("#token="));
  const std::string out = monitor.out_so_far();
  const std::size_t colon = out.rfind(':') + 1;
  const std::string port = out.substr(colon, out.find('/', colon) - colon),
                    token = out.substr(out.find("#token=") + 7, 32);
  const std::string url = "http://127.0.0.1:" + port + "/api/state";
  EXPECT_NE(fetched(url).find("token is missing"), std::string::npos);
  const Ended shown =
      run("/usr/bin/curl", {"--silent", "--max-time", "20", "--header", "Authorization: Bearer " + token, url});
  EXPECT_EQ(Json::parse(shown.out)["demecal_state"], 1);
}

TEST(LivePage, SaysWhatItCannotServe) {
  for (const char* const where : {"x", "70000", "example.org:80"}) {
    const Ended ended = run("demecal", {"monitor", "--domain", page_domain(5), "--http", where});
    EXPECT_EQ(ended.code, 10) << where;
    EXPECT_NE(ended.err.find("ADDRESS:PORT"), std::string::npos) << ended.err;
  }
  EXPECT_EQ(run("demecal", {"monitor", "--http", "0", "--json"}).code, 10);
  EXPECT_EQ(run("demecal", {"monitor", "--http", "0", "--once"}).code, 10);
  EXPECT_EQ(run("demecal", {"monitor", "--token-file", "x"}).code, 10);
  const Ended elsewhere = run("demecal", {"monitor", "--domain", page_domain(5), "--http", "192.0.2.1:1"});
  EXPECT_EQ(elsewhere.code, 11);
  EXPECT_NE(elsewhere.err.find("cannot be listened on"), std::string::npos) << elsewhere.err;
}

}  // namespace
}  // namespace demecal
