#include "data_check/pendant.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data_check/nearest_reading.hpp"
#include "data_check/other_number.hpp"
#include "data_check/pendant_rounding.hpp"
#include "effects/arm_state.hpp"
#include "fitting/fit.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "trials/explanations.hpp"
#include "trials/finding.hpp"
#include "trials/sign_sets.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

double largest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::ranges::max_element(values);
}

std::string triple(const Eigen::Vector3d& vector_m) {
  const auto rounded = [](double metres_value) { return std::round(1e2 * millimetres(metres_value)) / 1e2 + 0.0; };
  return fmt::format("[{:g}, {:g}, {:g}] mm", rounded(vector_m.x()), rounded(vector_m.y()), rounded(vector_m.z()));
}

Trial trial_of(const DataSet& data) {
  Trial trial{data.robot.chain, {data.robot.chain.tool_m}, {}, 1};
  for (std::size_t i = 0; i < data.poses.size(); ++i)
    trial.rows.push_back({data.poses[i].joints, *data.poses[i].position_m, 0, 0, i});
  return trial;
}

/// Where tool and base of a fit stand otherwise than described, a sentence each.
std::vector<std::string> tool_and_base(const TrialFit& fit, const Chain& chain, const PendantRounding& rounding) {
  std::vector<std::string> sentences;
  const double told_m = rounding.typical_m();
  const Eigen::Vector3d& tool_m = fit.tools_m.front();
  if ((tool_m - chain.tool_m).norm() > told_m) {
    sentences.push_back(fmt::format("The tool: the controller's tool point is at {} on the flange, {} is described{}.",
                                    triple(tool_m), triple(chain.tool_m),
                                    tool_m.norm() < 2.0 * told_m ? "; it shows the flange itself (tool 0)" : ""));
  }
  const Eigen::Isometry3d& base = fit.sensor_from_base.front();
  const Eigen::Vector3d turn = vector_of(base.linear());
  if (base.translation().norm() > told_m || turn.norm() > rounding.told_rad()) {
    std::string turned;
    if (turn.norm() > rounding.told_rad())
      turned = fmt::format(", turned by {:.2f} deg about [{:.2f}, {:.2f}, {:.2f}]", degrees(turn.norm()),
                           turn.normalized().x(), turn.normalized().y(), turn.normalized().z());
    sentences.push_back(
        fmt::format("The base: the described base stands at {}{} in the frame that the controller "
                    "counts in (`base:` of the robot file, or another frame is active).",
                    triple(base.translation()), turned));
  }
  return sentences;
}

constexpr const char* kOtherZeros = "Zeros of joints are elsewhere:";
constexpr const char* kOtherLinks = "The arm has other links than described:";

class PendantSearch {
 public:
  PendantSearch(const DataSet& data, PendantComparison& result)
      : data_(data), trial_(trial_of(data)), rounding_(data), result_(result) {}

  void run() {
    if (search(rounding_.is_coarse()) || !rounding_.is_coarse()) return;
    rounding_.believe(true);
    if (rounding_.accepts(result_.errors_m, trial_.rows)) {
      result_.agrees = result_.explained = true;
      result_.findings = left_open(data_, rounding_.typical_m());
    } else {
      search(false);
    }
    if (result_.explained) result_.findings.push_back(rounding_.sentence());
  }

 private:
  /// `simple`: without what many numbers at once would fit by chance.
  bool search(bool simple) {
    const TrialFit placed = fit_base_and_tools(trial_);
    if (settles(placed, {})) return true;
    constexpr double kSingleOnly_m = std::numeric_limits<double>::infinity();
    const std::vector<AlikeReading> singles = single_readings(best_explanation(trial_, placed, kSingleOnly_m, true));
    const auto signs = best_sign_set(trial_, {.zeros = false, .in_base = true});
    if (signs && nearer(signs->best, singles) && settles(reading_of_signs(*signs))) return true;
    if (settles(singles)) return true;
    if (settles_without_one() || settles_with_one_number()) return true;
    if (simple) return false;
    if (const auto set = best_sign_set(trial_, {.zeros = true, .in_base = true});
        set && settles(reading_of_signs(*set)))
      return true;
    if (const auto several = best_explanation(trial_, placed, rounding_.typical_m(), true);
        several && settles(reading_of(several->explanations)))
      return true;
    if (settles(single_readings(best_explanation(trial_, placed, kSingleOnly_m)))) return true;
    return try_numbers({.registration = true, .tool = true, .joint_offset = true}, false) ||
           try_numbers({.registration = true, .tool = true, .joint_offset = true, .geometry = true}, true);
  }

  /// Poses read otherwise, with the sentences that say how.
  struct Reading {
    Trial trial;
    std::vector<std::string> sentences;
  };

  Reading reading_of(const std::vector<Explanation>& together) const {
    Reading reading{trial_, {}};
    for (const Explanation& one : together) {
      one.apply(reading.trial);
      reading.sentences.push_back("It fits if " + one.clause + ".");
    }
    return reading;
  }

  Reading reading_of_signs(SignSetChoice choice) const {
    if (choice.distance_m <= same_m())
      std::erase_if(choice.alike, [&](const auto& other) { return other.distance_m > choice.distance_m + same_m(); });
    Reading reading = reading_of({choice.best});
    std::ranges::move(alike_sentences(choice), std::back_inserter(reading.sentences));
    return reading;
  }

  /// Up to which differences in how far tool and base stand from their description decide nothing.
  double same_m() const { return std::max(5e-3, 4.0 * rounding_.typical_m()); }

  /// How far tool and base stand from their description by a change; infinity where it does not agree.
  double distance_m(const Explanation& change) const {
    const Trial read = reading_of({change}).trial;
    const TrialFit fit = fit_base_and_tools(read);
    return rounding_.accepts(fit.error_m, read.rows) ? distance_from_description_m(read, fit, true)
                                                     : std::numeric_limits<double>::infinity();
  }

  /// Whether a set of signs leaves tool and base nearer to their description than any single change that agrees.
  bool nearer(const Explanation& signs, const std::vector<AlikeReading>& singles) const {
    return singles.empty() || distance_m(signs) + same_m() < singles.front().distance_m;
  }

  /// The single changes that agree, those which tool and base speak for first.
  std::vector<AlikeReading> single_readings(const std::optional<BestExplanation>& best) const {
    if (!best || best->explanations.size() != 1) return {};
    std::vector<Explanation> alike = best->equals;
    alike.insert(alike.begin(), best->explanations.front());
    return nearest_to_description(
        alike, [this](const Explanation& one) { return distance_m(one); }, same_m());
  }

  bool settles(const std::vector<AlikeReading>& singles) {
    if (singles.empty()) return false;
    Reading reading = reading_of({singles.front().change});
    std::ranges::move(as_well_sentences(singles, same_m()), std::back_inserter(reading.sentences));
    return settles(reading);
  }

  bool settles(const Reading& reading) {
    return settles(fit_base_and_tools(reading.trial), reading.trial.rows, reading.sentences, reading.trial.chain);
  }

  bool settles(const TrialFit& fit, std::vector<std::string> readings) {
    return settles(fit, trial_.rows, std::move(readings), data_.robot.chain);
  }

  bool settles(const TrialFit& fit, const std::vector<TrialRow>& rows, std::vector<std::string> readings,
               const Chain& described) {
    if (!rounding_.accepts(fit.error_m, rows)) return false;
    std::ranges::move(tool_and_base(fit, described, rounding_), std::back_inserter(readings));
    result_.findings = std::move(readings);
    result_.explained = true;
    return true;
  }

  /// Whether all poses but a certain one agree: where leaving out another helps as well, none is to blame.
  bool settles_without_one() {
    std::optional<std::size_t> odd;
    TrialFit fit;
    for (std::size_t out = 0; out < trial_.rows.size(); ++out) {
      Trial rest = trial_;
      rest.rows.erase(rest.rows.begin() + static_cast<std::ptrdiff_t>(out));
      TrialFit without = fit_base_and_tools(rest);
      if (!rounding_.accepts(without.error_m, rest.rows)) continue;
      if (odd) return false;
      odd = out;
      fit = std::move(without);
    }
    if (!odd) return false;
    const MeasuredPose& pose = data_.poses[*odd];
    std::vector<TrialRow> rest = trial_.rows;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(*odd));
    return settles(fit, rest,
                   {fmt::format("Line {}{}: the other {} poses agree, and by them its point is at {}, not at {}: "
                                "correct it, or read it off again.",
                                pose.line, name_beside_line(pose), fit.error_m.size(),
                                triple(predicted_point(fit, trial_.rows[*odd])), triple(*pose.position_m))},
                   data_.robot.chain);
  }

  bool settles_with_one_number() {
    const std::vector<OtherNumber> numbers = numbers_that_explain(
        trial_, [this](const std::vector<double>& errors_m) { return rounding_.accepts(errors_m, trial_.rows); });
    if (numbers.empty()) return false;
    std::vector<std::string> readings{numbers.front().is_zero ? kOtherZeros : kOtherLinks, numbers.front().sentence};
    for (std::size_t i = 1; i < numbers.size(); ++i)
      readings.push_back("As well, and these poses cannot tell which: " + numbers[i].sentence);
    return settles(numbers.front().fit, std::move(readings));
  }

  /// Whether other numbers of the links make it fit; those that differ most are named.
  bool try_numbers(const DeclaredModel& declared, bool links) {
    constexpr std::size_t kMostNamed = 6;
    constexpr double kTold = 4.0;  ///< standard errors
    std::vector<std::size_t> all(data_.poses.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    FitOptions options;
    options.prior_m = 1.0;  // a description may be of another arm altogether
    options.prior_rad = 3.0;
    options.robust = false;
    const Fit fit = fit_declared(data_, all, declared, nominal_robot(data_), options);
    if (fit.status != FitStatus::converged || !rounding_.accepts(tool_errors_m(fit.robot, data_, all), trial_.rows))
      return false;
    std::vector<std::pair<double, std::string>> named;
    for (const ParameterEstimate& estimate : fit.estimates) {
      if (estimate.id.kind != ParameterId::Kind::link) continue;
      const double difference = estimate.value - estimate.nominal;
      const bool is_angle = estimate.id.is_angle();
      const double noise = rounding_.is_believed() ? kTold * estimate.standard_error : 0.0;
      if (std::abs(difference) < std::max(noise, is_angle ? 1e-3 : kPendantRounding_m)) continue;
      named.emplace_back(std::abs(difference) * (is_angle ? 1.0 : 1.0 / 0.5),
                         fmt::format("{} differs by {:.2f}.", estimate.id.name(),
                                     is_angle ? degrees(difference) : millimetres(difference)));
    }
    if (named.empty()) return false;
    std::ranges::sort(named, [](const auto& one, const auto& other) { return one.first > other.first; });
    result_.findings.push_back(links ? kOtherLinks : kOtherZeros);
    for (std::size_t i = 0; i < std::min(kMostNamed, named.size()); ++i)
      result_.findings.push_back(std::move(named[i].second));
    result_.explained = true;
    return true;
  }

  const DataSet& data_;
  Trial trial_;
  PendantRounding rounding_;
  PendantComparison& result_;
};

}  // namespace

PendantComparison compare_with_pendant(const DataSet& data) {
  PendantComparison result;
  const CorrectedRobot nominal = nominal_robot(data);
  for (const MeasuredPose& pose : data.poses) result.errors_m.push_back(tool_error_m(nominal, data, pose));
  result.agrees = result.explained = largest(result.errors_m) <= kPendantRounding_m;
  if (result.agrees) {
    result.findings = left_open(data, kPendantRounding_m);
    return result;
  }
  if (data.poses.size() < kFewestPendantPoses) {
    result.findings.push_back(fmt::format(
        "{} poses cannot tell what differs: read off {} at least, with every joint well turned in some of them.",
        data.poses.size(), kFewestPendantPoses));
    return result;
  }
  PendantSearch(data, result).run();
  if (!result.explained) explain_by_rounded_unit(data, result);
  if (!result.explained) {
    result.findings.emplace_back(
        "No sign, exchange, convention, unit, zero or link length explains it: another robot, or poses that were not "
        "read off as they stand (another tool or user frame for some of them).");
    if (data.robot.chain.size() > kMostSigned)
      result.findings.push_back(fmt::format(
          "Signs of several joints at once were not tried: of arms with more than {} joints, and this one has {}, the "
          "sets of signs are too many.",
          kMostSigned, data.robot.chain.size()));
  }
  return result;
}

}  // namespace demecal::inline data_check
