#include "shared_work/null_noise.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

namespace demecal::inline shared_work {

double NullNoise::squares() const {
  double squares = 0.0;
  for (const auto& [count, own] : lengths)
    for (const double length : own) squares += length * length;
  return squares;
}

NullNoise::Draws NullNoise::draw(Eigen::Index count, RandomStream& random) const {
  constexpr Eigen::Index kRowsAtATime = 512;  // that lie near the processor together
  Eigen::MatrixXd fitted(rows(), count);
  Draws draws{RowMatrix(rows(), count), RowMatrix(belief_deviations.size(), count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    std::map<Eigen::Index, std::vector<double>> dealt = lengths;
    for (auto& [rows_each, own] : dealt)
      for (std::size_t k = own.size(); k > 1; --k) std::swap(own[k - 1], own[random.index(k)]);
    auto drawn = fitted.col(i);
    random.normals({drawn.data(), static_cast<std::size_t>(drawn.size())});
    for (std::size_t pose = 0; pose < poses(); ++pose) {
      auto own = drawn.segment(first_row[pose], rows_of_pose(pose));
      if (silent[pose]) {
        own.setZero();
        continue;
      }
      std::vector<double>& left = dealt[own.size()];
      own *= left.back() / std::max(own.norm(), 1e-300);
      left.pop_back();
    }
    draws.beliefs.col(i) = draw_beliefs(random);
  }
  for (Eigen::Index first = 0; first < fitted.rows(); first += kRowsAtATime) {
    const Eigen::Index now = std::min(kRowsAtATime, fitted.rows() - first);
    draws.fitted.middleRows(first, now) = fitted.middleRows(first, now);
  }
  return draws;
}

Eigen::VectorXd NullNoise::draw_poses(const std::vector<std::size_t>& drawn_poses, RandomStream& random) const {
  Eigen::Index count = 0;
  for (const std::size_t pose : drawn_poses) count += rows_of_pose(pose);
  std::map<Eigen::Index, std::vector<double>> dealt = lengths;
  Eigen::VectorXd drawn(count);
  random.normals({drawn.data(), static_cast<std::size_t>(drawn.size())});
  Eigen::Index first = 0;
  for (const std::size_t pose : drawn_poses) {
    auto own = drawn.segment(first, rows_of_pose(pose));
    first += own.size();
    if (silent[pose]) {
      own.setZero();
      continue;
    }
    std::vector<double>& left = dealt[own.size()];
    std::swap(left[random.index(left.size())], left.back());
    own *= left.back() / std::max(own.norm(), 1e-300);
    left.pop_back();
  }
  return drawn;
}

Eigen::VectorXd NullNoise::draw_beliefs(RandomStream& random) const {
  Eigen::VectorXd drawn = Eigen::VectorXd::Zero(belief_deviations.size());
  for (Eigen::Index i = 0; i < drawn.size(); ++i)
    if (believed[static_cast<std::size_t>(i)]) drawn[i] = belief_deviations[i] * random.normal();
  return drawn;
}

std::vector<Eigen::Index> NullResiduals::rows() const {
  std::vector<Eigen::Index> all;
  for (const std::size_t pose : poses)
    for (Eigen::Index row = noise.first_row[pose]; row < noise.first_row[pose + 1]; ++row) all.push_back(row);
  return all;
}

Eigen::MatrixXd NullResiduals::draw_all(Eigen::Index count, RandomStream& random) const {
  const auto [fitted, beliefs] = noise.draw(count, random);
  const Eigen::MatrixXd along = transposed_product(basis, fitted) + transposed_product(prior_basis, beliefs);
  Eigen::MatrixXd left;
  if (poses.size() == noise.poses()) {
    left = fitted - product(basis, along);
  } else {
    const std::vector<Eigen::Index> own = rows();
    left = fitted(own, Eigen::all) - product(basis(own, Eigen::all), along);
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const double whole = fitted.col(i).squaredNorm() + beliefs.col(i).squaredNorm() - along.col(i).squaredNorm();
    if (whole > 0) left.col(i) *= std::sqrt(model_squares / whole);
  }
  return left;
}

Eigen::MatrixXd NullResiduals::draw(Eigen::Index count, RandomStream& random) const {
  if (others_root.size() == 0) return draw_all(count, random);
  Eigen::MatrixXd fitted(basis.rows(), count), others(others_root.cols(), count);
  Eigen::MatrixXd beliefs(noise.belief_deviations.size(), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    fitted.col(i) = noise.draw_poses(poses, random);
    random.normals({others.col(i).data(), static_cast<std::size_t>(others.rows())});
    beliefs.col(i) = noise.draw_beliefs(random);
  }
  const Eigen::MatrixXd along =
      transposed_product(basis, fitted) + others_root * others + transposed_product(prior_basis, beliefs);
  Eigen::MatrixXd left = fitted - product(basis, along);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double whole = noise.squares() + beliefs.col(i).squaredNorm() - along.col(i).squaredNorm();
    if (whole > 0) left.col(i) *= std::sqrt(model_squares / whole);
  }
  return left;
}

}  // namespace demecal::inline shared_work
