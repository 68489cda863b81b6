// Poses that no fit learns from and that touch something say nothing of where the contact is: rows and columns of their
// group sum to nothing, and columns are still what the model does to the errors about the contact's mean, over the
// model's own size.
#include <gtest/gtest.h>

#include "fitting/touching_arm.hpp"
#include "measured_arm.hpp"

namespace demecal {
namespace {

constexpr RowScales kUnit{1.0, 1.0, 1.0};

KnownArm two_sockets(RandomStream& stream) {
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  misbuild(arm, stream, {.joint_offset = true, .geometry = true});
  touch(arm, stream, "a", {0.45, 0.25, 0.1}, 6, 1e-4, PoseSet::validation);
  touch(arm, stream, "b", {0.35, -0.35, 0.35}, 5, 1e-4, PoseSet::validation);
  return arm;
}

/// The rows of a group's poses, all point contacts, summed by axis.
Eigen::MatrixXd group_sum(const RowMatrix& rows, Eigen::Index first_pose, Eigen::Index poses) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3, rows.cols());
  for (Eigen::Index pose = first_pose; pose < first_pose + poses; ++pose) sum += rows.middleRows(3 * pose, 3);
  return sum;
}

TEST(UnseenField, SaysNothingOfWhereContactsAre) {
  RandomStream stream{9401};
  const KnownArm arm = two_sockets(stream);
  const CorrectedRobot nominal = nominal_robot(arm.data);
  const std::vector<ParameterId> ids = free_parameters(arm.data, kAll);
  const ResidualField field = unseen_field(arm.data, all_poses(arm.data), nominal, ids, kUnit);
  const EffectColumns columns = columns_of({{.kind = "gain", .joint = 2}}, arm.data.robot, field);
  ASSERT_EQ(field.rows(), 33);
  EXPECT_GT(field.residual.norm(), 1e-3);
  for (const RowMatrix& rows : {RowMatrix(field.residual), field.declared, columns.dense(field, 0)}) {
    EXPECT_GT(rows.norm(), 1e-4);
    EXPECT_LT(group_sum(rows, 0, 6).norm(), 1e-9 * rows.norm());
    EXPECT_LT(group_sum(rows, 6, 5).norm(), 1e-9 * rows.norm());
  }
}

TEST(UnseenField, HasColumnsOfTheErrorsAboutTheContactsMean) {
  constexpr double kStep = 1e-6;
  RandomStream stream{9402};
  const KnownArm arm = two_sockets(stream);
  const std::vector<ParameterId> ids = free_parameters(arm.data, kAll);
  const ParameterSpace space(nominal_robot(arm.data), ids);
  const ResidualField field = unseen_field(arm.data, all_poses(arm.data), space.reference(), ids, kUnit);
  std::vector<ParameterId> with_places = ids;
  for (const ParameterId& id : contact_parameters(arm.data, all_poses(arm.data))) with_places.push_back(id);
  const ParameterSpace sized(with_own_contacts(space.reference(), arm.data), with_places);
  const auto residual_of = [&](const Eigen::VectorXd& change) {
    Eigen::VectorXd of_arm = Eigen::VectorXd::Zero(sized.size());
    of_arm.head(change.size()) = change;
    const CorrectedRobot changed = space.at(change).robot;
    return Eigen::VectorXd(unseen_field(arm.data, all_poses(arm.data), changed, ids, kUnit).residual /
                           sized.at(of_arm).size);
  };
  for (int i = 0; i < space.size(); ++i) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(space.size(), i);
    const Eigen::VectorXd slope = (residual_of(-step) - residual_of(step)) / (2 * kStep);
    EXPECT_LT((slope - field.declared.col(i)).norm(), 1e-6 * (1.0 + slope.norm()))
        << ids[static_cast<std::size_t>(i)].name();
  }
}

}  // namespace
}  // namespace demecal
