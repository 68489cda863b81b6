// Matrices of text load as the arm they describe, and faults in them are named by line.
#include "data_files/robot_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../config/temporary_folder.hpp"
#include "errors/input_error.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/random_arm.hpp"
#include "symbolic/calculus.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

const std::string kConfigs = std::string(DEMECAL_SOURCE_DIR) + "/configs/";

TEST(Matrices, OfTheShippedFileAreTheShippedRobot) {
  Algebra algebra;
  const Listing listing = load_matrices(algebra, kConfigs + "matrices/puma761.yaml");
  const Chain chain = load_robot(kConfigs + "robots/puma761.yaml").chain;
  RandomStream stream{651};
  for (int i = 0; i < 50; ++i) {
    const JointVector q = random_joints(stream, chain);
    SymbolValues at;
    for (int joint = 0; joint < chain.size(); ++joint) at[commanded_joint(joint + 1)] = q[joint];
    const std::vector<double> values = values_of(elements(listing.pose), at);
    const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> pose(values.data());
    EXPECT_LT((pose - forward(chain, q).matrix()).cwiseAbs().maxCoeff(), 1e-12);
  }
}

std::string fault_of(const std::string& from, const std::string& to) {
  std::string text = read_file(kConfigs + "matrices/puma761.yaml");
  text.replace(text.find(from), from.size(), to);
  const TemporaryFolder folder;
  write_file(folder.path() / "matrices.yaml", text);
  Algebra algebra;
  try {
    load_matrices(algebra, folder.path() / "matrices.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Matrices, AreRefusedWithTheLineAndPlaceOfTheFault) {
  EXPECT_THAT(fault_of("a2*cos(theta2)", "a3*cos(theta2)"), HasSubstr("matrices[2]"));
  EXPECT_THAT(fault_of("a2*cos(theta2)", "a3*cos(theta2)"),
              HasSubstr("row 1, element 4, column 1: expected one of the names known here (a2 d2"));
  EXPECT_THAT(fault_of("a2*cos(theta2)", "a2*cos(theta2"), HasSubstr("row 1, element 4, column 14"));
  EXPECT_THAT(fault_of("[0, 0, 1, d2]", "[0, 0, 1]"), HasSubstr("4"));
  EXPECT_THAT(fault_of("values: {a2", "values: {theta1"), HasSubstr("is a joint as well"));
  EXPECT_THAT(fault_of("values: {a2: 0.650, d2: 0.191, d4: 0.600, d6: 0.125}", "values: [0.65]"),
              HasSubstr("values must be a map of names and numbers"));
  EXPECT_THAT(fault_of("theta1, theta2,", "theta2, theta2,"), HasSubstr("is named twice"));
  EXPECT_THAT(fault_of("demecal_matrices: 1", "demecal_matrices: 2"), HasSubstr("2"));
}

}  // namespace
}  // namespace demecal
