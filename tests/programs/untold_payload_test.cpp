// Languages whose statements of payload are not read: where a model depends on it, it is said that it is not told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "corrected_arm.hpp"
#include "languages/named_languages.hpp"
#include "languages/written_program.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(UntoldPayload, IsSaidOfProgramsThatDoNotStateIt) {
  RandomStream stream{7653};
  const Robot nominal = elbow_arm(stream);
  CorrectedRobot identified = random_robot(stream, nominal.chain, 0.0, 0.0);
  identified.corrections.assign(nominal.chain.joints.size(), {});
  identified.effects = {
      {.kind = "compliance", .joint = 1, .settings = {}, .form = "payload", .formula = {}, .values = {1e-6}}};
  const CommandModel model = unbounded_model(nominal, identified);
  const JointVector joints = regular_joints(stream, nominal.chain);
  const Eigen::Isometry3d tool = forward(nominal.chain, joints) * Eigen::Translation3d(nominal.chain.tool_m);
  for (const WrittenIn language : {WrittenIn::val2, WrittenIn::val3, WrittenIn::yaskawa_jbi}) {
    const std::string text = written(
        language, true, 1, [&](int index) { return pose_line(language, tool, joints, index, 6); }, "\n");
    std::string said;
    for (const Remark& warning :
         correct_program(text, read_program(language, text, "p", nominal.chain), model, {.near = joints}).warnings)
      said += warning.sentence + '\n';
    EXPECT_THAT(said,
                AllOf(HasSubstr("depends on the payload, which the program does not state"), HasSubstr("--payload-kg")))
        << to_string(language) << ": " << text;
  }
}

}  // namespace
}  // namespace demecal
