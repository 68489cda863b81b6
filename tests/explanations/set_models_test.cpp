// Models with sets of effects are those that a fit gives, also where poses hardly tell an effect.
#include "explanations/set_models.hpp"

#include <gtest/gtest.h>

#include "diagnosis/simulated_arm.hpp"

namespace demecal {
namespace {

/// Over a few degrees a wave of one period per turn is hardly anything but an offset and a slope.
TEST(SetModels, OfAnEffectThatPosesHardlyTellHasItAsSmallAsTheModelBelievesIt) {
  const DeclaredModel declared{.registration = true, .tool = true, .joint_offset = true, .geometry = true};
  Scenario scenario = perfect_scenario(parallel_arm(), 8);
  scenario.joint_ranges[1] = {-0.15, 0.15};
  scenario.backlash = {{2, 2e-3}};  // which the model lacks
  const DataSet data = simulate(scenario);
  const DiagnosisProblem problem{data, declared, poses_of(data, PoseSet::calibration),
                                 poses_of(data, PoseSet::validation)};
  DiagnosedModel model = diagnosed_model(problem, fit_declared(data, problem.fitted, declared, nominal_robot(data)));
  model.robot.effects = {{.kind = "eccentricity", .joint = 1, .settings = {{"order", 1.0}}}};
  model = refined(problem, model, 12);
  const CorrectedRobot same = SetModels(problem, model, {{model.robot.effects[0], 0.0}}).with({0}).robot;
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_NEAR(same.effects[0].values[k], model.robot.effects[0].values[k], 2e-4) << k;
}

}  // namespace
}  // namespace demecal
