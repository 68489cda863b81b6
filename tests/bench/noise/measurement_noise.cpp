#include "measurement_noise.hpp"

#include <cmath>
#include <numeric>

namespace demecal::bench {
namespace {

Eigen::Vector3d normal_offset(RandomStream& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return {x, y, z};
}

/// Unit variance; that of 3 degrees of freedom is 3.
double unit_student(RandomStream& random) {
  const double numerator = random.normal();
  const double chi_square = normal_offset(random).squaredNorm();
  return numerator / std::sqrt(chi_square / 3.0) / std::sqrt(3.0);
}

}  // namespace

Offsets white_noise(std::size_t points, double deviation_m, RandomStream& random) {
  Offsets all(points);
  for (Eigen::Vector3d& offset : all) offset = deviation_m * normal_offset(random);
  return all;
}

Offsets correlated_noise(std::size_t points, double correlation, double deviation_m, RandomStream& random) {
  const double fresh = std::sqrt(1.0 - correlation * correlation);
  Offsets all = white_noise(points, deviation_m, random);
  for (std::size_t i = 1; i < points; ++i) all[i] = correlation * all[i - 1] + fresh * all[i];
  return all;
}

Offsets student_noise(std::size_t points, double deviation_m, RandomStream& random) {
  Offsets all(points);
  for (Eigen::Vector3d& offset : all) {
    for (double& element : offset) element = deviation_m * unit_student(random);
  }
  return all;
}

Offsets tracker_noise(const Offsets& seen_m, double fixed_m, double per_metre, RandomStream& random) {
  Offsets all;
  for (const Eigen::Vector3d& point_m : seen_m)
    all.emplace_back((fixed_m + per_metre * point_m.norm()) * normal_offset(random));
  return all;
}

Offsets settling_drift(std::size_t points, const Eigen::Vector3d& end_m, double points_to_e) {
  Offsets all;
  for (std::size_t i = 0; i < points; ++i) all.emplace_back(-std::expm1(-static_cast<double>(i) / points_to_e) * end_m);
  return all;
}

Offsets steady_drift(std::size_t points, const Eigen::Vector3d& end_m) {
  Offsets all;
  for (std::size_t i = 0; i < points; ++i)
    all.emplace_back(static_cast<double>(i) / static_cast<double>(points - 1) * end_m);
  return all;
}

Offsets gross_errors(std::size_t points, double share, double least_m, double most_m, RandomStream& random) {
  std::vector<std::size_t> order(points);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto bad = static_cast<std::size_t>(std::lround(share * static_cast<double>(points)));
  Offsets all(points, Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < bad; ++i) {
    std::swap(order[i], order[i + random.index(points - i)]);
    const double size_m = least_m * std::pow(most_m / least_m, random.real());
    all[order[i]] = size_m * random_direction(random);
  }
  return all;
}

Eigen::Vector3d random_direction(RandomStream& random) {
  return normal_offset(random).normalized();
}

void add_to(Offsets& sum, const Offsets& more) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += more[i];
}

}  // namespace demecal::bench
