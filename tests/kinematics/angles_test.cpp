// Angles moved onto one branch: by whole turns only, and never leaving the data on both sides of a jump.
#include "kinematics/angles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "kinematics/units.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTurn = 2 * kPi;

double turns_between(double a, double b) {
  return (a - b) / kTurn;
}

double span_of(const std::vector<double>& angles) {
  const auto [least, greatest] = std::minmax_element(angles.begin(), angles.end());
  return *greatest - *least;
}

std::vector<double> mapped(const AngleBranch& branch, std::vector<double> angles) {
  for (double& angle : angles) angle = branch(angle);
  return angles;
}

/// The shortest arc that holds all angles, tried from every one of them.
double shortest_arc(const std::vector<double>& angles) {
  double shortest = kTurn;
  for (const double start : angles) {
    double longest = 0.0;
    for (const double angle : angles) {
      const double ahead = angle - start - kTurn * std::floor((angle - start) / kTurn);
      longest = std::max(longest, ahead);
    }
    shortest = std::min(shortest, longest);
  }
  return shortest;
}

/// `count` angles in [-pi, pi], as a controller reports quadrants, from an arc of random place and width.
std::vector<double> quadrant_angles(RandomStream& stream, std::size_t count, double widest) {
  const double centre = stream.real(-kPi, kPi), half = stream.real(0.0, widest / 2);
  std::vector<double> angles(count);
  for (double& angle : angles) angle = std::remainder(centre + stream.real(-half, half), kTurn);
  return angles;
}

TEST(WrapNear, MovesByWholeTurnsToWithinHalfATurn) {
  RandomStream stream{301};
  for (int trial = 0; trial < 1000; ++trial) {
    const double angle = stream.real(-40, 40), centre = stream.real(-20, 20);
    const double moved = wrap_near(angle, centre);
    EXPECT_LE(std::abs(moved - centre), kPi + 1e-12);
    EXPECT_NEAR(turns_between(moved, angle), std::round(turns_between(moved, angle)), 1e-12);
  }
}

TEST(WrapNear, LeavesAnglesNearTheCentreToTheBit) {
  RandomStream stream{302};
  for (int trial = 0; trial < 1000; ++trial) {
    const double centre = stream.real(-20, 20), angle = centre + stream.real(-3.1, 3.1);
    EXPECT_EQ(wrap_near(angle, centre), angle);
  }
}

TEST(ChooseBranch, GathersQuadrantDataOnTheirShortestArc) {
  RandomStream stream{303};
  int wrapped = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const auto angles = quadrant_angles(stream, 1 + stream.index(30), kTurn);
    const AngleBranch branch = choose_branch(angles);
    const auto after = mapped(branch, angles);
    EXPECT_LE(span_of(after), span_of(angles) + 1e-12);
    EXPECT_NEAR(span_of(after), shortest_arc(angles), 1e-9);
    for (std::size_t i = 0; i < angles.size(); ++i) {
      EXPECT_NEAR(turns_between(after[i], angles[i]), std::round(turns_between(after[i], angles[i])), 1e-12);
    }
    wrapped += branch.wraps ? 1 : 0;
  }
  EXPECT_GT(wrapped, 100);
  EXPECT_LT(wrapped, 900);
}

TEST(ChooseBranch, KeepsAnArcAcrossHalfATurnTogether) {
  const std::vector<double> angles{radians(170), radians(-175), radians(179), radians(-160)};
  const AngleBranch branch = choose_branch(angles);
  ASSERT_TRUE(branch.wraps);
  EXPECT_NEAR(span_of(mapped(branch, angles)), radians(30), 1e-12);
  // A command from between the data lands between them.
  EXPECT_NEAR(branch(radians(-180)) - branch(radians(179)), radians(1), 1e-12);
}

TEST(ChooseBranch, LeavesDataOfControllersThatCountTurnsUnchanged) {
  RandomStream stream{304};
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> angles{stream.chance(0.5) ? stream.real(3.2, 6.0) : stream.real(-6.0, -3.2)};
    for (std::size_t i = stream.index(20); i > 0; --i) angles.push_back(stream.real(-6.0, 6.0));
    EXPECT_FALSE(choose_branch(angles).wraps);
    EXPECT_EQ(mapped(choose_branch(angles), angles), angles);
  }
}

TEST(ChooseBranch, TakesAnglesRoundedJustBeyondHalfATurnAsQuadrants) {
  const std::vector<double> angles{kPi + 1e-8, -kPi + 0.1, kPi - 0.1, -kPi - 1e-8};
  EXPECT_NEAR(span_of(mapped(choose_branch(angles), angles)), 0.2, 1e-6);
}

TEST(ChooseBranch, OfNoneOrOneAngleChangesNothing) {
  EXPECT_FALSE(choose_branch({}).wraps);
  const std::vector<double> one{1.0};
  EXPECT_FALSE(choose_branch(one).wraps);
}

TEST(ChooseBranch, LeavesJointsThatCannotReachHalfATurnUnchanged) {
  RandomStream stream{305};
  int would_wrap = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> angles(10);
    for (double& angle : angles) angle = stream.real(radians(-160), radians(160));
    would_wrap += choose_branch(angles).wraps ? 1 : 0;
    EXPECT_FALSE(choose_branch(angles, radians(-160), radians(160)).wraps);
  }
  EXPECT_GT(would_wrap, 20);  // the data alone would have misled
}

TEST(ChooseBranch, BringsQuadrantDataBackBetweenLimitsBeyondHalfATurn) {
  RandomStream stream{306};
  for (int trial = 0; trial < 200; ++trial) {
    const double lower = stream.real(-4.0, -0.5), upper = stream.real(3.2, lower + kTurn);
    const double truth = stream.real(lower, upper);
    const std::vector<double> reported{std::remainder(truth, kTurn)};
    EXPECT_NEAR(choose_branch(reported, lower, upper)(reported[0]), truth, 1e-12);
  }
}

TEST(ChooseBranch, LetsTheDataDecideWhereLimitsSayNothing) {
  RandomStream stream{307};
  for (int trial = 0; trial < 200; ++trial) {
    const auto angles = quadrant_angles(stream, 10, kPi);
    const AngleBranch by_data = choose_branch(angles);
    for (const double reach : {0.0, radians(266)}) {
      const AngleBranch branch = choose_branch(angles, -reach, reach);
      EXPECT_EQ(branch.wraps, by_data.wraps);
      EXPECT_EQ(branch.centre_rad, by_data.centre_rad);
    }
  }
}

}  // namespace
}  // namespace demecal
