#include "planning/exchange.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "planning/moved_pose.hpp"
#include "planning/travel.hpp"

namespace demecal::inline planning {

PosteriorCovariance::PosteriorCovariance(Eigen::MatrixXd known, Eigen::MatrixXd weight)
    : known_(std::move(known)), weight_(std::move(weight)) {
  set({});
}

void PosteriorCovariance::set(const std::vector<Eigen::MatrixXd>& rows) {
  const Eigen::Index n = weight_.rows();
  Eigen::MatrixXd information = known_ + Eigen::MatrixXd::Identity(n, n);
  for (const Eigen::MatrixXd& own : rows) information.noalias() += own.transpose() * own;
  covariance_ = Cholesky(information).inverse();
}

void PosteriorCovariance::add(const Eigen::MatrixXd& rows) {
  const Eigen::MatrixXd along = rows * covariance_;
  Eigen::MatrixXd spread = along * rows.transpose();
  spread.diagonal().array() += 1.0;
  covariance_ -= along.transpose() * Cholesky(spread).solve(along);
}

void PosteriorCovariance::remove(const Eigen::MatrixXd& rows) {
  const Eigen::MatrixXd along = rows * covariance_;
  Eigen::MatrixXd left = -along * rows.transpose();
  left.diagonal().array() += 1.0;
  covariance_ += along.transpose() * PivotedCholesky(left).solve(along);
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
    const double gain = Cholesky(spread).solve(told).trace();
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

namespace {

constexpr int kRefinements = 24, kRefinementTries = 60;
constexpr double kWidest = 0.25, kNarrowing = 0.85;  ///< of a joint's range: how far tries of a round go
constexpr double kLeastRoundGain = 5e-4;             ///< of a round, over what there was

/// By how much rows would lower the expected squared error, at one state of knowledge.
class PoseGain {
 public:
  explicit PoseGain(const PosteriorCovariance& knowledge)
      : covariance_(knowledge.covariance()), wanted_(covariance_ * knowledge.weight() * covariance_) {}

  double operator()(const Eigen::MatrixXd& rows) const {
    Eigen::MatrixXd spread = rows * covariance_ * rows.transpose();
    spread.diagonal().array() += 1.0;
    return Cholesky(spread).solve(rows * wanted_ * rows.transpose()).trace();
  }

 private:
  const Eigen::MatrixXd& covariance_;
  Eigen::MatrixXd wanted_;
};

}  // namespace

RefinedPoses refined(const InformationModel& model, const FeasibleSpace& space, std::vector<PlannedPose> poses,
                     const Eigen::MatrixXd& known, const Eigen::MatrixXd& weight, RandomStream random) {
  std::vector<Eigen::MatrixXd> rows;
  std::ranges::transform(poses, std::back_inserter(rows),
                         [&](const PlannedPose& pose) { return model.measured_rows(pose); });
  PosteriorCovariance knowledge(known, weight);
  knowledge.set(rows);
  double width = kWidest;
  for (int round = 0; round < kRefinements; ++round, width *= kNarrowing) {
    const double before = knowledge.square_m2();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      knowledge.remove(rows[i]);
      const PoseGain gain_of(knowledge);
      double most = gain_of(rows[i]);
      for (int attempt = 0; attempt < kRefinementTries; ++attempt) {
        auto tried = moved_pose(space, model.model().sockets, poses[i], width, random);
        if (!tried) continue;
        Eigen::MatrixXd tells = model.measured_rows(*tried);
        const double gain = gain_of(tells);
        if (!(gain > most) || !is_feasible(space, *tried)) continue;
        most = gain;
        poses[i] = std::move(*tried);
        rows[i] = std::move(tells);
      }
      knowledge.add(rows[i]);
    }
    knowledge.set(rows);
    if (knowledge.square_m2() > (1.0 - kLeastRoundGain) * before) break;
  }
  return {std::move(poses), knowledge.covariance()};
}

RefinedPoses completed(const InformationModel& model, const std::vector<PlannedPose>& kept, std::size_t count,
                       const std::vector<PlannedPose>& candidates, const Eigen::MatrixXd& known,
                       const Eigen::MatrixXd& weight) {
  std::vector<PlannedPose> all = kept;
  all.insert(all.end(), candidates.begin(), candidates.end());
  Design design(stacked_rows(model, all), model.rows_per_pose(), known, weight);
  for (std::size_t i = 0; i < kept.size(); ++i) design.add(i);
  for (std::size_t i = 0; i < count; ++i) design.add_best();
  constexpr int kRounds = 4;
  design.exchange(kRounds);
  RefinedPoses chosen{{}, design.covariance()};
  for (const std::size_t i : design.chosen()) chosen.poses.push_back(all[i]);
  return chosen;
}

}  // namespace demecal::inline planning
