#include "calibration/jury.hpp"

#include <cmath>
#include <limits>
#include <numeric>

#include "kinematics/units.hpp"

namespace demecal {

double sum(const SquaredErrors& errors) {
  return std::accumulate(errors.begin(), errors.end(), 0.0);
}

PairedDifference paired(const SquaredErrors& worse, const SquaredErrors& better) {
  const double n = static_cast<double>(worse.size());
  PairedDifference difference;
  for (std::size_t i = 0; i < worse.size(); ++i) difference.mean += (worse[i] - better[i]) / n;
  double squares = 0.0;
  for (std::size_t i = 0; i < worse.size(); ++i) squares += std::pow(worse[i] - better[i] - difference.mean, 2);
  difference.standard_error = n > 1 ? std::sqrt(squares / (n - 1) / n) : std::numeric_limits<double>::infinity();
  return difference;
}

Jury::Jury(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot) : data_(data) {
  for (const std::size_t index : poses) {
    const MeasuredPose& pose = data.poses[index];
    const MeasurementRows measured = rows_of(pose);
    if (measured.position + measured.distances == 0) continue;
    rows_ += measured.position > 0 ? measured.position : measured.distances;
    poses_.push_back(index);
    motions_.push_back(robot.motions(Stop(pose), pose.target));
  }
}

std::vector<JointVector> Jury::corrected(const CorrectedRobot& robot) const {
  std::vector<JointVector> joints;
  joints.reserve(poses_.size());
  for (const std::size_t pose : poses_) joints.push_back(robot.corrected_joints(data_.poses[pose].joints));
  return joints;
}

std::vector<JointVector> Jury::with(std::vector<JointVector> corrected, std::size_t joint,
                                    const JointCorrection& correction) const {
  const auto at = static_cast<Eigen::Index>(joint);
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const double commanded = data_.poses[poses_[i]].joints[at];
    corrected[i][at] = commanded + correction(commanded);
  }
  return corrected;
}

SquaredErrors Jury::squared_errors(const CorrectedRobot& robot, const std::vector<JointVector>& corrected) const {
  SquaredErrors errors;
  errors.reserve(poses_.size());
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const MeasuredPose& pose = data_.poses[poses_[i]];
    const Eigen::Isometry3d predicted = robot.predict(corrected[i], motions_[i], pose.target);
    errors.push_back(std::pow(millimetres(tool_error_m(predicted, data_, pose)), 2));
  }
  return errors;
}

}  // namespace demecal
