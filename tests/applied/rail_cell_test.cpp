// An arm on a rail from its data over its calibration to programs: what the rail carries is determined, and corrected.
#include <gtest/gtest.h>

#include "calibrated_cell.hpp"
#include "data/text.hpp"
#include "kinematics/units.hpp"
#include "languages/languages.hpp"

namespace demecal {
namespace {

constexpr int kTargets = 30;

struct RailTargets {
  CalibratedCell cell;
  std::vector<JointVector> meant{};
};

RailTargets targets_on_rail(std::uint64_t seed) {
  RandomStream stream{seed};
  RailTargets targets{calibrated_cell(stream, 3)};
  while (!targets.cell.fitted || !targets.cell.ordinary) targets.cell = calibrated_cell(stream, 3);
  for (int i = 0; i < kTargets; ++i) targets.meant.push_back(joints_about(stream, targets.cell.middle, 0.5));
  return targets;
}

std::string number_list(const JointVector& joints) {
  std::string text = number_text(millimetres(joints[0]));
  for (const double angle : joints.tail<6>()) text += ',' + number_text(degrees(angle));
  return text;
}

/// The targets as joints of a table.
std::string table_of(const RailTargets& targets) {
  std::string text = "q1_mm,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,q7_deg\n";
  for (const JointVector& joints : targets.meant) text += number_list(joints) + '\n';
  return text;
}

/// The targets as poses of a KRL program, with the joints near each before it.
std::string krl_of(const RailTargets& targets) {
  const auto listed = [](std::span<const double> values, const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) text += names[i] + ' ' + number_text(values[i]) + ',';
    return text;
  };
  const std::vector<std::string> axes{"A1", "A2", "A3", "A4", "A5", "A6"}, pose{"X", "Y", "Z", "A", "B", "C"};
  std::string text = "DEF m()\n";
  for (const JointVector& joints : targets.meant) {
    const std::string rail = "E1 " + number_text(millimetres(joints[0])) + "}\n";
    const Eigen::Isometry3d tool = targets.cell.model.nominal_tool(joints);
    const Eigen::Vector3d turn = tool.linear().eulerAngles(2, 1, 0) * degrees(1.0), point = 1e3 * tool.translation();
    const JointVector angles = joints.tail<6>() * degrees(1.0);
    text += "PTP {" + listed({angles.data(), 6}, axes) + rail + "PTP {" +
            listed(std::vector<double>{point.x(), point.y(), point.z(), turn.x(), turn.y(), turn.z()}, pose) + rail;
  }
  return text + "END\n";
}

struct Misses {
  double before_m = 0.0, after_m = 0.0, worst_after_m = 0.0;  ///< root mean squares, and the largest
  int undetermined = 0, uncorrected = 0;
};

/// How far the real tool point is from where targets mean it, before and after the correction.
Misses misses_of(const CalibratedCell& cell, const CorrectedProgram& corrected) {
  Misses misses;
  for (const CorrectedTarget& target : corrected.targets) {
    for (const std::string& remark : target.remarks)
      misses.undetermined += remark.find("not determined") != remark.npos ? 1 : 0;
    if (target.is_uncorrected()) {
      ++misses.uncorrected;
      continue;
    }
    const auto miss_m = [&](const JointVector& joints) {
      return (cell.truth.robot.predict(Stop(joints), "").translation() - target.nominal_tool.translation()).norm();
    };
    misses.before_m += std::pow(miss_m(target.nominal), 2);
    misses.after_m += std::pow(miss_m(target.command), 2);
    misses.worst_after_m = std::max(misses.worst_after_m, miss_m(target.command));
  }
  const auto count = static_cast<double>(corrected.targets.size());
  misses.before_m = std::sqrt(misses.before_m / count);
  misses.after_m = std::sqrt(misses.after_m / count);
  return misses;
}

TEST(CalibratedRail, CorrectsWhatItCarries) {
  for (const std::uint64_t seed : {71u, 72u, 73u}) {
    SCOPED_TRACE(seed);
    const RailTargets targets = targets_on_rail(seed);
    for (const bool poses : {false, true}) {
      SCOPED_TRACE(poses ? "poses with E1" : "joints of a table");
      const std::string text = poses ? krl_of(targets) : table_of(targets);
      const Program program = read_program(*find_language(poses ? "krl" : "csv"), text, poses ? "p.src" : "p.csv",
                                           targets.cell.nominal.chain);
      const CorrectedProgram corrected = correct_program(text, program, targets.cell.model, {});
      ASSERT_EQ(corrected.targets.size(), static_cast<std::size_t>(poses ? 2 * kTargets : kTargets));
      const Misses misses = misses_of(targets.cell, corrected);
      EXPECT_EQ(misses.uncorrected, 0);
      EXPECT_LE(misses.undetermined, kTargets / 10) << "nearly all were, of numbers that belong to the base";
      EXPECT_GT(misses.before_m, 5e-4);
      EXPECT_LT(misses.after_m, 0.2 * misses.before_m);
      EXPECT_LT(misses.worst_after_m, misses.before_m);
    }
  }
}

}  // namespace
}  // namespace demecal
