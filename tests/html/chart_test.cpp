// Where values stand in a chart, and which are written beside it.
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "expression/bound.hpp"
#include "expression/evaluate.hpp"
#include "expression/text.hpp"
#include "html/chart.hpp"
#include "made_up_report.hpp"
#include "page_reading.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

Axis random_axis(RandomStream& random, bool logarithmic) {
  const double size = std::pow(10.0, random.real(-6.0, 6.0));
  const double lower = logarithmic ? size : size * random.real(-3.0, 3.0);
  const double upper =
      logarithmic ? lower * std::pow(10.0, random.real(0.01, 12.0)) : lower + size * random.real(0.1, 2.0);
  return {lower, upper, 300.0, 20.0, logarithmic};
}

TEST(Axis, TakesItsEndsToTheEndsOfThePictureAndKeepsTheOrder) {
  RandomStream random{421};
  for (int trial = 0; trial < 200; ++trial) {
    const Axis axis = random_axis(random, trial % 2 == 0);
    EXPECT_NEAR(axis(axis.lower), axis.from_px, 1e-9);
    EXPECT_NEAR(axis(axis.upper), axis.to_px, 1e-9);
    const double a = random.real(axis.lower, axis.upper), b = random.real(axis.lower, axis.upper);
    EXPECT_EQ(axis(a) > axis(b), a < b);
  }
}

TEST(Axis, ShowsEqualRatiosAsEqualLengthsWhereLogarithmic) {
  const Axis axis{0.1, 1000.0, 0.0, 400.0, true};
  EXPECT_NEAR(axis(1.0), 100.0, 1e-9);
  EXPECT_NEAR(axis(10.0), 200.0, 1e-9);
  EXPECT_NEAR(axis(0.0), 0.0, 1e-9);
  EXPECT_NEAR(axis(-5.0), 0.0, 1e-9);
}

TEST(Ticks, AscendWithinTheAxisAndAreNeitherTooFewNorTooMany) {
  RandomStream random{422};
  for (int trial = 0; trial < 400; ++trial) {
    const Axis axis = random_axis(random, trial % 2 == 0);
    const std::vector<double> found = ticks(axis, 5);
    EXPECT_GE(found.size(), 2u) << axis.lower << " to " << axis.upper;
    EXPECT_LE(found.size(), 10u) << axis.lower << " to " << axis.upper;
    EXPECT_TRUE(std::ranges::is_sorted(found));
    const double slack = 1e-9 * (axis.upper - axis.lower);
    EXPECT_GE(found.front(), axis.lower - slack);
    EXPECT_LE(found.back(), axis.upper + slack);
  }
}

TEST(Ticks, AreRoundNumbers) {
  EXPECT_EQ(ticks({0.0, 3.5, 0.0, 1.0, false}, 6), (std::vector<double>{0.0, 1.0, 2.0, 3.0}));
  EXPECT_EQ(ticks({-0.7, 0.9, 0.0, 1.0, false}, 4), (std::vector<double>{-0.5, 0.0, 0.5}));
  EXPECT_EQ(ticks({1.8, 23.0, 0.0, 1.0, true}, 5), (std::vector<double>{2.0, 5.0, 10.0, 20.0}));
  EXPECT_EQ(tick_text(3 * 0.1), "0.3");
  EXPECT_EQ(tick_text(-0.0), "0");
}

constexpr Interval kRange{-1.0, 2.0};

std::string chart_of(const std::string& expression) {
  const Tree formula = parse(expression);
  return correction_chart(formula, kRange, discontinuities(formula, kRange, 1e-5), "a label");
}

double value_at_place(double place, const Points& known, const std::vector<double>& values) {
  const double slope = (values[1] - values[0]) / (known[1].second - known[0].second);
  return values[0] + slope * (place - known[0].second);
}

TEST(CorrectionChart, ShowsTheFormulasValuesToScale) {
  const std::string expression = "0.002 * SIN(theta * 3) + 0.001";
  const Tree formula = parse(expression);
  const std::vector<Points> lines = lines_of(chart_of(expression), "curve");
  ASSERT_EQ(lines.size(), 1u);
  const Points& points = lines[0];
  ASSERT_GT(points.size(), 100u);
  const auto theta_of = [&](std::size_t i) {
    return std::lerp(kRange.lower, kRange.upper,
                     (points[i].first - points.front().first) / (points.back().first - points.front().first));
  };
  const auto value_of = [&](std::size_t i) {
    const double theta_rad = theta_of(i);
    return evaluate(formula, {&theta_rad, 1});
  };
  const std::size_t other = points.size() / 2;
  const Points known{points[0], points[other]};
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(value_at_place(points[i].second, known, {value_of(0), value_of(other)}), value_of(i), 2e-6);
  }
}

TEST(CorrectionChart, BreaksTheCurveAtEveryJumpAndMarksIt) {
  const std::string chart = chart_of("0.001 * SIGN(theta) + 0.0005 * SIGN(theta - 1.2)");
  EXPECT_EQ(lines_of(chart, "curve").size(), 3u);
  EXPECT_EQ(all_between(chart, "class=\"jump\"", "</line>").size(), 2u);
  for (const Points& line : lines_of(chart, "curve")) {
    for (const auto& [x, y] : line) EXPECT_DOUBLE_EQ(y, line[0].second) << "the value is the same between two jumps";
  }
}

TEST(CorrectionChart, DrawsAZeroLineAndFiniteNumbersOnly) {
  for (const char* const expression : {"0.001", "theta - theta", "0.00001 % theta", "1000000000 * theta",
                                       "SQRTp(theta)", "-0.003", "1 % (theta - 0.3) % (theta - 0.3)"}) {
    const std::string chart = chart_of(expression);
    EXPECT_EQ(all_between(chart, "class=\"zero\"", "/>").size(), 1u) << expression;
    EXPECT_EQ(chart.find("nan"), std::string::npos) << expression;
    EXPECT_EQ(chart.find("inf"), std::string::npos) << expression;
    EXPECT_EQ(unbalanced(chart), "") << expression;
  }
}

TEST(CorrectionChart, LetsAPoleLeaveThePictureRatherThanFlattenTheRest) {
  const std::vector<Points> lines = lines_of(chart_of("0.001 * SIN(theta * 3) + 0.000000001 % (theta - 0.3)"), "curve");
  double lowest = 1e9, highest = -1e9;
  for (const Points& line : lines) {
    for (std::size_t i = 0; i + 5 < line.size(); i += 5) {
      lowest = std::min(lowest, line[i].second);
      highest = std::max(highest, line[i].second);
    }
  }
  EXPECT_GT(highest - lowest, 10.0) << "the sine's height, px";
}

TEST(FitnessChart, HasOneLinePerIslandWithOnePointPerRow) {
  const FitnessHistory history = fitness_of(made_up_history(2, 3, 7));
  const std::vector<Points> lines = lines_of(fitness_chart(history, 2), "island");
  ASSERT_EQ(lines.size(), 3u);
  for (const Points& line : lines) {
    EXPECT_EQ(line.size(), 8u);
    for (std::size_t i = 1; i < line.size(); ++i) {
      EXPECT_GT(line[i].first, line[i - 1].first) << "generations run to the right";
      EXPECT_GE(line[i].second, line[i - 1].second) << "better fitness stands lower";
    }
  }
  EXPECT_EQ(fitness_chart(history, 3), "");
  EXPECT_EQ(fitness_caption(history, 3), "");
}

TEST(FitnessChart, ShowsEqualGainsAsEqualHeights) {
  const FitnessHistory history = read_fitness(
      "joint,island,generation,best_fitness,median_fitness,best_length,evaluations,migrants_taken,worker\n"
      "1,1,0,8,9,1,1,0,w\n1,1,10,4,9,1,1,0,w\n1,1,20,2,9,1,1,0,w\n1,1,30,0,9,1,1,0,w\n");
  const Points line = lines_of(fitness_chart(history, 1), "island").at(0);
  EXPECT_NEAR(line[1].second - line[0].second, line[2].second - line[1].second, 0.02);
  EXPECT_GT(line[3].second, line[2].second) << "a perfect fitness stands at the foot of the chart";
  EXPECT_EQ(fitness_caption(history, 1), "best 0 in generation 30, island 1");
}

}  // namespace

}  // namespace demecal
