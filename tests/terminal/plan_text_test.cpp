// A plan's summary fits one screen: the answer first, and the first of each list.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "planning/plan.hpp"
#include "screen_reading.hpp"
#include "terminal/report_text.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string numbered(const std::string& what, int number) {
  return what + " " + std::to_string(number) +
         " is a sentence that takes more than one line of a terminal, as such sentences usually do.";
}

TEST(PlanText, FitsOneScreenHoweverMuchThereIsToSay) {
  PlanRequest request;
  request.robot.chain.joints.resize(6);
  Plan plan;
  plan.counts = {30, 10, 10};
  plan.random_rms_m = 4e-5;
  const UnidentifiedDirection direction{
      0.0,
      false,
      {{{.kind = ParameterId::Kind::base_translation, .index = 2}, 0.7}, {{.kind = ParameterId::Kind::link}, 0.7}}};
  plan.unidentified.assign(12, direction);
  for (int joint = 0; joint < 6; ++joint)
    plan.detectable.push_back({{.kind = "joint_offset", .joint = joint, .values = {0.0}}, 0, 1e-4});
  plan.warnings = {numbered("Warning", 1), numbered("Warning", 2), numbered("Warning", 3)};
  for (int number = 1; number <= 7; ++number) plan.assumptions.push_back(numbered("Assumption", number));
  const std::string text = to_terminal(plan, request);
  EXPECT_LE(screen_lines(text).size(), 25U) << text;
  EXPECT_THAT(text, HasSubstr("not identifiable: 10 more in plan.html"));
  EXPECT_THAT(text, HasSubstr("would be found nine times in ten: 3 more in plan.html"));
  EXPECT_THAT(text, HasSubstr("- 6 more in plan.html"));
  for (const char* warning : {"Warning 1", "Warning 2", "Warning 3"}) EXPECT_THAT(text, HasSubstr(warning));
  EXPECT_LT(text.find("would be found"), text.find("Warning 1")) << "the answer first";
  plan.has_too_few_poses = true;
  const std::string too_few = to_terminal(plan, request);
  EXPECT_LT(too_few.find("Warning 1"), too_few.find("predicted error")) << "what may make the answer wrong before it";
  EXPECT_LT(too_few.find("would be found"), too_few.find("Warning 2"));
  plan.assumptions.resize(1);
  EXPECT_THAT(to_terminal(plan, request), Not(HasSubstr("- 6 more")));
}

}  // namespace
}  // namespace demecal
