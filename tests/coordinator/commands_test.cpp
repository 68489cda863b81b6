// What several commands refuse alike.
#include "coordinator/commands.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace demecal {
namespace {

DataSet data_of(const std::string& contact) {
  DataSet data;
  data.file = "poses.csv";
  MeasuredPose pose;
  pose.contact = contact;
  if (contact.empty()) pose.position_m = Eigen::Vector3d::Zero();
  data.poses.push_back(pose);
  return data;
}

TEST(Commands, TakeNoAgreementOfContactsForAccuracy) {
  EXPECT_NO_THROW(require_positions(data_of(""), "certify"));
  try {
    require_positions(data_of("left"), "certify");
    FAIL() << "contacts were taken for positions";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("certify needs measured positions"), std::string::npos) << error.what();
  }
}

TEST(Commands, LearnFromOneStationWhereTheySaySo) {
  DataSet data = data_of("");
  EXPECT_NO_THROW(require_instrument(data, "compare"));
  data.stations.resize(2);
  EXPECT_THROW(require_instrument(data, "compare"), InputError);
}

TEST(Commands, TakeNoOptionThatIsNoNumber) {
  CLI::App app;
  std::vector<double> tool_mm;
  app.add_option("--tool-mm", tool_mm)->delimiter(',')->expected(3)->check(number_from(-100.0, 100.0));
  for (const std::string text : {"nan,0,0", "0,inf,0", "0,0,-inf", "0,1e400,0", "0,100.1,0", "0,5mm,0"}) {
    EXPECT_THROW(app.parse("--tool-mm " + text), CLI::ValidationError) << text;
  }
  EXPECT_NO_THROW(app.parse("--tool-mm -100,2.5,1e2"));
  EXPECT_EQ(tool_mm, (std::vector<double>{-100.0, 2.5, 100.0}));
  std::string one = "nan";
  EXPECT_EQ(number_from(0.0, 1e5)(one), "'nan' must be a number from 0 to 100000, without a unit");
}

}  // namespace
}  // namespace demecal
