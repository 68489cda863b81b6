#include "preparation/frames.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "errors/check.hpp"

namespace demecal {
namespace {

Eigen::Matrix3Xd columns_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Matrix3Xd columns(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = points[i];
  return columns;
}

/// Whether the points spread in two directions at least, so that no turn about a line goes unseen.
bool spread_out(const Eigen::Matrix3Xd& points) {
  constexpr double kLeast = 1e-6;
  if (points.cols() < 3) return false;
  const Eigen::Matrix3Xd centred = points.colwise() - points.rowwise().mean();
  const Eigen::VectorXd spread = Eigen::JacobiSVD<Eigen::Matrix3Xd>(centred).singularValues();
  return spread[1] > kLeast * spread[0];
}

}  // namespace

double relative_height(const ThreePoints& points_m) {
  const Eigen::Vector3d side = points_m[1] - points_m[0], other = points_m[2] - points_m[0];
  const double longest = std::max({side.norm(), other.norm(), (points_m[2] - points_m[1]).norm()});
  if (!(side.norm() > 0.0)) return 0.0;
  return side.cross(other).norm() / side.norm() / longest;
}

Eigen::Isometry3d local_frame(const ThreePoints& points_m) {
  DEMECAL_CHECK(relative_height(points_m) > 0.0, "three points on a line");
  const Eigen::Vector3d x = (points_m[1] - points_m[0]).normalized();
  const Eigen::Vector3d z = x.cross(points_m[2] - points_m[0]).normalized();
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << x, z.cross(x), z;
  frame.translation() = points_m[0];
  return frame;
}

Eigen::Isometry3d three_point_frame(const ThreePoints& in_base_m, const ThreePoints& in_instrument_m) {
  return local_frame(in_base_m) * local_frame(in_instrument_m).inverse(Eigen::Isometry);
}

std::optional<Eigen::Isometry3d> best_fit(const std::vector<Eigen::Vector3d>& from,
                                          const std::vector<Eigen::Vector3d>& to) {
  DEMECAL_CHECK(from.size() == to.size(), from.size() << " and " << to.size() << " points");
  const Eigen::Matrix3Xd source = columns_of(from), target = columns_of(to);
  if (!spread_out(source) || !spread_out(target)) return std::nullopt;
  return Eigen::Isometry3d(Eigen::umeyama(source, target, false));
}

double misfit(const Eigen::Isometry3d& motion, const std::vector<Eigen::Vector3d>& from,
              const std::vector<Eigen::Vector3d>& to) {
  double sum = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) sum += (motion * from[i] - to[i]).squaredNorm();
  return from.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(from.size()));
}

bool mirrored(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to) {
  constexpr double kFarBetter = 0.2;
  std::vector<Eigen::Vector3d> image = from;
  for (Eigen::Vector3d& point : image) point.z() = -point.z();
  const auto as_is = best_fit(from, to), as_image = best_fit(image, to);
  return as_is && as_image && misfit(*as_image, image, to) < kFarBetter * misfit(*as_is, from, to);
}

}  // namespace demecal
