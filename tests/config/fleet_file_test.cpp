// What a fleet's file states of its robots reads back, and a file whose numbers are not those of its posterior is
// refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/model_file.hpp"
#include "errors/input_error.hpp"
#include "kinematics/random_arm.hpp"
#include "temporary_folder.hpp"

namespace demecal {
namespace {

CalibratedModel small_fleet() {
  CalibratedModel model;
  model.job = model.data_name = "fleet of 2 robots";
  model.version = "1.0";
  model.data_sha256 = "0123";
  model.nominal.chain = wrist_arm();
  model.nominal.name = "a type";
  DataSet none;
  none.robot = model.nominal;
  model.robot = nominal_robot(none);
  model.joints.resize(6);
  for (int joint = 0; joint < 6; ++joint) model.joints[static_cast<std::size_t>(joint)].joint = joint;
  const ParameterId number{ParameterId::Kind::link, 1, LinkParameter::a, {}};
  model.posterior = Posterior{{number}, {}, Eigen::MatrixXd::Constant(1, 1, 2e-4)};
  model.fleet = FleetOrigin{{{"one/model.yaml", "one", "data one", "11"}, {"two/model.yaml", "two", "data two", "22"}},
                            {{number.name(), 431.8, 0.02, 0.05}},
                            {{2, {1e-4, 5e-5}}}};
  return model;
}

TEST(FleetFile, ReadsBack) {
  const CalibratedModel written = small_fleet();
  const TemporaryFolder folder;
  const CalibratedModel read = load_model(folder.write("fleet.yaml", model_text(written)));
  ASSERT_TRUE(read.fleet);
  ASSERT_EQ(read.fleet->robots.size(), 2u);
  EXPECT_EQ(read.fleet->robots[1].file, "two/model.yaml");
  EXPECT_EQ(read.fleet->robots[1].job, "two");
  EXPECT_EQ(read.fleet->robots[1].data_name, "data two");
  EXPECT_EQ(read.fleet->robots[1].data_sha256, "22");
  ASSERT_EQ(read.fleet->numbers.size(), 1u);
  EXPECT_EQ(read.fleet->numbers[0].name, "joint 2 a_mm");
  EXPECT_EQ(read.fleet->numbers[0].mean, 431.8);
  EXPECT_EQ(read.fleet->numbers[0].standard_error, 0.02);
  EXPECT_EQ(read.fleet->numbers[0].spread, 0.05);
  ASSERT_EQ(read.fleet->curves.size(), 1u);
  EXPECT_EQ(read.fleet->curves[0].joint, 2);
  EXPECT_EQ(read.fleet->curves[0].wave_deviations_rad, (std::vector<double>{1e-4, 5e-5}));
}

TEST(FleetFile, IsRefusedWhereItsNumbersAreNotThoseOfThePosterior) {
  CalibratedModel model = small_fleet();
  model.fleet->numbers.clear();
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write("fleet.yaml", model_text(model));
  EXPECT_THROW(load_model(file), InputError);
}

}  // namespace
}  // namespace demecal
