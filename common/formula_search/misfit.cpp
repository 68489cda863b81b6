#include "formula_search/misfit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

#include "primitives/columns.hpp"
#include "primitives/primitive.hpp"
#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline formula_search {
namespace {

/// A constant and the functions up to ABS or, in formulas that have others, all functions.
double vocabulary_size(const Tree& tree) {
  const auto is_later = [](const Node& node) { return node.primitive > Primitive::absolute; };
  const auto last = std::ranges::any_of(tree, is_later) ? kPrimitives.back().primitive : Primitive::absolute;
  return static_cast<double>(last);
}

bool is_half_integer(double value) {
  return std::abs(2.0 * value - std::round(2.0 * value)) < 1e-12;
}

}  // namespace

FormulaMisfit::FormulaMisfit(const TrainingTable& table)
    : evaluate_(table.variables),
      variables_(static_cast<int>(table.variables.size())),
      poses_(table.target.size()),
      lever_(table.target.size()),
      residual_(table.target.size()),
      basis_(table.target.size(), 0) {
  for (std::size_t row = 0; row < poses_; ++row) {
    const auto i = static_cast<Eigen::Index>(row);
    pose_of_row_.push_back(row);
    lever_[i] = std::sqrt(table.weight[row]);
    residual_[i] = lever_[i] * table.target[row];
  }
  sum_by_pose();
}

FormulaMisfit::FormulaMisfit(const std::vector<std::vector<double>>& variables, const Linearization& linearization,
                             int joint, Eigen::VectorXd residual)
    : evaluate_(variables),
      variables_(static_cast<int>(variables.size())),
      poses_(linearization.fitted.poses.size()),
      lever_(linearization.fitted.motions.col(motion_column(joint, kTurnAboutZ))),
      residual_(std::move(residual)),
      basis_(linearization.projection.basis()) {
  for (std::size_t pose = 0; pose < poses_; ++pose) {
    pose_of_row_.insert(pose_of_row_.end(), static_cast<std::size_t>(linearization.fitted.rows_of_pose(pose)), pose);
  }
  sum_by_pose();
}

void FormulaMisfit::sum_by_pose() {
  const auto poses = static_cast<Eigen::Index>(poses_);
  squares_ = moments_ = Eigen::VectorXd::Zero(poses);
  along_ = Eigen::MatrixXd::Zero(poses, basis_.cols());
  for (Eigen::Index row = 0; row < lever_.size(); ++row) {
    const auto pose = static_cast<Eigen::Index>(pose_of_row_[static_cast<std::size_t>(row)]);
    squares_[pose] += lever_[row] * lever_[row];
    moments_[pose] += lever_[row] * residual_[row];
    along_.row(pose) += lever_[row] * basis_.row(row);
  }
}

double FormulaMisfit::nats_of(double squares) const {
  return 0.5 * static_cast<double>(residual_.size()) * std::log(std::max(squares, 1e-300));
}

Eigen::VectorXd FormulaMisfit::residual(const Tree& tree) {
  const auto values = evaluate_(tree);
  Eigen::VectorXd column(lever_.size());
  for (Eigen::Index row = 0; row < column.size(); ++row) {
    column[row] = lever_[row] * values[pose_of_row_[static_cast<std::size_t>(row)]];
  }
  const double whole = column.squaredNorm();
  if (!std::isfinite(whole)) return {};
  const Eigen::VectorXd along = basis_.transpose() * column;
  const double square = whole - along.squaredNorm();  // with its rows among those of beliefs
  if (!(square > kNewShare * whole)) return residual_;
  const double amplitude = column.dot(residual_) / square;
  return residual_ - amplitude * (column - basis_ * along);
}

double FormulaMisfit::nats(const Tree& tree) {
  const auto evaluated = evaluate_(tree);
  const Eigen::Map<const Eigen::VectorXd> values(evaluated.data(), std::ssize(evaluated));
  const double whole = values.cwiseAbs2().dot(squares_);
  if (!std::isfinite(whole)) return std::numeric_limits<double>::infinity();
  const double square = whole - (along_.transpose() * values).squaredNorm();
  const double total = residual_.squaredNorm();
  if (!(square > kNewShare * whole)) return nats_of(total);
  return nats_of(total - std::pow(values.dot(moments_), 2) / square);
}

double FormulaMisfit::gain_nats(const Tree& tree) {
  return nats_of(residual_.squaredNorm()) - nats(tree);
}

double description_nats(const Tree& tree, int variables, std::size_t poses) {
  const double word_nats = std::log(vocabulary_size(tree) + variables);
  double nats = 0.0;
  for (const Node& node : tree) {
    nats += word_nats;
    if (node.primitive == Primitive::constant && !is_half_integer(node.value)) {
      nats += 0.5 * std::log(static_cast<double>(std::max<std::size_t>(poses, 2)));
    }
  }
  return nats;
}

}  // namespace demecal::inline formula_search
