#include "residuals/noise_estimation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "effects/arm_state.hpp"
#include "parameters/observation.hpp"
#include "residuals/noise.hpp"
#include "residuals/smooth_corrections.hpp"

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

/// The smallest value of a function of a positive number, over kVariances and between the best one's neighbours.
double likeliest_variance(const std::function<double(double)>& minus_twice_log) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < kVariances.size(); ++i) {
    const double value = minus_twice_log(kVariances[i]);
    if (value >= least) continue;
    least = value;
    best = i;
  }
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
    for (int step = 0; step < kSteps; ++step) {
      const auto [slope, information] = likelihood_.along_joint_variances(variances);
      const Eigen::VectorXd logs = likelihood_.joint_shares().array().log();
      const Eigen::MatrixXd curvature = information + alike + 1e-9 * Eigen::MatrixXd::Identity(count, count);
      const Eigen::VectorXd change =
          PivotedCholesky(curvature).solve(slope - alike * logs).cwiseMax(-1.0).cwiseMin(1.0);
      likelihood_.set_joint_shares((logs + change).array().exp());
      if (change.cwiseAbs().maxCoeff() < kSettled) break;
    }
    const double mean = likelihood_.joint_shares().mean();
    variances[RestrictedLikelihood::joints] *= mean;
    likelihood_.set_joint_shares(likelihood_.joint_shares() / mean);
    least_ = value();
  }

  bool others_than_joints() const {
    return variances[RestrictedLikelihood::repeats] > 0.0 || variances[RestrictedLikelihood::order] > 0.0;
  }

  std::array<double, 3> variances{};
  double correlation = 0.0;

 private:
  double value() const { return likelihood_.minus_twice_log(variances); }

  RestrictedLikelihood& likelihood_;
  double least_;
};

/// Rows of the poses that take part, without weights and as they were measured.
class RowsTaken {
 public:
  explicit RowsTaken(const ResidualField& field) : field_(field) {
    constexpr double kTakesPart = 0.3;  ///< root of a pose's weight
    for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
      if (field.root_weight[pose] < kTakesPart) continue;
      poses.push_back(pose);
      for (Eigen::Index row = field.first_row[pose]; row < field.first_row[pose + 1]; ++row) {
        rows_.push_back(row);
        over_weight_.push_back(1.0 / field.root_weight[pose]);
      }
    }
  }
  Eigen::Index size() const { return std::ssize(rows_); }
  RowMatrix select(const RowMatrix& whitened) const {
    RowMatrix taken = unwhitened(field_, whitened)(rows_, Eigen::all);
    for (Eigen::Index i = 0; i < taken.rows(); ++i) taken.row(i) *= over_weight_[static_cast<std::size_t>(i)];
    return taken;
  }

  std::vector<std::size_t> poses;

 private:
  const ResidualField& field_;
  std::vector<Eigen::Index> rows_;
  std::vector<double> over_weight_;
};

/// The terms in the order of how fast they change; waves before polynomials that do alike.
std::vector<Eigen::Index> slow_first(const SmoothCorrections& smooth) {
  const auto changes = [&](Eigen::Index term) {
    const SmoothTerm& at = smooth.terms[static_cast<std::size_t>(term)];
    return at.harmonic > 0 ? static_cast<double>(at.harmonic) : 0.7 + 0.5 * at.family;
  };
  std::vector<Eigen::Index> order(smooth.terms.size());
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::stable_sort(order, {}, changes);
  return order;
}

/// The columns that the model may move in, among the declared ones and the smooth terms behind them.
std::vector<Eigen::Index> movable_columns(const Linearization& linearization, const SmoothCorrections& smooth) {
  constexpr double kMostOfRows = 0.6;  ///< of the rows of distinct poses
  const auto declared = static_cast<Eigen::Index>(linearization.ids.size());
  std::vector<Eigen::Index> columns(linearization.ids.size());
  std::iota(columns.begin(), columns.end(), Eigen::Index{0});
  const double share = static_cast<double>(distinct_poses(linearization.fitted)) /
                       static_cast<double>(linearization.fitted.poses.size());
  const double most = kMostOfRows * share * static_cast<double>(linearization.fitted.rows());
  for (const Eigen::Index term : slow_first(smooth))
    if (static_cast<double>(columns.size()) < most) columns.push_back(declared + term);
  return columns;
}

/// What the terms do whose columns are not among `moving`: with too few poses to tell, it counts as noise.
Eigen::VectorXd at_rest(const RowMatrix& columns, const std::vector<Eigen::Index>& moving,
                        const SmoothCorrections& smooth) {
  Eigen::VectorXd numbers = Eigen::VectorXd::Zero(columns.cols());
  numbers.tail(smooth.coefficients.size()) = smooth.coefficients;
  for (const Eigen::Index column : moving) numbers[column] = 0.0;
  return columns * numbers;
}

/// Whether anything could be told of heat: then drift explains as much where it warms while it is measured.
bool heat_varies(const ResidualField& field) {
  const auto celsius = [](const ArmState& state) { return state.stop.temperature_celsius; };
  return std::ranges::any_of(field.states, [&](const ArmState& state) {
    return celsius(state).has_value() && celsius(state) != celsius(field.states.front());
  });
}

/// Whether an arm and an instrument may be as noisy: else what the model lacks is taken for noise.
bool is_noise(const NoiseEstimate& noise, const RowScales& scales) {
  constexpr double kWorstJoint_rad = 1e-3, kWorstShared_m = 5e-3;
  const double unit_m = noise.scale * std::max(scales[kPosition], scales[kDistance]);
  return noise.model.joint_rad <= kWorstJoint_rad &&
         unit_m * std::max(noise.model.repeats, noise.model.order) <= kWorstShared_m;
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
  if (rows.drift_is_rival && components.correlation == 0.0) {
    order_nats = 0.0;
    components.estimate_order(std::span(kCorrelations).last(kSlow), order_nats);
  }
  constexpr int kSweeps = 2;  // components take from one another
  for (int sweep = 0; sweep < kSweeps && components.others_than_joints(); ++sweep) {
    components.estimate(RestrictedLikelihood::joints, kLikelier);
    if (likelihood.has(RestrictedLikelihood::repeats)) components.estimate(RestrictedLikelihood::repeats, kLikelier);
    if (components.correlation > 0.0) components.estimate(RestrictedLikelihood::order, order_nats);
  }
  components.estimate_joints_apart();
  const double scale = std::sqrt(likelihood.variance_left(components.variances));
  const Eigen::VectorXd& shares = likelihood.joint_shares();
  const auto& [joint, repeat, order] = components.variances;
  return {.model = {.joint_rad = scale * std::sqrt(joint / likelihood.per_joint_square()),
                    .repeats = std::sqrt(repeat),
                    .order = std::sqrt(order),
                    .correlation = order > 0.0 ? components.correlation : 0.0,
                    .joint_shares = {shares.begin(), shares.end()}},
          .scale = scale};
}

std::optional<NoiseEstimate> noise_shown(const Linearization& linearization, const SmoothCorrections& smooth) {
  const RowsTaken taken(linearization.fitted);
  if (taken.size() == 0) return std::nullopt;
  const RowMatrix columns = beside(linearization.fitted.declared, smooth.columns(linearization.fitted));
  const std::vector<Eigen::Index> moving = movable_columns(linearization, smooth);
  NoiseRows rows{
      .columns = taken.select(columns(Eigen::all, moving)),
      .residual = taken.select(linearization.fitted.residual + at_rest(columns, moving, smooth)),
      .joint_motions = taken.select(linearization.fitted.motions(Eigen::all, linearization.fitted.scattering)),
      .first_row = {0},
      .group = {},
      .order = {},
      .drift_is_rival = heat_varies(linearization.fitted)};
  for (const std::size_t pose : taken.poses) {
    rows.first_row.push_back(rows.first_row.back() + linearization.fitted.rows_of_pose(pose));
    rows.group.push_back(linearization.fitted.group[pose]);
    rows.order.push_back(static_cast<double>(linearization.fitted.poses[pose]));
  }
  return estimate_noise(rows);
}

DiagnosedModel with_noise_estimated(const DiagnosisProblem& problem, DiagnosedModel model) {
  const Linearization linearization = linearize(problem, model);
  const std::optional<NoiseEstimate> noise = noise_shown(linearization, model.smooth);
  if (!noise || !is_noise(*noise, model.scales)) return model;
  model.noise = noise->model;
  model.noise.fast = unfollowed_variance(model.noise, linearization.fitted.poses);
  model.noise_estimated = true;
  for (double& scale : model.scales) scale *= noise->scale;
  return model;
}

}  // namespace demecal::inline residuals
