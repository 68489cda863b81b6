// What a study prints and writes says what its runs were.
#include "report/study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "data/csv.hpp"
#include "data/number.hpp"
#include "random/random_stream.hpp"
#include "report/study_cells.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

/// Two cells with the first `seeds` seeds.
Study made_up_study(std::size_t seeds) {
  RandomStream random({81});
  Study study;
  study.job = "demo";
  study.robot = "PUMA 761";
  study.keys = {"gp.population_size", "gp.constants_range"};
  study.cells = {{"100", "[0, 1]"}, {"300", "[-1, 1]"}};
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    study.seeds.push_back(seed);
    for (std::size_t cell = 0; cell < 2; ++cell) {
      StudyRun run;
      run.cell = cell;
      run.seed = seed;
      run.calibration_mm = random.real(0.1, 0.2);
      run.validation_mm = random.real(0.2, 0.3);
      run.nodes = 20 + random.index(30);
      run.corrected = 5;
      run.evaluations = 40000 + random.index(1000);
      run.wall_s = random.real(1.0, 2.0);
      study.runs.push_back(run);
    }
  }
  return study;
}

TEST(StudyCsv, HasARowForEveryRunThatReadsBack) {
  const Study study = made_up_study(3);
  std::istringstream text(study_csv(study));
  const CsvTable table = read_csv(text, "study.csv");
  ASSERT_EQ(table.rows.size(), study.runs.size());
  const auto field = [&](std::size_t row, const char* column) {
    return table.rows[row].fields[table.find(column).value()];
  };
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    const StudyRun& run = study.runs[i];
    EXPECT_EQ(field(i, "cell"), std::to_string(run.cell + 1));
    EXPECT_EQ(field(i, "seed"), std::to_string(run.seed));
    EXPECT_EQ(field(i, "gp.constants_range"), study.cells[run.cell][1]);
    EXPECT_EQ(parse_number(field(i, "validation_rms_mm")), run.validation_mm);
    EXPECT_EQ(field(i, "accept_rms_mm"), "");
    EXPECT_EQ(field(i, "nodes"), std::to_string(run.nodes));
    EXPECT_EQ(field(i, "evaluations"), std::to_string(run.evaluations));
  }
}

TEST(StudyJson, HasTheMediansOfItsRuns) {
  const Study study = made_up_study(7);
  const Json told = Json::parse(study_json(study));
  EXPECT_EQ(told["demecal_study"], 1);
  ASSERT_EQ(told["cells"].size(), 2U);
  ASSERT_EQ(told["runs"].size(), 14U);
  EXPECT_EQ(told["cells"][1]["parameters"]["gp.population_size"], 300);
  EXPECT_EQ(told["cells"][1]["parameters"]["gp.constants_range"], "[-1, 1]");
  for (std::size_t cell = 0; cell < 2; ++cell) {
    std::vector<double> values;
    for (const StudyRun& run : study.runs) {
      if (run.cell == cell) values.push_back(run.validation_mm);
    }
    std::sort(values.begin(), values.end());
    const Json& validation = told["cells"][cell]["validation_rms_mm"];
    EXPECT_EQ(validation["median"], values[3]);
    EXPECT_EQ(validation["lower"], values[0]);
    EXPECT_EQ(validation["interval"], "order_statistics");
    EXPECT_GE(validation["confidence"], 0.95);
    EXPECT_TRUE(told["cells"][cell]["accept_rms_mm"].is_null());
  }
}

TEST(StudyTable, SaysWhatTheBracketsHold) {
  EXPECT_THAT(study_table(made_up_study(8)), HasSubstr("order statistics"));
  EXPECT_THAT(study_table(made_up_study(8)), Not(HasSubstr("least and the largest")));
  EXPECT_THAT(study_table(made_up_study(5)), HasSubstr("least and the largest"));
  EXPECT_THAT(study_table(made_up_study(5)), Not(HasSubstr("order statistics")));
  Study broken_off = made_up_study(6);
  broken_off.runs.pop_back();
  broken_off.interrupted = true;
  EXPECT_THAT(study_table(broken_off), HasSubstr("order statistics"));
  EXPECT_THAT(study_table(broken_off), HasSubstr("least and the largest"));
  EXPECT_THAT(study_table(broken_off), HasSubstr("11 of 12 runs (interrupted)"));
}

TEST(StudyTable, HasACellInALineAndColumnsOfWhatWasMeasured) {
  Study study = made_up_study(6);
  EXPECT_THAT(study_table(study), Not(HasSubstr("accept")));
  for (const auto& cell : study.cells) EXPECT_THAT(study_table(study), HasSubstr("  " + cell[1] + "  "));
  for (StudyRun& run : study.runs) run.accept_mm = 0.5;
  EXPECT_THAT(study_table(study), HasSubstr("0.5000 [0.5000, 0.5000]"));
  EXPECT_THAT(study_table(study), Not(HasSubstr("calibration mm")));
  for (StudyRun& run : study.runs) run.validation_mm = run.accept_mm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(study_table(study), HasSubstr("calibration mm"));
}

TEST(StudyTable, CanBeOfNoRun) {
  Study study = made_up_study(6);
  study.runs.clear();
  EXPECT_THAT(study_table(study), HasSubstr("0 of 12 runs"));
  EXPECT_EQ(Json::parse(study_json(study))["cells"][0]["runs"], 0);
}

TEST(BlocksTable, HasTheFirstBlocksAndSaysHowManyMoreThereAre) {
  Study study = made_up_study(2);
  EXPECT_THAT(blocks_table(study, 5), HasSubstr("No expression of two functions or more stands"));
  for (const char* form : {"SIN(2 * theta)", "COS(theta)", "theta * theta"}) {
    study.blocks.push_back({block_form(parse(form)), 3, 4, 5, 0.625});
  }
  const std::string text = blocks_table(study, 2);
  EXPECT_THAT(text, HasSubstr("SIN(c * theta)"));
  EXPECT_THAT(text, Not(HasSubstr("theta * theta")));
  EXPECT_THAT(text, HasSubstr("1 more"));
  const Json told = Json::parse(study_json(study));
  EXPECT_EQ(told["blocks"][0]["block"], "SIN(c * theta)");
  EXPECT_EQ(told["blocks"][2]["mean_rank_share"], 0.625);
}

}  // namespace
}  // namespace demecal
