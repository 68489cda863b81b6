// How a point moves by the links alone is the whole Jacobian's upper rows, and the flange stands where it does, to the
// bit.
#include "kinematics/point_motions.hpp"

#include <gtest/gtest.h>

#include "random_arm.hpp"

namespace demecal {
namespace {

TEST(PlacedScrews, HaveTheFlangeAndTheMotionsOfTheWholeJacobian) {
  RandomStream stream{3107};
  for (const Convention convention : kConventions) {
    for (int joints = 1; joints <= kMaxJoints; ++joints) {
      const Chain chain = mounted_arm(stream, joints, convention, 0.3);
      JointVector q(joints);
      for (double& joint : q) joint = stream.real(-2.0, 2.0);
      const PlacedScrews screws(FixedTurns(chain), q);
      EXPECT_EQ(screws.flange().matrix(), forward(chain, q).matrix());
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d point_m(stream.normal(), stream.normal(), stream.normal());
        EXPECT_EQ(PointMotions(link_jacobian(chain, q, point_m).topRows<3>()),
                  screws.motions(screws.flange() * point_m));
      }
    }
  }
}

}  // namespace
}  // namespace demecal
