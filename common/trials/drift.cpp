#include "trials/drift.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace demecal::inline trials {

std::vector<DriftShape> drift_shapes() {
  const auto linear = [](double share) { return share; };
  std::vector<DriftShape> shapes{{{linear}}};
  for (const double settling : {0.1, 0.3})
    shapes.push_back(
        {{[settling](double share) { return std::expm1(-share / settling) / std::expm1(-1.0 / settling); }}});
  for (int periods = 1; periods <= 3; ++periods) {
    const double turn = 2.0 * std::numbers::pi * periods;
    shapes.push_back({{linear, [turn](double share) { return std::sin(turn * share); },
                       [turn](double share) { return std::cos(turn * share) - 1.0; }},
                      true});
  }
  return shapes;
}

Eigen::VectorXd along(const Trial& trial, const DriftCourse& course) {
  Eigen::VectorXd all(static_cast<Eigen::Index>(trial.rows.size()));
  for (Eigen::Index i = 0; i < all.size(); ++i)
    all[i] = course(static_cast<double>(i) / static_cast<double>(all.size()));
  return all;
}

Eigen::MatrixXd drift_columns(const Trial& trial, const DriftShape& shape) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const TrialRow& row : trial.rows) middle += row.point_m / static_cast<double>(trial.rows.size());
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(trial.rows.size()),
                                                  6 * static_cast<Eigen::Index>(shape.courses.size()));
  for (std::size_t place = 0; place < shape.courses.size(); ++place) {
    const Eigen::VectorXd shares = along(trial, shape.courses[place]);
    for (Eigen::Index i = 0; i < shares.size(); ++i) {
      auto rows = columns.block<3, 6>(3 * i, 6 * static_cast<Eigen::Index>(place));
      rows.leftCols<3>() = shares[i] * Eigen::Matrix3d::Identity();
      for (int axis = 0; axis < 3; ++axis)
        rows.col(3 + axis) =
            shares[i] * Eigen::Vector3d::Unit(axis).cross(trial.rows[static_cast<std::size_t>(i)].point_m - middle);
    }
  }
  return columns;
}

}  // namespace demecal::inline trials
