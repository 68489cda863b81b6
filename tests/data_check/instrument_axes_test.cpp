// Axes of the instrument that are stretched or not square are named, and never for what gears and elasticity do.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "data_check/check_data.hpp"
#include "data_files/data_set_file.hpp"
#include "measured_arm.hpp"
#include "mistaken_case.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

std::vector<Robot> arms_of_bench() {
  return bench::mistaken_arms(DEMECAL_SOURCE_DIR "/configs/robots");
}

std::string said(const DataCheck& check) {
  std::string all;
  for (const Finding& finding : check.findings) all += finding.sentence + "\n";
  return all;
}

struct WrongAxes {
  std::string words;
  double lower, upper;  ///< between which the number in the sentence lies
  std::function<void(Eigen::Vector3d&)> make;
};

std::vector<WrongAxes> wrong_axes() {
  return {{R"(^x of the measured positions is [0-9.]+ % \(([0-9]+) ppm\) too long)", 1800, 2200,
           [](Eigen::Vector3d& point) { point.x() *= 1.002; }},
          {R"(^y of the measured positions is [0-9.]+ % \(([0-9]+) ppm\) too short)", 1350, 1650,
           [](Eigen::Vector3d& point) { point.y() *= 0.9985; }},
          {R"(^z of the measured positions is [0-9.]+ % \(([0-9]+) ppm\) too long)", 1800, 2200,
           [](Eigen::Vector3d& point) { point.z() *= 1.002; }},
          {R"(^x and z of the measured positions are not square: their axes enclose ([0-9.]+) deg)", 89.81, 89.845,
           [](Eigen::Vector3d& point) { point.x() += 0.003 * point.z(); }}};
}

TEST(InstrumentAxes, ThatAreStretchedOrSkewedAreNamed) {
  for (const std::uint64_t seed : {21, 22}) {
    for (const Robot& arm : arms_of_bench()) {
      for (const WrongAxes& wrong : wrong_axes()) {
        DataSet data = bench::unmistaken_cases({arm}, 1, {.seed = seed}).front().data;
        for (MeasuredPose& pose : data.poses) wrong.make(*pose.position_m);
        const DataCheck check = check_data(data);
        const std::string of = arm.name + ", " + wrong.words + ":\n" + said(check);
        ASSERT_EQ(check.findings.size(), 1u) << of;
        const Finding& finding = check.findings.front();
        EXPECT_EQ(finding.kind, FindingKind::wrong_axes) << of;
        EXPECT_EQ(check.verdict(), DataVerdict::suspicious);
        std::smatch number;
        ASSERT_TRUE(std::regex_search(finding.sentence, number, std::regex(wrong.words))) << of;
        EXPECT_GT(std::stod(number[1]), wrong.lower) << of;
        EXPECT_LT(std::stod(number[1]), wrong.upper) << of;
        EXPECT_LT(finding.if_changed_mm, 0.75 * finding.as_given_mm) << of;
      }
    }
  }
}

TEST(InstrumentAxes, AreNotBlamedForAnArmThatYieldsAndTurnsUnevenly) {
  for (const std::uint64_t seed : {23, 24, 25}) {
    for (const Robot& arm : arms_of_bench()) {
      RandomStream random{seed};
      Scenario scenario = bench::scenario_of(arm, {.poses = {60, 20, 20}}, random);
      for (int joint = 0; joint < arm.chain.size(); ++joint) {
        scenario.compliance.push_back({joint, 8e-6 * random.real()});
        scenario.backlash.push_back({joint, 5e-4 * random.real()});
        for (const double times : {1.0, 2.0, 3.0})
          scenario.gear_harmonics.push_back({joint, times, 8e-4 * random.normal(), 8e-4 * random.normal()});
      }
      const DataCheck check = check_data(bench::dealt(scenario));
      EXPECT_FALSE(check.has(FindingKind::wrong_axes)) << arm.name << said(check);
    }
  }
}

TEST(InstrumentAxes, AreNotBlamedWhereThatWouldMendNothing) {
  const std::filesystem::path file =
      std::filesystem::path(DEMECAL_SOURCE_DIR) / "../shared/data/ur10-leica/series-a.yaml";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the measured robots are not on this machine: " << file;
  for (const std::size_t rows : {500, 600}) {
    DataSet data = load_data_set(file);
    data.poses.resize(rows);
    const DataCheck check = check_data(data);
    EXPECT_FALSE(check.has(FindingKind::wrong_axes)) << said(check);
  }
}

TEST(InstrumentAxes, AreRightWhereAllLengthsAreTooLong) {
  for (const Robot& arm : arms_of_bench()) {
    DataSet data = bench::unmistaken_cases({arm}, 1, {.seed = 26}).front().data;
    for (MeasuredPose& pose : data.poses) *pose.position_m *= 1.002;
    const DataCheck check = check_data(data);
    EXPECT_FALSE(check.has(FindingKind::wrong_axes)) << arm.name << said(check);
  }
}

}  // namespace
}  // namespace demecal
