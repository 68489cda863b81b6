// Frames of three points and best fits recover any rigid motion; mirrors and lines are told from them.
#include <gtest/gtest.h>

#include "preparation/taught_points.hpp"
#include "random_measurements.hpp"

namespace demecal {
namespace {

std::vector<Eigen::Vector3d> moved(const Eigen::Isometry3d& motion, std::vector<Eigen::Vector3d> points) {
  for (Eigen::Vector3d& point : points) point = motion * point;
  return points;
}

ThreePoints three_of(const std::vector<Eigen::Vector3d>& points) {
  return {points[0], points[1], points[2]};
}

/// Three points that make a frame.
std::vector<Eigen::Vector3d> framing_points(RandomStream& stream) {
  while (true) {
    std::vector<Eigen::Vector3d> points = random_points(stream, 3);
    if (relative_height(three_of(points)) > 0.1) return points;
  }
}

TEST(LocalFrame, HasItsOriginAndAxesThroughItsPoints) {
  RandomStream stream{62, 1};
  for (int i = 0; i < 200; ++i) {
    const ThreePoints points = three_of(framing_points(stream));
    const Eigen::Isometry3d from_frame = local_frame(points);
    const Eigen::Isometry3d to_frame = from_frame.inverse();
    EXPECT_LT((from_frame * to_frame * points[2] - points[2]).norm(), 1e-13);
    EXPECT_NEAR(from_frame.linear().determinant(), 1.0, 1e-13);
    EXPECT_LT((to_frame * points[0]).norm(), 1e-13);
    EXPECT_LT((to_frame * points[1] - Eigen::Vector3d((points[1] - points[0]).norm(), 0, 0)).norm(), 1e-13);
    EXPECT_GT((to_frame * points[2]).y(), 0.0);
    EXPECT_NEAR((to_frame * points[2]).z(), 0.0, 1e-13);
  }
}

TEST(ThreePointFrame, RecoversAnyRigidMotion) {
  RandomStream stream{62, 2};
  for (int i = 0; i < 200; ++i) {
    const Eigen::Isometry3d motion = random_motion(stream);
    const std::vector<Eigen::Vector3d> points = framing_points(stream);
    const Eigen::Isometry3d found = three_point_frame(three_of(moved(motion, points)), three_of(points));
    EXPECT_TRUE(found.isApprox(motion, 1e-12));
    EXPECT_TRUE(three_point_frame(three_of(points), three_of(moved(motion, points))).isApprox(motion.inverse(), 1e-12));
  }
}

TEST(BestFit, RecoversAnyRigidMotionFromThreePointsOrMore) {
  RandomStream stream{62, 3};
  for (int i = 0; i < 200; ++i) {
    const Eigen::Isometry3d motion = random_motion(stream);
    std::vector<Eigen::Vector3d> points = framing_points(stream);
    for (const Eigen::Vector3d& more : random_points(stream, stream.index(10))) points.push_back(more);
    const auto found = best_fit(points, moved(motion, points));
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->isApprox(motion, 1e-10));
    EXPECT_FALSE(points.size() > 3 && is_mirrored(points, moved(motion, points)));
  }
}

TEST(BestFit, FitsNoisyPointsNoWorseThanThreePointsDoAndNoNeighbouringMotionFitsBetter) {
  RandomStream stream{62, 4};
  for (int i = 0; i < 100; ++i) {
    const std::vector<Eigen::Vector3d> points = [&] {
      auto all = framing_points(stream);
      for (const Eigen::Vector3d& more : random_points(stream, 20)) all.push_back(more);
      return all;
    }();
    std::vector<Eigen::Vector3d> seen = moved(random_motion(stream), points);
    for (Eigen::Vector3d& point : seen) point += random_point(stream, 1e-3);
    const Eigen::Isometry3d fit = *best_fit(points, seen);
    const double least = misfit(fit, points, seen);
    EXPECT_LT(least, misfit(three_point_frame(three_of(seen), three_of(points)), points, seen));
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      for (const double step : {-1e-4, 1e-4}) {
        const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
        EXPECT_LT(least, misfit(Eigen::Translation3d(step * unit) * fit, points, seen));
        EXPECT_LT(least, misfit(Eigen::AngleAxisd(step, unit) * fit, points, seen));
      }
    }
  }
}

TEST(BestFit, RefusesLinesAndTooFewPoints) {
  const std::vector<Eigen::Vector3d> line{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {-1, -2, -3}};
  const std::vector<Eigen::Vector3d> spread{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_FALSE(best_fit(line, spread));
  EXPECT_FALSE(best_fit(spread, line));
  EXPECT_FALSE(best_fit({{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {1, 0, 0}}));
  EXPECT_LT(relative_height({line[0], line[1], line[2]}), kLeastRelativeHeight);
  EXPECT_EQ(relative_height({spread[0], spread[0], spread[1]}), 0.0);
  EXPECT_NEAR(relative_height({spread[0], spread[1], spread[2]}), std::sqrt(0.5), 1e-15);
}

TEST(BestFit, TellsAMirrorFromNoise) {
  RandomStream stream{62, 5};
  for (int i = 0; i < 100; ++i) {
    const std::vector<Eigen::Vector3d> points = random_points(stream, 12);
    std::vector<Eigen::Vector3d> seen = moved(random_motion(stream), points);
    for (Eigen::Vector3d& point : seen) point += random_point(stream, 1e-2);
    EXPECT_FALSE(is_mirrored(points, seen));
    for (Eigen::Vector3d& point : seen) point.y() = -point.y();
    EXPECT_TRUE(is_mirrored(points, seen));
  }
}

}  // namespace
}  // namespace demecal
