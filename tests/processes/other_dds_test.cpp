// Every monitoring topic as a program of another DDS implementation reads it in a running calibration: it says what
// `monitor --json` says, and the result is the same to the bit whoever reads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using ::testing::_;
using ::testing::AnyOf;
using ::testing::ContainerEq;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSubsetOf;
using ::testing::Pair;
using Json = nlohmann::json;
using Lines = std::set<std::vector<std::string>>;

std::string other_domain(int which) {
  return private_domain(200 + which);
}

/// Cyclone DDS as ROS 2 sets it for one machine alone.
void set_up_cyclone() {
  ::setenv("CYCLONEDDS_URI",
           "<General><Interfaces><NetworkInterface name=\"lo\" "
           "multicast=\"false\"/></Interfaces><AllowMulticast>false</AllowMulticast>"
           "</General><Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>99</"
           "MaxAutoParticipantIndex>"
           "<Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery>",
           1);
}

/// What was read of each topic, sample by sample.
std::map<std::string, Lines> read_topics(const std::string& out) {
  std::map<std::string, Lines> topics;
  std::istringstream stream(out);
  for (std::string line; std::getline(stream, line);) {
    std::vector<std::string> cells;
    std::istringstream rest(line);
    for (std::string cell; std::getline(rest, cell, '\t');) cells.push_back(cell);
    const std::string topic = cells.front();
    cells.erase(cells.begin());
    topics[topic].insert(cells);
  }
  return topics;
}

std::string text_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// The last line of every island that the samples are of.
std::map<std::string, std::string> last_of_islands(const Lines& samples) {
  std::map<std::string, std::pair<long, std::string>> last;
  for (const auto& cells : samples) {
    const std::string island = cells[0] + '/' + cells[1] + '/' + cells[2];
    const long generation = std::stol(cells[3]);
    const std::string figures = cells[3] + ' ' + cells[4] + ' ' + (cells.size() > 6 ? cells[6] : "");
    if (!last.contains(island) || last[island].first <= generation) last[island] = {generation, figures};
  }
  std::map<std::string, std::string> texts;
  for (const auto& [island, figures] : last) texts[island] = figures.second;
  return texts;
}

/// Of every sample these cells.
Lines chosen(const Lines& samples, const std::vector<std::size_t>& cells) {
  Lines lines;
  for (const auto& sample : samples) {
    std::vector<std::string> line;
    for (const std::size_t cell : cells) line.push_back(sample.at(cell));
    lines.insert(line);
  }
  return lines;
}

/// Metres as the monitor prints them: in mm, unknown ones as null.
std::string in_millimetres(const std::string& metres) {
  const double value = 1e3 * std::stod(metres);
  return std::isfinite(value) ? Json(value).dump() : "null";
}

/// Samples of causes as what_was_found() has events of them.
Lines causes_of(const Lines& samples) {
  Lines lines;
  for (auto cells : samples) {
    if (cells.at(3) == "0") cells[3] = "null";
    for (const std::size_t metres : {5u, 6u}) cells.at(metres) = in_millimetres(cells.at(metres));
    cells.at(7) = Json(std::stod(cells.at(7))).dump();
    lines.insert(cells);
  }
  return lines;
}

/// The same of final figures.
Lines figures_of(const Lines& samples) {
  Lines lines;
  for (auto cells : samples) {
    for (const std::size_t metres : {4u, 5u, 6u, 7u}) cells.at(metres) = in_millimetres(cells.at(metres));
    lines.insert(cells);
  }
  return lines;
}

/// Of every event with this word the members that the samples have, in their order.
Lines what_was_found(const std::string& out, const std::string& word, const std::vector<std::string>& members) {
  Lines lines;
  std::istringstream stream(out);
  for (std::string line; std::getline(stream, line);) {
    const Json event = Json::parse(line);
    if (event["event"] != word) continue;
    std::vector<std::string> cells;
    for (const std::string& member : members) cells.push_back(text_of(event.at(member)));
    lines.insert(cells);
  }
  return lines;
}

class OtherDds : public ::testing::Test {
 protected:
  OtherDds() { set_up_cyclone(); }

  static std::vector<std::string> calibrate(const SmallJob& job, const std::string& out, int which) {
    return {"calibrate", job.job(),           "--out",  job.path(out), "--workers", "2",
            "--domain",  other_domain(which), "--quiet"};
  }
};

TEST_F(OtherDds, ReadsInEveryMonitoringTopicWhatTheMonitorPrints) {
  const SmallJob job(1000, 2, "  backlash:\n    - {joint: 2, width_rad: 0.002}\n");
  StartedProgram monitor("demecal", {"monitor", "--domain", other_domain(1), "--json", "--ros2"});
  ASSERT_TRUE(monitor.wait_for_out("begin"));
  StartedProgram reader("read-topics", {other_domain(1), "300"});
  ASSERT_TRUE(reader.wait_for_out("reading"));
  const Ended calibrated = run("demecal", calibrate(job, "out", 1));
  ASSERT_EQ(calibrated.code, 0) << calibrated.err;
  ASSERT_TRUE(monitor.wait_for_out("\"finished\""));
  ASSERT_TRUE(reader.wait_for_out("rt/demecal/loop\t")) << reader.out_so_far();
  reader.signal(SIGTERM);
  const Ended read = reader.wait(std::chrono::seconds(100));
  ASSERT_EQ(read.code, 0);
  monitor.signal(SIGINT);
  const Ended printed = monitor.wait(std::chrono::seconds(20));

  std::map<std::string, Lines> topics = read_topics(read.out);
  Lines lines, loop, controls, workers, progress;
  std::istringstream stream(printed.out);
  for (std::string line; std::getline(stream, line);) {
    const Json event = Json::parse(line);
    const std::string word = event["event"];
    if (word == "begin") continue;
    lines.insert({line});
    if (word == "run_state") controls.insert({text_of(event["run"]), text_of(event["state"])});
    if (word == "worker")
      workers.insert({event["worker"], event["host"], text_of(event["process"]), text_of(event["slots"])});
    if (word == "stage" || word == "round")
      loop.insert({event["calibration"], word == "stage" ? "0" : text_of(event["round"]), event["text"]});
    if (word == "progress") {
      progress.insert({event["run"], text_of(event["joint"]), text_of(event["island"]), text_of(event["generation"]),
                       text_of(event["evaluations"]), "", event["best_formula"]});
    }
  }
  EXPECT_THAT(topics["rt/demecal/events"], ContainerEq(lines));
  std::map<std::string, int> islands_of_runs;
  for (const auto& [island, figures] : last_of_islands(progress)) ++islands_of_runs[island.substr(0, island.find('/'))];
  // Corrections have two for each joint, explanations four.
  EXPECT_THAT(islands_of_runs, Each(Pair(_, AnyOf(12, 4))));
  EXPECT_THAT(islands_of_runs, Contains(Pair(_, 12)));
  for (const std::string own : {"demecal/11/", "rt/demecal/"}) {
    EXPECT_EQ(last_of_islands(topics[own + "progress"]), last_of_islands(progress)) << own;
    EXPECT_THAT(chosen(topics[own + "worker"], {0, 1, 2, 3}), ContainerEq(workers)) << own;
  }
  EXPECT_THAT(chosen(topics["rt/demecal/loop"], {0, 1, 4}), ContainerEq(loop));
  EXPECT_THAT(chosen(topics["rt/demecal/run_state"], {0, 1}), ContainerEq(controls));
  const Lines causes = what_was_found(
      printed.out, "cause",
      {"calibration", "number", "cause", "joint", "label", "without_mm", "with_mm", "share_of_error", "advice"});
  const Lines figures = what_was_found(printed.out, "final_figures",
                                       {"calibration", "job", "causes", "effects", "validation_before_mm",
                                        "validation_after_mm", "accept_before_mm", "accept_after_mm"});
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_EQ(figures.begin()->at(2), std::to_string(causes.size()));
  EXPECT_THAT(causes, Contains(Contains("lost motion of joint 2")));
  for (const std::string own : {"demecal/11/", "rt/demecal/"}) {
    EXPECT_THAT(causes_of(topics[own + "cause"]), ContainerEq(causes)) << own;
    EXPECT_THAT(figures_of(topics[own + "final_figures"]), ContainerEq(figures)) << own;
  }
  // Of these the writer keeps the last value alone: a reader that is slow misses what it replaced.
  const Lines ends = chosen(topics["demecal/11/loop"], {0, 1, 4}),
              states = chosen(topics["demecal/11/control"], {0, 1});
  EXPECT_THAT(ends, IsSubsetOf(loop));
  EXPECT_THAT(loop, Contains(ElementsAre(_, "0", HasSubstr("finished"))));
  for (const auto& line : loop) {
    if (line[1] != "0" || line[2].starts_with("finished")) {
      EXPECT_THAT(ends, Contains(line));
    }
  }
  for (const auto& line : controls) {
    if (line[1] == "finished") {
      EXPECT_THAT(states, Contains(line));
    }
  }
}

TEST_F(OtherDds, ChangesNothingOfTheModelWithTwentyReadersOneOfThemStopped) {
  const SmallJob job(1000, 2);
  ASSERT_EQ(run("demecal", calibrate(job, "alone", 2)).code, 0);
  StartedProgram monitor("demecal", {"monitor", "--domain", other_domain(2), "--json", "--ros2"});
  std::vector<std::unique_ptr<StartedProgram>> readers;
  for (int i = 0; i < 20; ++i)
    readers.push_back(
        std::make_unique<StartedProgram>("read-topics", std::vector<std::string>{other_domain(2), "300"}));
  for (const auto& reader : readers) ASSERT_TRUE(reader->wait_for_out("reading"));
  StartedProgram coordinator("demecal", calibrate(job, "read", 2));
  ASSERT_TRUE(readers[0]->wait_for_out("demecal/11/progress"));
  readers[0]->signal(SIGSTOP);
  EXPECT_EQ(coordinator.wait(std::chrono::seconds(240)).code, 0);
  const std::string alone = job.text("alone/model.yaml");
  ASSERT_FALSE(alone.empty());
  EXPECT_EQ(job.text("read/model.yaml"), alone);
}

}  // namespace
}  // namespace demecal
