// What several commands refuse alike.
#include "coordinator/commands.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace demecal
