#include "mistakes.hpp"

#include <algorithm>
#include <cmath>

#include "kinematics/units.hpp"

namespace demecal::bench {
namespace {

void each_pose(DataSet& data, const std::function<void(MeasuredPose&)>& change) {
  for (MeasuredPose& pose : data.poses) change(pose);
}

void each_joint(DataSet& data, int joint, const std::function<double(double)>& change) {
  each_pose(data, [&](MeasuredPose& pose) { pose.joints[joint] = change(pose.joints[joint]); });
}

/// Measured points moved along the rows.
void shift_points(DataSet& data, std::size_t from, int by) {
  std::vector<Eigen::Vector3d> points;
  for (const MeasuredPose& pose : data.poses) points.push_back(*pose.position_m);
  const auto n = static_cast<int>(points.size());
  for (auto i = static_cast<int>(from); i < n; ++i)
    data.poses[static_cast<std::size_t>(i)].position_m = points[static_cast<std::size_t>((i + by + n) % n)];
}

Eigen::Isometry3d moved(RandomStream& random, double shift_m, double turn_rad) {
  Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d axis(random.normal(), random.normal(), random.normal());
  const Eigen::Vector3d way(random.normal(), random.normal(), random.normal());
  move.linear() = Eigen::AngleAxisd(turn_rad, axis.normalized()).toRotationMatrix();
  move.translation() = shift_m * way.normalized();
  return move;
}

/// A joint whose angle the tool point shows in more than the base or the tool would take.
int inner_joint(const DataSet& data, RandomStream& random) {
  return 1 + static_cast<int>(random.index(static_cast<std::size_t>(data.robot.chain.size() - 2)));
}

std::size_t any_pose(const DataSet& data, RandomStream& random) {
  return random.index(data.poses.size());
}

void exchange_rows(MistakenCase& one, RandomStream& random, int pairs) {
  for (int i = 0; i < pairs; ++i) {
    MeasuredPose& first = one.data.poses[any_pose(one.data, random)];
    MeasuredPose& second = one.data.poses[any_pose(one.data, random)];
    if ((*first.position_m - *second.position_m).norm() < 0.05 || std::ranges::count(one.poses, first.pose_id) > 0 ||
        std::ranges::count(one.poses, second.pose_id) > 0) {
      --i;
      continue;
    }
    std::swap(first.position_m, second.position_m);
    one.poses.push_back(first.pose_id);
    one.poses.push_back(second.pose_id);
  }
}

/// The other robot: same joints, another size and other offsets.
void take_other_robot(DataSet& data, RandomStream& random) {
  for (Joint& joint : data.robot.chain.joints) {
    joint.a_m *= random.real(1.15, 1.4);
    joint.d_m *= random.real(0.6, 0.85);
    if (joint.a_m != 0.0) joint.a_m += random.real(0.03, 0.08);
  }
}

}  // namespace

std::vector<Mistake> mistakes() {
  using Kind = FindingKind;
  std::vector<Mistake> all;
  const auto add = [&all](Kind kind, std::string what, std::function<void(MistakenCase&, RandomStream&)> make,
                          Make arm = {}) {
    all.push_back({kind, std::move(what), std::move(make), arm});
  };
  add(Kind::joint_sign, "sign of an inner joint", [](MistakenCase& one, RandomStream& random) {
    each_joint(one.data, inner_joint(one.data, random), [](double q) { return -q; });
  });
  add(Kind::joint_sign, "sign of joint 1",
      [](MistakenCase& one, RandomStream&) { each_joint(one.data, 0, [](double q) { return -q; }); });
  add(Kind::joint_sign, "sign of the last joint", [](MistakenCase& one, RandomStream&) {
    each_joint(one.data, one.data.robot.chain.size() - 1, [](double q) { return -q; });
  });
  add(Kind::joint_offset, "an inner joint off by 90 deg", [](MistakenCase& one, RandomStream& random) {
    const double by = random.chance(0.5) ? radians(90.0) : -radians(90.0);
    each_joint(one.data, inner_joint(one.data, random), [by](double q) { return q + by; });
  });
  add(Kind::joint_offset, "joint 2 off by 180 deg",
      [](MistakenCase& one, RandomStream&) { each_joint(one.data, 1, [](double q) { return q + radians(180.0); }); });
  add(Kind::joints_exchanged, "two joint columns exchanged", [](MistakenCase& one, RandomStream& random) {
    const int first = inner_joint(one.data, random);
    each_pose(one.data, [first](MeasuredPose& pose) { std::swap(pose.joints[first], pose.joints[first + 1]); });
  });
  add(Kind::axes_exchanged, "x and y exchanged, base frame",
      [](MistakenCase& one, RandomStream&) {
        each_pose(one.data, [](MeasuredPose& pose) { std::swap(pose.position_m->x(), pose.position_m->y()); });
      },
      {.base_frame = true});
  add(Kind::axes_exchanged, "y and z exchanged, instrument's frame", [](MistakenCase& one, RandomStream&) {
    each_pose(one.data, [](MeasuredPose& pose) { std::swap(pose.position_m->y(), pose.position_m->z()); });
  });
  add(Kind::mirrored, "x negated", [](MistakenCase& one, RandomStream&) {
    each_pose(one.data, [](MeasuredPose& pose) { pose.position_m->x() *= -1.0; });
  });
  add(Kind::mirrored, "z negated, base frame",
      [](MistakenCase& one, RandomStream&) {
        each_pose(one.data, [](MeasuredPose& pose) { pose.position_m->z() *= -1.0; });
      },
      {.base_frame = true});
  add(Kind::unit, "inches under mm", [](MistakenCase& one, RandomStream&) {
    each_pose(one.data, [](MeasuredPose& pose) { *pose.position_m /= 25.4; });
  });
  add(Kind::unit, "metres under mm", [](MistakenCase& one, RandomStream&) {
    each_pose(one.data, [](MeasuredPose& pose) { *pose.position_m /= 1000.0; });
  });
  add(Kind::unit, "radians under deg", [](MistakenCase& one, RandomStream&) {
    each_pose(one.data, [](MeasuredPose& pose) { pose.joints *= radians(1.0); });
  });
  add(Kind::convention, "the other convention", [](MistakenCase& one, RandomStream&) {
    Convention& convention = one.data.robot.chain.convention;
    convention = convention == Convention::standard_dh ? Convention::modified_dh : Convention::standard_dh;
  });
  add(Kind::convention, "joint 3 reported against the ground", [](MistakenCase& one, RandomStream&) {
    each_pose(one.data, [](MeasuredPose& pose) { pose.joints[2] -= pose.joints[1]; });
  });
  add(Kind::rows_shifted, "points shifted by a few rows", [](MistakenCase& one, RandomStream& random) {
    shift_points(one.data, 0, 1 + static_cast<int>(random.index(5)));
  });
  add(Kind::rows_shifted, "points shifted by one from a row on", [](MistakenCase& one, RandomStream& random) {
    shift_points(one.data, one.data.poses.size() / 4 + random.index(one.data.poses.size() / 2), 1);
  });
  add(Kind::rows_shuffled, "points in another order", [](MistakenCase& one, RandomStream& random) {
    for (std::size_t i = one.data.poses.size(); i > 1; --i)
      std::swap(one.data.poses[i - 1].position_m, one.data.poses[random.index(i)].position_m);
  });
  add(Kind::rows_exchanged, "two pairs of rows exchanged",
      [](MistakenCase& one, RandomStream& random) { exchange_rows(one, random, 2); });
  add(Kind::instrument_moved, "the instrument moved by some mm midway", [](MistakenCase& one, RandomStream& random) {
    const Eigen::Isometry3d move = moved(random, random.real(0.004, 0.02), random.real(0.0, 0.01));
    const std::size_t from = one.data.poses.size() / 4 + random.index(one.data.poses.size() / 2);
    for (std::size_t i = from; i < one.data.poses.size(); ++i)
      one.data.poses[i].position_m = move * *one.data.poses[i].position_m;
  });
  add(Kind::instrument_moved, "the instrument set up anew for the last poses",
      [](MistakenCase& one, RandomStream& random) {
        const Eigen::Isometry3d move = moved(random, random.real(0.5, 2.0), random.real(0.5, 2.0));
        for (std::size_t i = one.data.poses.size() * 3 / 4; i < one.data.poses.size(); ++i)
          one.data.poses[i].position_m = move * *one.data.poses[i].position_m;
      });
  add(Kind::set_in_other_frame, "validation in another frame", [](MistakenCase& one, RandomStream& random) {
    const Eigen::Isometry3d move = moved(random, random.real(0.005, 0.8), random.real(0.005, 0.5));
    for (const std::size_t i : poses_of(one.data, PoseSet::validation))
      one.data.poses[i].position_m = move * *one.data.poses[i].position_m;
  });
  add(Kind::wrong_tool, "accept with another tool", {});
  add(Kind::wrong_tool, "a tool that is not the robot file's", [](MistakenCase& one, RandomStream& random) {
    one.data.robot.chain.tool_m +=
        Eigen::Vector3d(random.real(0.02, 0.05), random.real(-0.05, -0.02), random.real(0.02, 0.08));
  });
  add(Kind::constant_joint, "a joint that stands still", {});
  add(Kind::degenerate_points, "points on a line", {});
  add(Kind::copied_rows, "rows copied with their ids", [](MistakenCase& one, RandomStream& random) {
    for (int i = 0; i < 2; ++i) {
      const std::size_t at = any_pose(one.data, random);
      one.data.poses.insert(one.data.poses.begin() + static_cast<std::ptrdiff_t>(at) + 1, one.data.poses[at]);
      one.poses.push_back(one.data.poses[at].pose_id);
    }
  });
  add(Kind::copied_rows, "a measured point copied into another row", [](MistakenCase& one, RandomStream& random) {
    const std::size_t at = random.index(one.data.poses.size() - 1);
    one.data.poses[at + 1].position_m = one.data.poses[at].position_m;
    one.poses.push_back(one.data.poses[at + 1].pose_id);
  });
  add(Kind::typing_error, "two digits of a joint", [](MistakenCase& one, RandomStream& random) {
    MeasuredPose& pose = one.data.poses[any_pose(one.data, random)];
    pose.joints[inner_joint(one.data, random)] += radians(random.chance(0.5) ? 9.0 : -27.0);
    one.poses.push_back(pose.pose_id);
  });
  add(Kind::typing_error, "joints of two rows", [](MistakenCase& one, RandomStream& random) {
    for (const double by_deg : {1.0, 40.0}) {
      MeasuredPose& pose = one.data.poses[any_pose(one.data, random)];
      if (std::ranges::count(one.poses, pose.pose_id) > 0) continue;
      pose.joints[inner_joint(one.data, random)] -= radians(by_deg);
      one.poses.push_back(pose.pose_id);
    }
  });
  add(Kind::outlier, "five outliers", [](MistakenCase& one, RandomStream& random) {
    for (int i = 0; i < 5; ++i) {
      MeasuredPose& pose = one.data.poses[any_pose(one.data, random)];
      *pose.position_m += moved(random, random.real(0.006, 0.025), 0.0).translation();
      if (std::ranges::count(one.poses, pose.pose_id) == 0) one.poses.push_back(pose.pose_id);
    }
  });
  add(Kind::other_robot, "another robot",
      [](MistakenCase& one, RandomStream& random) { take_other_robot(one.data, random); });
  return all;
}

}  // namespace demecal::bench
