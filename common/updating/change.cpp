#include "updating/change.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "data/written_steps.hpp"
#include "decompositions/decompositions.hpp"
#include "errors/input_error.hpp"
#include "fitting/fit.hpp"
#include "next_measurement/next_measurement.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/parameter_space.hpp"
#include "parameters/posterior.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"
#include "updating/expected_noise.hpp"
#include "updating/joint_rounding.hpp"
#include "updating/model_amounts.hpp"
#include "updating/repeats.hpp"
#include "updating/unstated.hpp"

namespace demecal::inline updating {
namespace {

constexpr double kError = 0.05, kErrorOfAny = 1e-3;
/// Of a cause beside those found, or beside a base found anew: it is sought in what they left of the same poses.
constexpr double kErrorOfFurther = 0.005;
/// Of what causes leave, below which it is looked for in how joints are written.
constexpr double kChanceOfNoise = 0.1;
constexpr double kFound = 1.645 + 1.282;  ///< one-sided at 5 %, nine times in ten
constexpr std::size_t kFewestTestedPoses = 4;

double usual_size(const std::string& unit) {
  return unit == "m" ? 2e-4 : unit == "rad" ? 3e-4 : 0.0;
}

bool is_measured(const MeasuredPose& pose) {
  return pose.position_m || !pose.distances_m.empty();
}

bool registers(const Effect& effect) {
  return declared_flag(effect.kind) == &DeclaredModel::registration;
}

class ChangeSearch {
 public:
  ChangeSearch(const CalibratedModel& model, const DataSet& data, const std::set<std::string>& suspects)
      : model_(model), distinct_(distinct_poses(data)), data_(distinct_.data) {
    for (const MeasuredPose& pose : data.poses)
      if (is_measured(pose)) ++report_.measurements;
    for (std::size_t i = 0; i < data_.poses.size(); ++i)
      if (is_measured(data_.poses[i])) poses_.push_back(i);
    report_.poses = poses_.size();
    leave_out([&](std::size_t i) { return suspects.contains(data_.poses[poses_[i]].pose_id); });
    if (poses_.size() < kFewestTestedPoses)
      throw InputError({data.file, 0}, std::to_string(poses_.size()),
                       "poses are too few to tell whether the robot has changed: measure 4 at least, better 12");
    place();
    const ExpectedNoise noise = expected_noise(model_, robot_, data, distinct_, poses_);
    report_.noise_m = noise.noise_m;
    report_.not_testable = noise.sentences;
    known_rows_ = noise.known_rows;
    effects_ = possible_changes(data_, poses_);
  }

  ChangeReport run() {
    ChangeRows rows = make_rows();
    if (leave_out_gross(rows)) rows = make_rows();
    report_.error_m = rms(Eigen::VectorXd::Zero(0), rows);
    report_.lacking = unstated_sentences(robot_, data_, poses_, rows.unstated_m, report_.noise_m);
    const double chance_of_left = judge(rows);
    if (report_.verdict == ChangeVerdict::changed && chance_of_left < kChanceOfNoise) judge_as_rounded();
    for (std::size_t& pose : report_.outliers) pose = distinct_.measured[pose];
    return std::move(report_);
  }

 private:
  /// Finds the base again where the data's frame is another one.
  void place() {
    constexpr double kElsewhere_m = 5e-3;
    robot_ = model_.robot;
    robot_.described = data_.robot;
    std::vector<double> errors;
    for (const std::size_t pose : poses_) errors.push_back(tool_error_m(robot_, data_, data_.poses[pose]));
    if (median(errors) > kElsewhere_m && data_.frame == Frame::sensor) {
      const Fit fit = fit_registration(data_, poses_, {.registration = true}, robot_);
      if (fit.status == FitStatus::converged) {
        robot_ = fit.robot;
        report_.set_up_anew = true;
      }
    }
  }

  ChangeRows make_rows() const {
    return change_rows(model_, data_, {robot_, poses_, report_.noise_m, report_.set_up_anew, rounding_}, effects_);
  }

  /// Whether any was.
  bool leave_out_gross(const ChangeRows& rows) {
    constexpr double kGross = 6.0;
    Eigen::MatrixXd all(rows.values.size(), 0);
    for (const Eigen::MatrixXd& columns : rows.columns) {
      all.conservativeResize(Eigen::NoChange, all.cols() + columns.cols());
      all.rightCols(columns.cols()) = columns;
    }
    if (all.cols() >= all.rows() / 2 || poses_.size() < 2 * kFewestTestedPoses) return false;
    const Eigen::VectorXd left = rows.values - all * least_norm_solution(all, rows.values);
    std::vector<double> norms;
    Eigen::Index row = 0;
    for (const std::size_t pose : poses_) {
      const MeasuredPose& one = data_.poses[pose];
      const Eigen::Index count = (one.position_m ? 3 : 0) + std::ssize(one.distances_m);
      norms.push_back(left.segment(row, count).norm());
      row += count;
    }
    const double usual = std::max(1.0, median(norms));
    return leave_out([&](std::size_t i) { return norms[i] > kGross * usual; });
  }

  /// The poses of which `is_wrong` says so by their place among those compared, unless they are more than a quarter.
  /// Whether any was left out.
  template <typename IsWrong>
  bool leave_out(const IsWrong& is_wrong) {
    std::vector<std::size_t> kept, wrong;
    for (std::size_t i = 0; i < poses_.size(); ++i) (is_wrong(i) ? wrong : kept).push_back(poses_[i]);
    if (wrong.empty() || wrong.size() > poses_.size() / 4) return false;
    report_.outliers.insert(report_.outliers.end(), wrong.begin(), wrong.end());
    poses_ = kept;
    return true;
  }

  /// Of the tool's errors, m, with what the columns of the found causes explain taken away.
  double rms(const Eigen::VectorXd& explained, const ChangeRows& rows) const {
    if (explained.size() == 0) {
      double sum = 0.0;
      for (const std::size_t pose : poses_) sum += std::pow(tool_error_m(robot_, data_, data_.poses[pose]), 2.0);
      return std::sqrt(sum / static_cast<double>(poses_.size()));
    }
    return report_.error_m * std::sqrt(explained.squaredNorm() / std::max(rows.values.squaredNorm(), 1e-30));
  }

  /// Where joints are written coarsely, that may be what is left.
  void judge_as_rounded() {
    const auto rounding = notable_rounding(robot_.chain, data_, poses_, report_.noise_m);
    if (!rounding) return;
    rounding_ = rounding->steps;
    report_.not_testable.push_back(rounding->sentence);
    judge(make_rows());
  }

  /// Finds the causes; returns the chance of as much as they leave by noise alone.
  double judge(const ChangeRows& all) {
    ChangeRows rows = all;
    report_.found.clear();
    report_.verdict = ChangeVerdict::unchanged;
    report_.unnamed = report_.more = false;
    const auto n = static_cast<double>(rows.values.size());
    report_.p_any = fisher_p_value(rows.values.squaredNorm() / n, n, known_rows_);
    report_.strain = strain_of(rows);
    report_.strain_limit = std::sqrt(fisher_quantile(1.0 - kErrorOfAny, n, known_rows_));
    constexpr int kMostCauses = 3;
    for (int step = 0; step < kMostCauses; ++step) {
      std::vector<ChangeCause> causes = causes_on(rows);
      if (causes.empty()) break;
      if (step == 0) report_.tried = causes;
      if (causes.front().p_family >= (step == 0 && !report_.set_up_anew ? kError : kErrorOfFurther)) break;
      report_.found.push_back(causes.front());
      project(rows, causes.front().effect);
    }
    report_.left_m = report_.found.empty() ? report_.error_m : rms(rows.values, all);
    if (!explains(rows)) report_.found.clear();
    for (const ChangeCause& cause : report_.found)
      report_.verdict =
          std::max(report_.verdict, cause.is_registration ? ChangeVerdict::registration : ChangeVerdict::changed);
    if (report_.set_up_anew) report_.verdict = std::max(report_.verdict, ChangeVerdict::registration);
    report_.more = !report_.found.empty() && strain_of(rows) > report_.strain_limit;
    report_.unnamed = report_.found.empty() && report_.p_any < kErrorOfAny;
    if (report_.unnamed) report_.left_m = report_.error_m;
    if (report_.more || report_.unnamed) report_.verdict = ChangeVerdict::changed;
    return fisher_p_value(rows.values.squaredNorm() / n, n, known_rows_);
  }

  static double strain_of(const ChangeRows& rows) {
    return std::sqrt(rows.values.squaredNorm() / static_cast<double>(rows.values.size()));
  }

  /// Whether the causes found are what happened: a joint's sign, or rows of two sets, look like a little of everything.
  bool explains(const ChangeRows& left) const {
    constexpr double kFar = 1.5, kMost = 0.5;
    return strain_of(left) < kFar * report_.strain_limit || report_.left_m < kMost * report_.error_m;
  }

  /// Takes away from all rows what a cause explains.
  void project(ChangeRows& rows, const Effect& effect) const {
    for (std::size_t i = 0; i < effects_.size(); ++i) {
      if (!effects_[i].same_law_as(effect)) continue;
      const Eigen::MatrixXd basis = orthogonal_factor(rows.columns[i], rows.columns[i].cols());
      rows.values -= basis * (basis.transpose() * rows.values).eval();
      for (Eigen::MatrixXd& columns : rows.columns) columns -= basis * (basis.transpose() * columns).eval();
      rows.columns[i].setZero();
      return;
    }
  }

  /// Every cause on the rows left, the likeliest first.
  std::vector<ChangeCause> causes_on(const ChangeRows& rows) const {
    constexpr double kSeen = 1.0, kAsLikely = 6.0;
    const double n = static_cast<double>(rows.values.size()), whole = rows.values.squaredNorm();
    struct Scored {
      double length;
      ChangeCause cause;
    };
    std::vector<Scored> scored;
    for (std::size_t i = 0; i < effects_.size(); ++i) {
      const Eigen::MatrixXd& columns = rows.columns[i];
      if (columns.norm() < kSeen || columns.cols() + 2 > columns.rows()) continue;
      const PivotedQr qr(columns);
      const auto rank = static_cast<double>(qr.rank());
      ChangeCause cause;
      cause.effect = effects_[i];
      cause.is_registration = registers(effects_[i]);
      const Eigen::VectorXd values = qr.solve(rows.values);
      cause.effect.values.assign(values.begin(), values.end());
      cause.by_model = amount_by_model(robot_, data_, poses_, effects_[i]);
      const double left = (rows.values - columns * values).squaredNorm();
      const double freedom = known_rows_ + n - rank, variance = (known_rows_ + left) / freedom;
      cause.p_value = fisher_p_value(std::max(0.0, whole - left) / rank / variance, rank, freedom);
      fill_size(columns, std::sqrt(variance), cause);
      scored.push_back({(known_rows_ + n) * std::log(known_rows_ + left) + rank * std::log(n), std::move(cause)});
    }
    std::sort(scored.begin(), scored.end(), [](const Scored& a, const Scored& b) { return a.length < b.length; });
    std::vector<ChangeCause> causes;
    for (std::size_t i = 0; i < scored.size(); ++i) {
      ChangeCause& cause = scored[i].cause;
      cause.p_family = 1.0 - std::pow(1.0 - cause.p_value, static_cast<double>(scored.size()));
      for (std::size_t k = 1; i == 0 && k < scored.size(); ++k)
        if (scored[k].length - scored[0].length < kAsLikely) cause.rivals.push_back(to_string(scored[k].cause.effect));
      causes.push_back(std::move(cause));
    }
    return causes;
  }

  void fill_size(const Eigen::MatrixXd& columns, double deviation, ChangeCause& cause) const {
    const auto labels = law_of(cause.effect).coefficients(cause.effect, data_.robot);
    cause.unit = labels.front().unit;
    std::vector<Eigen::Index> same;
    double square = 0.0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i].unit != cause.unit) continue;
      same.push_back(static_cast<Eigen::Index>(i));
      square += cause.effect.values[i] * cause.effect.values[i];
    }
    cause.size = same.size() == 1 ? cause.effect.values[static_cast<std::size_t>(same.front())] : std::sqrt(square);
    const Eigen::MatrixXd covariance = moore_penrose_inverse(columns.transpose() * columns).inverse;
    double mean = 0.0;
    for (const Eigen::Index i : same) mean += covariance(i, i) / static_cast<double>(same.size());
    cause.standard_error = deviation * std::sqrt(std::max(mean, 0.0));
    cause.detectable = kFound * cause.standard_error;
    const double usual = usual_size(cause.unit);
    if (usual > 0.0 && cause.standard_error > 0.0)
      cause.power = 0.5 * std::erfc((1.645 - usual / cause.standard_error) / std::sqrt(2.0));
  }

  const CalibratedModel& model_;
  const DistinctPoses distinct_;
  const DataSet& data_;
  CorrectedRobot robot_;
  std::vector<std::size_t> poses_;
  std::vector<Effect> effects_;
  double known_rows_ = 0.0;  ///< what is known of the noise's size counts as so many rows more
  JointSteps rounding_;
  ChangeReport report_;
};

}  // namespace

std::string_view to_string(ChangeVerdict verdict) {
  constexpr std::array<std::string_view, 3> kWords{"unchanged", "registration", "changed"};
  return kWords[static_cast<std::size_t>(verdict)];
}

ChangeReport find_change(const CalibratedModel& model, const DataSet& data, const std::set<std::string>& suspects) {
  return ChangeSearch(model, data, suspects).run();
}

}  // namespace demecal::inline updating
