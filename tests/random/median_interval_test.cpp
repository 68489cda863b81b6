// The interval of a median: its probability counted over all ways in which values may fall, and tried on samples.
#include "random/distributions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "random/random_stream.hpp"

namespace demecal {
namespace {

/// 0, 1, ..., count - 1.
std::vector<double> numbered(std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(static_cast<double>(i));
  return values;
}

/// Over all equally likely ways of `count` values to lie below or above the median: the share in which it lies between
/// the value number `rank` and the one as far from the end.
double counted_share(std::size_t count, std::size_t rank) {
  std::size_t held = 0;
  for (std::uint32_t below = 0; below < (1U << count); ++below) {
    const auto number = static_cast<std::size_t>(std::popcount(below));
    if (number > rank && number < count - rank) ++held;
  }
  return static_cast<double>(held) / static_cast<double>(1U << count);
}

TEST(MedianInterval, IsTheInnermostOfItsConfidence) {
  for (std::size_t count = 6; count <= 16; ++count) {
    const MedianInterval interval = median_interval(numbered(count));
    const auto rank = static_cast<std::size_t>(interval.lower);
    EXPECT_EQ(interval.upper, static_cast<double>(count - 1 - rank)) << count;
    ASSERT_TRUE(interval.confidence.has_value()) << count;
    EXPECT_NEAR(*interval.confidence, counted_share(count, rank), 1e-12) << count;
    EXPECT_GE(*interval.confidence, 0.95) << count;
    EXPECT_LT(counted_share(count, rank + 1), 0.95) << count;
  }
}

TEST(MedianInterval, IsTheRangeWhereThereAreTooFewValues) {
  EXPECT_EQ(least_for_interval(), 6U);
  for (std::size_t count = 1; count < 6; ++count) {
    const MedianInterval interval = median_interval(numbered(count));
    EXPECT_FALSE(interval.confidence.has_value()) << count;
    EXPECT_EQ(interval.lower, 0.0);
    EXPECT_EQ(interval.upper, static_cast<double>(count - 1));
  }
}

TEST(MedianInterval, LiesAboutTheMedianInWhateverOrderValuesCome) {
  RandomStream random({41});
  for (std::size_t count = 1; count < 80; ++count) {
    std::vector<double> values = numbered(count);
    for (std::size_t i = count; i > 1; --i) std::swap(values[i - 1], values[random.index(i)]);
    const MedianInterval interval = median_interval(values);
    EXPECT_EQ(interval.median, 0.5 * static_cast<double>(count - 1)) << count;
    EXPECT_LE(interval.lower, interval.median) << count;
    EXPECT_GE(interval.upper, interval.median) << count;
  }
}

// Of a skew distribution: the cube of a uniform number.
TEST(MedianInterval, HoldsTheMedianAsOftenAsItSays) {
  constexpr int kSamples = 5000;
  for (const std::size_t count : {6U, 9U, 25U}) {
    RandomStream random({42, count});
    int held = 0;
    double confidence = 0.0;
    for (int sample = 0; sample < kSamples; ++sample) {
      std::vector<double> values;
      for (std::size_t i = 0; i < count; ++i) {
        const double uniform = random.real();
        values.push_back(uniform * uniform * uniform);
      }
      const MedianInterval interval = median_interval(values);
      confidence = *interval.confidence;
      held += interval.lower <= 0.125 && 0.125 <= interval.upper ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(held) / kSamples, confidence, 0.015) << count;
  }
}

TEST(MedianInterval, KnowsThousandsOfValues) {
  const MedianInterval interval = median_interval(numbered(10001));
  ASSERT_TRUE(interval.confidence.has_value());
  EXPECT_NEAR(*interval.confidence, 0.95, 0.003);
  EXPECT_NEAR(interval.upper - interval.lower, 2 * 1.96 * 50.0, 4.0);  // the binomial is all but normal
}

}  // namespace
}  // namespace demecal
