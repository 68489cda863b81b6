// Numbers as text, read strictly and written as short as they can be, and the names that users may have meant.
#include <gtest/gtest.h>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "data/text.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

TEST(Number, AcceptsDecimalNotation) {
  EXPECT_EQ(parse_number("12"), 12.0);
  EXPECT_EQ(parse_number("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(parse_number("+7"), 7.0);
  EXPECT_EQ(parse_number(".5"), 0.5);
}

TEST(Number, RejectsEverythingElse) {
  for (const char* text :
       {"", " 1", "1 ", "1,5", "abc", "1e", "0x10", "nan", "inf", "-inf", "1e999", "+-1", "+", "--1"}) {
    EXPECT_FALSE(parse_number(text)) << text;
  }
}

TEST(Number, RoundTripsThroughTextToTheBit) {
  std::mt19937_64 bits(761);
  int tried = 0;
  while (tried < 2000) {
    const double value = std::bit_cast<double>(std::uint64_t{bits()});
    if (!std::isfinite(value)) continue;
    ++tried;
    EXPECT_EQ(parse_number(number_text(value)), value);
  }
}

TEST(Number, WritesRoundDegreesOfRadians) {
  EXPECT_EQ(number_text(radians(-90.0), degrees, radians), "-90");
  EXPECT_EQ(number_text(radians(123.45), degrees, radians), "123.45");
  EXPECT_EQ(number_text(metres(150.25), millimetres, metres), "150.25");
  EXPECT_EQ(number_text(0.0, degrees, radians), "0");
}

TEST(Number, ComesBackFromAnotherUnitWithinTheLastBit) {
  std::mt19937_64 bits(560);
  for (int i = 0; i < 2000; ++i) {
    const double value = -3.0 + 6.0 * static_cast<double>(bits() >> 11) * 0x1.0p-53;
    const double back = radians(*parse_number(number_text(value, degrees, radians)));
    EXPECT_LE(std::abs(back - value), 2.0 * std::abs(value) * std::numeric_limits<double>::epsilon());
  }
}

TEST(NearestName, CountsTheFewestEdits) {
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("abdc", "abcd"), 1u);
}

TEST(NearestName, MeasuresLikeADistance) {
  std::mt19937_64 bits(3);
  const auto word = [&] {
    std::string letters;
    for (std::uint64_t i = bits() % 6; i > 0; --i) letters += static_cast<char>('a' + bits() % 3);
    return letters;
  };
  for (int i = 0; i < 500; ++i) {
    const std::string a = word(), b = word();
    EXPECT_EQ(edit_distance(a, b), edit_distance(b, a));
    EXPECT_EQ(edit_distance(a, b) == 0, a == b);
    EXPECT_LE(edit_distance(a, b), std::max(a.size(), b.size()));
  }
}

TEST(NearestName, IgnoresCaseAndTakesTheFirstOfEquals) {
  const std::vector<std::string> names{"q1_deg", "q2_deg", "x_mm"};
  EXPECT_EQ(nearest_name("X_MM", names), "x_mm");
  EXPECT_EQ(nearest_name("q7_deg", names), "q1_deg");
  EXPECT_EQ(nearest_name("q7_deg", {}), "");
}

TEST(NearestName, IsOneThatOnlyHasMoreWords) {
  const std::vector<std::string> keys{"type", "theta_offset_deg", "alpha_rad", "d_mm", "a_mm"};
  EXPECT_EQ(nearest_name("alpha", keys), "alpha_rad");
  EXPECT_EQ(nearest_name("d", keys), "d_mm");
  EXPECT_EQ(nearest_name("theta_offset", keys), "theta_offset_deg");
  EXPECT_EQ(nearest_name("tipe", keys), "type");
  EXPECT_EQ(nearest_name("dh", std::vector<std::string>{"urdf", "standard_dh", "modified_dh"}), "standard_dh");
  EXPECT_EQ(nearest_name("population", std::vector<std::string>{"population_size", "populations"}), "populations");
}

TEST(Words, AreJoinedAndCountedAsPeopleWriteThem) {
  EXPECT_EQ(joined_words(std::vector<std::string>{"a", "", "b c"}, ", "), "a, , b c");
  EXPECT_EQ(joined_words(std::vector<std::string>{"a"}, ", "), "a");
  EXPECT_EQ(joined_words({}, ", "), "");
  EXPECT_EQ(counted(0, "pose"), "0 poses");
  EXPECT_EQ(counted(1, "pose"), "1 pose");
  EXPECT_EQ(counted(12, "accept pose"), "12 accept poses");
}

}  // namespace

}  // namespace demecal
