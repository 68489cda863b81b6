// What stands in the page as words and numbers.
#include "html/markup.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "page_reading.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

TEST(EscapedText, HoldsNoMarkupAndReadsBackTheSame) {
  RandomStream random{411};
  const std::string letters = "<>&\"' ab;#39ltq\n";
  for (int trial = 0; trial < 500; ++trial) {
    std::string text;
    for (std::size_t i = random.index(30); i > 0; --i) text += letters[random.index(letters.size())];
    const std::string markup = escaped(text);
    EXPECT_EQ(markup.find_first_of("<>\"'"), std::string::npos) << markup;
    EXPECT_EQ(unescaped(markup), text);
  }
}

TEST(EscapedText, ReplacesWhatHtmlForbidsAndKeepsUtf8) {
  EXPECT_EQ(escaped(std::string("a\0b\x1B", 4)),
            "a\xEF\xBF\xBD"
            "b\xEF\xBF\xBD");
  EXPECT_EQ(escaped("Müller – µm 😀"), "Müller – µm 😀");
  for (const char* const bytes : {"\xFC", "\xC3", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF5\x80\x80\x80"}) {
    const std::string text = escaped(std::string("a") + bytes + "b");
    EXPECT_TRUE(text.starts_with("a\xEF\xBF\xBD")) << text;
    EXPECT_TRUE(
        text.ends_with("\xEF\xBF\xBD"
                       "b"))
        << text;
  }
}

TEST(FixedNumber, HasItsDecimalsAndADashWhereThereIsNone) {
  EXPECT_EQ(fixed(0.7714, 3), "0.771");
  EXPECT_EQ(fixed(-1.25, 3), "-1.250");
  EXPECT_EQ(fixed(-0.0001, 3), "0.000");
  EXPECT_EQ(fixed(-0.0009, 3), "-0.001");
  EXPECT_EQ(fixed(2.5e9, 2), "2.50e+09");
  EXPECT_EQ(fixed(std::nullopt, 3), "–");
  EXPECT_EQ(fixed(std::nan(""), 3), "–");
}

TEST(GroupedNumber, ReadsBackWithoutItsSpaces) {
  RandomStream random{412};
  for (int trial = 0; trial < 200; ++trial) {
    const auto value = static_cast<std::uint64_t>(std::pow(10.0, random.real(0.0, 18.0)));
    EXPECT_EQ(with_all_replaced(grouped_digits(value), "\u202F", ""), std::to_string(value));
  }
  EXPECT_EQ(grouped_digits(1234567), "1\u202F234\u202F567");
  EXPECT_EQ(grouped_digits(999), "999");
  EXPECT_EQ(grouped_digits(1000), "1\u202F000");
}

TEST(Change, IsSignedAndRelativeToWhatWas) {
  EXPECT_EQ(change(2.0, 1.0), "-50\u00A0%");
  EXPECT_EQ(change(128.035, 0.519), "-99.6\u00A0%");
  EXPECT_EQ(change(1e9, 1.0), "-100.000\u00A0%");
  EXPECT_EQ(change(2.0, 0.0), "-100\u00A0%");
  EXPECT_EQ(change(1.0, 1.25), "+25\u00A0%");
  EXPECT_EQ(change(1.0, 1.0), "0\u00A0%");
  EXPECT_EQ(change(1.0, 0.9999), "0\u00A0%");
  EXPECT_EQ(change(0.0, 1.0), "–");
  EXPECT_EQ(change(std::nullopt, 1.0), "–");
}

TEST(Duration, ShowsItsTwoLeadingUnits) {
  EXPECT_EQ(duration(41.34), "41.3 s");
  EXPECT_EQ(duration(725.9), "12 min 05 s");
  EXPECT_EQ(duration(11231.0), "3 h 07 min");
}

TEST(Section, IsLeftOutWithoutABody) {
  EXPECT_EQ(section("a", "A", ""), "");
  EXPECT_EQ(unbalanced(section("a", "A", "<p>b</p>")), "");
}

}  // namespace
}  // namespace demecal
