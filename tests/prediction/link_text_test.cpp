// Matrices of text, multiplied and differentiated as formulas, agree with the numeric kinematics.
#include <gtest/gtest.h>

#include "kinematics/forward.hpp"
#include "kinematics/random_arm.hpp"
#include "prediction/link_text.hpp"
#include "symbolic/calculus.hpp"
#include "symbolic/code.hpp"

namespace demecal {
namespace {

SymbolValues values_at(const Chain& chain, const JointVector& q) {
  SymbolValues values;
  for (int joint = 0; joint < chain.size(); ++joint) {
    values[commanded_joint(joint + 1)] = q[joint];
    for (int i = 0; i < kLinkParameters; ++i) {
      const auto parameter = static_cast<LinkParameter>(i);
      values[parameter_name(parameter, joint)] = chain.joints[static_cast<std::size_t>(joint)].parameter(parameter);
    }
  }
  return values;
}

Eigen::Matrix4d matrix_at(const SymbolicMatrix& matrix, const SymbolValues& at) {
  const std::vector<double> values = values_of(elements(matrix), at);
  return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
}

/// Random arms of either convention, some with prismatic joints, some without Hayati's beta.
Chain arm_of(RandomStream& stream, int which) {
  const auto convention = which % 2 == 0 ? Convention::standard_dh : Convention::modified_dh;
  Chain chain = random_arm(stream, 2 + which % 6, convention, which % 3 == 0 ? 0.4 : 0.0);
  if (which % 4 < 2) {
    for (Joint& joint : chain.joints) joint.beta_rad = 0.0;
  }
  if (which % 5 == 0) {  // right angles and parallel axes, as arms are drawn
    for (Joint& joint : chain.joints) {
      joint.alpha_rad = 0.5 * std::numbers::pi * (static_cast<double>(stream.index(3)) - 1.0);
      joint.theta_rad = 0.5 * std::numbers::pi * (static_cast<double>(stream.index(3)) - 1.0);
    }
  }
  return chain;
}

TEST(LinkText, MultipliesToTheNumericKinematicsWithNumbersAndWithNames) {
  RandomStream stream{621};
  for (int which = 0; which < 40; ++which) {
    const Chain chain = arm_of(stream, which);
    Algebra algebra;
    const SymbolicMatrix given = parse_product(algebra, link_texts(chain, LinkNumbers::given));
    const SymbolicMatrix named = parse_product(algebra, link_texts(chain, LinkNumbers::named));
    for (int i = 0; i < 5; ++i) {
      const JointVector q = random_joints(stream, chain);
      const Eigen::Matrix4d numeric = forward(chain, q).matrix();
      EXPECT_LT((matrix_at(given, values_at(chain, q)) - numeric).cwiseAbs().maxCoeff(), 1e-12);
      EXPECT_LT((matrix_at(named, values_at(chain, q)) - numeric).cwiseAbs().maxCoeff(), 1e-12);
    }
  }
}

TEST(LinkText, DifferentiatesToTheNumericJacobiansByEveryJointAndParameter) {
  RandomStream stream{622};
  for (int which = 0; which < 12; ++which) {
    const Chain chain = arm_of(stream, which);
    Algebra algebra;
    const SymbolicMatrix pose = parse_product(algebra, link_texts(chain, LinkNumbers::named));
    const JointVector q = random_joints(stream, chain);
    const SymbolValues at = values_at(chain, q);
    const Kinematics numeric = differential_kinematics(chain, q, Eigen::Vector3d::Zero());
    const auto expect_column = [&](const std::string& symbol, const Eigen::Matrix<double, 6, 1>& twist) {
      const Eigen::Matrix4d slope = matrix_at(derivative(pose, symbol), at);
      Eigen::Matrix3d turning;  // of the frame, by the angular part
      const Eigen::Vector3d w = twist.tail<3>();
      turning << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
      EXPECT_LT((slope.topRightCorner<3, 1>() - twist.head<3>()).norm(), 1e-12) << symbol;
      EXPECT_LT((slope.topLeftCorner<3, 3>() - turning * numeric.flange.linear()).norm(), 1e-12) << symbol;
    };
    for (int joint = 0; joint < chain.size(); ++joint) {
      expect_column(commanded_joint(joint + 1), numeric.joints.col(joint));
      for (int i = 0; i < kLinkParameters; ++i) {
        expect_column(parameter_name(static_cast<LinkParameter>(i), joint),
                      numeric.links.col(kLinkParameters * joint + i));
      }
    }
  }
}

TEST(LinkText, OfAnArmAsDrawnComesOutAsTextbooksWriteIt) {
  Algebra algebra;
  const SymbolicMatrix pose = parse_product(algebra, link_texts(wrist_arm(), LinkNumbers::given));
  const ExpressionPrinter text(CodeLanguage::text);
  EXPECT_EQ(text(pose[2][3]),
            "0.6*cos(q2 + q3) + 0.125*(cos(q2 + q3)*cos(q5) - sin(q2 + q3)*cos(q4)*sin(q5)) - 0.65*sin(q2)");
}

}  // namespace
}  // namespace demecal
