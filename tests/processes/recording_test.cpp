// A run's streams recorded by the monitor: read by MCAP's reference reader, and shown again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

std::string recorded_domain(int which) {
  return private_domain(180 + which);
}

std::vector<Json> lines_of_json(const std::string& text) {
  std::vector<Json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(Json::parse(line));
  return lines;
}

/// What the reference reader finds; it checks checksums, index, statistics and schemas.
std::vector<Json> read_by_reference(const std::string& file) {
  const Ended ended = run("/usr/bin/node", {std::string(DEMECAL_SOURCE_DIR) + "/tests/browser/read_mcap.mjs", file});
  EXPECT_EQ(ended.code, 0) << ended.err;
  return lines_of_json(ended.out);
}

/// Without nulls, and without the time: another monitor counts from another moment.
Json comparable(Json event) {
  event.erase("t_s");
  for (auto member = event.begin(); member != event.end();)
    member = member->is_null() ? event.erase(member) : std::next(member);
  return event;
}

TEST(Recording, HoldsARunForTheReferenceReaderAndForReplay) {
  const SmallJob job(200, 2);
  const std::string file = job.path("run.mcap");
  StartedProgram recording("demecal", {"monitor", "--domain", recorded_domain(1), "--json", "--record", file});
  ASSERT_TRUE(recording.wait_for_out("begin"));
  const Ended calibrated = run("demecal", {"calibrate", job.job(), "--out", job.path("out"), "--workers", "2",
                                           "--domain", recorded_domain(1), "--quiet"});
  ASSERT_EQ(calibrated.code, 0) << calibrated.err;
  ASSERT_TRUE(recording.wait_for_out("\"finished\""));
  recording.signal(SIGINT);
  const Ended ended = recording.wait(std::chrono::seconds(20));
  ASSERT_EQ(ended.code, 0) << ended.err;

  std::vector<Json> printed = lines_of_json(ended.out), recorded;
  printed.erase(printed.begin());  // the line that names the format
  std::set<std::string> topics;
  for (const Json& message : read_by_reference(file)) {
    recorded.push_back(message["event"]);
    topics.insert(message["topic"]);
  }
  ASSERT_EQ(recorded.size(), printed.size());
  for (std::size_t i = 0; i < printed.size(); ++i) EXPECT_EQ(comparable(recorded[i]), comparable(printed[i]));
  for (const char* const topic :
       {"/demecal/stage", "/demecal/run", "/demecal/worker", "/demecal/progress/joint_6/island_2"}) {
    EXPECT_TRUE(topics.contains(topic)) << topic;
  }

  const Ended again = run("demecal", {"monitor", "--replay", file, "--json", "--speed", "1000"});
  EXPECT_EQ(again.code, 0) << again.err;
  std::vector<Json> replayed = lines_of_json(again.out);
  replayed.erase(replayed.begin());
  ASSERT_EQ(replayed.size(), recorded.size());
  for (std::size_t i = 0; i < replayed.size(); ++i) {
    EXPECT_EQ(comparable(replayed[i]), comparable(printed[i]));
    EXPECT_EQ(replayed[i]["t_s"], recorded[i]["t_s"]);
  }
  const Ended page = run("demecal", {"monitor", "--replay", file, "--once"});
  EXPECT_EQ(page.code, 0);
  EXPECT_THAT(page.out, HasSubstr("finished"));

  // A run that calibrate recorded becomes such a file, too.
  const std::string made = job.path("made.mcap");
  EXPECT_EQ(run("demecal", {"monitor", "--replay", job.path("out"), "--speed", "1000", "--record", made}).code, 0);
  const auto lines = lines_of_json(job.text("out/events.jsonl"));
  EXPECT_EQ(read_by_reference(made).size(), lines.size() - 1);
}

TEST(Recording, OfAMonitorThatWasKilledShowsWhatItHad) {
  const SmallJob job(100000, 2);
  const std::string file = job.path("run.mcap");
  StartedProgram recording("demecal", {"monitor", "--domain", recorded_domain(2), "--json", "--record", file});
  StartedProgram coordinator("demecal", {"calibrate", job.job(), "--out", job.path("out"), "--workers", "1", "--domain",
                                         recorded_domain(2), "--quiet"});
  ASSERT_TRUE(recording.wait_for_out("\"progress\""));
  std::this_thread::sleep_for(std::chrono::seconds(3));  // longer than a chunk lasts
  recording.signal(SIGKILL);
  recording.wait(std::chrono::seconds(20));
  const Ended shown = run("demecal", {"monitor", "--replay", file, "--once"});
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_THAT(shown.out, HasSubstr("evolving"));
  EXPECT_THAT(shown.err, HasSubstr("run.mcap: "));
  EXPECT_THAT(shown.err, HasSubstr(": what was seen after "));
}

TEST(Recording, ThatIsDamagedShowsTheRestAndSaysWhatIsMissing) {
  const SmallJob job(3000, 2);
  const std::string file = job.path("run.mcap");
  ASSERT_EQ(run("demecal",
                {"calibrate", job.job(), "--out", job.path("out"), "--workers", "1", "--quiet", "--max-effects", "0"})
                .code,
            0);
  ASSERT_EQ(run("demecal", {"monitor", "--replay", job.path("out"), "--json", "--record", file}).code, 0);
  std::string bytes = job.text("run.mcap");
  const std::size_t place = bytes.find("\"progress\"");
  ASSERT_NE(place, std::string::npos);
  bytes[place + 1] ^= 1;
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
  const Ended shown = run("demecal", {"monitor", "--replay", file, "--once"});
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_THAT(shown.out, HasSubstr("finished"));
  EXPECT_THAT(shown.err, testing::ContainsRegex("run.mcap: bytes [0-9]+ to [0-9]+ are damaged: what was seen"));
  EXPECT_THAT(shown.err, testing::ContainsRegex("run.mcap: [0-9]+ of [0-9]+ events are missing"));
}

TEST(Recording, ReplacesNothingElse) {
  const SmallJob job;
  EXPECT_EQ(run("demecal", {"monitor", "--record", job.job()}).code, 10);
  EXPECT_FALSE(job.text("job.yaml").empty());
  EXPECT_EQ(run("demecal", {"monitor", "--record", job.path("nowhere/run.mcap")}).code, 11);
  EXPECT_EQ(run("demecal", {"monitor", "--replay", job.job(), "--json"}).code, 11);
  std::ofstream(job.path("bad.mcap"), std::ios::binary)
      << "\x89MCAP0\r\n"
      << std::string(1, 6) << std::string(1, 9) << std::string(16, '\0');
  const Ended bad = run("demecal", {"monitor", "--replay", job.path("bad.mcap"), "--json"});
  EXPECT_EQ(bad.code, 11);
  EXPECT_THAT(bad.err, HasSubstr("bad.mcap"));
}

}  // namespace
}  // namespace demecal
