// Where one joint's turn has changed, new poses say so of that joint and of no other.
#include "updating/belief_sizes.hpp"

#include <gtest/gtest.h>

#include "decompositions/decompositions.hpp"
#include "expression/tree.hpp"
#include "lacking_numbers.hpp"
#include "prediction/measurement.hpp"
#include "primitives/primitive.hpp"

namespace demecal {
namespace {

JointCorrection wave(double amplitude_rad, int cycles) {
  const Tree angle = apply(Primitive::multiply, constant_tree(cycles), variable_tree(0));
  const Tree curve = apply(Primitive::multiply, constant_tree(amplitude_rad), apply(Primitive::sine, angle));
  return {curve, AngleBranch{}, Interval{-3.2, 3.2}};
}

/// Forty new poses of an arm one of whose joints has come to wave by half a milliradian, beside a model of before.
struct WavingWrist {
  DataSet data;
  std::vector<std::size_t> poses;
  PriorModel prior;
  NewRows rows;

  double unseen_mm(const BeliefSizes& sizes) const {
    const Eigen::MatrixXd covariance = prior.covariance(sizes.factors, sizes.of_joint);
    Eigen::MatrixXd seen = rows.columns * covariance * rows.columns.transpose();
    seen.diagonal().array() += sizes.noise;
    const Eigen::VectorXd change = covariance * rows.columns.transpose() * Cholesky(seen).solve(rows.values);
    return error_figures(prior.changed(change), data, poses_of(data, PoseSet::validation)).rms_mm;
  }
};

WavingWrist waving_wrist(std::uint64_t seed, int joint, double amplitude_rad) {
  const CalibratedModel model = model_of_wrist(measured_wrist(true_wrist(seed), 100, 0, seed));
  CorrectedRobot now = true_wrist(seed);
  now.corrections[static_cast<std::size_t>(joint)] = wave(amplitude_rad, 2);
  const DataSet data = measured_wrist(now, 40, 100, 800 + seed);
  const std::vector<std::size_t> poses = poses_of(data, PoseSet::calibration);
  const CorrectedRobot placed = fit_registration(data, poses, {.registration = true, .tool = true}, model.robot).robot;
  PriorModel prior(model, placed, data, poses, model.declared);
  RowScales scales;
  scales[kPosition] = kMeasured_m;
  NewRows rows = rows_about(prior, data, poses, scales, Eigen::VectorXd::Zero(prior.numbers()), false);
  return {data, poses, std::move(prior), std::move(rows)};
}

/// Its own factor comes beside that of all joints' waves: what counts is how much larger it is than the others'.
TEST(BeliefSizes, GrowForTheJointThatChangedAndForNoOther) {
  for (std::uint64_t seed = 61; seed <= 63; ++seed) {
    for (const int changed : {0, 1, 2, 3}) {
      const WavingWrist arm = waving_wrist(seed, changed, 5e-4);
      const BeliefSizes sizes = likeliest_sizes(arm.prior, arm.rows, JointSizes::each);
      for (int joint = 0; joint < sizes.of_joint.size(); ++joint) {
        if (joint == changed) continue;
        EXPECT_GT(sizes.of_joint[changed], 2.0 * sizes.of_joint[joint]) << seed << " joint " << joint;
      }
    }
  }
}

TEST(BeliefSizes, OfEachJointLeaveLessOfUnseenPosesWhereOneChangedAndNoMoreWhereNoneDid) {
  for (std::uint64_t seed = 51; seed <= 53; ++seed) {
    for (const double amplitude_rad : {0.0, 5e-4}) {
      const WavingWrist arm = waving_wrist(seed, static_cast<int>(seed % 4), amplitude_rad);
      const double each_mm = arm.unseen_mm(likeliest_sizes(arm.prior, arm.rows, JointSizes::each));
      const double alike_mm = arm.unseen_mm(likeliest_sizes(arm.prior, arm.rows, JointSizes::alike));
      EXPECT_LT(each_mm, (amplitude_rad > 0.0 ? 1.0 : 1.05) * alike_mm) << seed << " " << amplitude_rad;
    }
  }
}

}  // namespace
}  // namespace demecal
