#include "decompositions/decompositions.hpp"
#include "products/tall_products.hpp"
#include "residuals/noise_estimation.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <type_traits>
#include <utility>
#include <vector>

#include "residuals/residual_field.hpp"

namespace demecal::inline residuals {
namespace {

/// A A': only half of it is worked out.
Eigen::MatrixXd product_with_itself(const Eigen::Ref<const Eigen::MatrixXd>& a) {
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(a.rows(), a.rows());
  product.selfadjointView<Eigen::Lower>().rankUpdate(a);
  product.triangularView<Eigen::StrictlyUpper>() = product.transpose();
  return product;
}

}  // namespace

RestrictedLikelihood::RestrictedLikelihood(const NoiseRows& rows, const std::vector<std::size_t>& poses,
                                           EvenDrift drift) {
  std::vector<Eigen::Index> taken;
  for (const std::size_t pose : poses) {
    first_row_.push_back(static_cast<Eigen::Index>(taken.size()));
    order_.push_back(rows.order[pose]);
    for (Eigen::Index row = rows.first_row[pose]; row < rows.first_row[pose + 1]; ++row) taken.push_back(row);
  }
  rows_ = std::ssize(taken);
  first_row_.push_back(rows_);
  const bool drifts = drift == EvenDrift::fitted && rows.even_drift.cols() > 0;
  const RowMatrix columns = drifts ? beside(rows.columns, rows.even_drift) : rows.columns;
  const Eigen::MatrixXd model = columns(taken, Eigen::all);
  const Eigen::VectorXd values = rows.residual(taken);
  if (model.cols() > 0) {
    const Eigen::VectorXd norms = model.colwise().norm().cwiseMax(1e-300);
    model_ = PivotedQr(model * norms.cwiseInverse().asDiagonal(), 1e-9);
    rank_ = model_.rank();
  }
  freedom_ = rows_ - rank_;
  left_ = beyond_model(values);
  take_joints(rows, poses);
  take_repeats(rows, poses);
  take_neighbourhood();
}

void RestrictedLikelihood::take_joints(const NoiseRows& rows, const std::vector<std::size_t>& poses) {
  const Eigen::Index joints_count = rows.joint_motions.cols();
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(rows_, joints_count * std::ssize(poses));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Index count = first_row_[i + 1] - first_row_[i];
    for (Eigen::Index joint = 0; joint < joints_count; ++joint)
      motions.block(first_row_[i], joint * std::ssize(poses) + static_cast<Eigen::Index>(i), count, 1) =
          rows.joint_motions.block(rows.first_row[poses[i]], joint, count, 1);
  }
  per_joint_square_ = std::max(motions.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(rows_, 1)), 1e-300);
  turns_ = beyond_model(motions / std::sqrt(per_joint_square_));
  const Eigen::Index own = std::ssize(poses);
  for (Eigen::Index joint = 0; joint < joints_count; ++joint)
    of_joint_.push_back(product_with_itself(turns_.middleCols(joint * own, own)));
  alike_over_alone_.resize(joints_count);
  for (Eigen::Index joint = 0; joint < joints_count; ++joint)
    alike_over_alone_[joint] =
        motions.squaredNorm() / std::max(motions.middleCols(joint * own, own).squaredNorm(), 1e-300);
  set_joint_shares(Eigen::VectorXd::Ones(joints_count));
}

/// One column a row of a repeated pose.
void RestrictedLikelihood::take_repeats(const NoiseRows& rows, const std::vector<std::size_t>& poses) {
  constexpr Eigen::Index kRowsShared = 6;
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < poses.size(); ++i) members[rows.group[poses[i]]].push_back(i);
  std::erase_if(members, [](const auto& group) { return group.second.size() < 2; });
  if (members.empty()) return;
  Eigen::MatrixXd shared = Eigen::MatrixXd::Zero(rows_, kRowsShared * std::ssize(members));
  Eigen::Index column = 0;
  for (const auto& [first, repeated] : members) {
    for (const std::size_t pose : repeated) {
      const Eigen::Index count = std::min(kRowsShared, first_row_[pose + 1] - first_row_[pose]);
      shared.block(first_row_[pose], column, count, count).setIdentity();
    }
    column += kRowsShared;
  }
  const Eigen::MatrixXd together = beyond_model(shared);
  covariance_[repeats] = together * together.transpose();
}

/// What is left of the rows themselves tells whether neighbours in order are alike, before anything is estimated.
void RestrictedLikelihood::take_neighbourhood() {
  Eigen::VectorXd padded = Eigen::VectorXd::Zero(rows_);
  padded.tail(freedom_) = left_;
  if (rank_ > 0) padded = model_.turned(padded);
  double products = 0.0, squares = 0.0;
  for (std::size_t i = 1; i < order_.size(); ++i) {
    const Eigen::Index count = std::min(first_row_[i + 1] - first_row_[i], first_row_[i] - first_row_[i - 1]);
    const double product = padded.segment(first_row_[i], count).dot(padded.segment(first_row_[i - 1], count));
    products += product;
    squares += product * product;
  }
  neighbourhood_ = squares > 0.0 ? products / std::sqrt(squares) : 0.0;
}

void RestrictedLikelihood::set_joint_shares(const Eigen::VectorXd& shares) {
  joint_shares_ = shares;
  covariance_[joints] = Eigen::MatrixXd::Zero(freedom_, freedom_);
  for (Eigen::Index joint = 0; joint < shares.size(); ++joint)
    covariance_[joints] += shares[joint] * of_joint_[static_cast<std::size_t>(joint)];
}

RestrictedLikelihood::Slope RestrictedLikelihood::along_joint_variances(const std::array<double, 3>& variances) const {
  const Eigen::Index poses = std::ssize(order_), count = joint_shares_.size();
  const Cholesky root(covariance(variances));
  const Eigen::MatrixXd turns = root.whitened(turns_);
  const Eigen::VectorXd left = root.whitened(left_);
  const double variance = left.squaredNorm() / static_cast<double>(freedom_);
  Slope result{Eigen::VectorXd(count), Eigen::MatrixXd(count, count)};
  std::vector<Eigen::MatrixXd> squares;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto own = turns.middleCols(i * poses, poses);
    squares.push_back(product_with_itself(own));
    const double size = variances[joints] * joint_shares_[i];
    result.slope[i] = 0.5 * size * ((own.transpose() * left).squaredNorm() / variance - own.squaredNorm());
    for (Eigen::Index k = 0; k <= i; ++k) {
      const double together = squares.back().cwiseProduct(squares[static_cast<std::size_t>(k)]).sum();
      result.information(i, k) = 0.5 * size * variances[joints] * joint_shares_[k] * together;
      result.information(k, i) = result.information(i, k);
    }
  }
  return result;
}

/// What of columns the model cannot follow: freedom x columns.
Eigen::MatrixXd RestrictedLikelihood::beyond_model(const Eigen::MatrixXd& columns) const {
  return rank_ > 0 ? Eigen::MatrixXd(model_.turned_back(columns).bottomRows(freedom_)) : columns;
}

void RestrictedLikelihood::set_correlation(double from_pose_to_pose) {
  const auto poses = std::ssize(order_);
  Eigen::MatrixXd alike(poses, poses);
  for (Eigen::Index i = 0; i < poses; ++i) {
    for (Eigen::Index k = 0; k < poses; ++k) {
      alike(i, k) = std::pow(from_pose_to_pose,
                             std::abs(order_[static_cast<std::size_t>(i)] - order_[static_cast<std::size_t>(k)]));
    }
    alike(i, i) += 1e-9;
  }
  const Eigen::MatrixXd root = Cholesky(alike).lower();
  constexpr Eigen::Index kAxes = 3;
  Eigen::MatrixXd shared = Eigen::MatrixXd::Zero(rows_, kAxes * poses);
  for (Eigen::Index i = 0; i < poses; ++i) {
    const auto pose = static_cast<std::size_t>(i);
    const Eigen::Index count = std::min(kAxes, first_row_[pose + 1] - first_row_[pose]);
    for (Eigen::Index axis = 0; axis < count; ++axis)
      shared.row(first_row_[pose] + axis).segment(axis * poses, poses) = root.row(i);
  }
  set_in_order(shared);
}

void RestrictedLikelihood::set_in_order(const Eigen::MatrixXd& columns) {
  const Eigen::MatrixXd drift = beyond_model(columns);
  covariance_[order] = drift * drift.transpose();
}

Eigen::MatrixXd RestrictedLikelihood::covariance(const std::array<double, 3>& variances) const {
  Eigen::MatrixXd whole = Eigen::MatrixXd::Identity(freedom_, freedom_);
  for (std::size_t i = 0; i < variances.size(); ++i)
    if (variances[i] > 0.0 && covariance_[i].size() > 0) whole += variances[i] * covariance_[i];
  return whole;
}

double RestrictedLikelihood::minus_twice_log(const std::array<double, 3>& variances) const {
  const Cholesky root(covariance(variances));
  if (!root.succeeded()) return std::numeric_limits<double>::infinity();
  const double squares = root.whitened(left_).squaredNorm();
  return static_cast<double>(freedom_) * std::log(std::max(squares, 1e-300)) + root.log_determinant();
}

double RestrictedLikelihood::variance_left(const std::array<double, 3>& variances) const {
  return Cholesky(covariance(variances)).whitened(left_).squaredNorm() /
         static_cast<double>(std::max<Eigen::Index>(freedom_, 1));
}

}  // namespace demecal::inline residuals
