// Arms are alike whatever rounding leaves, and the first difference is named with both values.
#include "kinematics/chain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "random_arm.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

TEST(FirstDifference, IsNoneOfRoundingAndNamesEveryNumber) {
  RandomStream stream{5501};
  const Chain arm = random_arm(stream, 6, Convention::standard_dh);
  Chain rounded = arm;
  rounded.joints[2].a_m += 1e-10;
  rounded.tool_m.x() += 0.1;
  rounded.joints[0].upper += 0.2;
  EXPECT_EQ(first_difference(arm, rounded), "");
  for (std::size_t joint = 0; joint < arm.joints.size(); ++joint) {
    for (int i = 0; i < kLinkParameters; ++i) {
      Chain other = arm;
      other.joints[joint].parameter(static_cast<LinkParameter>(i)) += 1e-3;
      EXPECT_THAT(first_difference(arm, other), HasSubstr("its joint " + std::to_string(joint + 1) + " has ")) << i;
    }
  }
  Chain longer = arm;
  longer.joints[1].d_m = 0.12;
  Chain shorter = longer;
  shorter.joints[1].d_m = 0.1;
  EXPECT_EQ(first_difference(longer, shorter), "its joint 2 has d 100 mm, not 120 mm");
}

TEST(FirstDifference, NamesWhatIsNoNumberOfALink) {
  RandomStream stream{5502};
  const Chain arm = random_arm(stream, 4, Convention::modified_dh);
  Chain other = arm;
  other.joints.pop_back();
  EXPECT_EQ(first_difference(arm, other), "it has 3 joints, not 4");
  other = arm;
  other.convention = Convention::standard_dh;
  EXPECT_THAT(first_difference(arm, other), HasSubstr("convention"));
  other = arm;
  other.base.translation().z() += 0.01;
  EXPECT_THAT(first_difference(arm, other), HasSubstr("base"));
  other = arm;
  other.couplings.push_back({2, 1, 1.0});
  EXPECT_THAT(first_difference(arm, other), HasSubstr("couplings"));
  other = arm;
  other.joints[1].type = is_revolute(arm.joints[1]) ? JointType::prismatic : JointType::revolute;
  EXPECT_THAT(first_difference(arm, other), HasSubstr("its joint 2 slides"));
}

}  // namespace
}  // namespace demecal
