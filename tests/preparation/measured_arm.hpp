// An arm with errors, measured by three cords: its program, its readings and its taught points as text.
#pragma once

#include <string>
#include <vector>

#include "data/text.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/random_arm.hpp"
#include "kinematics/units.hpp"
#include "languages/named_languages.hpp"
#include "preparation/prepared.hpp"
#include "random_measurements.hpp"

namespace demecal {

/// The numbers separated by `separator`, each with all its digits.
inline std::string numbers_text(const Eigen::VectorXd& values, const std::string& separator) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : separator) + number_text(value);
  return text;
}

/// What is true of a measurement, and what is written of it.
struct MeasuredArm {
  Robot robot;
  CordInstrument cords;
  Eigen::Isometry3d instrument_from_base;
  std::vector<JointVector> joints;
  std::vector<Eigen::Vector3d> seen_m;  ///< where the erring arm really stood; instrument's frame

  Eigen::Vector3d nominal_m(std::size_t pose) const { return tool_position(robot.chain, joints[pose]); }

  std::string val2() const {
    std::string text = ".PROGRAM t1\n MOVE mcp[1]\n.END\n.LOCATIONS\n";
    for (std::size_t i = 0; i < joints.size(); ++i) {
      text += "#cp[" + std::to_string(i + 1) + "] " +
              numbers_text(joints[i].unaryExpr([](double q) { return degrees(q); }), " ") + "\n";
    }
    return text + ".END\n";
  }

  /// In 1/16 mm, the tool turned by half a turn about x.
  std::string val2_poses(const std::string& array) const {
    std::string text = ".PROGRAM t1\n MOVE mcp[1]\n.END\n.LOCATIONS\n";
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const Eigen::Vector3d sixteenths = (16e3 * nominal_m(i)).array().round();
      text += array + "[" + std::to_string(i + 1) + "] 16384 0 0 0 -16384 0 0 0 -16384 " +
              numbers_text(sixteenths, " ") + "\n";
    }
    return text + ".END\n";
  }

  /// One reading of every pose in counts, by number.
  std::string readings() const {
    std::string text = "pose,a_counts,b_counts,c_counts\n";
    for (std::size_t i = 0; i < joints.size(); ++i) text += std::to_string(i + 1) + "," + counts(seen_m[i]) + "\n";
    return text;
  }

  std::string counts(const Eigen::Vector3d& point_m) const {
    const Eigen::Vector3d out_m = cord_lengths(cords.corners, point_m) - cords.top_cords_m;
    return numbers_text(out_m.cwiseProduct(*cords.counts_per_m) + cords.zero_counts, ",");
  }
};

/// `error_m` is the largest error along an axis; every pose has another.
inline MeasuredArm measured_arm(RandomStream& stream, std::size_t poses, double error_m) {
  MeasuredArm arm;
  arm.robot.name = "arm";
  arm.robot.chain = wrist_arm();
  arm.cords.corners = *cord_corners({1.5, 1.4, 1.3});
  arm.cords.top_cords_m = {0.101, 0.102, 0.103};
  arm.cords.counts_per_m = Eigen::Vector3d(20000, 20100, 19900);
  arm.cords.zero_counts = {5, -70, 100};
  arm.instrument_from_base = random_motion(stream);
  arm.instrument_from_base.linear() = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 9).normalized()).matrix();
  arm.instrument_from_base.translation() = Eigen::Vector3d(0.4, 0.5, 3.0);  // below the base, which all points clear
  for (std::size_t i = 0; i < poses; ++i) {
    arm.joints.push_back(0.5 * random_joints(stream, arm.robot.chain));
    arm.seen_m.emplace_back(arm.instrument_from_base * (arm.nominal_m(i) + random_point(stream, error_m)));
  }
  return arm;
}

inline PointFile point_file(const std::string& text, const Chain& chain, const std::string& file) {
  return {text, read_program(WrittenIn::val2, text, file, chain)};
}

/// What loading the files of this arm gives: one set, and a local frame of three exact points.
inline RawMeasurements raw_of(const MeasuredArm& arm) {
  RawMeasurements raw{.name = "cords", .file = "preparation.yaml", .robot = arm.robot, .local_frame = {}, .sets = {}};
  const ThreePoints base_m{Eigen::Vector3d(0.5, 0, 0), Eigen::Vector3d(0.9, 0.1, 0.2), Eigen::Vector3d(0.4, 0.6, 0.1)};
  TaughtPoints taught{base_m, {}};
  for (std::size_t i = 0; i < 3; ++i) taught.in_instrument_m[i] = arm.instrument_from_base * base_m[i];
  raw.local_frame = taught;
  RawSet set;
  set.joints = point_file(arm.val2(), arm.robot.chain, "cp.v2");
  set.readings = read_readings(table_of(arm.readings()), arm.cords);
  raw.sets.push_back(set);
  return raw;
}

}  // namespace demecal
