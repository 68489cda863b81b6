// Proposed poses come in the names and units of the data set that they are to join.
#include "data_files/data_set_file.hpp"
#include "drafting/planned_files.hpp"

#include <gtest/gtest.h>

#include "../config/sample_files.hpp"
#include "../config/temporary_folder.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

Stop stop_at(double angle_rad, double slide_m, double payload_kg) {
  Stop stop(JointVector{{angle_rad, slide_m}});
  stop.approach = ApproachSigns{{-1.0, 1.0}};
  stop.payload_kg = payload_kg;
  return stop;
}

std::string proposed(const std::string& data_set_text, const std::vector<Stop>& stops) {
  const TemporaryFolder folder;
  folder.write("robot.yaml", kRobotText);
  folder.write("poses.csv", kPosesText);
  const DataSet data = load_data_set(folder.write("dataset.yaml", kDataSetText));
  return proposed_poses_csv(folder.write("named.yaml", data_set_text), data, stops);
}

TEST(ProposedPoses, HaveTheDataSetsColumnsAndUnits) {
  const std::string csv = proposed(kDataSetText, {stop_at(radians(12.5), 0.1, 0.0), stop_at(-1.0, 0.02, 0.0)});
  EXPECT_EQ(csv, "pose_id,q1_deg,q2_mm,s1,s2\nN1,12.500,100.000,-1,1\nN2,-57.296,20.000,-1,1\n");
}

TEST(ProposedPoses, FollowUnitsThatStandApartAndNameThePayload) {
  std::string text = changed(kDataSetText, "[q1_deg, q2_mm]", "[turn, slide_m]");
  text = changed(text, "  approach: [s1, s2]\n", "  payload: load_kg\n") + "units: {angle: rad}\n";
  EXPECT_EQ(proposed(text, {stop_at(0.25, 0.1, 1.5)}),
            "pose_id,turn,slide_m,s1,s2,load_kg\nN1,0.250000,0.100000,-1,1,1.5\n");
}

TEST(ProposedPoses, HavePayloadsInTheUnitOfTheirName) {
  const std::string text = changed(kDataSetText, "  approach: [s1, s2]\n", "  payload: load_g\n");
  EXPECT_NE(proposed(text, {stop_at(0.0, 0.1, 1.5)}).find("load_g\nN1,0.000,100.000,-1,1,1500\n"), std::string::npos);
}

}  // namespace
}  // namespace demecal
