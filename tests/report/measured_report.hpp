// A report's poses, as measured in a grid about an arm, for pages and tables.
#pragma once

#include <cmath>
#include <string>

#include "calibration/erring_arm.hpp"
#include "prediction/measurement.hpp"
#include "report/make_report.hpp"
#include "report/report.hpp"

namespace demecal {

/// With `count` poses of a PUMA that errs by its joints, in three sets, with times and temperatures.
inline Report with_measured_poses(Report report, int count) {
  const DataSet data =
      measure(true_puma({"", "0.0004*SIN(3*theta)", "0.0003*COS(2*theta)", "", "", ""}), count, 5e-5, 11, false);
  const CorrectedRobot before = nominal_robot(data);
  const CorrectedRobot after = true_puma({"", "0.0004*SIN(3*theta)", "", "", "", ""});
  report.pose_errors.clear();
  for (std::size_t i = 0; i < data.poses.size(); ++i) {
    const MeasuredPose& pose = data.poses[i];
    PoseErrorEntry entry;
    entry.id = pose.pose_id;
    entry.set = i % 5 == 0 ? "accept" : i % 3 == 2 ? "validation" : "calibration";
    entry.before_mm = 1e3 * tool_error_m(before, data, pose);
    entry.after_mm = 1e3 * tool_error_m(after, data, pose);
    entry.interval95_mm = 0.4;
    if (i % 37 == 5) entry.flags = {"outlier"};
    if (i % 41 == 7) entry.flags.emplace_back("outside_measured");
    entry.place = pose_place(data, pose, before, after);
    entry.place.time_s = 12.0 * static_cast<double>(i);
    entry.place.temperature_celsius = 20.0 + 5.0 * (1.0 - std::exp(-static_cast<double>(i) / 90.0));
    report.pose_errors.push_back(entry);
  }
  report.arm = arm_entry(after, "");
  return report;
}

}  // namespace demecal
