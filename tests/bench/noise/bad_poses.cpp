#include "bad_poses.hpp"

#include <fmt/format.h>

#include <cmath>

#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "measurement_noise.hpp"

namespace demecal::bench {
namespace {

constexpr double kLeastApart_m = 0.05;
constexpr double kLeastMistyped_m = 1e-3;
constexpr double kGrossShare = 0.02, kLeastGross_m = 1e-3, kMostGross_m = 1.0;

std::vector<std::string> exchange(DataSet& data, std::span<const std::size_t> among, RandomStream& random) {
  while (true) {
    MeasuredPose& first = data.poses[among[random.index(among.size())]];
    MeasuredPose& second = data.poses[among[random.index(among.size())]];
    if ((*first.position_m - *second.position_m).norm() < kLeastApart_m) continue;
    std::swap(first.position_m, second.position_m);
    return {first.pose_id, second.pose_id};
  }
}

double mistyped(double angle_rad, RandomStream& random) {
  switch (random.index(3)) {
    case 0:
      return with_digits_exchanged(angle_rad, random);
    case 1:
      return -angle_rad;
    default:
      return angle_rad + (random.chance(0.5) ? radians(10.0) : -radians(10.0));
  }
}

std::vector<std::string> mistype(DataSet& data, std::span<const std::size_t> among, RandomStream& random) {
  while (true) {
    MeasuredPose& pose = data.poses[among[random.index(among.size())]];
    JointVector typed = pose.joints;
    double& joint = typed[static_cast<Eigen::Index>(random.index(static_cast<std::size_t>(typed.size())))];
    joint = mistyped(joint, random);
    const Chain& chain = data.robot.chain;
    if ((tool_position(chain, typed) - tool_position(chain, pose.joints)).norm() < kLeastMistyped_m) continue;
    pose.joints = typed;
    return {pose.pose_id};
  }
}

std::vector<std::string> err_grossly(DataSet& data, std::span<const std::size_t> among, RandomStream& random) {
  const Offsets errors = gross_errors(among.size(), kGrossShare, kLeastGross_m, kMostGross_m, random);
  std::vector<std::string> bad;
  for (std::size_t i = 0; i < among.size(); ++i) {
    if (errors[i].isZero(0.0)) continue;
    *data.poses[among[i]].position_m += errors[i];
    bad.push_back(data.poses[among[i]].pose_id);
  }
  return bad;
}

}  // namespace

double with_digits_exchanged(double angle_rad, RandomStream& random) {
  std::string text = fmt::format("{:.2f}", degrees(angle_rad));
  std::vector<std::pair<std::size_t, std::size_t>> neighbours;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    const std::size_t next = text[i + 1] == '.' ? i + 2 : i + 1;
    const bool digits = text[i] >= '0' && text[i] <= '9';
    if (digits && text[i] != text[next]) neighbours.emplace_back(i, next);
  }
  if (neighbours.empty()) return angle_rad;
  const auto [first, second] = neighbours[random.index(neighbours.size())];
  std::swap(text[first], text[second]);
  return radians(std::stod(text));
}

std::vector<std::string> put_fault(Fault fault, DataSet& data, std::span<const std::size_t> among,
                                   RandomStream& random) {
  switch (fault) {
    case Fault::exchanged:
      return exchange(data, among, random);
    case Fault::typing:
      return mistype(data, among, random);
    case Fault::gross:
      return err_grossly(data, among, random);
    case Fault::none:
      break;
  }
  return {};
}

}  // namespace demecal::bench
