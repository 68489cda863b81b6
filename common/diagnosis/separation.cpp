#include "diagnosis/separation.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>

namespace demecal {
namespace {

/// Squared noncentrality for a one-sided test at 5 % with power 0.9: normal quantiles of 0.95 and 0.9.
constexpr double kTold = (1.6449 + 1.2816) * (1.6449 + 1.2816);
/// Of a column's square: what is believed of it at least, so that hardly visible directions imitate nothing.
constexpr double kBelieved = 1e-5;

}  // namespace

Products products(const RowMatrix& model, const RowMatrix& asked, double weight) {
  return {weight * (model.transpose() * model), weight * (model.transpose() * asked),
          weight * (asked.transpose() * asked)};
}

Separation::Separation(const Products& present, const Products& per_pose, const Eigen::VectorXd& precision) {
  present_ = present.cross;
  per_pose_ = per_pose.cross;
  asked_ = present.asked;
  asked_per_pose_ = per_pose.asked;
  asked_.diagonal() += precision;
  if (per_pose.model.size() == 0) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(per_pose.model);
  spread_ = eigen.eigenvalues().cwiseMax(0.0);
  present_ = eigen.eigenvectors().transpose() * present_;
  per_pose_ = eigen.eigenvectors().transpose() * per_pose_;
}

double Separation::information(double poses, const std::vector<Eigen::Index>& others, Eigen::Index signal) const {
  std::vector<Eigen::Index> all = others;
  all.push_back(signal);
  const Eigen::MatrixXd along = (present_ + poses * per_pose_)(Eigen::all, all);
  const Eigen::VectorXd known = (1.0 + poses * spread_.array()).inverse();
  Eigen::MatrixXd left = (asked_ + poses * asked_per_pose_)(all, all);
  left -= along.transpose() * known.asDiagonal() * along;
  const auto count = static_cast<Eigen::Index>(others.size());
  if (count == 0) return left(0, 0);
  Eigen::MatrixXd rivals = left.topLeftCorner(count, count);
  Eigen::VectorXd scale(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index column = others[static_cast<std::size_t>(i)];
    const double square = asked_(column, column) + asked_per_pose_(column, column);
    rivals(i, i) += kBelieved * square;
    scale[i] = square > 0 ? 1 / std::sqrt(square) : 0.0;
  }
  const Eigen::VectorXd moment = scale.cwiseProduct(left.col(count).head(count));
  const Eigen::MatrixXd scaled = scale.asDiagonal() * rivals * scale.asDiagonal();
  return left(count, count) - moment.dot(scaled.completeOrthogonalDecomposition().solve(moment));
}

std::optional<int> Separation::poses_needed(const std::vector<Eigen::Index>& others, Eigen::Index signal,
                                            int most) const {
  const double enough = information(0.0, others, signal) + kTold;
  const auto tells = [&](int poses) { return information(poses, others, signal) >= enough; };
  if (!tells(most)) return std::nullopt;
  int few = 0, many = 1;
  while (many < most && !tells(many)) {
    few = many;
    many = std::min(2 * many, most);
  }
  while (many - few > 1) {
    const int middle = few + (many - few) / 2;
    (tells(middle) ? many : few) = middle;
  }
  return many;
}

}  // namespace demecal
