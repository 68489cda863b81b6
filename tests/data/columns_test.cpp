// Units from the names of columns.
#include "data/columns.hpp"

#include <gtest/gtest.h>

#include "small_arm.hpp"

namespace demecal {
namespace {

TEST(ColumnUnit, StandsAtTheEndOfTheNameInAnyCase) {
  EXPECT_EQ(unit_of(column("q1_deg"), Quantity::angle, {}).name, "deg");
  EXPECT_EQ(unit_of(column("Q1_RAD"), Quantity::angle, {}).name, "rad");
  EXPECT_DOUBLE_EQ(unit_of(column("x_mm"), Quantity::length, {}).to_inside(1500.0), 1.5);
  EXPECT_DOUBLE_EQ(unit_of(column("x_m"), Quantity::length, {}).to_inside(1.5), 1.5);
}

TEST(ColumnUnit, IsAssumedOnlyWhereTheNameHasNone) {
  const AssumedUnits assumed{find_unit("rad"), find_unit("m")};
  EXPECT_EQ(unit_of(column("q1"), Quantity::angle, assumed).name, "rad");
  EXPECT_EQ(unit_of(column("q1_deg"), Quantity::angle, assumed).name, "deg");
  EXPECT_EQ(unit_of(column("x"), Quantity::length, assumed).name, "m");
}

TEST(ColumnUnit, NeedsNoNameWhereThereIsOnlyOne) {
  EXPECT_EQ(unit_of(column("order"), Quantity::time, {}).name, "s");
  EXPECT_EQ(unit_of(column("load"), Quantity::mass, {}).name, "kg");
  EXPECT_EQ(unit_of(column("T"), Quantity::temperature, {}).name, "celsius");
}

TEST(ColumnUnit, OfTemperaturesAndMassesMayBeThoseOfOtherPrograms) {
  for (const char* name : {"Temp_F", "temperature_degF", "arm_fahrenheit"})
    EXPECT_NEAR(unit_of(column(name), Quantity::temperature, {}).to_inside(68.0), 20.0, 1e-12) << name;
  for (const char* name : {"T_K", "arm_kelvin"})
    EXPECT_NEAR(unit_of(column(name), Quantity::temperature, {}).to_inside(293.15), 20.0, 1e-12) << name;
  for (const char* name : {"T_C", "arm_degC", "arm_celsius"})
    EXPECT_EQ(unit_of(column(name), Quantity::temperature, {}).to_inside(20.0), 20.0) << name;
  EXPECT_DOUBLE_EQ(unit_of(column("payload_g"), Quantity::mass, {}).to_inside(2500.0), 2.5);
  const AssumedUnits assumed{find_unit("deg"), find_unit("mm")};
  EXPECT_EQ(unit_of(column("x_c"), Quantity::length, assumed).name, "mm") << "a name, not a unit";
}

TEST(ColumnUnit, RefusesTheWrongUnitAndNone) {
  const auto refusal = [](const char* name, Quantity quantity) {
    return complaint([&] { unit_of(column(name), quantity, {}); });
  };
  EXPECT_EQ(
      refusal("q1", Quantity::angle),
      "set.yaml:5: 'q1': carries no unit: it is expected to hold an angle and end in _deg or _rad, or `units:` must "
      "give the unit");
  EXPECT_EQ(refusal("q1_mm", Quantity::angle),
            "set.yaml:5: 'q1_mm': ends in a unit of a length; it is expected to hold an angle and end in _deg or _rad");
  EXPECT_EQ(
      refusal("payload_lb", Quantity::mass),
      "set.yaml:5: 'payload_lb': ends in a unit that is not supported; it is expected to hold a mass and end in _kg");
}

}  // namespace
}  // namespace demecal
