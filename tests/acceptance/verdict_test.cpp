// What is proved of a tolerance is true at least as often as is said, whatever the distribution of errors.
#include "acceptance/verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <vector>

#include "random/random_stream.hpp"

namespace demecal {
namespace {

using Draw = std::function<double(RandomStream&)>;

double half_normal(RandomStream& random) {
  return std::abs(random.normal());
}
constexpr double kHalfNormal95 = 1.959964;

/// The length of a vector of three normal numbers.
double maxwell(RandomStream& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return std::sqrt(x * x + y * y + z * z);
}
constexpr double kMaxwell95 = 2.795483;

/// Heavy tails: P(error > x) = (1 + x)^-3.
double pareto(RandomStream& random) {
  return std::pow(random.real(1e-12, 1.0), -1.0 / 3.0) - 1.0;
}
const double kPareto95 = std::pow(0.05, -1.0 / 3.0) - 1.0;

struct Shares {
  double conforming = 0.0, not_conforming = 0.0;
};

/// How often what is proved at a tolerance equal to the true value of the 95 % share.
Shares proved(const Draw& draw, double tolerance, std::size_t poses, std::uint64_t seed) {
  constexpr int kTrials = 4000;
  RandomStream random{seed};
  Shares shares;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> errors(poses);
    for (double& error : errors) error = draw(random);
    const Conformity verdict = judge(errors, tolerance, 0.0, 0.0).verdict;
    shares.conforming += verdict == Conformity::conformity ? 1.0 / kTrials : 0.0;
    shares.not_conforming += verdict == Conformity::non_conformity ? 1.0 / kTrials : 0.0;
  }
  return shares;
}

/// What EVALUATION.md quotes.
void print(const char* distribution, std::size_t poses, const Shares& shares) {
  std::printf("%-12s %4zu poses: conformity %.4f, non-conformity %.4f\n", distribution, poses, shares.conforming,
              shares.not_conforming);
}

/// 2.5 % and three standard errors of a share of 4000.
constexpr double kMost = 0.025 + 3.0 * 0.00247;

TEST(Verdict, ProvesWhatIsNotTrueAtMostAsOftenAsIsSaid) {
  for (const std::size_t poses : {10U, 20U, 40U, 72U, 150U, 600U}) {
    for (const auto& [draw, tolerance] :
         std::vector<std::pair<Draw, double>>{{half_normal, kHalfNormal95}, {maxwell, kMaxwell95}}) {
      const Shares shares = proved(draw, tolerance, poses, 100 + poses);
      print(tolerance == kMaxwell95 ? "three axes" : "one axis", poses, shares);
      EXPECT_LE(shares.conforming, kMost) << poses;
      EXPECT_LE(shares.not_conforming, kMost) << poses;
    }
  }
}

TEST(Verdict, NeedsNoDistributionWithManyPoses) {
  for (const std::size_t poses : {72U, 150U, 600U}) {
    const Shares shares = proved(pareto, kPareto95, poses, 7 + poses);
    print("heavy tails", poses, shares);
    EXPECT_LE(shares.conforming, kMost) << poses;
    EXPECT_LE(shares.not_conforming, kMost) << poses;
  }
}

/// What is 8 % of the time far beyond any tolerance, and small otherwise.
double far_off(RandomStream& random) {
  return random.chance(0.08) ? 100.0 : 0.01 * half_normal(random);
}

/// Why fewer than 72 poses prove nothing without saying of which errors, and fewer than 20 nothing at all.
TEST(Verdict, RestsOnNormalErrorsWithFewPoses) {
  for (const std::size_t poses : {20U, 40U, 60U}) {
    const Shares heavy = proved(pareto, kPareto95, poses, 17 + poses), far = proved(far_off, 10.0, poses, 27 + poses);
    print("heavy tails", poses, heavy);
    print("8 % far off", poses, far);
    EXPECT_NEAR(far.conforming, std::pow(0.92, static_cast<double>(poses)), 0.02) << poses;
  }
  for (const std::size_t poses : {72U, 150U}) {
    const Shares far = proved(far_off, 10.0, poses, 27 + poses);
    print("8 % far off", poses, far);
    EXPECT_LE(far.conforming, kMost) << poses;
  }
  const std::vector<double> small(kFewestJudged, 1e-4);
  EXPECT_EQ(judge(small, 1e-3, 0.0, 0.0).verdict, Conformity::conformity);
  const std::vector<double> fewer(kFewestJudged - 1, 1e-4);
  const Judgement judged = judge(fewer, 1e-3, 0.0, 0.0);
  EXPECT_EQ(judged.verdict, Conformity::undecided);
  EXPECT_NE(judged.withheld, "");
  EXPECT_EQ(judge(std::vector<double>(12, 1e-2), 1e-3, 0.0, 0.0).withheld, "") << "nothing was withheld";
}

TEST(Verdict, IsProvedBySingleMeasurementsAndDisprovedByTheirMeans) {
  const std::vector<double> singles(200, 6e-4), means(200, 1e-4);
  EXPECT_EQ(judge(singles, means, 5e-4, 0.0, 0.0).verdict, Conformity::undecided);
  EXPECT_EQ(judge(singles, means, 7e-4, 0.0, 0.0).verdict, Conformity::conformity);
  EXPECT_EQ(judge(singles, means, 0.9e-4, 0.0, 0.0).verdict, Conformity::non_conformity);
}

TEST(Verdict, ProvesEitherWhereTheToleranceIsFarFromTheError) {
  RandomStream random{31};
  std::vector<double> errors(60);
  for (double& error : errors) error = 1e-4 * maxwell(random);
  EXPECT_EQ(judge(errors, 1e-3, 0.0, 0.0).verdict, Conformity::conformity);
  EXPECT_EQ(judge(errors, 1e-4, 0.0, 0.0).verdict, Conformity::non_conformity);
  const Judgement close = judge(errors, 2.8e-4, 0.0, 0.0);
  EXPECT_EQ(close.verdict, Conformity::undecided);
  EXPECT_LE(*close.lower_m, close.error_m);
  EXPECT_GE(*close.upper_m, close.error_m);
}

TEST(Verdict, CountsTheInstrumentsUncertaintyAgainstEitherProof) {
  const std::vector<double> errors(200, 1e-4);
  EXPECT_EQ(judge(errors, 1.5e-4, 0.0, 0.0).verdict, Conformity::conformity);
  EXPECT_EQ(judge(errors, 1.5e-4, 2.4e-5, 0.0).verdict, Conformity::conformity);
  EXPECT_EQ(judge(errors, 1.5e-4, 2.6e-5, 0.0).verdict, Conformity::undecided);
  EXPECT_EQ(judge(errors, 0.5e-4, 2.4e-5, 0.0).verdict, Conformity::non_conformity);
  EXPECT_EQ(judge(errors, 0.5e-4, 2.6e-5, 0.0).verdict, Conformity::undecided);
  EXPECT_EQ(judge(errors, 0.5e-4, 0.0, 2.6e-5).verdict, Conformity::undecided) << "noise makes errors look larger";
  EXPECT_EQ(judge(errors, 1.5e-4, 0.0, 2.6e-5).verdict, Conformity::conformity) << "and never smaller";
}

TEST(Verdict, SaysHowManyPosesWouldDecide) {
  const std::vector<double> errors(20, 1e-4);
  const Judgement judged = judge(errors, 1.01e-4, 0.0, 0.0);
  EXPECT_EQ(judged.verdict, Conformity::undecided);
  EXPECT_TRUE(judged.assumes_normal);
  const auto needed = poses_to_decide(errors, errors, judged);
  ASSERT_TRUE(needed);
  EXPECT_EQ(*needed, fewest_without_assumption());
  EXPECT_EQ(fewest_without_assumption(), 72U);
  const std::vector<double> enough(*needed, 1e-4);
  EXPECT_EQ(judge(enough, 1.01e-4, 0.0, 0.0).verdict, Conformity::conformity);
  const std::vector<double> fewer(*needed - 1, 1e-4);
  EXPECT_EQ(judge(fewer, 1.01e-4, 0.0, 0.0).verdict, Conformity::undecided);
}

TEST(Verdict, OfNoPosesIsUndecided) {
  EXPECT_EQ(judge({}, 1.0, 0.0, 0.0).verdict, Conformity::undecided);
}

}  // namespace
}  // namespace demecal
