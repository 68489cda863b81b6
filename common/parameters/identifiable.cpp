#include "decompositions/decompositions.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/parameter_space.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "errors/check.hpp"

namespace demecal::inline parameters {
namespace {

/// How far parameters may usually move: links by about a millimetre or what turns half a metre of arm as far; base and
/// tool by much more. Coefficients of effects have no usual size: see usual_changes.
double usual_change(const ParameterId& id) {
  const double change = id.is_angle() ? 2e-3 : 1e-3;
  return id.kind == ParameterId::Kind::link ? change : 1e3 * change;
}

/// The usual changes of all parameters. Effects are taken to move the measurements a thousandth as far as the other
/// parameters do at least: what a link can explain is not laid at an effect's door.
Eigen::VectorXd usual_changes(const ScaledJacobian& jacobian, const std::vector<ParameterId>& ids) {
  constexpr double kLittle = 1e-3;
  const auto n = static_cast<Eigen::Index>(ids.size());
  Eigen::VectorXd usual(n);
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < n; ++i) {
    usual[i] = usual_change(ids[static_cast<std::size_t>(i)]);
    if (ids[static_cast<std::size_t>(i)].kind != ParameterId::Kind::effect && !jacobian.scaled.col(i).isZero(0.0)) {
      least = std::min(least, usual[i] * jacobian.lengths[i]);
    }
  }
  if (!std::isfinite(least)) least = 1.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (ids[static_cast<std::size_t>(i)].kind != ParameterId::Kind::effect) continue;
    usual[i] = kLittle * least / jacobian.lengths[i];
  }
  return usual;
}

/// The largest absolute entry outside rows already taken.
struct Pivot {
  Eigen::Index row = 0, column = 0;
  double size = -1.0;
};

Pivot largest_entry(const Eigen::MatrixXd& matrix, const std::vector<bool>& taken) {
  Pivot pivot;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Eigen::Index column = 0;
    if (taken[static_cast<std::size_t>(i)]) continue;
    const double size = matrix.row(i).cwiseAbs().maxCoeff(&column);
    if (size > pivot.size) pivot = {i, column, size};
  }
  return pivot;
}

/// The same span with as many zeros as it allows (Gauss-Jordan with full pivoting): directions people can read.
Eigen::MatrixXd sparse_span(Eigen::MatrixXd rows) {
  std::vector<bool> taken(static_cast<std::size_t>(rows.rows()), false);
  for (Eigen::Index step = 0; step < rows.rows(); ++step) {
    const Pivot pivot = largest_entry(rows, taken);
    taken[static_cast<std::size_t>(pivot.row)] = true;
    rows.row(pivot.row) /= rows(pivot.row, pivot.column);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      if (i != pivot.row) rows.row(i) -= (rows(i, pivot.column) * rows.row(pivot.row)).eval();
    }
  }
  return rows;
}

/// A direction by the effects (unit norm) its parameters have in it.
UnidentifiedDirection direction_of(const Eigen::VectorXd& shares, const std::vector<ParameterId>& ids) {
  constexpr double kShare = 0.1;
  UnidentifiedDirection direction;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const double share = shares[static_cast<Eigen::Index>(i)];
    if (std::abs(share) > kShare) direction.parts.emplace_back(ids[i], share);
  }
  auto& parts = direction.parts;
  std::stable_sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
    constexpr double kEqual = 1e-6;
    return std::round(std::abs(a.second) / kEqual) > std::round(std::abs(b.second) / kEqual);
  });
  const double sign = !parts.empty() && parts.front().second < 0 ? -1.0 : 1.0;
  for (auto& part : parts) part.second *= sign;
  return direction;
}

std::vector<UnidentifiedDirection> readable_directions(const Eigen::MatrixXd& rows, const ScaledJacobian& jacobian,
                                                       const std::vector<ParameterId>& ids, bool weak) {
  std::vector<UnidentifiedDirection> directions;
  const Eigen::MatrixXd readable = sparse_span(rows);
  for (Eigen::Index i = 0; i < readable.rows(); ++i) {
    const Eigen::VectorXd shares = readable.row(i).transpose().normalized();
    directions.push_back(direction_of(shares, ids));
    directions.back().relative_singular =
        jacobian.largest > 0 ? (jacobian.scaled * shares).norm() / jacobian.largest : 0;
    directions.back().weak = weak;
  }
  return directions;
}

/// Orthonormal columns that span what is orthogonal to the columns of `matrix` (n x k, full rank).
Eigen::MatrixXd complement(const Eigen::MatrixXd& matrix) {
  const Eigen::Index n = matrix.rows(), k = matrix.cols();
  if (k == 0) return Eigen::MatrixXd::Identity(n, n);
  return orthogonal_factor(matrix, n).rightCols(n - k);
}

/// `basis` with its columns combined so that factor * basis is orthonormal.
Eigen::MatrixXd whitened(const Eigen::MatrixXd& factor, const Eigen::MatrixXd& basis) {
  const SingularSystem svd = singular_system(factor * basis, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return basis * svd.v * svd.values.cwiseInverse().asDiagonal();
}

}  // namespace

ScaledJacobian::ScaledJacobian(const Eigen::MatrixXd& factor)
    : scaled(factor), lengths(factor.colwise().norm().transpose()) {
  constexpr double kRounding = 1e-13;
  if (lengths.size() == 0) return;
  const double smallest = kRounding * lengths.maxCoeff();
  for (Eigen::Index i = 0; i < lengths.size(); ++i) {
    if (lengths[i] <= smallest) {
      lengths[i] = 1.0;
      scaled.col(i).setZero();
    }
    scaled.col(i) /= lengths[i];
  }
  largest = singular_system(scaled).values[0];
}

IdentifiableSubspace identifiable_subspace(const ScaledJacobian& jacobian, const std::vector<ParameterId>& ids,
                                           double rank_tolerance) {
  const auto n = static_cast<Eigen::Index>(ids.size());
  DEMECAL_CHECK(jacobian.lengths.size() == n, jacobian.lengths.size() << " columns of " << n << " parameters");
  if (n == 0) return {};
  const SingularSystem svd = singular_system(jacobian.scaled, Eigen::ComputeFullV);
  const Eigen::Index held = (svd.values.array() <= rank_tolerance * jacobian.largest).count();
  const Eigen::MatrixXd null = svd.v.rightCols(held);
  const Eigen::VectorXd usual = usual_changes(jacobian, ids);
  const Eigen::VectorXd in_usual = (jacobian.lengths.array() * usual.array()).inverse();
  const Eigen::MatrixXd seen = usual.asDiagonal() * complement(in_usual.asDiagonal() * null);
  return {whitened(jacobian.scaled * jacobian.lengths.asDiagonal(), seen),
          readable_directions(null.transpose(), jacobian, ids, false)};
}

std::vector<UnidentifiedDirection> weak_directions(const ScaledJacobian& jacobian, const std::vector<ParameterId>& ids,
                                                   const Eigen::MatrixXd& covariance,
                                                   const Eigen::VectorXd& precision) {
  constexpr double kPriorKnowsBetter = 0.5;
  if (ids.empty()) return {};
  const Eigen::MatrixXd shrinkage = precision.asDiagonal() * covariance * precision.asDiagonal();
  const auto eigen = eigen_system(shrinkage);
  const Eigen::Index weak = (eigen.values.array() > kPriorKnowsBetter).count();
  // Base and tool move along as the covariance says, so that the whole direction is hardly seen.
  const Eigen::MatrixXd moves = covariance * precision.asDiagonal() * eigen.vectors.rightCols(weak);
  return readable_directions((jacobian.lengths.asDiagonal() * moves).transpose(), jacobian, ids, true);
}

void leave_out_contacts(std::vector<UnidentifiedDirection>& directions) {
  for (UnidentifiedDirection& direction : directions)
    std::erase_if(direction.parts, [](const auto& part) { return part.first.kind == ParameterId::Kind::contact; });
  std::erase_if(directions, [](const UnidentifiedDirection& direction) { return direction.parts.empty(); });
}

}  // namespace demecal::inline parameters
