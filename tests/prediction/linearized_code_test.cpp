// The derivatives that the exported inverse takes its steps by.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iomanip>
#include <sstream>

#include "compiled_code.hpp"
#include "prediction/corrected_arm.hpp"
#include "random_robot.hpp"

namespace demecal {
namespace {

/// Prints of every stop the largest differences of `linearize` from `forward` and from quotients of differences.
constexpr const char* kCompared = R"code(
#include <stdio.h>
int main(void) {
  const struct circumstances none = {0};
  for (unsigned stop = 0; stop < sizeof stops/sizeof stops[0]; ++stop) {
    double pose[16], expected[16], jacobian[6][N], q[N], before[6], after[6], of_pose = 0.0, of_jacobian = 0.0;
    linearize(&none, stops[stop], pose, jacobian);
    forward_at(&none, stops[stop], expected);
    for (int i = 0; i < 16; ++i) of_pose = fmax(of_pose, fabs(pose[i] - expected[i]));
    for (int k = 0; k < N; ++k) {
      for (int i = 0; i < N; ++i) q[i] = stops[stop][i];
      q[k] += 1e-5;
      measure(&none, expected, q, after);
      q[k] -= 2e-5;
      measure(&none, expected, q, before);
      for (int i = 0; i < 6; ++i)
        of_jacobian = fmax(of_jacobian, fabs(jacobian[i][k] - (before[i] - after[i])/2e-5));
    }
    printf("%.17g %.17g\n", of_pose, of_jacobian);
  }
  return 0;
}
)code";

/// Uneven gears that are known in a part of the joints' ranges alone.
std::vector<Effect> held_harmonics(RandomStream& stream, int joints) {
  std::vector<Effect> effects;
  for (int joint = 0; joint < joints; ++joint) {
    for (const double ratio : {1.0, 2.0, 50.0}) {
      Effect effect{.kind = "gear_harmonic",
                    .joint = joint,
                    .settings = {{"ratio", ratio}},
                    .values = {1e-3 * stream.normal(), 1e-3 * stream.normal()}};
      effect.ranges[joint] = {-0.2, 2.0};
      effects.push_back(effect);
    }
  }
  return effects;
}

TEST(LinearizedCode, HasTheDerivativesOfForward) {
  if (!there_is("cc")) GTEST_SKIP() << "there is no C compiler called cc";
  RandomStream stream{7564};
  for (const int joints : {5, 6, 7}) {
    const Convention convention = joints == 6 ? Convention::standard_dh : Convention::modified_dh;
    const Chain nominal = mounted_arm(stream, joints, convention, 0.2);
    CorrectedRobot robot = random_robot(stream, nominal, 1e-3, 0.02);
    robot.described.chain = nominal;
    robot.corrections[1] = {};
    robot.effects = held_harmonics(stream, joints);
    Algebra algebra;
    const Listing listing = listing_of(corrected_arm(algebra, robot, ""), robot, "An arm");
    std::ostringstream code;
    code << code_of(listing, CodeLanguage::c)
         << inverse_in_c(listing, described_listing(algebra, robot, robot.tool("")))
         << "static const double stops[][N] = {" << std::setprecision(17);
    constexpr int kStops = 40;
    for (int i = 0; i < kStops; ++i) {
      code << '{';
      for (const double q : random_joints(stream, nominal)) code << q << ',';
      code << "},\n";
    }
    code << "};\n" << kCompared;
    const CodeFolder folder;
    const std::string program = folder.path("linearized");
    int failed = 0;
    const std::string said = output_of(
        "cc -std=c99 -O1 -Wall -Wextra -Werror -o " + program + ' ' + folder.write("arm.c", code.str()) + " -lm",
        failed);
    ASSERT_EQ(failed, 0) << said;
    std::istringstream printed(output_of(program, failed));
    for (int i = 0; i < kStops; ++i) {
      double of_pose = 0.0, of_jacobian = 0.0;
      ASSERT_TRUE(printed >> of_pose >> of_jacobian);
      EXPECT_LT(of_pose, 1e-12) << joints << " joints";
      EXPECT_LT(of_jacobian, 1e-6) << joints << " joints";
    }
  }
}

}  // namespace
}  // namespace demecal
