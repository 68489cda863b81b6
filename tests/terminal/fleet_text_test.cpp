// What a terminal shows of a fleet: every number with its unit, and what spread and error mean.
#include "terminal/fleet_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(FleetTable, GivesEveryNumberItsUnit) {
  CalibratedModel model;
  model.fleet = FleetOrigin{};
  model.fleet->numbers = {{"joint 2 alpha_deg", -1.9953e-7, 0.002, 0.01},
                          {"joint 2 a_mm", 650.02, 0.03, 0.1},
                          {"backlash joint 2 width_rad", 0.0005, 1e-5, 4e-5},
                          {"compliance joint 3 k_rad_per_Nm", 2.5e-6, 1e-7, 2e-7}};
  const std::string table = fleet_table(model);
  EXPECT_THAT(table, Not(HasSubstr("-1.99")));
  EXPECT_THAT(table, ::testing::ContainsRegex("joint 2 alpha +0.00000 +0.01 +0.002  deg\n"));
  EXPECT_THAT(table, ::testing::ContainsRegex("joint 2 a +650.0200 +0.1 +0.03  mm\n"));
  EXPECT_THAT(table, ::testing::ContainsRegex("backlash joint 2 width +0.5000 +0.04 +0.01  mrad\n"));
  EXPECT_THAT(table, ::testing::ContainsRegex("k_rad_per_Nm +2.5e-06 .*  of the name, SI\n"));
  EXPECT_THAT(table, HasSubstr("spread: standard deviation of robots of the type about the mean"));
}

}  // namespace
}  // namespace demecal
