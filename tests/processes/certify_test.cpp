// demecal certify: a verdict with every tolerance, three files, and what nobody stated named.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "certified.hpp"
#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using Json = nlohmann::json;

TEST(Certify, EndsWellWhateverTheVerdict) {
  Certified robot;
  const Ended wide = robot.certify("10"), narrow = robot.certify("0.001"), json = robot.certify("10", {"--json"});
  ASSERT_EQ(wide.code, 0) << wide.err;
  ASSERT_EQ(narrow.code, 0) << narrow.err;
  ASSERT_EQ(json.code, 0) << json.err;
  EXPECT_TRUE(has(wide.out, "Undecided: so few prove nothing of others")) << wide.out;
  EXPECT_TRUE(has(narrow.out, "Non-conformity proved")) << narrow.out;
  // A list of jobs shows the last line of each.
  const std::string last = narrow.out.substr(narrow.out.rfind('\n', narrow.out.size() - 2) + 1);
  EXPECT_TRUE(last.starts_with("Non-conformity proved")) << last;
  EXPECT_TRUE(has(wide.out, "not measured")) << "RP without repeats";
  const Json said = Json::parse(json.out);
  EXPECT_EQ(said["judgement"]["verdict"], "undecided");
  EXPECT_NE(said["judgement"]["withheld"], "");
  EXPECT_EQ(said["judged_set"], "accept");
  EXPECT_EQ(said["judgement"]["poses"], 10);
  const double error_mm = said["judgement"]["error_mm"];
  // Within the errors' own scatter nothing decides; beyond them all, more poses of the same kind would.
  const Ended close = robot.certify(std::to_string(1.02 * error_mm)),
              beyond = robot.certify(std::to_string(1.5 * error_mm));
  for (const Ended& undecided : {close, beyond}) {
    EXPECT_EQ(undecided.code, 0);
    EXPECT_TRUE(has(undecided.out, "Undecided")) << undecided.out;
  }
  EXPECT_TRUE(has(close.out, "no practical number of poses would decide")) << close.out;
  EXPECT_TRUE(has(beyond.out, "poses in all")) << beyond.out;
}

/// The shipped arm without an instrument: a model, and certificates of it by lengths.
TEST(Certify, JudgesKnownLengthsWhereNothingWasMeasured) {
  SmallJob job;
  const std::string configs = DEMECAL_SOURCE_DIR "/configs/";
  const Ended found = run("demecal", {"calibrate", configs + "jobs/sockets.yaml", "--workers", "in-process", "--quiet",
                                      "--out", job.path("out")});
  ASSERT_EQ(found.code, 0) << found.err;
  const auto certify = [&](const std::string& data, const std::string& tolerance) {
    return run("demecal", {"certify", job.path("out/model.yaml"), data, "--tolerance", tolerance, "--out",
                           job.path("signed"), "--json"});
  };
  const std::string shipped = configs + "data/puma761-sockets/dataset.yaml";
  const Ended kept = certify(shipped, "2"), finer = certify(shipped, "0.01");
  ASSERT_EQ(kept.code, 0) << kept.err;
  const Json said = Json::parse(kept.out);
  EXPECT_EQ(said["judged"], "error of lengths between touched points");
  EXPECT_EQ(said["judgement"]["verdict"], "undecided") << "twelve prove nothing of others";
  EXPECT_EQ(said["judgement"]["beyond"], 0);
  EXPECT_EQ(said["judgement"]["poses"], 12);  // 24 accept poses, each an end of one length
  EXPECT_LT(said["error_mm"]["after"]["rms"], said["error_mm"]["before"]["rms"]);
  EXPECT_EQ(Json::parse(finer.out)["judgement"]["verdict"], "undecided") << "lengths are known to 0.02 mm";
  EXPECT_TRUE(has(Json::parse(finer.out)["remedy"], "a better known length is needed"));
  const std::string page = job.text("signed/certificate.html");
  EXPECT_TRUE(has(page, "error of lengths between touched points"));
  EXPECT_FALSE(has(page, "position error"));

  std::string no_length = job.text(shipped);
  no_length.erase(no_length.find("    - {between: [unseen-0"),
                  no_length.find("frame:") - no_length.find("    - {between: [unseen-0"));
  for (const char* const name : {"poses.csv", "robot.yaml"})
    std::filesystem::copy_file(configs + "data/puma761-sockets/" + name, job.path(name),
                               std::filesystem::copy_options::overwrite_existing);
  std::ofstream(job.path("no-length.yaml")) << no_length;
  const Ended refused = certify(job.path("no-length.yaml"), "2");
  EXPECT_EQ(refused.code, 11);
  EXPECT_TRUE(has(refused.err, "contacts.distances")) << refused.err;
}

/// Whose poses are drawn into sets all the same, where they are read.
TEST(Certify, JudgesAllPosesOfOtherDataWithoutSets) {
  Certified robot;
  std::string data = robot.text("data/dataset.yaml"), poses = robot.text("data/poses.csv");
  const std::size_t column = data.find("  set: ");
  ASSERT_NE(column, std::string::npos);
  data.erase(column, data.find('\n', column) + 1 - column);
  poses.erase(poses.find_last_of('\n', poses.size() - 2) + 1);
  std::ofstream(robot.path("data/dataset.yaml")) << data;
  std::ofstream(robot.path("data/poses.csv")) << poses;
  const Ended ended = robot.certify("10", {"--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json said = Json::parse(ended.out);
  EXPECT_EQ(said["judgement"]["poses"], std::ranges::count(poses, '\n') - 1);
  EXPECT_TRUE(has(ended.out, "all poses are judged")) << ended.out;
  EXPECT_FALSE(has(ended.out, "took part in the choice")) << ended.out;
}

TEST(Certify, RefusesPositionsThatWereComputed) {
  Certified robot;
  std::string scenario = robot.text("scenario.yaml");
  scenario.erase(scenario.find("errors:"));
  scenario.replace(scenario.find("noise_mm: 0.05"), 14, "noise_mm: 0");
  std::ofstream(robot.path("exact.yaml")) << scenario;
  const Ended simulated =
      run("demecal", {"simulate", robot.path("exact.yaml"), "--out", robot.path("data"), "--force"});
  ASSERT_EQ(simulated.code, 0) << simulated.err;
  const Ended refused = robot.certify("10");
  EXPECT_EQ(refused.code, 12) << refused.out;
  EXPECT_TRUE(has(refused.err, "not measured ones")) << refused.err;
  EXPECT_TRUE(robot.text("signed/certificate.html").empty());
  EXPECT_EQ(robot.certify("10", {"--force"}).code, 0);
}

TEST(Certify, HasTheFiguresOfTheReport) {
  Certified robot;
  ASSERT_EQ(robot.certify("0.5").code, 0);
  const Json report = Json::parse(robot.text("out/report.json"));
  const std::string page = robot.text("signed/certificate.html"), xml = robot.text("signed/certificate.xml");
  for (const char* const stage : {"registered", "after"}) {
    for (const char* const figure : {"mean", "rms", "p95", "max"}) {
      const double value_mm = report["error_mm"][stage]["accept"][figure];
      char cell[64];
      std::snprintf(cell, sizeof cell, ">%.3f<", value_mm);
      EXPECT_TRUE(has(page, cell)) << stage << ' ' << figure << ' ' << cell;
    }
  }
  const std::string largest = report["error_mm"]["after"]["accept"]["max"].dump();
  EXPECT_TRUE(has(xml, "<si:value>" + largest.substr(0, 8))) << largest;
}

TEST(Certify, PrintsTheSameFigures) {
  Certified robot;
  const Ended ended = robot.certify("0.5", {"--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  if (!std::filesystem::exists(robot.path("signed/certificate.pdf"))) GTEST_SKIP() << "no printer of pages here";
  const std::string words = words_of_pdf(robot.path("signed/certificate.pdf"));
  if (words.empty()) GTEST_SKIP() << "no pdftotext here";
  const Json said = Json::parse(ended.out);
  for (const char* const figure : {"mean", "rms", "p95", "max"}) {
    char text[64];
    std::snprintf(text, sizeof text, "%.3f", said["error_mm"]["after"][figure].get<double>());
    EXPECT_TRUE(has(words, text)) << figure << "\n" << words;
  }
  EXPECT_TRUE(has(words, said["judgement"]["verdict"]));
  EXPECT_TRUE(has(words, "Page 1 of ")) << words;
}

TEST(Certify, StatesWhatTheDataSetStatesAndNamesTheRest) {
  Certified robot(
      "certificate:\n  customer: \"Foundry & Sons\"\n  serial_number: 4711\n  date: 2026-02-03\n"
      "  instrument_uncertainty_mm: 0.01\n");
  const Ended ended = robot.certify("0.5");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const std::string page = robot.text("signed/certificate.html"), xml = robot.text("signed/certificate.xml");
  for (const std::string& text : {page, xml}) {
    EXPECT_TRUE(has(text, "Foundry &amp; Sons"));
    EXPECT_TRUE(has(text, "4711"));
    EXPECT_TRUE(has(text, "2026-02-03"));
  }
  EXPECT_TRUE(has(page, "Not stated, and left blank: Certificate number; ")) << page;
  EXPECT_TRUE(has(xml, "not stated"));
  EXPECT_TRUE(has(ended.out, "not stated, and blank on the certificate")) << ended.out;
  EXPECT_FALSE(has(page, "Customer; "));
}

TEST(Certify, TakesTheJobsFieldsThroughTheModel) {
  SmallJob job(2, 1);
  std::ofstream(job.job(), std::ios::app) << "certificate: {customer: Foundry, operator: A. Person, country: DE}\n";
  const Ended ended = run("demecal", {"calibrate", job.job(), "--out", job.path("out"), "--workers", "in-process:1",
                                      "--max-effects", "0", "--quiet"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Ended certified = run(
      "demecal", {"certify", job.path("out/model.yaml"), job.data(), "--tolerance", "1", "--out", job.path("signed")});
  ASSERT_EQ(certified.code, 0) << certified.err;
  EXPECT_TRUE(has(job.text("signed/certificate.xml"), "A. Person"));
  EXPECT_TRUE(has(job.text("signed/certificate.xml"), "<dcc:countryCodeISO3166_1>DE<"));
}

TEST(Certify, SaysWhatIsWrongWithFieldsAndTolerances) {
  Certified robot;
  EXPECT_EQ(robot.certify("-1").code, 10);
  EXPECT_EQ(robot.certify("nan").code, 10);
  std::ofstream(robot.path("data/dataset.yaml"), std::ios::app) << "certificate: {date: 3 March}\n";
  const Ended date = robot.certify("1");
  EXPECT_EQ(date.code, 11);
  EXPECT_TRUE(has(date.err, "'3 March': certificate.date must be a day written as 2026-01-31")) << date.err;
}

TEST(Certify, RefusesTheModelOfAnotherArmAsEvaluateDoes) {
  Certified robot;
  std::string arm = robot.text("data/robot.yaml");
  const std::string upper_arm = "a_mm: 650,";
  ASSERT_TRUE(has(arm, upper_arm)) << arm;
  arm.replace(arm.find(upper_arm), upper_arm.size(), "a_mm: 690,");
  std::ofstream(robot.path("data/robot.yaml")) << arm;
  const Ended certified = robot.certify("1");
  EXPECT_EQ(certified.code, 11);
  EXPECT_TRUE(has(certified.err, "is not the arm that the model corrects (PUMA 761): described as it is"))
      << certified.err;
  EXPECT_TRUE(has(certified.err, "up to 40 mm from there")) << certified.err;
  EXPECT_EQ(robot.text("signed/certificate.html"), "");
  const std::vector<std::string> evaluate{"evaluate", robot.path("out/model.yaml"), robot.path("data/dataset.yaml")};
  EXPECT_EQ(run("demecal", evaluate).code, 11);
  EXPECT_EQ(run("demecal", {evaluate[0], evaluate[1], evaluate[2], "--force"}).code, 0);
}

TEST(Certify, NeverOverwritesFilesThatAreNotOurs) {
  Certified robot;
  std::filesystem::create_directories(robot.path("signed"));
  std::ofstream(robot.path("signed/certificate.html")) << "something else\n";
  EXPECT_EQ(robot.certify("1").code, 10);
  EXPECT_EQ(robot.text("signed/certificate.html"), "something else\n");
  EXPECT_EQ(robot.certify("1", {"--force"}).code, 0);
}

}  // namespace
}  // namespace demecal
