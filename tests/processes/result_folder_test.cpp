// Folders of results through the real programs: what demecal left is written again, what others left never unasked.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

Ended diagnose_into(const SmallJob& job, const std::string& out, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"diagnose", job.data(),      "--out", job.path(out), "--declare", "registration",
                                     "--quiet",  "--max-effects", "0"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run("demecal", arguments);
}

void leave(const SmallJob& job, const std::string& file, const std::string& text) {
  std::filesystem::create_directories(std::filesystem::path(job.path(file)).parent_path());
  std::ofstream(job.path(file)) << text;
}

TEST(ResultFolder, IsWrittenAgainWhereDemecalLeftIt) {
  const SmallJob job;
  std::filesystem::create_directories(job.path("out"));
  leave(job, "out/notes.txt", "mine");
  EXPECT_EQ(diagnose_into(job, "out").code, 0);
  EXPECT_EQ(diagnose_into(job, "out").code, 0);
  EXPECT_EQ(diagnose_into(job, "out", {"--propose", "3"}).code, 0);
  EXPECT_EQ(diagnose_into(job, "out", {"--propose", "3"}).code, 0);
  EXPECT_EQ(job.text("out/notes.txt"), "mine");
  const Ended report = run("demecal", {"report", job.path("out")});
  EXPECT_EQ(report.code, 0) << report.err;
}

TEST(ResultFolder, KeepsFilesOfOthersUnlessForced) {
  const SmallJob job;
  leave(job, "out/report.html", "a page of somebody else's\n");
  leave(job, "out/model.yaml", "colour: red\n");
  const Ended refused = diagnose_into(job, "out");
  EXPECT_EQ(refused.code, 10);
  EXPECT_NE(refused.err.find("model.yaml, report.html are there already"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--force"), std::string::npos);
  EXPECT_EQ(job.text("out/report.html"), "a page of somebody else's\n");
  EXPECT_EQ(job.text("out/report.json"), "");
  EXPECT_EQ(diagnose_into(job, "out", {"--force"}).code, 0);
  EXPECT_EQ(diagnose_into(job, "out").code, 0);
}

TEST(ResultFolder, KeepsWhatWasChangedSinceUnlessForced) {
  const SmallJob job;
  ASSERT_EQ(diagnose_into(job, "out").code, 0);
  const std::string edited = job.text("out/model.yaml") + "# checked by hand\n";
  leave(job, "out/model.yaml", edited);
  const Ended refused = diagnose_into(job, "out");
  EXPECT_EQ(refused.code, 10);
  EXPECT_NE(refused.err.find("model.yaml is there already"), std::string::npos) << refused.err;
  EXPECT_EQ(job.text("out/model.yaml"), edited);
  leave(job, "data/poses.csv", job.text("data/poses.csv") + "\n");
  const Ended data = run("demecal", {"simulate", job.path("scenario.yaml"), "--out", job.path("data")});
  EXPECT_EQ(data.code, 10);
  EXPECT_NE(data.err.find("poses.csv is there already"), std::string::npos) << data.err;
  EXPECT_EQ(run("demecal", {"simulate", job.path("scenario.yaml"), "--out", job.path("data"), "--force"}).code, 0);
  EXPECT_EQ(run("demecal", {"simulate", job.path("scenario.yaml"), "--out", job.path("data")}).code, 0);
  EXPECT_EQ(diagnose_into(job, "out", {"--force"}).code, 0);
}

TEST(ResultFolder, KnowsItsResultsWithoutAListAndTakesNothingElseForItsOwn) {
  const SmallJob job;
  ASSERT_EQ(diagnose_into(job, "out", {"--propose", "3"}).code, 0);
  std::filesystem::remove(job.path("out/.demecal-files"));
  EXPECT_EQ(run("demecal", {"report", job.path("out")}).code, 0);
  EXPECT_EQ(diagnose_into(job, "out").code, 0);
  EXPECT_EQ(diagnose_into(job, "out", {"--propose", "3"}).code, 10) << "a person may have filled it in";
  std::filesystem::remove(job.path("data/.demecal-files"));
  leave(job, "data/my-robot.yaml", "mine");
  EXPECT_EQ(run("demecal", {"robot", "show", "ur5e", "--out", job.path("data/my-robot.yaml")}).code, 10);
  EXPECT_EQ(job.text("data/my-robot.yaml"), "mine");
  EXPECT_EQ(run("demecal", {"simulate", job.path("scenario.yaml"), "--out", job.path("data")}).code, 10);
}

/// A table of poses by numbers, each a thousandth: as if metres stood where millimetres are meant.
void shrink_measured_columns(const SmallJob& job) {
  std::istringstream rows(job.text("data/poses.csv"));
  std::string made, row;
  std::vector<bool> is_length;
  while (std::getline(rows, row)) {
    std::istringstream cells(row);
    std::size_t column = 0;
    std::string made_row;
    for (std::string cell; std::getline(cells, cell, ','); ++column) {
      if (made.empty())
        is_length.push_back(cell.ends_with("_mm"));
      else if (is_length[column])
        cell = std::to_string(std::stod(cell) / 1000.0);
      made_row += (column == 0 ? "" : ",") + cell;
    }
    made += made_row + "\n";
  }
  leave(job, "data/poses.csv", made);
}

TEST(ResultFolder, HoldsNoResultsOfEarlierDataBesideThatTheDataContradict) {
  const SmallJob job;
  leave(job, "out/notes.txt", "mine");
  leave(job, "out/standstills.csv", "mine, too");
  ASSERT_EQ(diagnose_into(job, "out", {"--propose", "3"}).code, 0);
  const std::string edited = job.text("out/proposed.csv") + "# measured on Monday\n";
  leave(job, "out/proposed.csv", edited);
  shrink_measured_columns(job);
  const Ended refused = diagnose_into(job, "out");
  ASSERT_EQ(refused.code, 12) << refused.err;
  EXPECT_NE(job.text("out/report.json").find("\"method\": \"none\""), std::string::npos);
  for (const char* const gone : {"model.yaml", "pose-errors.csv"})
    EXPECT_FALSE(std::filesystem::exists(job.path("out/" + std::string(gone)))) << gone;
  EXPECT_EQ(job.text("out/.demecal-files").find("model.yaml"), std::string::npos);
  EXPECT_EQ(job.text("out/notes.txt"), "mine");
  EXPECT_EQ(job.text("out/standstills.csv"), "mine, too");
  EXPECT_EQ(job.text("out/proposed.csv"), edited);
}

TEST(ResultFolder, HoldsNoResultsOfAnEarlierRunThatThisOneDoesNotWrite) {
  const SmallJob job(5, 1);
  const std::vector<std::string> calibrate{"calibrate",     job.job(),   "--out",
                                           job.path("out"), "--workers", "in-process:2"};
  ASSERT_EQ(run("demecal", calibrate).code, 0);
  ASSERT_NE(job.text("out/fronts.csv"), "");
  const std::string evolution = "\"progress\"";
  ASSERT_NE(job.text("out/events.jsonl").find(evolution), std::string::npos);
  const std::string edited = job.text("out/history.csv") + "\n";
  leave(job, "out/history.csv", edited);
  ASSERT_EQ(diagnose_into(job, "out").code, 0);
  EXPECT_FALSE(std::filesystem::exists(job.path("out/fronts.csv")));
  EXPECT_EQ(job.text("out/events.jsonl").find(evolution), std::string::npos) << "its own record, not the earlier one";
  EXPECT_EQ(job.text("out/history.csv"), edited);
  std::filesystem::remove(job.path("out/history.csv"));
  // What a run writes stays, its events among them, which are written all the while.
  ASSERT_EQ(run("demecal", calibrate).code, 0);
  for (const char* const kept :
       {"model.yaml", "report.json", "report.html", "pose-errors.csv", "history.csv", "fronts.csv", "events.jsonl"})
    EXPECT_NE(job.text("out/" + std::string(kept)), "") << kept;
}

TEST(ResultFolder, GoesOnAfterARunThatWasKilledOrInterrupted) {
  const SmallJob job(3000, 2);
  const std::vector<std::string> arguments{"calibrate", job.job(), "--out",    job.path("out"),
                                           "--workers", "1",       "--domain", private_domain()};
  for (const int signal : {SIGKILL, SIGINT}) {
    StartedProgram program("demecal", arguments);
    ASSERT_TRUE(program.wait_for_err("generation")) << program.err_so_far();
    program.signal(signal);
    EXPECT_NE(program.wait().code, 10);
  }
  StartedProgram again("demecal", arguments);
  EXPECT_TRUE(again.wait_for_err("generation")) << again.err_so_far();
  again.signal(SIGINT);
  EXPECT_EQ(again.wait().code, 130);
}

}  // namespace
}  // namespace demecal
