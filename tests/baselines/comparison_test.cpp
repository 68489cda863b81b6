// The table of a comparison holds every method, and its JSON every figure.
#include "baselines/comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace demecal {
namespace {

using ::testing::HasSubstr;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Comparison two_methods() {
  const ErrorFigures none{kNone, kNone, kNone, kNone};
  return {"job",
          "arm",
          "poses",
          "ab12",
          {30, 20, 0},
          {{"fourier_1",
            "Fourier series, order 1 (Everett, Vincze)",
            {{{1, 2, 3, 4}, {5.25, 6, 7, 8}, none}},
            81,
            0.5,
            "ridge 1e-05"},
           {"radial_basis", "radial-basis network on the position", {none, none, none}, 0, 0, "no positions"}}};
}

TEST(Comparison, HasALineForEveryMethodThatFitsATerminal) {
  const std::string text = comparison_table(two_methods());
  EXPECT_THAT(text, HasSubstr("30 poses fitted, 20 of validation, 0 of acceptance"));
  EXPECT_THAT(text, HasSubstr("5.2500"));
  EXPECT_THAT(text, HasSubstr("no positions"));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
}

TEST(Comparison, HoldsItsFiguresInJsonAndNullWhereThereAreNone) {
  const auto json = nlohmann::json::parse(comparison_json(two_methods()));
  EXPECT_EQ(json["demecal_comparison"], 1);
  EXPECT_EQ(json["poses"]["validation"], 20);
  EXPECT_EQ(json["methods"][0]["error_mm"]["validation"]["mean"], 5.25);
  EXPECT_EQ(json["methods"][0]["parameters"], 81);
  EXPECT_TRUE(json["methods"][0]["error_mm"]["accept"]["rms"].is_null());
  EXPECT_TRUE(json["methods"][1]["error_mm"]["calibration"]["max"].is_null());
}

}  // namespace
}  // namespace demecal
