// Trilateration inverts distances on any triangle, and its derivative is that of its differences.
#include <gtest/gtest.h>

#include "preparation/readings.hpp"
#include "random_measurements.hpp"

namespace demecal {
namespace {

/// A point well off the triangle's plane, on the given side.
Eigen::Vector3d point_off_the_plane(RandomStream& stream, PlaneSide side) {
  Eigen::Vector3d point = random_point(stream, 2.0);
  point.z() = stream.real(0.2, 2.0) * (side == PlaneSide::above ? 1.0 : -1.0);
  return point;
}

TEST(Trilateration, InvertsDistancesOnBothSidesOfAnyTriangle) {
  RandomStream stream{61, 1};
  for (int i = 0; i < 500; ++i) {
    const auto corners = cord_corners(random_triangle(stream));
    ASSERT_TRUE(corners);
    const PlaneSide side = stream.chance(0.5) ? PlaneSide::above : PlaneSide::below;
    const Eigen::Vector3d point = point_off_the_plane(stream, side);
    const CordPoint found = trilaterate(*corners, cord_lengths(*corners, point), side);
    ASSERT_TRUE(found.meets());
    EXPECT_LT((found.point_m - point).norm(), 1e-11);
  }
}

TEST(Trilateration, PutsTheCornersAtTheirDistances) {
  RandomStream stream{61, 2};
  for (int i = 0; i < 200; ++i) {
    const CordTriangle triangle = random_triangle(stream);
    const CordCorners corners = *cord_corners(triangle);
    const Eigen::Vector3d from_c = cord_lengths(corners, {corners.c_x_m, corners.c_y_m, 0.0});
    EXPECT_NEAR(corners.b_x_m, triangle.ab_m, 1e-12);
    EXPECT_NEAR(from_c[0], triangle.ca_m, 1e-12);
    EXPECT_NEAR(from_c[1], triangle.bc_m, 1e-12);
  }
}

TEST(Trilateration, HasTheDerivativeOfItsDifferences) {
  RandomStream stream{61, 3};
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 200; ++i) {
    const CordCorners corners = *cord_corners(random_triangle(stream));
    const Eigen::Vector3d cords = cord_lengths(corners, point_off_the_plane(stream, PlaneSide::below));
    const CordPoint at = trilaterate(corners, cords, PlaneSide::below);
    for (Eigen::Index cord = 0; cord < 3; ++cord) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(cord);
      const Eigen::Vector3d difference = (trilaterate(corners, cords + step, PlaneSide::below).point_m -
                                          trilaterate(corners, cords - step, PlaneSide::below).point_m) /
                                         (2.0 * kStep);
      EXPECT_LT((at.derivative.col(cord) - difference).norm(), 1e-6 * at.derivative.norm());
    }
  }
}

TEST(Trilateration, StatesTheScatterThatNoisyCordsHave) {
  RandomStream stream{61, 4};
  const CordCorners corners = *cord_corners({1.2, 1.0, 0.9});
  const Eigen::Vector3d cords = cord_lengths(corners, {0.5, 0.4, 0.8});
  const CordPoint at = trilaterate(corners, cords, PlaneSide::above);
  constexpr double kCord_m = 1e-5;
  constexpr int kDraws = 20000;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Vector3d noise(stream.normal(), stream.normal(), stream.normal());
    const Eigen::Vector3d off = trilaterate(corners, cords + kCord_m * noise, PlaneSide::above).point_m - at.point_m;
    scatter += off * off.transpose() / kDraws;
  }
  const Eigen::Matrix3d stated = covariance_of(at, kCord_m);
  EXPECT_LT((scatter - stated).norm(), 0.05 * stated.norm());
}

TEST(Trilateration, SaysWhereCordsDoNotMeet) {
  const CordCorners corners = *cord_corners({1.0, 1.0, 1.0});
  EXPECT_FALSE(trilaterate(corners, {0.1, 0.1, 0.1}, PlaneSide::above).meets());
  EXPECT_LT(trilaterate(corners, {0.1, 0.1, 0.1}, PlaneSide::above).height_squared_m2, 0.0);
  EXPECT_FALSE(trilaterate(corners, {1.0, 5.0, 1.0}, PlaneSide::above).meets());
}

TEST(Trilateration, RefusesTrianglesThatAreNone) {
  EXPECT_FALSE(cord_corners({1.0, 3.0, 1.0}));
  EXPECT_FALSE(cord_corners({1.0, 2.0, 1.0}));
  EXPECT_FALSE(cord_corners({2.0, 1.0 + 1e-7, 1.0}));
  EXPECT_FALSE(cord_corners({0.0, 1.0, 1.0}));
  EXPECT_FALSE(cord_corners({-1.0, 1.0, 1.0}));
  EXPECT_TRUE(cord_corners({1.0, 1.99, 1.0}));
}

}  // namespace
}  // namespace demecal
