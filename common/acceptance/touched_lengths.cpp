#include "acceptance/touched_lengths.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <ranges>
#include <string>
#include <utility>

#include "acceptance/iso9283.hpp"
#include "acceptance/verdict.hpp"
#include "effects/arm_state.hpp"
#include "errors/input_error.hpp"
#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/posterior.hpp"
#include "prediction/measurement.hpp"
#include "report/evaluation.hpp"
#include "report/length_entries.hpp"
#include "report/report.hpp"

namespace demecal::inline acceptance {
namespace {

Eigen::Vector3d tool_m(const CorrectedRobot& robot, const MeasuredPose& pose) {
  return robot.predict(Stop(pose), pose.target).translation();
}

/// As view_of() positions: where the model has the ends of the lengths.
CertifiedView view_of_lengths(const DataSet& data, const std::vector<TouchedLength>& lengths,
                              const CorrectedRobot& robot) {
  CertifiedView view{.arm = arm_points(robot, data.poses[lengths.front().rows.front()])};
  for (const TouchedLength& length : lengths)
    for (const Eigen::Vector3d& end_m : length.ends_m) view.points_m.emplace_back(end_m, length.error_m);
  return view;
}

std::vector<double> errors_in_m(const std::vector<TouchedLength>& lengths) {
  std::vector<double> errors_m;
  for (const TouchedLength& length : lengths) errors_m.push_back(length.error_m);
  return errors_m;
}

SetErrors errors_of_lengths(const std::vector<TouchedLength>& lengths) {
  std::vector<double> errors_mm;
  for (const TouchedLength& length : lengths) errors_mm.push_back(millimetres(length.error_m));
  return set_errors(error_figures(std::move(errors_mm)));
}

/// The largest standard uncertainty of the lengths.
double sigma_m(const std::vector<TouchedLength>& lengths) {
  return std::ranges::max(lengths, {}, [](const TouchedLength& length) { return length.known->sigma_m; })
      .known->sigma_m;
}

std::vector<CertifiedPose> certified_lengths(const DataSet& data, const std::vector<TouchedLength>& before,
                                             const std::vector<TouchedLength>& after, double tolerance_m) {
  std::vector<CertifiedPose> poses;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const auto& [first, second] = after[i].rows;
    poses.push_back({.id = data.poses[first].pose_id + " – " + data.poses[second].pose_id,
                     .target = after[i].known->first + " – " + after[i].known->second,
                     .measurements = 1,
                     .before_mm = if_finite(millimetres(before[i].error_m)),
                     .after_mm = if_finite(millimetres(after[i].error_m)),
                     .beyond = after[i].error_m > tolerance_m,
                     .single_mm = if_finite(millimetres(after[i].error_m))});
  }
  std::ranges::stable_sort(poses, std::ranges::greater{}, &CertifiedPose::after_mm);
  return poses;
}

/// Those that the model was not fitted to: calibration poses of its own data that touch both ends gave it these.
std::vector<TouchedLength> unfitted(std::vector<TouchedLength> lengths, const DataSet& data) {
  const auto is_touched = [&](const std::string& contact) {
    return std::ranges::any_of(data.poses, [&](const MeasuredPose& pose) {
      return pose.set == PoseSet::calibration && pose.contact == contact;
    });
  };
  std::erase_if(lengths, [&](const TouchedLength& length) {
    return is_touched(length.known->first) && is_touched(length.known->second);
  });
  return lengths;
}

}  // namespace

bool touch_alone(const DataSet& data, std::span<const std::size_t> rows) {
  return !rows.empty() && std::ranges::all_of(rows, [&](std::size_t row) {
    const MeasuredPose& pose = data.poses[row];
    return !pose.contact.empty() && !pose.position_m && pose.distances_m.empty();
  });
}

std::vector<TouchedLength> touched_lengths(const DataSet& data, std::span<const std::size_t> rows,
                                           const CorrectedRobot& robot) {
  std::map<std::string, std::deque<std::size_t>> touching;
  for (const std::size_t row : rows)
    if (data.contacts.form_of(data.poses[row].contact).kind == ContactKind::point)
      touching[data.poses[row].contact].push_back(row);
  std::vector<TouchedLength> lengths;
  for (bool more = true; more;) {
    more = false;
    for (const KnownDistance& known : data.contacts.distances) {
      std::deque<std::size_t>&first = touching[known.first], &second = touching[known.second];
      if (first.empty() || second.empty()) continue;
      TouchedLength one{.known = &known, .rows = {first.front(), second.front()}};
      first.pop_front();
      second.pop_front();
      for (std::size_t end = 0; end < 2; ++end) one.ends_m[end] = tool_m(robot, data.poses[one.rows[end]]);
      one.error_m = std::abs((one.ends_m[0] - one.ends_m[1]).norm() - known.length_m);
      lengths.push_back(one);
      more = true;
    }
  }
  return lengths;
}

void judge_lengths(const CalibratedModel& model, const DataSet& data, std::span<const std::size_t> rows,
                   const CertifiedRun& run, Certificate& certificate) {
  if (run.refit_base)
    throw InputError({data.file, 0}, "contact",
                     "poses that only touch something do not tell where the base stands: leave --refit-base out");
  const CorrectedRobot described = model.declared.tool
                                       ? refitted(data, {.registration = false, .tool = true}, nominal_robot(data))
                                       : nominal_robot(data);
  std::vector<TouchedLength> before = touched_lengths(data, rows, described),
                             after = touched_lengths(data, rows, model.robot);
  const bool any_touched = !after.empty();
  if (is_calibrated_with(model, data)) {
    before = unfitted(std::move(before), data);
    after = unfitted(std::move(after), data);
  }
  if (any_touched && after.empty()) {
    throw InputError(
        {data.file, 0}, "contact",
        "the " + certificate.judged_set +
            " poses touch no known length but those that the model was fitted to: that it has them as long "
            "as they are stated does not show that they are; touch the ends of another length, of points "
            "that no calibration pose touches");
  }
  if (after.empty()) {
    const std::string untold = untold_lengths_sentence(data);
    throw InputError({data.file, 0}, "contact",
                     "the " + certificate.judged_set +
                         " poses touch no two points whose distance is known: without an instrument only such lengths "
                         "can be judged (contacts.distances in DATASET.yaml)" +
                         (untold.empty() ? "" : ". " + untold));
  }
  certificate.words = kJudgedLengths;
  certificate.before = errors_of_lengths(before);
  certificate.after = errors_of_lengths(after);
  certificate.before_words =
      model.declared.tool ? "as its maker describes it, tool fitted" : "as its maker describes it";
  certificate.characteristics = characteristics(data, {}, model.robot);
  const auto distance = std::ranges::find(certificate.characteristics, "AD", &Characteristic::symbol);
  distance->value_mm = certificate.after.max_mm;
  distance->basis = fmt::format("{} times both ends of a known length touched; rms {:.3f} mm", after.size(),
                                certificate.after.rms_mm.value_or(0.0));
  // Two touches scatter along the length.
  const double noise_m = model.interval ? std::sqrt(2.0) * model.interval->noise_m : 0.0;
  certificate.judgement = judge(errors_in_m(after), run.tolerance_m, sigma_m(after), noise_m);
  certificate.poses_to_decide = poses_to_decide(errors_in_m(after), errors_in_m(after), certificate.judgement);
  certificate.poses = certified_lengths(data, before, after, run.tolerance_m);
  certificate.view = view_of_lengths(data, after, model.robot);
}

}  // namespace demecal::inline acceptance
