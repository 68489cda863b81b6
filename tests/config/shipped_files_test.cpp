// Every file under configs/ loads, says what it is for, and the real measured robots beside the project load too.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "config/job_file.hpp"
#include "config/scenario_file.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"
#include "simulation/simulated_robot.hpp"
#include "temporary_folder.hpp"

namespace demecal {
namespace {

using ::testing::StartsWith;

const std::filesystem::path kSource = DEMECAL_SOURCE_DIR;

std::vector<std::filesystem::path> yaml_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  return files;
}

TEST(ShippedFiles, SayWhatTheyAreForInTheirFirstLine) {
  for (const char* folder : {"robots", "jobs", "grids", "scenarios", "preparation", "matrices"}) {
    for (const auto& file : yaml_files(kSource / "configs" / folder)) {
      std::ifstream stream(file);
      std::string line;
      std::getline(stream, line);
      EXPECT_THAT(line, StartsWith("# ")) << file;
    }
  }
}

TEST(ShippedFiles, RobotsLoad) {
  const auto files = yaml_files(kSource / "configs/robots");
  EXPECT_GE(files.size(), 3u);
  for (const auto& file : files) EXPECT_NO_THROW(load_robot(file)) << file;
}

TEST(ShippedFiles, JobsAndScenariosLoad) {
  for (const auto& file : yaml_files(kSource / "configs/jobs")) EXPECT_NO_THROW(load_job(file)) << file;
  for (const auto& file : yaml_files(kSource / "configs/scenarios")) EXPECT_NO_THROW(load_scenario(file)) << file;
}

TEST(ShippedFiles, GridsAreValidOnTheDemoJob) {
  const auto files = yaml_files(kSource / "configs/grids");
  EXPECT_FALSE(files.empty());
  for (const auto& file : files) {
    EXPECT_GT(grid_cells(kSource / "configs/jobs/demo.yaml", load_grid(file)).size(), 1u) << file;
  }
}

TEST(ShippedFiles, ScenariosCanBeMeasuredAndReadBack) {
  for (const auto& file : yaml_files(kSource / "configs/scenarios")) {
    const TemporaryFolder folder;
    const DataSet data = simulate(load_scenario(file));
    const DataSet back = load_data_set(write_data_set(data, folder.path(), "simulated"));
    EXPECT_EQ(back.poses.size(), data.poses.size()) << file;
  }
}

TEST(ShippedFiles, ThePumaIsTheOneOfTheThesis) {
  const Robot robot = load_robot(kSource / "configs/robots/puma761.yaml");
  const Chain& chain = robot.chain;
  ASSERT_EQ(chain.size(), 6);
  EXPECT_DOUBLE_EQ(chain.joints[1].a_m, 0.65);
  EXPECT_DOUBLE_EQ(chain.joints[1].d_m, 0.191);
  EXPECT_DOUBLE_EQ(chain.joints[3].d_m, 0.6);
  EXPECT_DOUBLE_EQ(chain.joints[5].d_m, 0.125);
  EXPECT_TRUE(chain.tool_m.isApprox(Eigen::Vector3d(0.15025, 0.00163, 0.05569)));
}

struct RealSet {
  const char* file;
  std::size_t poses;
  int joints;
};

class RealData : public ::testing::TestWithParam<RealSet> {};

TEST_P(RealData, Loads) {
  const std::filesystem::path file = kSource / "../shared/data" / GetParam().file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the measured robots are not on this machine: " << file;
  const DataSet data = load_data_set(file);
  EXPECT_EQ(data.poses.size(), GetParam().poses);
  EXPECT_EQ(data.robot.chain.size(), GetParam().joints);
  EXPECT_EQ(data.sha256.size(), 64u);
  EXPECT_GT(poses_of(data, PoseSet::validation).size(), 20u);
  EXPECT_TRUE(data.poses.front().position_m && data.poses.front().approach);
}

INSTANTIATE_TEST_SUITE_P(Measured, RealData,
                         ::testing::Values(RealSet{"ur5-tracker/ur5-grid.yaml", 1020, 6},
                                           RealSet{"wam-tracker/wam-grid.yaml", 236, 7},
                                           RealSet{"ur10-leica/series-a.yaml", 11911, 6},
                                           RealSet{"ur10-leica/series-b.yaml", 1495, 6},
                                           RealSet{"ur10-leica/series-c.yaml", 2773, 6}));

}  // namespace
}  // namespace demecal
