// What columns share with errors and with each other is the same to the bit, however many rows are left out that hold
// nothing.
#include "trials/projected_columns.hpp"

#include <gtest/gtest.h>

#include <cstddef>

#include "mistaken_case.hpp"

namespace demecal {
namespace {

Trial trial_of_unmistaken() {
  const DataSet data =
      bench::unmistaken_cases({bench::mistaken_arms(DEMECAL_SOURCE_DIR "/configs/robots")[0]}, 1).front().data;
  Trial trial{data.robot.chain, {data.robot.chain.tool_m}, {}, 1};
  for (std::size_t i = 0; i < data.poses.size(); ++i)
    trial.rows.push_back({data.poses[i].joints, *data.poses[i].position_m, 0, 0, i});
  return trial;
}

TEST(ProjectedColumns, OfOneColumnThatBeginsLateAreThoseOfTheWholeColumn) {
  const Trial trial = trial_of_unmistaken();
  const TrialFit fit = fit_arm(trial, fit_base_and_tools(trial));
  const ProjectedColumns projected(trial, fit);
  for (int joint = 0; joint < trial.chain.size(); ++joint) {
    for (std::size_t first = 0; first < trial.rows.size(); ++first) {
      Eigen::VectorXd column = joint_column(trial, fit, joint);
      column.head(3 * static_cast<Eigen::Index>(first)).setZero();
      const auto [with_error, with_itself] = projected.of_column(column, first);
      EXPECT_EQ(with_error, projected.with_error(column)[0]) << joint << " " << first;
      EXPECT_EQ(with_itself, projected.with_itself(column)(0, 0)) << joint << " " << first;
    }
  }
}

TEST(ProjectedColumns, OfJointsAreDifferencesOfPredictedPoints) {
  const Trial trial = trial_of_unmistaken();
  const TrialFit fit = fit_arm(trial, fit_base_and_tools(trial));
  for (int joint = 0; joint < trial.chain.size(); ++joint) {
    const Eigen::VectorXd column = joint_column(trial, fit, joint);
    for (std::size_t i = 0; i < trial.rows.size(); ++i) {
      TrialRow row = trial.rows[i];
      row.joints[joint] += 1e-6;
      const Eigen::Vector3d difference = (predicted_point(fit, row) - predicted_point(fit, trial.rows[i])) / 1e-6;
      EXPECT_EQ(Eigen::Vector3d(column.segment<3>(3 * static_cast<Eigen::Index>(i))), difference) << joint << " " << i;
    }
  }
}

}  // namespace
}  // namespace demecal
