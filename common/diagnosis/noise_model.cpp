#include "diagnosis/noise_model.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>

namespace demecal {
namespace {

constexpr Eigen::Index kMostRows = 360;  ///< in an estimate: a likelihood costs their cube
constexpr std::size_t kRuns = 3;         ///< of poses, where not all take part
constexpr double kLikelier = 0.5;        ///< nats that a component must make the residuals likelier by
constexpr double kLikelierInOrder = 2.0;
constexpr std::array kCorrelations{0.5, 0.8, 0.9, 0.95, 0.98, 0.995};
constexpr std::array kVariances{0.01, 0.1, 1.0, 10.0, 100.0};

/// The poses of a field that take part: all, or as many as kMostRows allow, in kRuns runs.
std::vector<std::size_t> taking_part(const NoiseRows& rows) {
  const std::size_t poses = rows.group.size();
  const double rows_of_pose =
      static_cast<double>(rows.residual.size()) / static_cast<double>(std::max<std::size_t>(poses, 1));
  const auto most = static_cast<std::size_t>(static_cast<double>(kMostRows) / std::max(rows_of_pose, 1.0));
  std::vector<std::size_t> taken;
  for (std::size_t i = 0; i < poses; ++i) {
    const std::size_t length = most / kRuns, run = i * kRuns / poses, begin = (run * poses + kRuns - 1) / kRuns;
    if (poses <= most || i - begin < length) taken.push_back(i);
  }
  return taken;
}

/// Minus twice the restricted log-likelihood of components of variance, up to a constant, over some of the poses.
class RestrictedLikelihood {
 public:
  RestrictedLikelihood(const NoiseRows& rows, const std::vector<std::size_t>& poses);

  Eigen::Index freedom() const { return freedom_; }
  enum Component { joints, repeats, order };
  bool has(Component component) const { return covariance_[component].size() > 0; }
  double minus_twice_log(const std::array<double, 3>& variances) const;
  /// Sum of squares per degree of freedom, the components being as they are.
  double variance_left(const std::array<double, 3>& variances) const;
  /// Mean variance of a row per rad^2 of the joints' scatter.
  double per_joint_square() const { return per_joint_square_; }
  void set_correlation(double from_pose_to_pose);
  /// Lag-one products of the poses' residuals over what chance would make their root mean square.
  double neighbourhood() const { return neighbourhood_; }

 private:
  Eigen::MatrixXd beyond_model(const Eigen::MatrixXd& columns) const;
  Eigen::MatrixXd covariance(const std::array<double, 3>& variances) const;

  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> model_;
  Eigen::Index rows_ = 0, rank_ = 0, freedom_ = 0;
  Eigen::VectorXd left_;
  std::array<Eigen::MatrixXd, 3> covariance_;
  std::vector<Eigen::Index> first_row_;
  std::vector<double> order_;
  double per_joint_square_ = 1.0, neighbourhood_ = 0.0;
};

RestrictedLikelihood::RestrictedLikelihood(const NoiseRows& rows, const std::vector<std::size_t>& poses) {
  std::vector<Eigen::Index> taken;
  for (const std::size_t pose : poses) {
    first_row_.push_back(static_cast<Eigen::Index>(taken.size()));
    order_.push_back(rows.order[pose]);
    for (Eigen::Index row = rows.first_row[pose]; row < rows.first_row[pose + 1]; ++row) taken.push_back(row);
  }
  rows_ = std::ssize(taken);
  first_row_.push_back(rows_);
  const Eigen::MatrixXd model = rows.columns(taken, Eigen::all);
  const Eigen::VectorXd values = rows.residual(taken);
  if (model.cols() > 0) {
    const Eigen::VectorXd norms = model.colwise().norm().cwiseMax(1e-300);
    model_.setThreshold(1e-9);
    model_.compute(model * norms.cwiseInverse().asDiagonal());
    rank_ = model_.rank();
  }
  freedom_ = rows_ - rank_;
  left_ = beyond_model(values);
  const Eigen::Index joints_count = rows.joint_motions.cols();
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(rows_, joints_count * std::ssize(poses));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Index count = first_row_[i + 1] - first_row_[i];
    motions.block(first_row_[i], static_cast<Eigen::Index>(i) * joints_count, count, joints_count) =
        rows.joint_motions.middleRows(rows.first_row[poses[i]], count);
  }
  per_joint_square_ = std::max(motions.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(rows_, 1)), 1e-300);
  const Eigen::MatrixXd seen = beyond_model(motions / std::sqrt(per_joint_square_));
  covariance_[joints] = seen * seen.transpose();
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < poses.size(); ++i) members[rows.group[poses[i]]].push_back(i);
  std::erase_if(members, [](const auto& group) { return group.second.size() < 2; });
  if (!members.empty()) {
    constexpr Eigen::Index kRowsShared = 6;
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
  // What is left of the rows themselves tells whether neighbours in order are alike, before anything is estimated.
  Eigen::VectorXd padded = Eigen::VectorXd::Zero(rows_);
  padded.tail(freedom_) = left_;
  if (rank_ > 0) padded.applyOnTheLeft(model_.householderQ());
  double products = 0.0, squares = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Eigen::Index count = std::min(first_row_[i + 1] - first_row_[i], first_row_[i] - first_row_[i - 1]);
    const double product = padded.segment(first_row_[i], count).dot(padded.segment(first_row_[i - 1], count));
    products += product;
    squares += product * product;
  }
  neighbourhood_ = squares > 0.0 ? products / std::sqrt(squares) : 0.0;
}

/// What of columns the model cannot follow: freedom x columns.
Eigen::MatrixXd RestrictedLikelihood::beyond_model(const Eigen::MatrixXd& columns) const {
  Eigen::MatrixXd turned = columns;
  if (rank_ > 0) turned.applyOnTheLeft(model_.householderQ().adjoint());
  return turned.bottomRows(freedom_);
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
  const Eigen::MatrixXd root = alike.llt().matrixL();
  constexpr Eigen::Index kAxes = 3;
  Eigen::MatrixXd shared = Eigen::MatrixXd::Zero(rows_, kAxes * poses);
  for (Eigen::Index i = 0; i < poses; ++i) {
    const auto pose = static_cast<std::size_t>(i);
    const Eigen::Index count = std::min(kAxes, first_row_[pose + 1] - first_row_[pose]);
    for (Eigen::Index axis = 0; axis < count; ++axis)
      shared.row(first_row_[pose] + axis).segment(axis * poses, poses) = root.row(i);
  }
  const Eigen::MatrixXd drift = beyond_model(shared);
  covariance_[order] = drift * drift.transpose();
}

Eigen::MatrixXd RestrictedLikelihood::covariance(const std::array<double, 3>& variances) const {
  Eigen::MatrixXd whole = Eigen::MatrixXd::Identity(freedom_, freedom_);
  for (std::size_t i = 0; i < variances.size(); ++i)
    if (variances[i] > 0.0 && covariance_[i].size() > 0) whole += variances[i] * covariance_[i];
  return whole;
}

double RestrictedLikelihood::minus_twice_log(const std::array<double, 3>& variances) const {
  const Eigen::LLT<Eigen::MatrixXd> root(covariance(variances));
  if (root.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  const double squares = root.matrixL().solve(left_).squaredNorm();
  return static_cast<double>(freedom_) * std::log(std::max(squares, 1e-300)) +
         2.0 * Eigen::MatrixXd(root.matrixLLT()).diagonal().array().log().sum();
}

double RestrictedLikelihood::variance_left(const std::array<double, 3>& variances) const {
  return covariance(variances).llt().matrixL().solve(left_).squaredNorm() /
         static_cast<double>(std::max<Eigen::Index>(freedom_, 1));
}

/// The smallest value of a function of a positive number, over kVariances and between the best one's neighbours.
double likeliest(const std::function<double(double)>& minus_twice_log) {
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
    trial[component] = likeliest([&](double variance) {
      trial[component] = variance;
      return likelihood_.minus_twice_log(trial);
    });
    const double with = likelihood_.minus_twice_log(trial);
    variances[component] = without - with > 2.0 * nats ? trial[component] : 0.0;
    least_ = value();
  }
  void estimate_order() {
    const double before = least_;
    double best = least_;
    for (const double candidate : kCorrelations) {
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
    if (before - best <= 2.0 * kLikelierInOrder) return void(correlation = 0.0);
    likelihood_.set_correlation(correlation);
    estimate(RestrictedLikelihood::order, kLikelierInOrder);
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
  if (likelihood.neighbourhood() > kInOrder) components.estimate_order();
  constexpr int kSweeps = 2;  // components take from one another
  for (int sweep = 0; sweep < kSweeps && components.others_than_joints(); ++sweep) {
    components.estimate(RestrictedLikelihood::joints, kLikelier);
    if (likelihood.has(RestrictedLikelihood::repeats)) components.estimate(RestrictedLikelihood::repeats, kLikelier);
    if (components.correlation > 0.0) components.estimate(RestrictedLikelihood::order, kLikelierInOrder);
  }
  const auto& [joint, repeat, order] = components.variances;
  const double scale = std::sqrt(likelihood.variance_left(components.variances));
  return {.model = {.joint_rad = scale * std::sqrt(joint / likelihood.per_joint_square()),
                    .repeats = std::sqrt(repeat),
                    .order = std::sqrt(order),
                    .correlation = order > 0.0 ? components.correlation : 0.0},
          .scale = scale};
}

}  // namespace demecal
