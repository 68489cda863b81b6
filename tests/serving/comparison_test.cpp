// Finished jobs beside each other, by what their reports state.
#include "serving/job_files.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace demecal {
namespace {

using Rows = nlohmann::json;

TEST(Comparison, HasTheFiguresOfEveryReportSetBySet) {
  const std::string report =
      R"({"demecal_report": 1, "method": "direct", "seed": 3, "data_sha256": "ab", "robot": "arm",
    "error_mm": {"nominal": {}, "before": {"calibration": {"mean": 1, "rms": 2, "p95": 3, "max": 4}},
                 "after": {"calibration": {"rms": 0.5}, "validation": {"rms": 0.25}, "accept": {}}}})";
  const Rows compared =
      Rows::parse(comparison_text({{"first", report}, {"broken", "{"}, {"empty", ""}, {"old", "{}"}}));
  EXPECT_EQ(compared["demecal_jobs_comparison"], 1);
  ASSERT_EQ(compared["jobs"].size(), 4U);
  const Rows& row = compared["jobs"][0];
  EXPECT_EQ(row["job"], "first");
  EXPECT_EQ(row["seed"], 3);
  EXPECT_EQ(row["data_sha256"], "ab");
  EXPECT_EQ(row["error_mm"]["before"]["calibration"]["max"], 4);
  EXPECT_EQ(row["error_mm"]["after"]["validation"]["rms"], 0.25);
  EXPECT_TRUE(row["error_mm"]["before"]["accept"]["rms"].is_null());
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(compared["jobs"][i]["readable"], false);
}

TEST(Comparison, StandsWhateverAReportHolds) {
  for (const char* const text :
       {R"({"error_mm": 3})", R"({"error_mm": {"after": [1]}})", R"({"error_mm": {"after": {"accept": "x"}}})",
        R"({"error_mm": null, "seed": {"a": []}})"}) {
    EXPECT_EQ(Rows::parse(comparison_text({{"job", text}}))["jobs"][0]["job"], "job") << text;
  }
}

}  // namespace
}  // namespace demecal
