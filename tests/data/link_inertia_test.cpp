// Inertias of links: those of clouds of mass points are taken, those that no cloud has are not, and bodies add up.
#include "data/link_inertia.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "random/random_stream.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

/// Mass points.
struct MassCloud {
  std::vector<double> masses_kg;
  std::vector<Eigen::Vector3d> points_m;

  LinkMass mass() const {
    LinkMass sum;
    for (const double one : masses_kg) sum.mass_kg += one;
    for (std::size_t i = 0; i < points_m.size(); ++i) sum.centre_m += masses_kg[i] / sum.mass_kg * points_m[i];
    return sum;
  }
  /// By its definition, about a point.
  Eigen::Matrix3d inertia(const Eigen::Vector3d& about_m) const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < points_m.size(); ++i) {
      const Eigen::Vector3d arm = points_m[i] - about_m;
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d turned = Eigen::Vector3d::Unit(axis).cross(arm);  // velocity at 1 rad/s
        sum.col(axis) += masses_kg[i] * arm.cross(turned);
      }
    }
    return sum;
  }
};

MassCloud drawn_cloud(RandomStream& stream, int points) {
  MassCloud cloud;
  for (int i = 0; i < points; ++i) {
    cloud.masses_kg.push_back(stream.real(0.1, 5.0));
    cloud.points_m.emplace_back(stream.real(-0.5, 0.5), stream.real(-0.5, 0.5), stream.real(-0.5, 0.5));
  }
  return cloud;
}

TEST(LinkInertia, OfAnyMassPointsIsOneThatABodyHas) {
  RandomStream stream{3301};
  for (int i = 0; i < 200; ++i) {
    const MassCloud cloud = drawn_cloud(stream, 1 + i % 5);  // one point, a rod, a plate, and more
    EXPECT_EQ(fault_of_inertia(cloud.inertia(cloud.mass().centre_m)), "") << i;
  }
}

TEST(LinkInertia, ThatNoBodyHasIsRefusedHoweverItIsTurned) {
  RandomStream stream{3302};
  for (int i = 0; i < 50; ++i) {
    const Origin turn{{}, {stream.real(-3, 3), stream.real(-3, 3), stream.real(-3, 3)}};
    const auto fault = [&](double x, double y, double z) {
      return fault_of_inertia(turned_inertia(Eigen::Vector3d(x, y, z).asDiagonal(), turn));
    };
    EXPECT_EQ(fault(1.0, 2.0, 3.0), "");
    EXPECT_EQ(fault(1.0, 2.0, 3.001), "") << "rounded";
    EXPECT_THAT(fault(1.0, 2.0, 3.1), HasSubstr("none exceeds the sum of the other two"));
    EXPECT_THAT(fault(-0.1, 2.0, 2.0), HasSubstr("no negative principal moment"));
  }
}

TEST(LinkInertia, OfJoinedBodiesIsThatOfAllTheirPoints) {
  RandomStream stream{3303};
  for (int i = 0; i < 50; ++i) {
    MassCloud all;
    std::vector<InertialBody> bodies;
    for (int body = 0; body < 3; ++body) {
      const MassCloud cloud = drawn_cloud(stream, 4);
      bodies.push_back({cloud.mass(), cloud.inertia(cloud.mass().centre_m)});
      all.masses_kg.insert(all.masses_kg.end(), cloud.masses_kg.begin(), cloud.masses_kg.end());
      all.points_m.insert(all.points_m.end(), cloud.points_m.begin(), cloud.points_m.end());
    }
    const Eigen::Vector3d centre_m = all.mass().centre_m;
    EXPECT_LT((joint_inertia(bodies, centre_m) - all.inertia(centre_m)).cwiseAbs().maxCoeff(), 1e-12);
  }
}

}  // namespace
}  // namespace demecal
