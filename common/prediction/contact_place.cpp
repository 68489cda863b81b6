#include "prediction/contact_place.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "decompositions/decompositions.hpp"
#include "errors/check.hpp"
#include "kinematics/angles.hpp"

namespace demecal::inline prediction {
namespace {

using Touches = std::vector<Touch>;

Eigen::Vector3d mean_point(const Touches& touches) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Touch& touch : touches) mean += touch.point_m / static_cast<double>(touches.size());
  return mean;
}

/// The points' own axes as columns, by ascending extent.
Eigen::Matrix3d principal_axes(const Touches& touches, const Eigen::Vector3d& middle) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Touch& touch : touches) spread += (touch.point_m - middle) * (touch.point_m - middle).transpose();
  return eigen_system_of_three(spread).vectors;
}

/// A rotation whose z is that direction.
Eigen::Matrix3d frame_along(const Eigen::Vector3d& direction) {
  return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), direction).toRotationMatrix();
}

bool is_of_wire(const Touches& touches) {
  return std::ranges::any_of(touches, [](const Touch& touch) { return touch.length_m > 0.0; });
}

/// Centre and radius of the sphere through points, linear in x^2 - l^2 = 2 c x + (r^2 - c^2), l a wire's length, whose
/// zero is taken to be right; few points give the smallest.
void fit_sphere(const Touches& touches, ContactPlace& place) {
  const Eigen::Vector3d middle = place.frame.translation();
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(touches.size()), 4);
  Eigen::VectorXd squares(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const Touch& touch = touches[static_cast<std::size_t>(i)];
    const Eigen::Vector3d off = touch.point_m - middle;
    rows.row(i) << 2.0 * off.transpose(), 1.0;
    squares[i] = off.squaredNorm() - touch.length_m * touch.length_m;
  }
  const Eigen::Vector4d found = least_norm_solution(rows, squares);
  place.frame.translation() = middle + found.head<3>();
  if (!place.is_radius_known && !is_of_wire(touches))
    place.radius_m = std::sqrt(std::max(found[3] + found.head<3>().squaredNorm(), 0.0));
}

/// Gauss and Newton's steps from a place nearby.
void refine_sphere(const Touches& touches, ContactPlace& place) {
  constexpr int kSteps = 20;
  const Eigen::Index numbers = place.is_radius_known ? 3 : 4;
  if (std::ssize(touches) < numbers) return;
  for (int step = 0; step < kSteps; ++step) {
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(touches.size()), 4);
    Eigen::VectorXd left(rows.rows());
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      const Touch& touch = touches[static_cast<std::size_t>(i)];
      rows.row(i) << -contact_jacobian(place, touch.point_m), -1.0;
      left[i] = contact_residual(place, touch)[0];
    }
    const Eigen::VectorXd change = least_norm_solution(rows.leftCols(numbers), left);
    if (!change.allFinite()) return;
    place.frame.translation() += change.head<3>();
    if (!place.is_radius_known) place.radius_m += change[3];
  }
}

ContactPlace place_by_least_squares(const ContactForm& form, const Touches& touches) {
  constexpr double kShortest_m = 1e-9;
  ContactPlace place{form.kind, Eigen::Isometry3d::Identity(), form.radius_m.value_or(0.0), form.radius_m.has_value()};
  const Eigen::Vector3d middle = mean_point(touches);
  place.frame.translation() = middle;
  if (form.kind == ContactKind::plane || form.kind == ContactKind::line) {
    const Eigen::Vector3d axis = principal_axes(touches, middle).col(form.kind == ContactKind::plane ? 0 : 2);
    if (axis.norm() > kShortest_m) place.frame.linear() = frame_along(axis);
  }
  if (form.kind == ContactKind::sphere) {
    fit_sphere(touches, place);
    refine_sphere(touches, place);
  }
  return place;
}

double middle_value(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<double> off_place_m(const ContactPlace& place, const Touches& touches) {
  std::vector<double> all;
  for (const Touch& touch : touches) all.push_back(contact_residual(place, touch).norm());
  return all;
}

/// The touches that lie no farther off than `most_m`.
Touches touches_within(const Touches& touches, const std::vector<double>& off_m, double most_m) {
  Touches near;
  for (std::size_t i = 0; i < touches.size(); ++i)
    if (off_m[i] <= most_m) near.push_back(touches[i]);
  return near;
}

/// The place of three quarters of the touches: those that lie `off_m` least, then those that are nearest to their own
/// place, in turn (least trimmed squares).
ContactPlace place_of_most(const ContactForm& form, const Touches& touches, std::vector<double> off_m) {
  constexpr int kMostTurns = 10;
  const std::ptrdiff_t last = 3 * std::ssize(touches) / 4;
  ContactPlace place;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    std::vector<double> ordered = off_m;
    std::nth_element(ordered.begin(), ordered.begin() + last, ordered.end());
    place = place_by_least_squares(form, touches_within(touches, off_m, ordered[static_cast<std::size_t>(last)]));
    std::vector<double> next_m = off_place_m(place, touches);
    if (next_m == off_m) break;
    off_m = std::move(next_m);
  }
  return place;
}

/// How far touches are from the middle of most of them, which few that touched something else cannot move.
std::vector<double> from_middle_m(const Touches& touches) {
  Eigen::Vector3d middle;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> along;
    for (const Touch& touch : touches) along.push_back(touch.point_m[axis]);
    middle[axis] = middle_value(std::move(along));
  }
  std::vector<double> all;
  for (const Touch& touch : touches) all.push_back((touch.point_m - middle).norm());
  return all;
}

}  // namespace

PlaceDistance place_distance(const ContactPlace& first, const ContactPlace& second) {
  const Eigen::Vector3d apart = first.frame.translation() - second.frame.translation();
  const bool first_is_plane = first.kind == ContactKind::plane;
  if (!first_is_plane && second.kind != ContactKind::plane) return {apart.norm(), apart.stableNormalized()};
  const Eigen::Vector3d normal = (first_is_plane ? first : second).frame.linear().col(2);
  const double across_m = normal.dot(apart);
  return {std::abs(across_m), across_m < 0.0 ? Eigen::Vector3d(-normal) : normal};
}

std::vector<int> motions_of(const ContactPlace& place) {
  switch (place.kind) {
    case ContactKind::point:
      return {0, 1, 2};
    case ContactKind::plane:
      return {2, 3, 4};
    case ContactKind::sphere:
      return place.is_radius_known ? std::vector<int>{0, 1, 2} : std::vector<int>{0, 1, 2, kRadiusMotion};
    case ContactKind::line:
      return {0, 1, 3, 4};
  }
  DEMECAL_CHECK(false, "contact kind=" << static_cast<int>(place.kind));
  return {};
}

ContactPlace moved_place(ContactPlace place, int motion, double change) {
  const Eigen::Matrix3d axes = place.frame.linear();
  if (motion == kRadiusMotion) {
    place.radius_m += change;
  } else if (motion < 3) {
    place.frame.translation() += change * axes.col(motion);
  } else {
    place.frame.linear() = Eigen::AngleAxisd(change, axes.col(motion - 3)) * axes;
  }
  return place;
}

int rows_of(ContactKind kind) {
  return kind == ContactKind::point ? 3 : kind == ContactKind::line ? 2 : 1;
}

Eigen::VectorXd contact_residual(const ContactPlace& place, const Touch& touch) {
  const Eigen::Vector3d off = place.frame.inverse() * touch.point_m;
  switch (place.kind) {
    case ContactKind::point:
      return -off;
    case ContactKind::plane:
      return Eigen::VectorXd::Constant(1, -off.z());
    case ContactKind::sphere:
      return Eigen::VectorXd::Constant(1, place.radius_m + touch.length_m - off.norm());
    case ContactKind::line:
      return -off.head<2>();
  }
  DEMECAL_CHECK(false, "contact kind=" << static_cast<int>(place.kind));
  return {};
}

Eigen::Matrix<double, Eigen::Dynamic, 3> contact_jacobian(const ContactPlace& place, const Eigen::Vector3d& point_m) {
  const Eigen::Matrix3d to_frame = place.frame.linear().transpose();
  switch (place.kind) {
    case ContactKind::point:
      return to_frame;
    case ContactKind::plane:
      return to_frame.row(2);
    case ContactKind::sphere:
      return (point_m - place.frame.translation()).stableNormalized().transpose();
    case ContactKind::line:
      return to_frame.topRows<2>();
  }
  DEMECAL_CHECK(false, "contact kind=" << static_cast<int>(place.kind));
  return {};
}

Eigen::Vector3d equivalent_motion(const ContactPlace& place, int motion, const Eigen::Vector3d& turn,
                                  const Eigen::Vector3d& point_m) {
  const Eigen::Vector3d off = point_m - place.frame.translation();
  if (motion == kRadiusMotion) return -off.stableNormalized();
  if (motion < 3) return -shift_axis(place, motion, turn);
  return -turn_axis(place, motion, turn).cross(off);
}

Eigen::Vector3d shift_axis(const ContactPlace& place, int motion, const Eigen::Vector3d& turn) {
  return (place.frame.linear() * rotation_of(turn).transpose()).col(motion);
}

Eigen::Vector3d turn_axis(const ContactPlace& place, int motion, const Eigen::Vector3d& turn) {
  // The frame is reference * exp(turn); a step of the vector turns it by left_jacobian(turn), seen in the reference.
  const Eigen::Matrix3d reference = place.frame.linear() * rotation_of(turn).transpose();
  return reference * left_jacobian(turn).col(motion - 3);
}

ContactPlace contact_place(const ContactForm& form, const Touches& touches) {
  constexpr std::size_t kMany = 12;
  constexpr double kOffMost = 20.0;    // times what the middle touch is off the place of most: no noise goes so far
  constexpr double kOffMiddle = 10.0;  // times as far from the middle of most as the middle touch: no ball is so long
  const ContactPlace of_all = place_by_least_squares(form, touches);
  if (form.kind == ContactKind::point || touches.size() < kMany || is_of_wire(touches)) return of_all;
  const auto are_few_fewer = [&](const Touches& near) {
    return near.size() < touches.size() && 4 * near.size() >= 3 * touches.size();
  };
  const std::vector<double> of_all_m = off_place_m(of_all, touches), away_m = from_middle_m(touches);
  for (const std::vector<double>& start_m : {away_m, of_all_m}) {
    const std::vector<double> off_m = off_place_m(place_of_most(form, touches, start_m), touches);
    const double most_m = middle_value(off_m);
    const Touches near = touches_within(touches, off_m, kOffMost * most_m);
    if (most_m < middle_value(of_all_m) && are_few_fewer(near)) return place_by_least_squares(form, near);
  }
  const Touches near = touches_within(touches, away_m, kOffMiddle * middle_value(away_m));
  return form.kind == ContactKind::sphere && are_few_fewer(near) ? place_by_least_squares(form, near) : of_all;
}

}  // namespace demecal::inline prediction
