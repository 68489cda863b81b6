// Programs do not say where an arm goes on a workpiece that a positioner carries: none is taken for one that does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../errors/complaint.hpp"
#include "kinematics/forward.hpp"
#include "languages/written_program.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ProgramsBesideAPositioner, AreRefusedButForTablesOfJoints) {
  RandomStream random{613};
  const Chain plain = wrist_arm();
  Chain turned = plain, slid = plain;  // of six joints as a program has, and one that slides as a rail does
  turned.positioner = slid.positioner = 1;
  slid.joints.insert(slid.joints.begin(), Joint{.type = JointType::prismatic, .upper = 1.0});
  for (const WrittenIn language : kLanguages) {
    for (const bool of_poses : {true, false}) {
      if (!of_poses && !has_joint_targets(language)) continue;
      SCOPED_TRACE(to_string(language) + (of_poses ? " of poses" : " of joints"));
      const std::string text = written(
          language, of_poses, 2,
          [&](int index) {
            const JointVector joints = random_joints(random, plain);
            return of_poses ? pose_line(language, forward(plain, joints), joints, index, 3)
                            : joints_line(language, joints, index, 3);
          },
          "\n");
      const auto refusal = [&](const Chain& arm) { return complaint([&] { read_program(language, text, "p", arm); }); };
      EXPECT_THAT(refusal(plain), IsEmpty());
      const bool table = row_of(language).title == "CSV";
      if (table && !of_poses) {
        EXPECT_THAT(refusal(turned), IsEmpty());
      } else {
        EXPECT_THAT(refusal(turned), HasSubstr("positioner"));
        EXPECT_THAT(refusal(slid), HasSubstr("positioner"));
      }
    }
  }
}

}  // namespace
}  // namespace demecal
