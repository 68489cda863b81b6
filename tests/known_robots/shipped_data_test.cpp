// The data set that comes with the project is what the scenario that comes with it gives.
#include <gtest/gtest.h>

#include "config/load_data_set.hpp"
#include "config/load_scenario.hpp"
#include "simulation/simulated_robot.hpp"

namespace demecal {
namespace {

TEST(ShippedData, IsWhatTheScenarioGives) {
  const DataSet shipped = load_data_set(DEMECAL_SOURCE_DIR "/configs/data/puma761-demo/dataset.yaml");
  const DataSet made = simulate(load_scenario(DEMECAL_SOURCE_DIR "/configs/scenarios/demo.yaml"));
  ASSERT_EQ(shipped.poses.size(), made.poses.size());
  for (std::size_t i = 0; i < made.poses.size(); ++i) {
    EXPECT_LT((shipped.poses[i].joints - made.poses[i].joints).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((*shipped.poses[i].position_m - *made.poses[i].position_m).norm(), 1e-12);
    EXPECT_EQ(shipped.poses[i].set, made.poses[i].set);
  }
}

}  // namespace
}  // namespace demecal
