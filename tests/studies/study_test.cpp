// What a study writes says what its runs were.
#include "studies/study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "data/csv.hpp"
#include "data/text.hpp"
#include "made_up_study.hpp"

namespace demecal {
namespace {

using Json = nlohmann::ordered_json;

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
  const Json told = Json::parse(to_json(study));
  EXPECT_EQ(told["demecal_study"], 1);
  ASSERT_EQ(told["cells"].size(), 2U);
  ASSERT_EQ(told["runs"].size(), 14U);
  EXPECT_EQ(told["cells"][1]["parameters"]["gp.population_size"], 300);
  EXPECT_EQ(told["cells"][1]["parameters"]["gp.constants_range"], "[-1, 1]");
  for (std::size_t cell = 0; cell < 2; ++cell) {
    std::vector<double> values;
    for (const StudyRun& run : study.runs) {
      if (run.cell == cell) values.push_back(*run.validation_mm);
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

TEST(StudyJson, CanBeOfNoRun) {
  Study study = made_up_study(6);
  study.runs.clear();
  EXPECT_EQ(Json::parse(to_json(study))["cells"][0]["runs"], 0);
}

TEST(StudyJson, HasAllBlocks) {
  Study study = made_up_study(2);
  for (const char* form : {"SIN(2 * theta)", "COS(theta)", "theta * theta"}) {
    study.blocks.push_back({block_form(parse(form)), 3, 4, 5, 0.625});
  }
  const Json told = Json::parse(to_json(study));
  EXPECT_EQ(told["blocks"][0]["block"], "SIN(c * theta)");
  EXPECT_EQ(told["blocks"][2]["mean_rank_share"], 0.625);
}

}  // namespace
}  // namespace demecal
