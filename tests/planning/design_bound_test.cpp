// No poses get below the bound, drawn or refined, measured once or several times; and the best of them get near it.
#include "planning/design_bound.hpp"
#include "decompositions/decompositions.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "planning/candidates.hpp"
#include "planning/exchange.hpp"
#include "planning/planned_arm.hpp"

namespace demecal {
namespace {

class DesignBound : public testing::Test {
 protected:
  static PlannedModel planned_model() {
    PlannedModel planned;
    planned.nominal.robot = planned_arm();
    planned.declared = {.registration = true, .tool = true, .joint_offset = true, .geometry = true};
    return planned;
  }
  std::vector<PlannedPose> draw(std::size_t count, std::uint64_t seed) const {
    return draw_poses(space_, count, RandomStream{81, seed}).poses;
  }
  /// Expected squared error after `times` measurements of these poses.
  double square_m2(const std::vector<PlannedPose>& poses, double times = 1.0) const {
    const Eigen::MatrixXd rows = stacked_rows(model_, poses);
    const Eigen::MatrixXd information =
        known_ + Eigen::MatrixXd::Identity(known_.rows(), known_.cols()) + times * rows.transpose() * rows;
    return workspace_.square_m2(Cholesky(information).inverse());
  }
  double bound_m2(std::size_t count, std::uint64_t seed) const {
    return least_square_m2(model_, space_, draw(200, seed), known_, workspace_.weight(), count, RandomStream{82, seed});
  }
  std::vector<PlannedPose> refined_from(std::size_t count, std::uint64_t seed) const {
    return refined(model_, space_, draw(count, seed), known_, workspace_.weight(), RandomStream{83, seed}).poses;
  }

  FeasibleSpace space_{planned_arm(), assumed_cell(planned_arm())};
  InformationModel model_{planned_model()};
  Workspace workspace_{model_, draw(60, 1)};
  Eigen::MatrixXd known_ = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(model_.ids().size()),
                                                 static_cast<Eigen::Index>(model_.ids().size()));
};

TEST_F(DesignBound, HoldsForAllPosesAndIsNearTheBest) {
  for (const std::size_t count : {15u, 30u}) {
    const double bound = bound_m2(count, 2);
    for (std::uint64_t seed = 10; seed < 30; ++seed) EXPECT_GE(square_m2(draw(count, seed)), bound);
    for (std::uint64_t seed = 30; seed < 33; ++seed) {
      const double best = square_m2(refined_from(count, seed));
      EXPECT_GE(best, bound);
      EXPECT_LE(best, 1.2 * bound);
    }
  }
}

TEST_F(DesignBound, HoldsForPosesThatAreMeasuredSeveralTimes) {
  EXPECT_GE(square_m2(refined_from(15, 40), 3.0), bound_m2(45, 3));
}

/// Weights begin with other poses, but the optimum is one.
TEST_F(DesignBound, DependsLittleOnThePosesItBeginsWith) {
  const double one = bound_m2(30, 4), other = bound_m2(30, 5);
  EXPECT_NEAR(one / other, 1.0, 0.05);
}

TEST_F(DesignBound, FallsWithWhatIsKnownAlready) {
  const double before = bound_m2(20, 6);
  const Eigen::MatrixXd rows = stacked_rows(model_, draw(30, 50));
  known_ = rows.transpose() * rows;
  EXPECT_LT(bound_m2(20, 6), before);
  EXPECT_GE(square_m2(refined_from(20, 51)), bound_m2(20, 6));
}

}  // namespace
}  // namespace demecal
