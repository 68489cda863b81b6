#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data_check/searches.hpp"
#include "decompositions/decompositions.hpp"
#include "kinematics/units.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "trials/finding.hpp"

namespace demecal::inline data_check {
namespace {

const double kAngleOff_rad = radians(3.0);  ///< what an arm as described may have an angle wrong by, and more
constexpr double kDeviations = 4.0;

/// A normal or direction, and how surely its touches tell it.
struct PlacedAxis {
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  double deviation_rad = 0.0;
};

std::optional<PlacedAxis> placed_axis(const DataSet& data, const CorrectedRobot& robot, const std::string& contact) {
  const ContactForm form = data.contacts.form_of(contact);
  std::vector<Touch> touches;
  for (const MeasuredPose& pose : data.poses)
    if (pose.contact == contact && pose.set == PoseSet::calibration) touches.push_back(touch_of(robot, pose));
  constexpr std::size_t kFewest = 4;
  if (touches.size() < kFewest) return std::nullopt;
  const ContactPlace place = contact_place(form, touches);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  double squares_m2 = 0.0;
  for (const Touch& touch : touches) {
    const Eigen::Vector3d off = touch.point_m - place.frame.translation();
    spread += off * off.transpose();
    squares_m2 += contact_residual(place, touch).squaredNorm();
  }
  // A plane turns about its longest extent most easily, a line about any axis across it.
  const double across_m2 = eigen_system_of_three(spread).values[form.kind == ContactKind::plane ? 1 : 2];
  const double noise_m2 = squares_m2 / static_cast<double>(touches.size() - kFewest + 1);
  if (!(across_m2 > 0.0)) return std::nullopt;
  return PlacedAxis{place.frame.linear().col(2), std::sqrt(noise_m2 / across_m2)};
}

}  // namespace

std::vector<Finding> find_wrong_angles(const DataSet& data, const CorrectedRobot& robot) {
  std::vector<Finding> found;
  for (const KnownAngle& known : data.contacts.angles) {
    const std::optional<PlacedAxis> first = placed_axis(data, robot, known.first);
    const std::optional<PlacedAxis> second = placed_axis(data, robot, known.second);
    if (!first || !second) continue;
    const double apart_rad = std::acos(std::min(1.0, std::abs(first->axis.dot(second->axis))));
    const double off_rad = known.square ? radians(90.0) - apart_rad : apart_rad;
    const double open_rad = std::hypot(known.sigma_rad, first->deviation_rad, second->deviation_rad);
    if (!(off_rad > kAngleOff_rad + kDeviations * open_rad)) continue;
    Finding finding{.kind = FindingKind::wrong_kind};
    finding.sentence = fmt::format(
        "'{}' and '{}' are {} as stated, and {:.1f} deg from that by the arm as described. Correct contacts.{}, or the "
        "names of the contacts.",
        known.first, known.second, known.square ? "square to one another" : "parallel", degrees(off_rad),
        known.square ? "square" : "parallel");
    found.push_back(std::move(finding));
  }
  return found;
}

}  // namespace demecal::inline data_check
