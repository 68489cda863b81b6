#include "prediction/place_uncertainty.hpp"

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <vector>

#include "decompositions/decompositions.hpp"

namespace demecal::inline prediction {

double placed_m2(const ContactPlace& own, const std::vector<Touch>& touches, const ContactPlace& other,
                 double noise_m) {
  constexpr double kStep = 1e-6, kUnseen = 1e-9;
  const std::vector<int> motions = motions_of(own);
  const Eigen::Index each = rows_of(own.kind);
  Eigen::MatrixXd rows(each * std::ssize(touches), std::ssize(motions));
  Eigen::VectorXd slopes(std::ssize(motions));
  for (Eigen::Index k = 0; k < slopes.size(); ++k) {
    const ContactPlace moved = moved_place(own, motions[static_cast<std::size_t>(k)], kStep);
    slopes[k] = (place_distance(moved, other).length_m - place_distance(own, other).length_m) / kStep;
    for (Eigen::Index i = 0; i < std::ssize(touches); ++i) {
      const Touch& touch = touches[static_cast<std::size_t>(i)];
      rows.block(each * i, k, each, 1) = (contact_residual(moved, touch) - contact_residual(own, touch)) / kStep;
    }
  }
  const auto information = eigen_system(rows.transpose() * rows);
  const double least = kUnseen * information.values.maxCoeff();
  double open_m2 = 0.0;
  for (Eigen::Index i = 0; i < slopes.size(); ++i) {
    const double slope = information.vectors.col(i).dot(slopes);
    if (information.values[i] > least)
      open_m2 += slope * slope / information.values[i];
    else if (std::abs(slope) > kUnseen)
      return std::numeric_limits<double>::infinity();
  }
  return noise_m * noise_m * open_m2;
}

}  // namespace demecal::inline prediction
