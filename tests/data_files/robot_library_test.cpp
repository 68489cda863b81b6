// The arms of configs/robots stand where their descriptions, or their published dimensions, have them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "data_files/robot_file.hpp"
#include "kinematics/random_arm.hpp"
#include "urdf/urdf_arm.hpp"
#include "urdf/urdf_file.hpp"
#include "yaml/files.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal {
namespace {

struct LibraryArm {
  const char* robot;
  const char* urdf;
  const char* tip = nullptr;
};

const LibraryArm kDescribed[] = {{"abb-irb120", "irb120_3_58"},
                                 {"abb-irb2600-12-165", "irb2600_12_165"},
                                 {"abb-irb4600-20-250", "irb4600_20_250"},
                                 {"abb-irb6700-200-260", "irb6700_200_260"},
                                 {"fanuc-crx10ial", "crx10ial"},
                                 {"fanuc-lrmate200id", "lrmate200id"},
                                 {"fanuc-m20ia", "m20ia"},
                                 {"fanuc-r2000ic-165f", "r2000ic165f"},
                                 {"kuka-kr3-r540", "kr3r540"},
                                 {"kuka-kr6-r900-2", "kr6r900_2"},
                                 {"kuka-kr10-r1100", "kr10r1100sixx"},
                                 {"kuka-kr210-l150", "kr210l150"},
                                 {"yaskawa-mh5", "mh5"},
                                 {"yaskawa-sia20d", "sia20d"},
                                 {"staubli-rx160", "rx160"},
                                 {"staubli-tx2-60", "tx2_60"},
                                 {"franka-panda", "panda", "panda_link8"},
                                 {"kuka-iiwa14", "iiwa14_no_collision", "iiwa_link_ee"},
                                 {"puma560", "puma560_robot"},
                                 {"ur5", "ur5", "tool0"},
                                 {"ur5e", "universalUR5e"}};

/// Where the flange of an arm without a description stands, and which way it points: sums, by hand, of the dimensions
/// that the head of its file names, in poses where the links are level or upright.
struct PublishedStand {
  const char* robot;
  std::vector<double> at_deg;
  Eigen::Vector3d flange_mm, along;
};

const std::vector<PublishedStand> kPublished = {
    {"abb-irb1600-6-145", {0, 0, 0, 0, 0, 0}, {815.0, 0.0, 1186.5}, {1.0, 0.0, 0.0}},
    {"abb-irb1600-6-145", {0, 90, 0, 0, 0, 0}, {850.0, 0.0, -178.5}, {0.0, 0.0, -1.0}},
    {"abb-irb1600-6-145", {90, 0, -90, 0, 90, 0}, {0.0, 215.0, 1786.5}, {0.0, 1.0, 0.0}},
    {"yaskawa-gp8", {0, 0, 0, 0, 0, 0}, {460.0, 0.0, 715.0}, {1.0, 0.0, 0.0}},
    {"yaskawa-gp8", {0, 90, 0, 0, 0, 0}, {425.0, 0.0, -90.0}, {0.0, 0.0, -1.0}},
    {"yaskawa-gp8", {90, 0, 90, 0, -90, 0}, {0.0, 80.0, 1015.0}, {0.0, 1.0, 0.0}},
    {"yaskawa-mh24", {0, 0, 0, 0, 0, 0}, {1045.0, 0.0, 960.0}, {1.0, 0.0, 0.0}},
    {"yaskawa-mh24", {0, 90, 0, 0, 0, 0}, {1110.0, 0.0, -895.0}, {0.0, 0.0, -1.0}},
    {"yaskawa-mh24", {90, 0, 90, 0, -90, 0}, {0.0, 50.0, 1555.0}, {0.0, 1.0, 0.0}},
    {"staubli-tx2-90", {0, 0, 0, 0, 0, 0}, {50.0, 50.0, 1428.0}, {0.0, 0.0, 1.0}},
    {"staubli-tx2-90", {0, 90, 0, 0, 0, 0}, {1000.0, 50.0, 478.0}, {1.0, 0.0, 0.0}},
    {"staubli-tx2-90", {90, 0, 90, 0, 90, 0}, {-50.0, 475.0, 803.0}, {0.0, 0.0, -1.0}},
    {"ur3", {0, 0, 0, 0, 0, 0}, {-456.9, -194.25, 66.55}, {0.0, -1.0, 0.0}},
    {"ur3", {0, -90, 90, -90, 90, 0}, {-298.6, -112.35, 477.45}, {0.0, 0.0, 1.0}},
    {"ur3e", {0, 0, 0, 0, 0, 0}, {-456.75, -223.15, 66.5}, {0.0, -1.0, 0.0}},
    {"ur3e", {0, -90, 90, -90, 90, 0}, {-298.55, -131.05, 487.5}, {0.0, 0.0, 1.0}},
    {"ur10", {0, 0, 0, 0, 0, 0}, {-1184.3, -256.141, 11.6}, {0.0, -1.0, 0.0}},
    {"ur10", {0, -90, 90, -90, 90, 0}, {-688.0, -163.941, 831.5}, {0.0, 0.0, 1.0}},
    {"ur10e", {0, 0, 0, 0, 0, 0}, {-1184.25, -290.7, 60.85}, {0.0, -1.0, 0.0}},
    {"ur10e", {0, -90, 90, -90, 90, 0}, {-691.4, -174.15, 909.95}, {0.0, 0.0, 1.0}},
    {"ur16e", {0, 0, 0, 0, 0, 0}, {-838.4, -290.7, 60.85}, {0.0, -1.0, 0.0}},
    {"ur16e", {0, -90, 90, -90, 90, 0}, {-479.85, -174.15, 775.65}, {0.0, 0.0, 1.0}},
    {"kuka-iiwa7", {0, 0, 0, 0, 0, 0, 0}, {0.0, 0.0, 1266.0}, {0.0, 0.0, 1.0}},
    {"kuka-iiwa7", {0, 90, 0, 0, 0, 0, 0}, {926.0, 0.0, 340.0}, {1.0, 0.0, 0.0}},
    {"kuka-iiwa7", {0, 0, 0, -90, 0, 90, 0}, {400.0, 0.0, 614.0}, {0.0, 0.0, -1.0}},
    {"barrett-wam7", {0, 0, 0, 0, 0, 0, 0}, {0.0, 0.0, 910.0}, {0.0, 0.0, 1.0}},
    {"barrett-wam7", {0, 0, 0, 90, 0, 90, 0}, {345.0, 0.0, 535.0}, {0.0, 0.0, -1.0}},
    {"puma761", {0, 0, 0, 0, 0, 0}, {650.0, 191.0, 725.0}, {0.0, 0.0, 1.0}},
    {"puma761", {90, -90, 90, 0, 90, 0}, {-191.0, 125.0, 1250.0}, {0.0, 1.0, 0.0}}};

const std::filesystem::path kLibrary = std::filesystem::path(DEMECAL_SOURCE_DIR) / "configs/robots";

class LibraryArms : public ::testing::TestWithParam<LibraryArm> {
 protected:
  void SetUp() override {
    if (std::filesystem::exists(file_)) urdf_ = parse_urdf(read_file(file_), file_);
    if (GetParam().tip != nullptr) tip_ = GetParam().tip;
  }

  const std::filesystem::path file_ =
      std::filesystem::path(DEMECAL_SOURCE_DIR) / "../shared/data/urdf" / (std::string(GetParam().urdf) + ".urdf");
  std::optional<UrdfFile> urdf_;  ///< its description, where it is there
  std::optional<std::string> tip_;
};

TEST_P(LibraryArms, StandWithinAHundredthOfAMillimetreOfTheirDescription) {
  if (!urdf_) GTEST_SKIP() << "needs " << file_;
  const UrdfArm arm = arm_between(*urdf_, {}, tip_);
  const Chain described = equivalent_chain(arm.drawing).chain;
  const Robot robot = load_robot(kLibrary / (std::string(GetParam().robot) + ".yaml"));
  ASSERT_EQ(robot.chain.size(), described.size());
  RandomStream stream{1851};
  for (int i = 0; i < 200; ++i) {
    const JointVector q = random_joints(stream, robot.chain);
    const Eigen::Isometry3d one = forward(robot.chain, q), other = forward(described, q);
    EXPECT_LT((one.translation() - other.translation()).norm(), 1e-5);
    EXPECT_LT((one.linear() - other.linear()).cwiseAbs().maxCoeff(), 1e-5);
  }
}

/// The file's text with the base that its remark gives for positions as the controller has them; empty where it has
/// none.
std::string as_controllers_count(std::string text) {
  const std::string remark = "\n# base: ", key = "\nbase: ";
  const std::size_t given = text.find(remark), own = text.find(key);
  if (given == std::string::npos) return {};
  const std::string base = text.substr(given + remark.size(), text.find('\n', given + 1) - given - remark.size());
  return text.replace(own + key.size(), text.find('\n', own + 1) - own - key.size(), base);
}

TEST_P(LibraryArms, SayWhereTheControllerCountsFromWhereThatIsElsewhere) {
  if (!urdf_) GTEST_SKIP() << "needs " << file_;
  const UrdfArm arm = arm_between(*urdf_, {}, tip_);
  const bool elsewhere = std::ranges::any_of(
      arm.notes, [](const auto& note) { return note.find("controllers count") != std::string::npos; });
  const std::string text = as_controllers_count(read_file(kLibrary / (std::string(GetParam().robot) + ".yaml")));
  ASSERT_EQ(!text.empty(), elsewhere);
  if (!elsewhere) return;
  const Chain counted = equivalent_chain(arm_between(*urdf_, "base", arm.tip).drawing).chain;
  const Robot robot = read_robot(parse_yaml(text, "robot.yaml").with_version("robot", 1));
  RandomStream stream{1852};
  for (int i = 0; i < 20; ++i) {
    const JointVector q = random_joints(stream, robot.chain);
    EXPECT_LT((forward(robot.chain, q).matrix() - forward(counted, q).matrix()).cwiseAbs().maxCoeff(), 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Described, LibraryArms, ::testing::ValuesIn(kDescribed), [](const auto& instance) {
  std::string name = instance.param.robot;
  std::erase(name, '-');
  return name;
});

TEST(RobotLibrary, ArmsWithoutADescriptionStandWhereTheirPublishedDimensionsPutThem) {
  for (const PublishedStand& stand : kPublished) {
    SCOPED_TRACE(stand.robot);
    const Robot robot = load_robot(kLibrary / (std::string(stand.robot) + ".yaml"));
    const Eigen::Isometry3d flange = forward(robot.chain, joints_from_deg_or_mm(robot.chain, stand.at_deg));
    EXPECT_LT((flange.translation() * 1e3 - stand.flange_mm).norm(), 0.01) << flange.translation().transpose() * 1e3;
    EXPECT_LT((flange.linear().col(2) - stand.along).norm(), 1e-6) << flange.linear().col(2).transpose();
  }
}

TEST(RobotLibrary, HasNoArmThatNothingHolds) {
  std::set<std::string> held{"elbow-offset"}, shipped;  // which is invented
  for (const LibraryArm& arm : kDescribed) held.insert(arm.robot);
  for (const PublishedStand& stand : kPublished) held.insert(stand.robot);
  for (const auto& file : std::filesystem::directory_iterator(kLibrary)) shipped.insert(file.path().stem().string());
  EXPECT_THAT(shipped, ::testing::ElementsAreArray(held));
}

}  // namespace
}  // namespace demecal
