// A set of effects with its least-squares fit to a residual, kept up to date as effects come and go.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace demecal::inline effect_sets {

/// Columns first .. first + count - 1 belong to one effect.
struct ColumnSpan {
  Eigen::Index first = 0;
  Eigen::Index count = 0;
};

/// What sets of effects would explain, to first order: rows whitened, everything declared projected off. The columns of
/// one effect are of unit length and orthogonal to each other, but for a belief in small coefficients that lets any two
/// sets be fitted.
struct ExplanationProblem {
  Eigen::MatrixXd gram;           ///< X^T X of all effects' columns X, the belief added to its diagonal
  Eigen::VectorXd moment;         ///< X^T residual
  double squares = 0.0;           ///< of the residual without any of them
  double rows = 0.0;              ///< measured numbers
  double freedom = 0.0;           ///< of these, how many the model leaves
  double poses = 0.0;             ///< distinct ones
  std::vector<ColumnSpan> spans;  ///< per effect; of no columns where the model explains it
  std::vector<double> naming_costs_nats;
  std::vector<std::size_t> cause;        ///< per effect: the same number for those an engineer counts as one cause
  std::vector<std::string> cause_names;  ///< by these numbers, for those who watch
};

/// Another effect beside one of a set.
struct Alike {
  std::size_t effect = 0;
  double cosine = 0.0;  ///< between what the one explains beside the others of its set, and the best it can make of it
  double nats_behind = 0.0;  ///< by how much the description is longer with it in the other's place
};

class FittedSet {
 public:
  /// Of no effect. Keeps the problem by reference.
  explicit FittedSet(const ExplanationProblem& problem) : problem_(&problem), squares_(problem.squares) {}
  /// Of these, at once: many times as fast as one added after another where there are many.
  FittedSet(const ExplanationProblem& problem, std::vector<std::size_t> effects);

  /// In the order in which they came.
  const std::vector<std::size_t>& effects() const { return effects_; }
  bool holds(std::size_t effect) const;
  /// Different ones, ascending.
  std::vector<std::size_t> causes() const;
  /// What is left of the sum of squares.
  double squares() const { return squares_; }
  /// Of the columns of effects(), one after another.
  const Eigen::VectorXd& coefficients() const { return coefficients_; }
  Eigen::Index columns() const { return coefficients_.size(); }
  /// The length of the residual's description, less that without any effect; nats.
  double description_nats() const { return saved_nats(squares_ / problem_->squares) + price_; }
  /// What an effect's name and numbers take of it.
  double price_nats(std::size_t effect) const;

  /// X^T of what the set leaves of the residual.
  Eigen::VectorXd moments_left() const;
  /// The same in `spans` of the columns alone; elsewhere the numbers say nothing.
  Eigen::VectorXd moments_left(const std::vector<ColumnSpan>& spans) const;
  /// By how much the description grows shorter without the effect at this place of effects().
  double gain_without(std::size_t place) const;
  /// The place of the effect without which it grows shortest; nothing where it grows shorter without none.
  std::optional<std::size_t> least_worth() const;
  /// By how much the sum of squares rises without it.
  double rise_without(std::size_t place) const;

  /// Every effect outside the set in the place of the one at `place`.
  std::vector<Alike> alike(std::size_t place) const;

  void add(std::size_t effect);
  /// Adds the effect where the description grows shorter by it; whether it does.
  bool add_if_shorter(std::size_t effect);
  void remove(std::size_t place);
  void remove_cause(std::size_t cause);

 private:
  /// What an effect's columns are beside those of the set.
  struct Beside {
    Eigen::MatrixXd explained;      ///< columns x count: their least-squares values by the set's columns
    Eigen::MatrixXd fresh_inverse;  ///< of the gram matrix of what is not explained
    Eigen::VectorXd coefficients;
    double drop = 0.0;  ///< of the sum of squares
  };
  Beside beside(const ColumnSpan& span) const;
  void add(std::size_t effect, const Beside& beside);
  double saved_nats(double share) const;
  std::pair<Eigen::Index, Eigen::Index> span_at(std::size_t place) const;

  const ExplanationProblem* problem_;
  std::vector<std::size_t> effects_;
  std::vector<Eigen::Index> columns_;  ///< theirs
  Eigen::MatrixXd inverse_;            ///< of their gram matrix
  Eigen::VectorXd coefficients_;
  double squares_, price_ = 0.0;
};

}  // namespace demecal::inline effect_sets
