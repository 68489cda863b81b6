// Which of many poses to measure, so that the tool is known best over a workspace: I-optimal designs; and poses moved a
// little, one after another, wherever that lets them tell more: what no list of candidates holds.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "planning/cell.hpp"
#include "planning/information.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline planning {

/// What measured poses leave unknown of a model's numbers, kept up while poses are added and taken away. The numbers
/// are in units of what is believed of them, so that nothing measured leaves the identity as their covariance.
class PosteriorCovariance {
 public:
  /// `known`: information already there (numbers x numbers); `weight`: of the expected squared error, see Workspace.
  PosteriorCovariance(Eigen::MatrixXd known, Eigen::MatrixXd weight);

  const Eigen::MatrixXd& covariance() const { return covariance_; }
  const Eigen::MatrixXd& weight() const { return weight_; }
  /// The expected squared error, m^2, mean over the workspace.
  double square_m2() const { return weight_.cwiseProduct(covariance_).sum(); }

  /// Measured is exactly what has these rows, pose by pose: single updates lose digits little by little.
  void set(const std::vector<Eigen::MatrixXd>& rows);
  void add(const Eigen::MatrixXd& rows);
  void remove(const Eigen::MatrixXd& rows);

 private:
  Eigen::MatrixXd known_, weight_, covariance_;
};

/// Chooses poses among candidates by what each would measure.
class Design {
 public:
  /// `rows`: of all candidates, one after another, `rows_per_pose` each; `known` and `weight` as of
  /// PosteriorCovariance.
  Design(Eigen::MatrixXd rows, int rows_per_pose, const Eigen::MatrixXd& known, Eigen::MatrixXd weight);

  std::size_t candidates() const { return static_cast<std::size_t>(rows_.rows() / rows_per_pose_); }
  const std::vector<std::size_t>& chosen() const { return chosen_; }
  const Eigen::MatrixXd& covariance() const { return knowledge_.covariance(); }
  double square_m2() const { return knowledge_.square_m2(); }

  /// Adds the candidate that lowers the expected squared error most; false where none is left.
  bool add_best();
  void add(std::size_t candidate);
  /// Exchanges chosen poses for better ones (Fedorov, 1972) until a round of all of them gains less than a share, or
  /// `rounds` are over.
  void exchange(int rounds, double least_gain = 2e-3);

 private:
  Eigen::MatrixXd rows_of(std::size_t candidate) const {
    return rows_.middleRows(static_cast<Eigen::Index>(candidate) * rows_per_pose_, rows_per_pose_);
  }
  void remove(std::size_t place);
  std::size_t best_candidate() const;
  void refresh();

  Eigen::MatrixXd rows_;
  int rows_per_pose_;
  PosteriorCovariance knowledge_;
  std::vector<std::size_t> chosen_;
  std::vector<bool> taken_;
};

/// Poses, and the covariance that measuring them leaves of the model's numbers, in units of belief.
struct RefinedPoses {
  std::vector<PlannedPose> poses;
  Eigen::MatrixXd covariance;
};

/// `kept` and `count` of the candidates beside them, each the one that lowers the expected squared error most; then all
/// are exchanged for better candidates as Design::exchange() does.
RefinedPoses completed(const InformationModel& model, const std::vector<PlannedPose>& kept, std::size_t count,
                       const std::vector<PlannedPose>& candidates, const Eigen::MatrixXd& known,
                       const Eigen::MatrixXd& weight);

/// `poses` after rounds in which each is replaced by the best of feasible poses near it, or with one joint anywhere
/// (coordinate exchange after Meyer and Nachtsheim, 1995), where that lowers the expected squared error: the product of
/// `weight` with the covariance. `known`: information already there. Never worse than what it begins with.
RefinedPoses refined(const InformationModel& model, const FeasibleSpace& space, std::vector<PlannedPose> poses,
                     const Eigen::MatrixXd& known, const Eigen::MatrixXd& weight, RandomStream random);

}  // namespace demecal::inline planning
