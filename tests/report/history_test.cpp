// The course of evolution, written as a table and read back for its charts.
#include "report/history.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "data/csv.hpp"
#include "errors/input_error.hpp"
#include "made_up_report.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kHeader =
    "joint,island,generation,best_fitness,median_fitness,best_length,evaluations,migrants_taken,worker\n";

std::string complaint(const std::string& csv) {
  try {
    read_fitness(csv);
  } catch (const InputError& fault) {
    return fault.what();
  }
  return "none";
}

TEST(HistoryCsv, ReadsBackTheSame) {
  const std::vector<HistoryRow> rows = made_up_history(3, 2, 4);
  std::istringstream text(history_csv(rows));
  const CsvTable table = read_csv(text, "history.csv");
  ASSERT_EQ(table.rows.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::vector<std::string>& fields = table.rows[i].fields;
    EXPECT_EQ(fields[0], std::to_string(rows[i].island.joint + 1));
    EXPECT_EQ(fields[1], std::to_string(rows[i].island.deme + 1));
    EXPECT_EQ(fields[2], std::to_string(rows[i].generation));
    EXPECT_EQ(std::stod(fields[3]), rows[i].figures.best);
    EXPECT_EQ(std::stod(fields[4]), rows[i].figures.median);
    EXPECT_EQ(fields[6], std::to_string(rows[i].evaluations));
    EXPECT_EQ(fields[8], rows[i].worker);
  }
}

TEST(HistoryCsv, HasItsHeaderWithoutRows) {
  EXPECT_EQ(history_csv({}), kHeader);
}

TEST(HistoryCsv, KeepsARowOnOneLineWhateverTheWorkerIsCalled) {
  std::vector<HistoryRow> rows = made_up_history(1, 1, 1);
  rows[0].worker = "cell 4, left \"arm\"\nsecond";
  rows[1].worker = "";
  std::istringstream text(history_csv(rows));
  const CsvTable table = read_csv(text, "history.csv");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0].fields.back(), "cell 4, left \"arm\" second");
  EXPECT_EQ(table.rows[1].fields.back(), "");
}

TEST(FitnessHistory, HoldsEveryRowAtItsIsland) {
  const std::vector<HistoryRow> rows = made_up_history(3, 2, 4);
  const FitnessHistory history = read_fitness(history_csv(rows));
  std::size_t at = 0;
  for (const auto& [joint, curves] : history.joints) {
    for (const auto& [island, points] : curves) {
      for (const FitnessPoint& point : points) {
        ASSERT_LT(at, rows.size());
        EXPECT_EQ(joint, rows[at].island.joint + 1);
        EXPECT_EQ(island, rows[at].island.deme + 1);
        EXPECT_EQ(point.generation, rows[at].generation);
        EXPECT_EQ(point.best, rows[at].figures.best);
        EXPECT_GE(point.best, history.lowest);
        EXPECT_LE(point.best, history.highest);
        ++at;
      }
    }
  }
  EXPECT_EQ(at, rows.size());
}

TEST(FitnessHistory, IsTheSameOfRowsAndOfTheirTable) {
  std::vector<HistoryRow> rows = made_up_history(3, 2, 4);
  rows[2].figures.best = std::numeric_limits<double>::infinity();
  const FitnessHistory direct = fitness_of(rows), read = read_fitness(history_csv(rows));
  EXPECT_EQ(direct.lowest, read.lowest);
  EXPECT_EQ(direct.highest, read.highest);
  ASSERT_EQ(direct.joints.size(), read.joints.size());
  for (const auto& [joint, curves] : direct.joints) {
    for (const auto& [island, points] : curves) {
      const std::vector<FitnessPoint>& others = read.joints.at(joint).at(island);
      ASSERT_EQ(points.size(), others.size());
      for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ(points[i].generation, others[i].generation);
        EXPECT_EQ(points[i].best, others[i].best);
      }
    }
  }
}

TEST(FitnessHistory, IsEmptyWithoutRows) {
  for (const std::string& csv : {std::string(), kHeader, "\n# nothing yet\n" + kHeader + "\n\n"}) {
    EXPECT_THAT(read_fitness(csv).joints, IsEmpty());
  }
}

TEST(FitnessHistory, LeavesOutFitnessThatIsNotFinite) {
  std::vector<HistoryRow> rows = made_up_history(1, 1, 2);
  rows[0].figures.best = std::numeric_limits<double>::infinity();
  rows[1].figures.best = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(read_fitness(history_csv(rows)).joints.at(1).at(1).size(), 1u);
}

TEST(FitnessHistory, NamesLineAndValueOfWhatItCannotRead) {
  EXPECT_EQ(complaint(kHeader + "1,1,0,3.5,4,5,6,7,w\n1,x,0,3,4,5,6,7,w\n"),
            "history.csv:3: 'x': must be a whole number from 1");
  EXPECT_THAT(complaint(kHeader + "0,1,0,3,4,5,6,7,w\n"), HasSubstr("history.csv:2: '0'"));
  EXPECT_THAT(complaint(kHeader + "1,1,0,low,4,5,6,7,w\n"), HasSubstr("'low': must be a number"));
  EXPECT_THAT(complaint(kHeader + "1,1,soon,2,4,5,6,7,w\n"), HasSubstr("'soon': must be a number"));
  EXPECT_THAT(complaint(kHeader + "1,1\n"), HasSubstr("history.csv:2"));
  EXPECT_THAT(complaint("joint,island,generation\n1,1,0\n"), HasSubstr("has no column best_fitness"));
}

}  // namespace
}  // namespace demecal
