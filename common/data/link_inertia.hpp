// The inertia of a link: whether a body can have it, and that of several bodies as one.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/drawn_arm.hpp"

namespace demecal::inline data {

/// Of every link about its centre of mass, kg m^2, in the axes of the link's frame as its file draws it; nothing where
/// the file does not state it. An arm that stands still has no use for inertias: no robot holds them.
using LinkInertias = std::vector<std::optional<Eigen::Matrix3d>>;

/// Of xx, xy, xz, yy, yz, zz: the elements of the matrix, as URDFs and SDFs have them.
Eigen::Matrix3d symmetric_matrix(const std::array<double, 6>& elements);
std::array<double, 6> matrix_elements(const Eigen::Matrix3d& symmetric);

/// The same inertia in the axes in which `origin` states how its own are turned.
Eigen::Matrix3d turned_inertia(const Eigen::Matrix3d& inertia_kgm2, const Origin& origin);

/// Three moments about perpendicular axes through the centre of mass, about which a body's products are zero:
/// ascending.
Eigen::Vector3d principal_moments(const Eigen::Matrix3d& inertia_kgm2);

/// Why no body has this inertia about its centre of mass, as a rule: "must ..."; empty: one can. Rounding to 0.1 % of
/// the largest moment is allowed for.
std::string fault_of_inertia(const Eigen::Matrix3d& inertia_kgm2);

/// A body with its inertia about its own centre of mass, both in the axes and from the origin of one common frame.
struct InertialBody {
  LinkMass mass;
  Eigen::Matrix3d inertia_kgm2;
};

/// The inertia of rigidly joined bodies about the centre of mass of all (parallel axes).
Eigen::Matrix3d joint_inertia(std::span<const InertialBody> bodies, const Eigen::Vector3d& centre_m);

}  // namespace demecal::inline data
