// The arms of configs/robots stand where their descriptions have them.
#include <gtest/gtest.h>

#include "data_files/robot_file.hpp"
#include "kinematics/random_arm.hpp"
#include "urdf/urdf_arm.hpp"
#include "urdf/urdf_file.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

struct LibraryArm {
  const char* robot;
  const char* urdf;
  const char* tip = nullptr;
};

class LibraryArms : public ::testing::TestWithParam<LibraryArm> {};

TEST_P(LibraryArms, StandWithinAHundredthOfAMillimetreOfTheirDescription) {
  const std::filesystem::path source = DEMECAL_SOURCE_DIR;
  const auto file = source / "../shared/data/urdf" / (std::string(GetParam().urdf) + ".urdf");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "needs " << file;
  const UrdfFile urdf = parse_urdf(read_file(file), file);
  const UrdfArm arm =
      arm_between(urdf, {}, GetParam().tip == nullptr ? std::nullopt : std::optional<std::string>(GetParam().tip));
  const Chain described = equivalent_chain(arm.drawing).chain;
  const Robot robot = load_robot(source / "configs/robots" / (std::string(GetParam().robot) + ".yaml"));
  ASSERT_EQ(robot.chain.size(), described.size());
  RandomStream stream{1851};
  for (int i = 0; i < 200; ++i) {
    const JointVector q = random_joints(stream, robot.chain);
    const Eigen::Isometry3d one = forward(robot.chain, q), other = forward(described, q);
    EXPECT_LT((one.translation() - other.translation()).norm(), 1e-5);
    EXPECT_LT((one.linear() - other.linear()).cwiseAbs().maxCoeff(), 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Described, LibraryArms,
    ::testing::Values(LibraryArm{"abb-irb120", "irb120_3_58"}, LibraryArm{"abb-irb2600-12-165", "irb2600_12_165"},
                      LibraryArm{"abb-irb4600-20-250", "irb4600_20_250"},
                      LibraryArm{"abb-irb6700-200-260", "irb6700_200_260"}, LibraryArm{"fanuc-crx10ial", "crx10ial"},
                      LibraryArm{"fanuc-lrmate200id", "lrmate200id"}, LibraryArm{"fanuc-m20ia", "m20ia"},
                      LibraryArm{"fanuc-r2000ic-165f", "r2000ic165f"}, LibraryArm{"kuka-kr3-r540", "kr3r540"},
                      LibraryArm{"kuka-kr6-r900-2", "kr6r900_2"}, LibraryArm{"kuka-kr10-r1100", "kr10r1100sixx"},
                      LibraryArm{"kuka-kr210-l150", "kr210l150"}, LibraryArm{"yaskawa-mh5", "mh5"},
                      LibraryArm{"yaskawa-sia20d", "sia20d"}, LibraryArm{"staubli-rx160", "rx160"},
                      LibraryArm{"staubli-tx2-60", "tx2_60"}, LibraryArm{"franka-panda", "panda", "panda_link8"},
                      LibraryArm{"kuka-iiwa14", "iiwa14_no_collision", "iiwa_link_ee"},
                      LibraryArm{"puma560", "puma560_robot"}, LibraryArm{"ur5", "ur5", "tool0"},
                      LibraryArm{"ur5e", "universalUR5e"}),
    [](const auto& instance) {
      std::string name = instance.param.robot;
      std::erase(name, '-');
      return name;
    });

}  // namespace
}  // namespace demecal
