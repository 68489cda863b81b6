#include "data_check/pendant_rounding.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "data/written_steps.hpp"
#include "data_check/pendant.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kCoarsestDigit_deg = 1.0, kCoarseDigit_deg = 0.1;
constexpr double kCoarsestDigit_mm = 1.0, kCoarseDigit_mm = 0.1;
constexpr double kCoarsestDigit_rad = 1e-2, kCoarseDigit_rad = 1e-3;
constexpr double kSlack = 1e-6;

/// The place of the last digit that values of this step need, at most `coarsest`: those that were sent to round values
/// may all be multiples of more. 0 where they have finer digits than `coarse`.
double digit(double step, double coarsest, double coarse) {
  if (step <= 0.0) return 0.0;
  const double place = std::min(std::pow(10.0, std::floor(std::log10(step) + kSlack)), coarsest);
  return place < (1.0 - kSlack) * coarse ? 0.0 : place;
}

}  // namespace

void PendantRounding::set_angle_digit(const Chain& chain, const std::vector<JointVector>& joints) {
  std::vector<double> angles;
  for (const JointVector& one : joints) {
    for (int joint = 0; joint < chain.size(); ++joint) {
      if (is_revolute(chain, joint)) angles.push_back(one[joint]);
    }
  }
  if (angles.empty()) return;
  const double in_deg_rad = decimal_step(angles, radians(1.0)), in_rad = decimal_step(angles, 1.0);
  in_radians_ = in_rad > in_deg_rad;
  step_rad_ = in_radians_ ? digit(in_rad, kCoarsestDigit_rad, kCoarseDigit_rad)
                          : radians(digit(degrees(in_deg_rad), kCoarsestDigit_deg, kCoarseDigit_deg));
}

PendantRounding::PendantRounding(const DataSet& data) {
  const Chain& chain = data.robot.chain;
  std::vector<JointVector> joints;
  std::vector<double> positions;
  for (const MeasuredPose& pose : data.poses) {
    joints.push_back(pose.joints);
    positions.insert(positions.end(), pose.position_m->begin(), pose.position_m->end());
  }
  const JointSteps steps = joint_steps(chain, joints);
  const auto turning = std::ranges::count_if(chain.joints, [](const Joint& joint) { return is_revolute(joint); });
  set_angle_digit(chain, joints);
  if (turning < chain.size()) slide_m_ = metres(digit(millimetres(steps.slide_m), kCoarsestDigit_mm, kCoarseDigit_mm));
  position_m_ = metres(digit(millimetres(decimal_step(positions, metres(1.0))), kCoarsestDigit_mm, kCoarseDigit_mm));
  if (step_rad_ + slide_m_ + position_m_ == 0.0) return;
  for (const MeasuredPose& pose : data.poses) {
    const Jacobian jacobian = joint_jacobian(chain, pose.joints, nominal_tool(data, pose));
    double squares_m2 = 3.0 * position_m_ * position_m_, most_m = 0.5 * std::sqrt(3.0) * position_m_;
    for (int joint = 0; joint < chain.size(); ++joint) {
      const double moved_m = (is_revolute(chain, joint) ? step_rad_ : slide_m_) * jacobian.col(joint).head<3>().norm();
      squares_m2 += moved_m * moved_m;
      most_m += 0.5 * moved_m;
    }
    rms_m_.push_back(std::max(std::sqrt(squares_m2 / 12.0), kPendantRounding_m / 3.0));
    most_m_.push_back(most_m + kPendantRounding_m);
  }
}

bool PendantRounding::accepts(const std::vector<double>& errors_m, const std::vector<TrialRow>& rows) const {
  constexpr double kMostRatio = 1.5;  ///< of root mean squares, which six poses keep
  // Joints that were sent to round values fit so well; of rounded ones few poses fit some change to more than that.
  constexpr double kExact_m = 2e-5;
  const double exact_m = is_coarse() ? kExact_m : kPendantRounding_m;
  double squares = 0.0;
  bool within = true;
  for (std::size_t i = 0; i < errors_m.size(); ++i) {
    const double most_m = believed_ ? most_m_[rows[i].pose] : exact_m;
    within = within && errors_m[i] <= most_m;
    if (believed_) squares += std::pow(errors_m[i] / rms_m_[rows[i].pose], 2);
  }
  return within && squares <= kMostRatio * kMostRatio * static_cast<double>(errors_m.size());
}

double PendantRounding::typical_m() const {
  if (!believed_) return kPendantRounding_m;
  double squares_m2 = 0.0;
  for (const double rms_m : rms_m_) squares_m2 += rms_m * rms_m;
  return std::sqrt(squares_m2 / static_cast<double>(rms_m_.size()));
}

double PendantRounding::told_rad() const {
  constexpr double kTold_rad = 1e-3;
  return believed_ ? std::max(kTold_rad, step_rad_) : kTold_rad;
}

std::string PendantRounding::sentence() const {
  std::string written;
  const auto add = [&](const char* what, double step, const char* unit) {
    if (step > 0.0) written += fmt::format("{}{} to {:g} {}", written.empty() ? "" : ", ", what, step, unit);
  };
  add("angles", in_radians_ ? step_rad_ : degrees(step_rad_), in_radians_ ? "rad" : "deg");
  add("sliding joints", millimetres(slide_m_), "mm");
  add("positions", millimetres(position_m_), "mm");
  return fmt::format(
      "The readings are rounded ({}), which alone puts points {:.2g} mm off (rms), {:.2g} mm at most: lengths and "
      "tools that differ by less, and zeros that differ by less than {:.2g} deg, are not told. Read off more digits.",
      written, millimetres(typical_m()), millimetres(*std::ranges::max_element(most_m_)), degrees(told_rad()));
}

}  // namespace demecal::inline data_check
