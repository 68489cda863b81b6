// Refined poses tell more than those they began with, stay feasible, and their covariance is that of their rows.
#include "decompositions/decompositions.hpp"
#include "planning/exchange.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "kinematics/random_arm.hpp"
#include "planning/candidates.hpp"
#include "planning/travel.hpp"

namespace demecal {
namespace {

Eigen::MatrixXd covariance_of(const InformationModel& model, const std::vector<PlannedPose>& poses,
                              const Eigen::MatrixXd& known) {
  Eigen::MatrixXd information = known + Eigen::MatrixXd::Identity(known.rows(), known.cols());
  for (const PlannedPose& pose : poses) {
    const Eigen::MatrixXd rows = model.measured_rows(pose);
    information += rows.transpose() * rows;
  }
  return Cholesky(information).inverse();
}

TEST(RefinedPoses, TellMoreStayFeasibleAndAreAFunctionOfTheArguments) {
  Robot robot;
  robot.chain = wrist_arm();
  robot.chain.tool_m = {0.1, 0.02, 0.08};
  PlannedModel planned;
  planned.nominal.robot = robot;
  planned.declared = {.registration = true, .tool = true, .joint_offset = true, .geometry = true};
  const InformationModel model(planned);
  const FeasibleSpace space(robot, assumed_cell(robot));
  const auto numbers = static_cast<Eigen::Index>(model.ids().size());
  const Eigen::MatrixXd known = Eigen::MatrixXd::Zero(numbers, numbers);
  const Workspace workspace(model, draw_poses(space, 60, RandomStream{71, 1}).poses);
  for (const std::uint64_t seed : {1, 2, 3}) {
    const std::vector<PlannedPose> random = draw_poses(space, 16, RandomStream{71, 1 + seed}).poses;
    const RefinedPoses better = refined(model, space, random, known, workspace.weight(), RandomStream{72, seed});
    ASSERT_EQ(better.poses.size(), random.size());
    const double before = workspace.square_m2(covariance_of(model, random, known));
    const double after = workspace.square_m2(covariance_of(model, better.poses, known));
    EXPECT_LT(after, 0.7 * before);
    EXPECT_NEAR(workspace.square_m2(better.covariance), after, 1e-6 * after);
    for (const PlannedPose& pose : better.poses) {
      EXPECT_EQ(space.obstruction(pose.joints), Obstruction::none);
      EXPECT_TRUE(is_free(space, approach_stop(space, pose), pose.joints));
    }
    const RefinedPoses again = refined(model, space, random, known, workspace.weight(), RandomStream{72, seed});
    EXPECT_EQ(again.covariance, better.covariance);
  }
}

}  // namespace
}  // namespace demecal
