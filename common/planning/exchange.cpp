#include "planning/exchange.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

namespace demecal::inline planning {

Knowledge::Knowledge(Eigen::MatrixXd known, Eigen::MatrixXd weight)
    : known_(std::move(known)), weight_(std::move(weight)) {
  set({});
}

void Knowledge::set(const std::vector<Eigen::MatrixXd>& rows) {
  const Eigen::Index n = weight_.rows();
  Eigen::MatrixXd information = known_ + Eigen::MatrixXd::Identity(n, n);
  for (const Eigen::MatrixXd& own : rows) information.noalias() += own.transpose() * own;
  covariance_ = information.llt().solve(Eigen::MatrixXd::Identity(n, n));
}

void Knowledge::add(const Eigen::MatrixXd& rows) {
  const Eigen::MatrixXd along = rows * covariance_;
  Eigen::MatrixXd spread = along * rows.transpose();
  spread.diagonal().array() += 1.0;
  covariance_ -= along.transpose() * spread.llt().solve(along);
}

void Knowledge::remove(const Eigen::MatrixXd& rows) {
  const Eigen::MatrixXd along = rows * covariance_;
  Eigen::MatrixXd left = -along * rows.transpose();
  left.diagonal().array() += 1.0;
  covariance_ += along.transpose() * left.ldlt().solve(along);
}

Design::Design(Eigen::MatrixXd rows, int rows_per_pose, const Eigen::MatrixXd& known, Eigen::MatrixXd weight)
    : rows_(std::move(rows)), rows_per_pose_(rows_per_pose), knowledge_(known, std::move(weight)) {
  taken_.assign(candidates(), false);
}

void Design::refresh() {
  std::vector<Eigen::MatrixXd> rows;
  for (const std::size_t candidate : chosen_) rows.push_back(rows_of(candidate));
  knowledge_.set(rows);
}

std::size_t Design::best_candidate() const {
  const Eigen::MatrixXd along = rows_ * knowledge_.covariance();
  const Eigen::MatrixXd wanted = along * knowledge_.weight();
  std::size_t best = candidates();
  double most = 0.0;
  for (std::size_t i = 0; i < candidates(); ++i) {
    if (taken_[i]) continue;
    const auto first = static_cast<Eigen::Index>(i) * rows_per_pose_;
    const auto own = along.middleRows(first, rows_per_pose_);
    Eigen::MatrixXd spread = own * rows_.middleRows(first, rows_per_pose_).transpose();
    spread.diagonal().array() += 1.0;
    const Eigen::MatrixXd told = wanted.middleRows(first, rows_per_pose_) * own.transpose();
    const double gain = spread.llt().solve(told).trace();
    if (gain > most) {
      most = gain;
      best = i;
    }
  }
  return best;
}

bool Design::add_best() {
  const std::size_t best = best_candidate();
  if (best == candidates()) return false;
  add(best);
  return true;
}

void Design::add(std::size_t candidate) {
  knowledge_.add(rows_of(candidate));
  chosen_.push_back(candidate);
  taken_[candidate] = true;
}

void Design::remove(std::size_t place) {
  const std::size_t candidate = chosen_[place];
  knowledge_.remove(rows_of(candidate));
  chosen_.erase(chosen_.begin() + static_cast<std::ptrdiff_t>(place));
  taken_[candidate] = false;
}

void Design::exchange(int rounds, double least_gain) {
  for (int round = 0; round < rounds; ++round) {
    refresh();
    const double before = square_m2();
    const std::size_t count = chosen_.size();
    for (std::size_t i = 0; i < count; ++i) {
      remove(0);  // whatever replaces it goes to the end: all take their turn
      if (!add_best()) return;
    }
    refresh();
    if (square_m2() > (1.0 - least_gain) * before) return;
  }
}

}  // namespace demecal::inline planning
