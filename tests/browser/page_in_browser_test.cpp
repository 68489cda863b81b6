// The report's page in a real browser: nothing on its console, tables sort, pictures answer, nothing is cut off on a
// telephone, and twelve thousand poses are no trouble.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "html/page.hpp"
#include "report/made_up_loop.hpp"
#include "report/measured_report.hpp"

namespace demecal {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::json;

/// Where scripts/install-dependencies puts it.
const std::filesystem::path kPuppeteer = std::string(DEMECAL_SOURCE_DIR) + "/tests/browser/node_modules/puppeteer-core";
const std::filesystem::path kBrowser = "/usr/bin/chromium";

class PageInBrowser : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kPuppeteer) || !std::filesystem::exists(kBrowser))
      GTEST_SKIP() << "no browser, or no puppeteer-core to drive it: scripts/install-dependencies installs both";
    char name[] = "/tmp/demecal-browser-XXXXXX";
    folder_ = ::mkdtemp(name);
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  /// What the page did when it was used.
  Json used(const std::string& page) {
    const std::filesystem::path file = folder_ / "report.html", said = folder_ / "said.json", log = folder_ / "log";
    std::ofstream(file, std::ios::binary) << page;
    // Screenshots stay where a person who asks for them finds them.
    const char* const screenshots = std::getenv("DEMECAL_SCREENSHOTS");
    const std::string command = "timeout 150 node '" DEMECAL_SOURCE_DIR "/tests/browser/check_page.cjs' '" +
                                kPuppeteer.string() + "' '" + kBrowser.string() + "' '" + file.string() + "' " +
                                (screenshots == nullptr ? "" : "'" + std::string(screenshots) + "'") + " > '" +
                                said.string() + "' 2> '" + log.string() + "'";
    if (std::system(command.c_str()) != 0) {
      std::ifstream text(log);
      ADD_FAILURE() << std::string{std::istreambuf_iterator<char>(text), {}};
      return {};
    }
    std::ifstream text(said);
    return Json::parse(text);
  }

 private:
  std::filesystem::path folder_;
};

std::vector<double> numbers(const Json& cells) {
  std::vector<double> values;
  for (const Json& cell : cells) values.push_back(std::stod(cell.get<std::string>()));
  return values;
}

void expect_usable(const Json& seen) {
  EXPECT_THAT(seen["complaints"], IsEmpty()) << seen["complaints"];
  EXPECT_THAT(seen["requests"], IsEmpty()) << seen["requests"];
  EXPECT_TRUE(std::ranges::is_sorted(numbers(seen["after_descending"]), std::ranges::greater{}));
  EXPECT_TRUE(std::ranges::is_sorted(numbers(seen["before_descending"]), std::ranges::greater{}));
  EXPECT_TRUE(std::ranges::is_sorted(numbers(seen["before_ascending"])));
  EXPECT_EQ(seen["sorted_by"], "before, mm ascending");
  EXPECT_EQ(seen["filtered_sets"], Json::array({"validation"}));
  EXPECT_EQ(seen["rows_of_no_pose"], 0);
  for (const char* const deed : {"slider_draws", "button_turns", "slice_draws", "key_tilts", "plots_differ"})
    EXPECT_EQ(seen[deed], true) << deed;
  EXPECT_THAT(seen["hovered"].get<std::string>(), HasSubstr("mm before"));
  EXPECT_THAT(seen["tapped"].get<std::string>(), HasSubstr("mm before"));
  EXPECT_THAT(seen["slice_place"].get<std::string>(),
              ::testing::MatchesRegex("z = -?[0-9]+ ± [0-9.]+ mm, [0-9]+ poses"));
  EXPECT_LE(seen["causes_beyond_at_1280"], 0);
  EXPECT_LE(seen["causes_beyond_at_400"], 0);
  EXPECT_THAT(seen["cut_in_print"], IsEmpty()) << seen["cut_in_print"];
  EXPECT_TRUE(seen["picked"].get<std::string>().starts_with(seen["first_row"].get<std::string>() + " ("));
  EXPECT_THAT(seen["cut_at_400"], IsEmpty()) << seen["cut_at_400"];
  EXPECT_LE(seen["width_at_400"], 400);
  EXPECT_EQ(seen["dark_page"], "rgb(18, 23, 28)");
  EXPECT_GT(seen["printed_bytes"], 10000);
}

TEST_F(PageInBrowser, AnswersWhoeverUsesIt) {
  Report report = with_measured_poses(made_up_looped_report(27), 300);
  CauseEntry cause;
  cause.name = "bearings of joint 2, or the elasticity of what stands between it and joint 3, whichever bends more";
  cause.advice = "Measure with two payloads at poses where the upper arm is level, then look at the bearings first.";
  report.causes.assign(2, cause);
  expect_usable(used(report_html(report, fitness_of(made_up_history(6, 3, 10)))));
}

TEST_F(PageInBrowser, OpensTwelveThousandPosesInTwoSecondsAndFiveMegabytes) {
  const std::string page = report_html(with_measured_poses(made_up_report(), 12000), {});
  EXPECT_LE(page.size(), 5U << 20U);
  const Json seen = used(page);
  expect_usable(seen);
  EXPECT_LE(seen["opened_ms"], 2000);
  EXPECT_THAT(seen["pages"].get<std::string>(), HasSubstr("of 12000 poses"));
}

}  // namespace
}  // namespace demecal
