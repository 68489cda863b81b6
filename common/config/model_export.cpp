#include "config/model_export.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>

#include "closed_calibration/links_alone.hpp"
#include "data/data_set.hpp"
#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/drawn_arm.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"
#include "programs/command_model.hpp"
#include "urdf/urdf_arm.hpp"
#include "urdf/urdf_file.hpp"
#include "yaml/files.hpp"

namespace demecal::inline config {
namespace {

std::string rounded_mm_text(double length_m) {
  return number_text(std::round(1e6 * length_m) / 1e3) + " mm";
}

bool same_origin(const Origin& one, const Origin& other) {
  constexpr double kRounding = 1e-9;
  return (pose_of(one).matrix() - pose_of(other).matrix()).cwiseAbs().maxCoeff() < kRounding;
}

/// The joints of the file are those that the robot was imported from.
void check_source(const UrdfArm& arm, const DrawnArm& drawing, const std::string& file) {
  const bool count = arm.drawing.joints.size() == drawing.joints.size();
  for (std::size_t i = 0; count && i < drawing.joints.size(); ++i) {
    const DrawnJoint &one = arm.drawing.joints[i], &other = drawing.joints[i];
    const bool same_axis = (one.axis.normalized() - other.axis.normalized()).norm() < 1e-9;
    if (same_axis && same_origin(one.origin, other.origin)) continue;
    throw InputError({file, arm.joints[i]->line}, one.name,
                     "is not the joint " + std::to_string(i + 1) +
                         " that the robot was imported with: its origin or axis differs; export into that file, or "
                         "import this one and calibrate again");
  }
  if (!count) {
    throw InputError({file, 0}, std::to_string(arm.drawing.joints.size()),
                     "is not the number of joints that the robot was imported with");
  }
}

std::string urdf_path(const CalibratedModel& model, const std::string& file) {
  if (!file.empty()) return file;
  std::error_code ignored;
  if (std::filesystem::exists(model.nominal.urdf->file, ignored)) return model.nominal.urdf->file;
  throw InputError({model.nominal.urdf->file, 0}, "",
                   "is the URDF that the robot was imported from, and is no longer there; say --urdf FILE");
}

ExportedArm rewritten(const CalibratedModel& model, const CorrectedRobot& robot, const std::string& source) {
  if (model.nominal.chain.positioner > 0)
    throw InputError({source, 0}, "", "has no positioner, where the model begins: export it in another format");
  const std::string text = read_file(source);
  const UrdfFile urdf = parse_urdf(text, source);
  const UrdfArm arm = arm_between(urdf, model.nominal.urdf->base, model.nominal.urdf->tip);
  const DrawnArm& drawing = *model.nominal.drawing;
  check_source(arm, drawing, source);
  const std::vector<Origin> origins = origins_of(drawing, robot.chain);
  std::vector<NewOrigin> changes;
  double most_m = 0.0, most_rad = 0.0;
  for (std::size_t i = 0; i < origins.size(); ++i) {
    const Eigen::Isometry3d own = arm.before[i].inverse() * pose_of(origins[i]);
    changes.push_back({arm.joints[i], origin_of(own, arm.joints[i]->origin)});
    const Eigen::Isometry3d change = pose_of(arm.joints[i]->origin).inverse() * own;
    most_m = std::max(most_m, change.translation().norm());
    most_rad = std::max(most_rad, vector_of(change.linear()).norm());
  }
  return {with_origins(text, changes),
          {"origins of " + std::to_string(origins.size()) + " joints moved by " + rounded_mm_text(most_m) + " and " +
           number_text(std::round(degrees(most_rad) * 1e4) / 1e4) + " deg at most"}};
}

}  // namespace

CorrectedRobot in_own_base(const CalibratedModel& model) {
  const CorrectedRobot robot =
      model.declared.registration ? without_base(model.robot, model.nominal.chain) : model.robot;
  return command_model(model.nominal, robot, std::vector<double>(robot.chain.joints.size(), 0.0)).robot;
}

std::vector<std::string> lacks_of_links(const CalibratedModel& model, const LinksAlone& alone) {
  std::vector<std::string> notes;
  const Eigen::Vector3d tool_m = alone.links.tool("").translation();
  if (alone.most_m > 0.0)
    notes.push_back("joint corrections and effects are left out, for links cannot hold them" +
                    std::string(alone.fitted ? ", and the links are those that come nearest to them" : "") +
                    ": at random poses of the measured ranges, come to from either side, the tool is off by " +
                    rounded_mm_text(alone.mean_m) + " on average and " + rounded_mm_text(alone.most_m) +
                    " at most (neither heat nor time counted); `apply` and `export --format c` hold them");
  if (!model.declared.registration && !model.job.empty())
    notes.emplace_back(
        "links begin at the arm's base as described, for where it stands was not fitted: the first joint's zero and "
        "height are those of the drawing where they were not measured otherwise");
  if ((tool_m - model.nominal.chain.tool_m).norm() > 1e-6)
    notes.push_back("the tool point is left out: identified at " + rounded_mm_text(tool_m.x()) + ", " +
                    rounded_mm_text(tool_m.y()) + ", " + rounded_mm_text(tool_m.z()) + " in the flange's frame");
  return notes;
}

ExportedArm calibrated_urdf(const CalibratedModel& model, const std::string& file) {
  const LinksAlone alone = links_alone(model, in_own_base(model));
  const CorrectedRobot& robot = alone.links;
  ExportedArm exported;
  if (model.nominal.urdf && model.nominal.drawing && model.nominal.drawing->by_axes) {
    exported = rewritten(model, robot, urdf_path(model, file));
  } else {
    if (!file.empty()) {
      throw InputError({file, 0}, model.nominal.name,
                       "is a robot that was not imported from a URDF; without --urdf a new one is written");
    }
    exported = {plain_urdf(model.nominal, robot.chain),
                {"the robot was not imported from a URDF; a new one of links without bodies is written"}};
    if (model.nominal.chain.positioner > 0)
      exported.notes.emplace_back(
          "its link base is the workpiece on the positioner, whose joints stand before the arm's");
  }
  if (!robot.chain.couplings.empty())
    exported.notes.emplace_back("couplings between joints are left out: joint values are those of the drives");
  for (std::string& lack : lacks_of_links(model, alone)) exported.notes.push_back(std::move(lack));
  return exported;
}

ExportedArm ros2_parameters(const CalibratedModel& model, const std::string& file) {
  ExportedArm exported = calibrated_urdf(model, file);
  std::istringstream urdf(exported.text);
  std::string text = "/**:\n  ros__parameters:\n    robot_description: |2\n";
  for (std::string line; std::getline(urdf, line);) {
    if (line.ends_with('\r')) line.pop_back();
    text += line.empty() ? "\n" : "      " + line + "\n";
  }
  exported.text = text;
  return exported;
}

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

std::string rounded_number_text(double value) {
  const double near = std::round(value * 1e12) / 1e12;
  return number_text(near == 0.0 ? 0.0 : near);
}

}  // namespace

ExportedArm ur_calibration(const CalibratedModel& model) {
  const DriverArm driver = driver_arm(model);
  const LinksAlone alone = links_alone(model, in_own_base(model));
  ExportedArm exported{"", lacks_of_links(model, alone)};
  const std::vector<Eigen::Isometry3d> frames = frames_on_axes(alone.links.chain);
  std::ostringstream text;
  text << "kinematics:\n";
  Eigen::Isometry3d before = driver.base;
  for (std::size_t i = 0; i < kLinks.size(); ++i) {
    const Eigen::Isometry3d link = frames[i] * driver.on_axes[i];
    const Origin origin = origin_of(before.inverse() * link, usual_angles(i));
    text << "  " << kLinks[i] << ":\n    x: " << rounded_number_text(origin.xyz_m.x())
         << "\n    y: " << rounded_number_text(origin.xyz_m.y()) << "\n    z: " << rounded_number_text(origin.xyz_m.z())
         << "\n    roll: " << rounded_number_text(origin.rpy_rad.x())
         << "\n    pitch: " << rounded_number_text(origin.rpy_rad.y())
         << "\n    yaw: " << rounded_number_text(origin.rpy_rad.z()) << '\n';
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
