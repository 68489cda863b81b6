#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "decompositions/decompositions.hpp"
#include "residuals/noise_estimation.hpp"

namespace demecal::inline residuals {
namespace {

constexpr Eigen::Index kMostLikelihoodRows = 360;  ///< in an estimate: a likelihood costs their cube
constexpr std::size_t kRuns = 3;                   ///< of poses, where not all take part
constexpr double kLikelier = 0.5;                  ///< nats that a component must make the residuals likelier by
constexpr double kLikelierInOrder = 2.0;
constexpr std::array kCorrelations{0.5, 0.8, 0.9, 0.95, 0.98, 0.995};
constexpr std::size_t kSlow = 2;  ///< of these, the last: those of what heat does
constexpr std::array kVariances{0.01, 0.1, 1.0, 10.0, 100.0};

/// The poses of a field that take part: all, or as many as kMostLikelihoodRows allow, in kRuns runs.
std::vector<std::size_t> taking_part(const NoiseRows& rows) {
  const std::size_t poses = rows.group.size();
  const double rows_of_pose =
      static_cast<double>(rows.residual.size()) / static_cast<double>(std::max<std::size_t>(poses, 1));
  const auto most = static_cast<std::size_t>(static_cast<double>(kMostLikelihoodRows) / std::max(rows_of_pose, 1.0));
  std::vector<std::size_t> taken;
  for (std::size_t i = 0; i < poses; ++i) {
    const std::size_t length = most / kRuns, run = i * kRuns / poses, begin = (run * poses + kRuns - 1) / kRuns;
    if (poses <= most || i - begin < length) taken.push_back(i);
  }
  return taken;
}

/// Which of kVariances makes a function least, and how little that is.
std::pair<std::size_t, double> likeliest_of_few(const std::function<double(double)>& minus_twice_log) {
  std::pair<std::size_t, double> best{0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < kVariances.size(); ++i) {
    const double value = minus_twice_log(kVariances[i]);
    if (value < best.second) best = {i, value};
  }
  return best;
}

/// The smallest value of a function of a positive number, over kVariances and between the best one's neighbours.
double likeliest_variance(const std::function<double(double)>& minus_twice_log) {
  const std::size_t best = likeliest_of_few(minus_twice_log).first;
  double lower = std::log(kVariances[best == 0 ? 0 : best - 1]),
         upper = std::log(kVariances[std::min(best + 1, kVariances.size() - 1)]);
  constexpr double kGolden = 0.618034;
  constexpr int kSteps = 6;
  double a = upper - kGolden * (upper - lower), b = lower + kGolden * (upper - lower);
  double at_a = minus_twice_log(std::exp(a)), at_b = minus_twice_log(std::exp(b));
  for (int step = 0; step < kSteps; ++step) {
    if (at_a < at_b) {
      upper = std::exchange(b, a);
      a = upper - kGolden * (upper - lower);
      at_b = std::exchange(at_a, minus_twice_log(std::exp(a)));
    } else {
      lower = std::exchange(a, b);
      b = lower + kGolden * (upper - lower);
      at_a = std::exchange(at_b, minus_twice_log(std::exp(b)));
    }
  }
  return std::exp(0.5 * (lower + upper));
}

/// Finds the components one after another, twice where there are several.
class Components {
 public:
  explicit Components(RestrictedLikelihood& likelihood) : likelihood_(likelihood), least_(value()) {}

  void estimate(RestrictedLikelihood::Component component, double nats) {
    std::array<double, 3> trial = variances;
    trial[component] = 0.0;
    const double without = likelihood_.minus_twice_log(trial);
    trial[component] = likeliest_variance([&](double variance) {
      trial[component] = variance;
      return likelihood_.minus_twice_log(trial);
    });
    const double with = likelihood_.minus_twice_log(trial);
    variances[component] = without - with > 2.0 * nats ? trial[component] : 0.0;
    least_ = value();
  }
  void estimate_order(std::span<const double> correlations, double nats) {
    const double before = least_;
    double best = least_;
    for (const double candidate : correlations) {
      likelihood_.set_correlation(candidate);
      for (const double variance : {0.3, 3.0, 30.0}) {
        std::array<double, 3> trial = variances;
        trial[RestrictedLikelihood::order] = variance;
        const double value = likelihood_.minus_twice_log(trial);
        if (value >= best) continue;
        best = value;
        correlation = candidate;
      }
    }
    if (before - best <= 2.0 * nats) return void(correlation = 0.0);
    likelihood_.set_correlation(correlation);
    estimate(RestrictedLikelihood::order, nats);
  }

  /// How the joints' variances differ, which are believed to be alike within a factor of e or so (one standard
  /// deviation of their logarithms): Fisher's scoring.
  void estimate_joints_apart() {
    constexpr int kSteps = 4;
    constexpr double kSettled = 0.05;  ///< of a logarithm
    if (variances[RestrictedLikelihood::joints] <= 0.0) return;
    const Eigen::Index count = likelihood_.joint_shares().size();
    const Eigen::MatrixXd alike = Eigen::MatrixXd::Identity(count, count) -
                                  Eigen::MatrixXd::Constant(count, count, 1.0 / static_cast<double>(count));
    Eigen::MatrixXd told;
    for (int step = 0; step < kSteps; ++step) {
      const auto [slope, information] = likelihood_.along_joint_variances(variances);
      const Eigen::VectorXd logs = likelihood_.joint_shares().array().log();
      const Eigen::MatrixXd curvature = information + alike + 1e-9 * Eigen::MatrixXd::Identity(count, count);
      const Eigen::VectorXd change =
          PivotedCholesky(curvature).solve(slope - alike * logs).cwiseMax(-1.0).cwiseMin(1.0);
      likelihood_.set_joint_shares((logs + change).array().exp());
      told = information;
      if (change.cwiseAbs().maxCoeff() < kSettled) break;
    }
    const Eigen::VectorXd logs = likelihood_.joint_shares().array().log();
    cost_of_shares_ = logs.dot(alike * logs) +
                      Cholesky(Eigen::MatrixXd::Identity(count, count) + alike * told * alike).log_determinant();
    const double mean = likelihood_.joint_shares().mean();
    variances[RestrictedLikelihood::joints] *= mean;
    likelihood_.set_joint_shares(likelihood_.joint_shares() / mean);
    least_ = value();
  }

  /// One joint that repeats badly among others that do not: alike, joints are then hardly likelier than none, and are
  /// further apart than they are believed to be. Kept where it is likelier by more than the choice of one costs; what
  /// shares near each other cost of belief, and of the room that they had, is no likelihood of theirs.
  bool estimate_one_joint(double nats) {
    constexpr double kMostShareAlone = 1e5;  ///< a joint that hardly moves points makes none of their scatter
    const Eigen::Index count = likelihood_.joint_shares().size();
    if (count < 2) return false;
    const Eigen::VectorXd before = likelihood_.joint_shares();
    const auto alone = [&](Eigen::Index joint) {
      likelihood_.set_joint_shares(likelihood_.share_alone(joint) * Eigen::VectorXd::Unit(count, joint));
    };
    std::array<double, 3> trial = variances;
    const auto value_at = [&](double variance) {
      trial[RestrictedLikelihood::joints] = variance;
      return likelihood_.minus_twice_log(trial);
    };
    std::pair<Eigen::Index, double> best{0, std::numeric_limits<double>::infinity()};
    for (Eigen::Index joint = 0; joint < count; ++joint) {
      if (likelihood_.share_alone(joint) > kMostShareAlone) continue;
      alone(joint);
      if (const double value = likeliest_of_few(value_at).second; value < best.second) best = {joint, value};
    }
    if (std::isinf(best.second)) return false;
    alone(best.first);
    const double variance = likeliest_variance(value_at), least = value_at(variance);
    const double choice = 2.0 * (nats + std::log(static_cast<double>(count)));
    if (least + choice >= least_ + cost_of_shares_) {
      likelihood_.set_joint_shares(before);
      return false;
    }
    variances[RestrictedLikelihood::joints] = variance;
    least_ = least;
    estimate_rest(best.first, nats);
    return true;
  }

  /// What the other joints scatter, alike, beside the one that stands out.
  void estimate_rest(Eigen::Index one, double nats) {
    const Eigen::VectorXd alone = likelihood_.joint_shares();
    Eigen::VectorXd best = alone;
    double least = least_ - 2.0 * nats;
    for (const double rest : {0.001, 0.003, 0.01, 0.03, 0.1}) {
      Eigen::VectorXd shares = Eigen::VectorXd::Constant(alone.size(), rest * alone[one]);
      shares[one] = alone[one];
      likelihood_.set_joint_shares(shares);
      if (value() >= least) continue;
      least = value();
      best = shares;
    }
    likelihood_.set_joint_shares(best);
    estimate(RestrictedLikelihood::joints, nats);
  }

  bool others_than_joints() const {
    return variances[RestrictedLikelihood::repeats] > 0.0 || variances[RestrictedLikelihood::order] > 0.0;
  }

  std::array<double, 3> variances{};
  double correlation = 0.0;

 private:
  double value() const { return likelihood_.minus_twice_log(variances); }

  RestrictedLikelihood& likelihood_;
  double least_, cost_of_shares_ = 0.0;
};

/// Columns of even drift over some poses, each as large over the rows as independent noise.
Eigen::MatrixXd of_unit_rows(const NoiseRows& rows, const std::vector<std::size_t>& poses) {
  std::vector<Eigen::Index> taken;
  for (const std::size_t pose : poses)
    for (Eigen::Index row = rows.first_row[pose]; row < rows.first_row[pose + 1]; ++row) taken.push_back(row);
  Eigen::MatrixXd columns = rows.even_drift(taken, Eigen::all);
  const double root_rows = std::sqrt(static_cast<double>(columns.rows()));
  for (auto column : columns.colwise()) column *= root_rows / std::max(column.norm(), 1e-300);
  return columns;
}

/// Whether even drift, which is a cause, is what goes by the order of measuring rather than slow noise that neighbours
/// share: each in place of the other, beside what joints scatter, and as large as makes the residuals likeliest. Drift
/// has to be likelier by what any component costs.
bool drifts_evenly(const NoiseRows& rows, const std::vector<std::size_t>& poses, std::array<double, 3> variances) {
  if (rows.even_drift.cols() == 0) return false;
  RestrictedLikelihood likelihood(rows, poses, RestrictedLikelihood::EvenDrift::not_fitted);
  const auto least = [&] {
    const auto value_at = [&](double variance) {
      variances[RestrictedLikelihood::order] = variance;
      return likelihood.minus_twice_log(variances);
    };
    return value_at(likeliest_variance(value_at));
  };
  variances[RestrictedLikelihood::order] = 0.0;
  const double without = likelihood.minus_twice_log(variances);
  constexpr Eigen::Index kShifts = 3;  ///< the first columns: a base may creep without turning, as slow noise does
  const Eigen::MatrixXd drift = of_unit_rows(rows, poses);
  double even = std::numeric_limits<double>::infinity();
  for (const Eigen::Index count : {std::min(kShifts, drift.cols()), drift.cols()}) {
    likelihood.set_in_order(drift.leftCols(count));
    even = std::min(even, least());
  }
  if (without - even <= 2.0 * kLikelierInOrder) return false;
  return std::ranges::all_of(std::span(kCorrelations).last(kSlow), [&](double correlation) {
    likelihood.set_correlation(correlation);
    return even + 2.0 * kLikelier < least();
  });
}

}  // namespace

NoiseEstimate estimate_noise(const NoiseRows& rows) {
  constexpr Eigen::Index kFewest = 12;  ///< degrees of freedom below which nothing can be told
  constexpr double kInOrder = 1.0;      ///< lag-one products, in their own scatter, that are worth a closer look
  const std::vector<std::size_t> poses = taking_part(rows);
  RestrictedLikelihood likelihood(rows, poses);
  if (likelihood.freedom() < kFewest) return {};
  Components components(likelihood);
  components.estimate(RestrictedLikelihood::joints, kLikelier);
  if (likelihood.has(RestrictedLikelihood::repeats)) components.estimate(RestrictedLikelihood::repeats, kLikelier);
  double order_nats = kLikelierInOrder;
  if (likelihood.neighbourhood() > kInOrder) components.estimate_order(kCorrelations, order_nats);
  if (rows.drift_is_rival && components.correlation == 0.0 && !drifts_evenly(rows, poses, components.variances)) {
    order_nats = 0.0;
    components.estimate_order(std::span(kCorrelations).last(kSlow), order_nats);
  }
  const auto share_out = [&] {  // components take from one another
    constexpr int kSweeps = 2;
    for (int sweep = 0; sweep < kSweeps && components.others_than_joints(); ++sweep) {
      components.estimate(RestrictedLikelihood::joints, kLikelier);
      if (likelihood.has(RestrictedLikelihood::repeats)) components.estimate(RestrictedLikelihood::repeats, kLikelier);
      if (components.correlation > 0.0) components.estimate(RestrictedLikelihood::order, order_nats);
    }
  };
  share_out();
  components.estimate_joints_apart();
  if (components.estimate_one_joint(kLikelier)) share_out();
  const double scale = std::sqrt(likelihood.variance_left(components.variances));
  const double mean_share = likelihood.joint_shares().mean();
  const Eigen::VectorXd shares = likelihood.joint_shares() / mean_share;
  const auto& [joint, repeat, order] = components.variances;
  return {.model = {.joint_rad = scale * std::sqrt(joint * mean_share / likelihood.per_joint_square()),
                    .repeats = std::sqrt(repeat),
                    .order = std::sqrt(order),
                    .correlation = order > 0.0 ? components.correlation : 0.0,
                    .joint_shares = {shares.begin(), shares.end()}},
          .scale = scale};
}

}  // namespace demecal::inline residuals
