#include "data/link_inertia.hpp"

#include <cmath>

#include "data/text.hpp"
#include "decompositions/decompositions.hpp"

namespace demecal::inline data {
namespace {

/// To four digits.
std::string moments_text(const Eigen::Vector3d& moments) {
  std::string text;
  for (int i = 0; i < 3; ++i) {
    const double size = moments[i] == 0.0 ? 0.0 : std::floor(std::log10(std::abs(moments[i])));
    const double unit = std::pow(10.0, 3.0 - size);
    text += (i == 0 ? "" : i == 1 ? ", " : " and ") + number_text(std::round(moments[i] * unit) / unit);
  }
  return text + " kg m^2";
}

}  // namespace

Eigen::Matrix3d symmetric_matrix(const std::array<double, 6>& elements) {
  const auto [xx, xy, xz, yy, yz, zz] = elements;
  Eigen::Matrix3d matrix;
  matrix << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return matrix;
}

std::array<double, 6> matrix_elements(const Eigen::Matrix3d& symmetric) {
  return {symmetric(0, 0), symmetric(0, 1), symmetric(0, 2), symmetric(1, 1), symmetric(1, 2), symmetric(2, 2)};
}

Eigen::Matrix3d turned_inertia(const Eigen::Matrix3d& inertia_kgm2, const Origin& origin) {
  if (origin.rpy_rad.isZero(0.0)) return inertia_kgm2;
  const Eigen::Matrix3d turn = pose_of(origin).linear();
  return turn * inertia_kgm2 * turn.transpose();
}

Eigen::Vector3d principal_moments(const Eigen::Matrix3d& inertia_kgm2) {
  return eigen_system_of_three(inertia_kgm2).values;
}

std::string fault_of_inertia(const Eigen::Matrix3d& inertia_kgm2) {
  constexpr double kRounding = 1e-3;
  const Eigen::Vector3d moments = principal_moments(inertia_kgm2);
  const double slack = kRounding * moments.cwiseAbs().maxCoeff();
  const std::string shown = moments_text(moments);
  if (moments[0] < -slack) return "must have no negative principal moment, as no body has one; its are " + shown;
  if (moments[0] + moments[1] < moments[2] - slack)
    return "must have principal moments of which none exceeds the sum of the other two, as those of any body about its "
           "centre of mass; its are " +
           shown;
  return "";
}

Eigen::Matrix3d joint_inertia(std::span<const InertialBody> bodies, const Eigen::Vector3d& centre_m) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const InertialBody& body : bodies) {
    const Eigen::Vector3d arm_m = body.mass.centre_m - centre_m;
    sum += body.inertia_kgm2 +
           body.mass.mass_kg * (arm_m.squaredNorm() * Eigen::Matrix3d::Identity() - arm_m * arm_m.transpose());
  }
  return sum;
}

}  // namespace demecal::inline data
