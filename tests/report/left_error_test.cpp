// What no cause explains is said where it is much, and where what is left is no noise.
#include "report/left_error.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "report/report.hpp"

namespace demecal {
namespace {

/// Noise of 0.08 mm an axis, and a model that errs by so much more.
Report report_of(double model_error_mm) {
  Report report;
  report.stopped = "no_structure";
  report.poses.calibration = 120;
  report.poses.validation = 40;
  report.noise.emplace();
  report.noise->independent_mm = 0.08;
  report.noise->estimated = true;
  report.prediction_interval.emplace();
  report.prediction_interval->noise_mm = 0.08;
  report.prediction_interval->model_error_mm = model_error_mm;
  report.front = {{0, 1.7, {}, false}, {2, std::sqrt(3.0) * std::hypot(0.08, model_error_mm), {}, true}};
  return report;
}

TEST(UnexplainedError, IsWhatIsLeftBeyondNoise) {
  const auto much = unexplained_error(report_of(0.15));
  ASSERT_TRUE(much);
  EXPECT_NEAR(*much->error_mm, std::sqrt(3.0) * 0.15, 1e-9);
  EXPECT_NEAR(*much->noise_mm, std::sqrt(3.0) * 0.08, 1e-9);
  EXPECT_NEAR(*much->left_mm, std::sqrt(3.0) * 0.17, 1e-9);
  EXPECT_EQ(unexplained_sentence(*much),
            "Not explained: 0.260 mm of the error: 0.294 mm are left on validation poses, of which noise makes 0.139 "
            "mm.");
  EXPECT_FALSE(unexplained_error(report_of(0.0)));
  EXPECT_FALSE(unexplained_error(report_of(0.07))) << "less than half of it";
}

TEST(UnexplainedError, IsNoneOfTheNumbersOwnUncertainty) {
  Report report = report_of(0.0);
  report.front.back().validation_rms_mm = 0.3;
  EXPECT_FALSE(unexplained_error(report));
}

TEST(UnexplainedError, GoesByRepeatsWhereThereAreAny) {
  Report report = report_of(0.15);
  EXPECT_NE(unexplained_error(report)->advice.find("joints that do not repeat"), std::string::npos);
  report.noise_floor_mm = 0.08;
  EXPECT_EQ(unexplained_error(report)->advice.find("joints that do not repeat"), std::string::npos);
  report.noise_floor_mm = 0.16;
  EXPECT_FALSE(unexplained_error(report)) << "it is how the arm repeats";
}

TEST(UnexplainedError, IsNotSaidWhereItIsNotKnown) {
  Report few = report_of(0.15);
  few.poses.validation = 9;
  EXPECT_FALSE(unexplained_error(few));
  Report unknown = report_of(0.15);
  unknown.noise->estimated = false;
  EXPECT_FALSE(unexplained_error(unknown));
  Report touched = report_of(0.15);
  touched.contacts.emplace_back();
  EXPECT_FALSE(unexplained_error(touched));
  Report drifting = report_of(0.15);
  drifting.noise->shared_in_order_mm = 0.14;
  EXPECT_FALSE(unexplained_error(drifting)) << "the order of measuring explains it";
}

TEST(UnexplainedError, SaysWhatWasNotSeen) {
  Report report = report_of(0.15);
  EXPECT_EQ(unexplained_error(report)->advice.find("not looked for"), std::string::npos);
  EXPECT_NE(unexplained_error(report)->advice.find("closed_loop.highest_ratio"), std::string::npos);
  report.considered = {"backlash"};
  report.untestable = {{"thermal_offset", "no temperature column"}};
  EXPECT_NE(unexplained_error(report)->advice.find("not looked for"), std::string::npos);
  EXPECT_NE(unexplained_error(report)->advice.find("what these data cannot show ("), std::string::npos);
}

}  // namespace
}  // namespace demecal
