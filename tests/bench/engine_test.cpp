// The engine's benchmark: its workload is the one that it states, and its parts add up.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/output.hpp"
#include "engine/workload.hpp"

namespace demecal::bench::engine {
namespace {

TEST(EngineWorkload, IsTheOneOfTheStatedFigures) {
  EXPECT_FALSE(find_fault(parameters()));
  EXPECT_EQ(evaluations(parameters()), 51'000u);
  EXPECT_EQ(smooth_table(30).target.size(), 30u);
}

TEST(EngineFigures, AreSharesOfWhatWasMeant) {
  const RunFigures figures = measure_parts(20, 1, 1e9);
  EXPECT_GT(found_in_store(figures), 0.5);
  EXPECT_LT(found_in_store(figures), 1.0);
  EXPECT_LT(figures.functions_computed, figures.functions);
  EXPECT_LT(figures.functions, figures.nodes);
  EXPECT_GT(figures.seconds.total(), figures.seconds.variation);
}

TEST(EngineJson, HasOneObjectALineWithTheAgreedKeys) {
  EngineRow row;
  row.rows = 30;
  row.threads = 2;
  row.speed = {4e5, 8e5};
  row.parts.seconds.evaluation = 2.0;
  row.parts.functions_computed = 100.0;
  row.parts.functions = 400.0;
  row.parts.functions_made = 100.0;
  std::ostringstream out;
  write_json(out, {row, row}, {1e10, 1e9, 1e8});
  std::istringstream lines(out.str());
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const auto object = nlohmann::json::parse(line);
    EXPECT_EQ(object.at("workload"), "run");
    EXPECT_EQ(object.at("rows"), 30);
    EXPECT_EQ(object.at("threads"), 2);
    EXPECT_EQ(object.at("evaluations_per_s"), 8e5);
    EXPECT_EQ(object.at("node_rows_per_s"), 1500.0);
    EXPECT_EQ(object.at("found_in_store"), 0.75);
    EXPECT_EQ(object.at("fma_per_s"), 1e10);
    EXPECT_EQ(object.at("sin_per_s"), 1e9);
  }
  EXPECT_EQ(count, 2);
}

}  // namespace
}  // namespace demecal::bench::engine
