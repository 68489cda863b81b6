// The data sets that come with the project are what the scenarios that come with it give.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "config/scenario_file.hpp"
#include "data_files/data_set_file.hpp"
#include "simulation/simulated_robot.hpp"

namespace demecal {
namespace {

class ShippedData : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(ShippedData, IsWhatTheScenarioGives) {
  const auto [folder, scenario] = GetParam();
  const std::string configs = DEMECAL_SOURCE_DIR "/configs/";
  const DataSet shipped = load_data_set(configs + "data/" + folder + "/dataset.yaml");
  const DataSet made = simulate(load_scenario(configs + "scenarios/" + scenario));
  ASSERT_EQ(shipped.poses.size(), made.poses.size());
  for (std::size_t i = 0; i < made.poses.size(); ++i) {
    EXPECT_LT((shipped.poses[i].joints - made.poses[i].joints).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_EQ(shipped.poses[i].contact, made.poses[i].contact);
    ASSERT_EQ(shipped.poses[i].position_m.has_value(), made.poses[i].position_m.has_value());
    if (made.poses[i].position_m) {
      EXPECT_LT((*shipped.poses[i].position_m - *made.poses[i].position_m).norm(), 1e-12);
    }
    EXPECT_EQ(shipped.poses[i].set, made.poses[i].set);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShippedData,
                         testing::Values(std::pair{"puma761-demo", "demo.yaml"},
                                         std::pair{"puma761-chapter6", "chapter6.yaml"},
                                         std::pair{"puma761-structural", "structural.yaml"},
                                         std::pair{"puma761-sockets", "sockets.yaml"}));

}  // namespace
}  // namespace demecal
