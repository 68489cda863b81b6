// Few new poses tell whether an arm has changed, and what has; an arm as it was is said to be so.
#include <gtest/gtest.h>

#include "errors/input_error.hpp"
#include "lacking_numbers.hpp"
#include "parameters/declared_model.hpp"
#include "updating/change.hpp"

namespace demecal {
namespace {

CalibratedModel model_of_seed(std::uint64_t seed) {
  return model_of_wrist(measured_wrist(true_wrist(seed), 60, 30, seed));
}

bool is(const ChangeCause& cause, bool DeclaredModel::*flag) {
  return declared_flag(cause.effect.kind) == flag;
}

TEST(Change, IsHardlyEverFoundInAnArmAsItWas) {
  int changed = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const CalibratedModel model = model_of_seed(seed);
    for (std::uint64_t again = 0; again < 12; ++again)
      changed += find_change(model, measured_wrist(true_wrist(seed), 14, 0, 100 * seed + again)).verdict ==
                         ChangeVerdict::unchanged
                     ? 0
                     : 1;
  }
  EXPECT_LE(changed, 6);  // of 60: beyond it is less likely than 5 % at a rate of 5 %
}

TEST(Change, OfAZeroIsNamedWithItsJointAndSize) {
  int named = 0, cases = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const CalibratedModel model = model_of_seed(seed);
    for (const int joint : {1, 2, 3}) {
      CorrectedRobot now = true_wrist(seed);
      now.chain.joints[static_cast<std::size_t>(joint)].theta_rad += 4e-4;
      const ChangeReport report = find_change(model, measured_wrist(now, 14, 0, 200 + seed));
      ++cases;
      EXPECT_EQ(report.verdict, ChangeVerdict::changed);
      if (report.found.empty()) continue;
      const ChangeCause& first = report.found.front();
      if (!is(first, &DeclaredModel::joint_offset) || first.effect.joint != joint) continue;
      ++named;
      EXPECT_NEAR(first.size, 4e-4, 1.5e-4);
    }
  }
  EXPECT_GE(named, cases - 1);
}

TEST(Change, OfTheBaseAloneIsToldFromOneOfTheRobot) {
  const CalibratedModel model = model_of_seed(1);
  CorrectedRobot now = true_wrist(1);
  now.sensor_from_base.translation() += Eigen::Vector3d(6e-4, -5e-4, 6e-4);
  const ChangeReport moved = find_change(model, measured_wrist(now, 14, 0, 301));
  std::string found;
  for (const ChangeCause& cause : moved.found)
    found += cause.effect.kind + " of joint " + std::to_string(cause.effect.joint + 1) + ", p " +
             std::to_string(cause.p_family) + "; ";
  EXPECT_EQ(moved.verdict, ChangeVerdict::registration) << found << "unnamed: " << moved.unnamed;
  EXPECT_LT(moved.left_m, 0.3 * moved.error_m);
  now.sensor_from_base.translation() += Eigen::Vector3d(0.5, 0.2, 0.1);
  const ChangeReport anew = find_change(model, measured_wrist(now, 14, 0, 302));
  EXPECT_TRUE(anew.set_up_anew);
  EXPECT_EQ(anew.verdict, ChangeVerdict::registration);
}

TEST(Change, OfTheToolIsNamed) {
  const CalibratedModel model = model_of_seed(2);
  CorrectedRobot now = true_wrist(2);
  now.tools.at("").translation() += Eigen::Vector3d(2e-4, 1e-4, -2e-4);
  const ChangeReport report = find_change(model, measured_wrist(now, 14, 0, 303));
  EXPECT_EQ(report.verdict, ChangeVerdict::changed);
  ASSERT_FALSE(report.found.empty());
  EXPECT_TRUE(is(report.found.front(), &DeclaredModel::tool));
}

TEST(Change, StrainsTheModelBeyondTheLimitAndAnUnchangedArmDoesNot) {
  const CalibratedModel model = model_of_seed(3);
  const ChangeReport same = find_change(model, measured_wrist(true_wrist(3), 14, 0, 304));
  EXPECT_GT(same.strain, 0.4);
  EXPECT_LT(same.strain, same.strain_limit);
  CorrectedRobot now = true_wrist(3);
  now.chain.joints[2].theta_rad += 1e-3;
  const ChangeReport changed = find_change(model, measured_wrist(now, 14, 0, 305));
  EXPECT_GT(changed.strain, changed.strain_limit);
  EXPECT_LT(changed.p_any, 1e-3);
}

TEST(Change, CannotBeToldFromThreePoses) {
  EXPECT_THROW(find_change(model_of_seed(1), measured_wrist(true_wrist(1), 3, 0, 1)), InputError);
}

}  // namespace
}  // namespace demecal
