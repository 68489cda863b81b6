// Where a contact is, and how far a tool point is from where the contact would have it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "data/contacts.hpp"

namespace demecal::inline prediction {

/// A place of a contact: a point at the frame's origin; a plane through it with the frame's z as normal; a sphere about
/// it; a line through it along z.
struct ContactPlace {
  ContactKind kind = ContactKind::point;
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  double radius_m = 0.0;         ///< of a sphere
  bool is_radius_known = false;  ///< then it is no number to be found
};

/// A tool point that touches something. A wire's far end is a sphere of radius 0 about which the point is at the length
/// that the wire shows.
struct Touch {
  Eigen::Vector3d point_m;
  double length_m = 0.0;
};

/// How far apart two places are, neither of them a line: points and centres of spheres from each other; where one is a
/// plane, its frame's origin or the other place from it (of two planes, the second from the first).
struct PlaceDistance {
  double length_m = 0.0;
  Eigen::Vector3d along = Eigen::Vector3d::Zero();  ///< unit; how it grows as the first place moves
};
PlaceDistance place_distance(const ContactPlace& first, const ContactPlace& second);

/// The motions that move a place of that kind: 0 to 2 along the frame's axes, 3 to 5 about them, kRadiusMotion.
inline constexpr int kRadiusMotion = 6;
std::vector<int> motions_of(const ContactPlace& place);

/// The place moved by so much of one of its motions: turns are about the axes of its own frame.
ContactPlace moved_place(ContactPlace place, int motion, double change);

/// How many numbers a touch of that kind tells.
int rows_of(ContactKind kind);

/// Where the contact would have the tool point minus where it is, along the frame's axes: rows_of() numbers, m.
Eigen::VectorXd contact_residual(const ContactPlace& place, const Touch& touch);

/// The change of the touched quantities (rows_of() x 3) with a motion of the tool point.
Eigen::Matrix<double, Eigen::Dynamic, 3> contact_jacobian(const ContactPlace& place, const Eigen::Vector3d& point_m);

/// The motion of the tool point at `point_m` that touches the same as a unit of a motion of the place would. `turn` is
/// the rotation vector that the frame has been turned by from that which the motions 3 to 5 are components of.
Eigen::Vector3d equivalent_motion(const ContactPlace& place, int motion, const Eigen::Vector3d& turn,
                                  const Eigen::Vector3d& point_m);

/// The direction along which a unit of one of the motions 0 to 2 shifts the place.
Eigen::Vector3d shift_axis(const ContactPlace& place, int motion, const Eigen::Vector3d& turn);

/// The direction (of unit length to first order) about which a unit of one of the motions 3 to 5 turns the place.
Eigen::Vector3d turn_axis(const ContactPlace& place, int motion, const Eigen::Vector3d& turn);

/// The place by least squares of the points that touch it; where there are too few of them, one that they fit.
ContactPlace contact_place(const ContactForm& form, const std::vector<Touch>& touches);

}  // namespace demecal::inline prediction
