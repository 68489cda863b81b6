// Constants that are rounded for people stay near what they were, and are numbers.
#include "expression/rounded_constant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "random/random_stream.hpp"

namespace demecal {
namespace {

TEST(RoundedConstant, IsNearestAmongThoseWithAsManyDigits) {
  RandomStream stream{61};
  for (int i = 0; i < 1000; ++i) {
    const double value = stream.real(-1.0, 1.0) * std::pow(10.0, stream.real(-12.0, 12.0));
    for (int digits = 1; digits <= 6; ++digits) {
      const double rounded = rounded_constant(value, digits);
      EXPECT_NEAR(rounded, value, std::abs(value) * 0.5001 * std::pow(10.0, 1 - digits));
      EXPECT_DOUBLE_EQ(rounded_constant(rounded, digits), rounded);
      EXPECT_EQ(rounded_constant(-value, digits), -rounded);
    }
  }
  EXPECT_EQ(rounded_constant(0.00031415, 3), 0.000314);
  EXPECT_EQ(rounded_constant(-271828.0, 2), -270000.0);
}

TEST(RoundedConstant, OfNothingOrNextToNothingIsWhatItWas) {
  const double least = std::numeric_limits<double>::denorm_min(), infinite = std::numeric_limits<double>::infinity();
  for (const double value : {0.0, least, -least, 1e-310, infinite, -infinite})
    EXPECT_EQ(rounded_constant(value, 3), value);
  EXPECT_TRUE(std::isnan(rounded_constant(std::nan(""), 3)));
}

}  // namespace
}  // namespace demecal
