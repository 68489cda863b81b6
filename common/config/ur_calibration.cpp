#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <sstream>

#include "config/model_export.hpp"
#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "kinematics/drawn_arm.hpp"
#include "kinematics/units.hpp"
#include "yaml/files.hpp"

namespace demecal::inline config {
namespace {

constexpr std::array<const char*, 6> kLinks{"shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3"};

/// Behind every joint's own turn and offset, all joints at 0; last the flange. Each stands on its joint's axis.
std::vector<Eigen::Isometry3d> frames_on_axes(const Chain& chain) {
  std::vector<Eigen::Isometry3d> frames;
  Eigen::Isometry3d frame = chain.base;
  for (const Joint& row : chain.joints) {
    for (const Elementary& transform : elementary_transforms(chain.convention)) {
      advance(frame, transform, row.parameter(transform.parameter));
      if (transform.parameter == LinkParameter::d) frames.push_back(frame);
    }
  }
  frames.push_back(frame * chain.flange);
  return frames;
}

Eigen::Isometry3d about_x(double angle_rad) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitX()));
}

/// The frames that the driver's names stand for, all joints at 0, in its own base: by the dimensions that the axes
/// show.
std::vector<Eigen::Isometry3d> driver_frames(const std::vector<Eigen::Isometry3d>& seen) {
  constexpr double kRight = std::numbers::pi / 2.0;
  const auto at = [&](std::size_t joint) -> Eigen::Vector3d { return seen[joint].translation(); };
  const double d1 = at(1).z(), d4 = -at(4).y(), d5 = d1 - at(5).z(), d6 = -at(6).y() - d4;
  const double elbow = at(2).x(), wrist = at(3).x();
  const auto place = [](double x, double y, double z, double roll) {
    return Eigen::Isometry3d(Eigen::Translation3d(x, y, z) * about_x(roll));
  };
  return {place(0, 0, d1, 0),
          place(0, 0, d1, kRight),
          place(elbow, 0, d1, kRight),
          place(wrist, -d4, d1, kRight),
          place(wrist, -d4, d1 - d5, 2.0 * kRight),
          place(wrist, -d4 - d6, d1 - d5, kRight)};
}

/// Whether the frame on an axis differs from the driver's by what is along and about that axis alone.
bool on_same_axis(const Eigen::Isometry3d& one, const Eigen::Isometry3d& other) {
  constexpr double kSame_m = 1e-4, kSame_rad = 1e-3;
  const Eigen::Isometry3d between = one.inverse() * other;
  return between.translation().head<2>().norm() < kSame_m &&
         (between.linear().col(2) - Eigen::Vector3d::UnitZ()).norm() < kSame_rad;
}

struct DriverArm {
  Eigen::Isometry3d base;                  ///< of the driver, in the arm's
  std::vector<Eigen::Isometry3d> on_axes;  ///< the driver's frames in those on the axes
};

DriverArm driver_arm(const CalibratedModel& model) {
  const std::vector<Eigen::Isometry3d> frames = frames_on_axes(model.nominal.chain);
  for (const double turn_rad : {0.0, std::numbers::pi}) {
    if (frames.size() != kLinks.size() + 1) break;
    DriverArm arm{Eigen::Isometry3d(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ())), {}};
    std::vector<Eigen::Isometry3d> seen;
    for (const Eigen::Isometry3d& frame : frames) seen.push_back(arm.base.inverse() * frame);
    const std::vector<Eigen::Isometry3d> driver = driver_frames(seen);
    bool same = driver[2].translation().x() < 0.0 && model.nominal.chain.couplings.empty();
    for (std::size_t i = 0; i < driver.size(); ++i) {
      same = same && on_same_axis(seen[i], driver[i]);
      arm.on_axes.push_back(seen[i].inverse() * driver[i]);
    }
    if (same) return arm;
  }
  throw InputError({}, model.nominal.name,
                   "is no arm of Universal Robots, whose axes all joints at 0 are up, three times forward, down and "
                   "forward: their driver's calibration cannot hold it");
}

/// Angles as the driver's own files have them.
Origin usual_angles(std::size_t link) {
  constexpr double kRight = std::numbers::pi / 2.0;
  if (link == 1 || link == 4) return {{}, {kRight, 0.0, 0.0}};
  if (link == 5) return {{}, {kRight, std::numbers::pi, std::numbers::pi}};
  return {};
}

std::string rounded(double value) {
  const double near = std::round(value * 1e12) / 1e12;
  return number_text(near == 0.0 ? 0.0 : near);
}

}  // namespace

ExportedArm ur_calibration(const CalibratedModel& model) {
  const DriverArm driver = driver_arm(model);
  ExportedArm exported{"", lacks_of_links(model)};
  const std::vector<Eigen::Isometry3d> frames = frames_on_axes(in_own_base(model).chain);
  std::ostringstream text;
  text << "kinematics:\n";
  Eigen::Isometry3d before = driver.base;
  for (std::size_t i = 0; i < kLinks.size(); ++i) {
    const Eigen::Isometry3d link = frames[i] * driver.on_axes[i];
    const Origin origin = origin_of(before.inverse() * link, usual_angles(i));
    text << "  " << kLinks[i] << ":\n    x: " << rounded(origin.xyz_m.x()) << "\n    y: " << rounded(origin.xyz_m.y())
         << "\n    z: " << rounded(origin.xyz_m.z()) << "\n    roll: " << rounded(origin.rpy_rad.x())
         << "\n    pitch: " << rounded(origin.rpy_rad.y()) << "\n    yaw: " << rounded(origin.rpy_rad.z()) << '\n';
    before = link;
  }
  const std::string hash = sha256(text.str());
  text << "  hash: calib_" << std::stoull(hash.substr(0, 15), nullptr, 16) << '\n';
  exported.text = text.str();
  exported.notes.emplace_back(
      "the hash is of these numbers; the driver compares it with the one in the robot and warns that it differs");
  return exported;
}

}  // namespace demecal::inline config
