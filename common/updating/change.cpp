#include "updating/change.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "data/written_steps.hpp"
#include "decompositions/decompositions.hpp"
#include "errors/input_error.hpp"
#include "fitting/fit.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"
#include "updating/change_causes.hpp"
#include "updating/change_rows.hpp"
#include "updating/change_steps.hpp"
#include "updating/changed_zeros.hpp"
#include "updating/expected_noise.hpp"
#include "updating/joint_rounding.hpp"
#include "updating/repeats.hpp"
#include "updating/unstated.hpp"

namespace demecal::inline updating {
namespace {

constexpr double kError = 0.05, kErrorOfAny = 1e-3;
/// Of a cause beside those found, or beside a base found anew: it is sought in what they left of the same poses.
constexpr double kErrorOfFurther = 0.005;
/// Of what causes leave, below which it is looked for in how joints are written.
constexpr double kChanceOfNoise = 0.1;
constexpr std::size_t kFewestTestedPoses = 4;

bool is_measured(const MeasuredPose& pose) {
  return pose.position_m || !pose.distances_m.empty();
}

/// Where the rows were linearised.
struct Linearised {
  ChangeRows rows;
  Eigen::VectorXd taken_in;  ///< of the coefficients of the causes found, what the robot has there
};

class ChangeSearch {
 public:
  /// `base_may_move`: it is found again where the errors are large.
  ChangeSearch(const CalibratedModel& model, const DataSet& data, const std::set<std::string>& suspects,
               bool base_may_move)
      : model_(model), distinct_(distinct_poses(without_unknown_orientations(model, data))), data_(distinct_.data) {
    for (const MeasuredPose& pose : data.poses)
      if (is_measured(pose)) ++report_.measurements;
    for (std::size_t i = 0; i < data_.poses.size(); ++i)
      if (is_measured(data_.poses[i])) poses_.push_back(i);
    report_.poses = poses_.size();
    leave_out([&](std::size_t i) { return suspects.contains(data_.poses[poses_[i]].pose_id); });
    if (poses_.size() < kFewestTestedPoses)
      throw InputError({data.file, 0}, std::to_string(poses_.size()),
                       "poses are too few to tell whether the robot has changed: measure 4 at least, better 12");
    place(base_may_move);
    const ExpectedNoise noise = expected_noise(model_, robot_, data, distinct_, poses_);
    report_.noise_m = noise.noise_m;
    report_.not_testable = noise.sentences;
    known_positions_ = noise.known_rows;
    compare_orientations();
  }

  bool base_was_found() const { return report_.set_up_anew; }
  ChangeReport run() {
    ScaledChangeRows scaled = scaled_rows(robot_);
    ChangeRows rows = whitened(scaled);
    if (leave_out_gross(rows)) {
      compare_orientations();
      scaled = scaled_rows(robot_);
      rows = whitened(scaled);
    }
    report_.orientation_rad = orientation_rad_;
    report_.unseen_zeros = unseen_zeros(scaled, rows, effects_, report_.set_up_anew);
    report_.error_m = rms_m(robot_);
    report_.lacking = unstated_sentences(robot_, data_, poses_, rows.unstated_m, report_.noise_m);
    const double chance_of_left = judge(rows);
    if (report_.verdict == ChangeVerdict::changed && chance_of_left < kChanceOfNoise) judge_as_rounded();
    if (std::string heat = unseen_heat_sentence(report_.found, robot_, data_, poses_); !heat.empty())
      report_.not_testable.insert(report_.not_testable.begin(), std::move(heat));
    for (std::size_t& pose : report_.outliers) pose = distinct_.measured[pose];
    return std::move(report_);
  }

 private:
  /// Finds the base again where the data's frame is another one.
  void place(bool base_may_move) {
    robot_ = model_.robot;
    robot_.described = data_.robot;
    if (!base_may_move) return;
    if (std::optional<CorrectedRobot> moved = set_up_anew(robot_, data_, poses_)) {
      robot_ = std::move(*moved);
      report_.set_up_anew = true;
    }
  }

  ComparedPoses compared(const CorrectedRobot& robot) const {
    return {robot, poses_, report_.noise_m, orientation_rad_, report_.set_up_anew, rounding_};
  }
  ScaledChangeRows scaled_rows(const CorrectedRobot& robot) const {
    return scaled_change_rows(model_, data_, compared(robot), effects_);
  }

  /// Estimates how far orientations scatter, and compares them where that can be told.
  void compare_orientations() {
    constexpr double kFewestRows = 6.0;
    effects_ = possible_changes(data_, poses_, true);
    const OrientationNoise noise = orientation_noise(model_, data_, compared(robot_), effects_);
    orientation_rad_ = noise.freedom >= kFewestRows ? noise.noise_rad : 0.0;
    if (orientation_rad_ == 0.0) effects_ = possible_changes(data_, poses_, false);
    known_rows_ = orientation_rad_ == 0.0 ? known_positions_ : std::min(known_positions_, noise.freedom);
  }

  /// Whether any was.
  bool leave_out_gross(const ChangeRows& rows) {
    constexpr double kGross = 6.0;
    if (poses_.size() < 2 * kFewestTestedPoses) return false;
    const std::vector<double> norms = norms_beyond_causes(rows);
    if (norms.empty()) return false;
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

  /// Of the tool's errors by a robot, m.
  double rms_m(const CorrectedRobot& robot) const {
    double sum = 0.0;
    for (const std::size_t pose : poses_) sum += std::pow(tool_error_m(robot, data_, data_.poses[pose]), 2.0);
    return std::sqrt(sum / static_cast<double>(poses_.size()));
  }

  /// Where joints are written coarsely, that may be what is left.
  void judge_as_rounded() {
    const auto rounding = notable_rounding(robot_.chain, data_, poses_, report_.noise_m);
    if (!rounding) return;
    rounding_ = rounding->steps;
    report_.not_testable.push_back(rounding->sentence);
    judge(whitened(scaled_rows(robot_)));
  }

  /// Finds the causes; returns the chance of as much as they leave by noise alone.
  double judge(const ChangeRows& all) {
    Linearised at{all, {}};
    report_.verdict = ChangeVerdict::unchanged;
    const auto n = static_cast<double>(all.values.size());
    report_.p_any = fisher_p_value(all.values.squaredNorm() / n, n, known_rows_);
    report_.strain = strain_of(all);
    report_.strain_limit = std::sqrt(fisher_quantile(1.0 - kErrorOfAny, n, known_rows_));
    constexpr int kMostCauses = 3;
    constexpr std::size_t kMostTried = 4;  // of each step: what the likeliest does may be so to first order only
    std::vector<ChangeStep> steps{{{}, all, report_.strain, report_.strain, report_.error_m, orientation_rad_}};
    for (int step = 0; step < kMostCauses; ++step) {
      std::vector<ChangeCause> causes =
          tested_causes(steps.back().left, {robot_, data_, poses_, effects_, known_rows_});
      if (causes.empty()) break;
      if (step == 0) report_.tried = causes;
      const double error = step == 0 && !report_.set_up_anew ? kError : kErrorOfFurther;
      const std::size_t before = steps.size();
      for (std::size_t i = 0; i < std::min(kMostTried, causes.size()) && steps.size() == before; ++i) {
        if (causes[i].p_family >= error) break;
        if (std::optional<ChangeStep> next = with_further(steps.back(), causes[i], at))
          steps.push_back(std::move(*next));
      }
      if (steps.size() == before) break;
    }
    ChangeStep& last = steps[named_step(steps, {report_.strain_limit, all.expected_m})];
    orientation_rad_ = last.orientation_rad;
    report_.found = std::move(last.found);
    report_.left_m = last.left_m;
    for (const ChangeCause& cause : report_.found)
      report_.verdict =
          std::max(report_.verdict, cause.is_registration ? ChangeVerdict::registration : ChangeVerdict::changed);
    if (report_.set_up_anew) report_.verdict = std::max(report_.verdict, ChangeVerdict::registration);
    report_.warmed = warmed_zeros(report_.found, report_.tried, robot_);
    report_.more = !report_.found.empty() && last.strain > report_.strain_limit;
    report_.unnamed = report_.found.empty() && report_.p_any < kErrorOfAny;
    if (report_.more || report_.unnamed) report_.verdict = ChangeVerdict::changed;
    return fisher_p_value(last.left.values.squaredNorm() / n, n, known_rows_);
  }

  /// One cause more. None where the robot with it does not really leave less: what rows say of a large change, to
  /// first order, need not be so.
  std::optional<ChangeStep> with_further(const ChangeStep& before, const ChangeCause& cause, Linearised& at) {
    ChangeStep next = before;
    Linearised there = at;
    next.found.push_back(cause);
    next.left = refit(there, next.found);
    next.orientation_rad = orientation_rad_;
    next.strain = strain_by(next.found);
    next.strain_before = orientation_rad_ == before.orientation_rad ? before.strain : strain_by(before.found);
    next.left_m = rms_m(with_causes(next.found));
    if (!really_leaves_less(next, before.left_m)) {
      orientation_rad_ = before.orientation_rad;
      return std::nullopt;
    }
    at = std::move(there);
    return next;
  }

  /// Of what the robot with these causes leaves.
  double strain_by(const std::vector<ChangeCause>& found) const {
    return strain_of(whitened(scaled_rows(with_causes(found))));
  }

  /// Takes the causes into the robot, and linearises there again while they explain more so: what they leave of the
  /// rows. Large zeros and tools turn the arm, and what is second order in one looks like a little of others.
  ChangeRows refit(Linearised& at, std::vector<ChangeCause>& found) {
    constexpr int kMostRounds = 5;
    constexpr double kWorth = 0.99;
    const auto amounts_at = [&](const ChangeRows& rows) { return amounts_on(found, rows, effects_, known_rows_); };
    ChangeAmounts amounts = amounts_at(at.rows);
    at.taken_in.conservativeResizeLike(Eigen::VectorXd::Zero(amounts.values.size()));
    set_amounts(at.taken_in + amounts.values, amounts.variances, data_.robot, found);
    bool moved = false;
    for (int round = 0; round < kMostRounds; ++round) {
      Linearised next{whitened(scaled_rows(with_causes(found))), at.taken_in + amounts.values};
      ChangeAmounts beyond = amounts_at(next.rows);
      if (!(beyond.left < kWorth * amounts.left)) break;
      moved = true;
      at = std::move(next);
      amounts = std::move(beyond);
      set_amounts(at.taken_in + amounts.values, amounts.variances, data_.robot, found);
    }
    if (moved && orientation_rad_ > 0.0) {
      // What was second order counted as their noise.
      const CorrectedRobot robot = with_causes(found);
      orientation_rad_ = orientation_noise(model_, data_, compared(robot), effects_).noise_rad;
      at = {whitened(scaled_rows(robot)), at.taken_in + amounts.values};
      amounts = amounts_at(at.rows);
      set_amounts(at.taken_in + amounts.values, amounts.variances, data_.robot, found);
    }
    return left_by(found, amounts, at.rows, effects_);
  }

  /// A base that was found before they were is found again.
  CorrectedRobot with_causes(const std::vector<ChangeCause>& found) const {
    CorrectedRobot robot = robot_;
    for (const ChangeCause& cause : found) robot.effects.push_back(cause.effect);
    if (!report_.set_up_anew) return robot;
    const Fit fit = fit_registration(data_, poses_, {.registration = true}, robot, {.starts = 0});
    return fit.status == FitStatus::converged ? fit.robot : robot;
  }

  const CalibratedModel& model_;
  const DistinctPoses distinct_;
  const DataSet& data_;
  CorrectedRobot robot_;
  std::vector<std::size_t> poses_;
  std::vector<Effect> effects_;
  /// What is known of the noise's size counts as so many rows more; the same of positions alone.
  double known_rows_ = 0.0, known_positions_ = 0.0;
  double orientation_rad_ = 0.0;  ///< noise of orientations, per axis; 0: they are not compared
  JointSteps rounding_;
  ChangeReport report_;
};

/// Whether causes were found of which none is of the base, and nothing is left.
bool explains_all(const ChangeReport& report) {
  return !report.found.empty() && !report.more &&
         std::ranges::none_of(report.found, [](const ChangeCause& cause) { return cause.is_registration; });
}

}  // namespace

std::string_view to_string(ChangeVerdict verdict) {
  constexpr std::array<std::string_view, 3> kWords{"unchanged", "registration", "changed"};
  return kWords[static_cast<std::size_t>(verdict)];
}

ChangeReport find_change(const CalibratedModel& model, const DataSet& data, const std::set<std::string>& suspects) {
  ChangeSearch search(model, data, suspects, true);
  if (search.base_was_found()) {
    // A zero that is off by degrees moves the tool as far: where it explains all, the base stands where it stood.
    ChangeReport with_old_base = ChangeSearch(model, data, suspects, false).run();
    if (explains_all(with_old_base)) return with_old_base;
  }
  return search.run();
}

}  // namespace demecal::inline updating
