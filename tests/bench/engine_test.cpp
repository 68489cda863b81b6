// The engine's benchmark: its workload is the one that it states, and its parts add up.
#include <gtest/gtest.h>

#include <cmath>
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
  const EngineFigures figures = measure_parts(parameters(), 20, 1, 1e9);
  EXPECT_GT(found_in_store(figures), 0.5);
  EXPECT_LT(found_in_store(figures), 1.0);
  EXPECT_LT(figures.functions_computed, figures.functions);
  EXPECT_LT(figures.functions, figures.nodes);
  EXPECT_GT(figures.seconds.total(), figures.seconds.variation);
}

TEST(EngineWorkload, FitsEveryNewIndividualWithTenSteps) {
  EXPECT_FALSE(find_fault(fitting_parameters()));
  EXPECT_EQ(fitting_parameters().constant_steps, 10);
  GpParameters few = fitting_parameters();
  few.population_size = 40;
  few.number_generations = 5;
  const EngineFigures figures = measure_parts(few, 30, 1, 1e9);
  EXPECT_GT(figures.fits, 0.6 * 240.0);
  EXPECT_LE(figures.fits, 240.0);
  EXPECT_GT(figures.seconds.fitting, 0.0);
}

TEST(EngineAccuracy, HasALessonOfTheStatedSizeAndNoise) {
  const AccuracyLesson lesson = accuracy_lesson(99);
  EXPECT_FALSE(find_fault(accuracy_parameters()));
  EXPECT_EQ(lesson.training.target.size(), 30u);
  EXPECT_EQ(lesson.validation.target.size(), 30u);
  double squares = 0.0;
  for (std::size_t i = 0; i < lesson.unseen.target.size(); ++i) {
    const double t = lesson.unseen.variables[0][i];
    squares += std::pow(lesson.unseen.target[i] - 3.0 * std::sin(t) - 1.2 * std::cos(2.0 * t) + 0.8 * t, 2);
  }
  EXPECT_NEAR(std::sqrt(squares / 1000.0), 0.1, 0.01);
  EXPECT_NE(lesson.training.target, lesson.validation.target);
}

TEST(EngineAccuracy, ChoosesAModelInTheTimeItIsGiven) {
  const AccuracyFigures figures = measure_accuracy(99, 0.005);
  EXPECT_LT(figures.validation_rmse, 2e-3);
  EXPECT_GT(figures.unseen_rmse, 0.9e-4);
  EXPECT_LT(figures.law_rmse, 2e-4);
  EXPECT_GT(figures.nodes, 0u);
}

TEST(EngineJson, SaysNullWhereTheTargetWasNotReached) {
  AccuracyFigures figures;
  figures.seed = 3;
  figures.ms_to_target = NAN;
  figures.validation_rmse = 1.2e-4;
  std::ostringstream out;
  write_json(out, {figures});
  const auto object = nlohmann::json::parse(out.str());
  EXPECT_EQ(object.at("workload"), "accuracy");
  EXPECT_EQ(object.at("seed"), 3);
  EXPECT_TRUE(object.at("ms_to_target").is_null());
  EXPECT_EQ(object.at("validation_rmse_after_10s"), 1.2e-4);
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
