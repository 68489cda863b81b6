#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibration/admissible.hpp"
#include "calibration/calibration.hpp"
#include "calibration/job.hpp"
#include "calibration/joint_targets.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "diagnosis/loop.hpp"
#include "errors/input_error.hpp"
#include "fitting/fit.hpp"
#include "fitting/stations.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "parameters/posterior.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "report/make_report.hpp"
#include "updating/learned_drift.hpp"
#include "updating/update.hpp"
#include "workflows/workflows.hpp"

namespace demecal::inline workflows {
namespace {

/// Base and tool of the old model, found in the new data.
Fit placed_in(const DataSet& data, const std::vector<std::size_t>& poses, const CorrectedRobot& model) {
  Fit fit = fit_registration(data, poses, {.registration = true, .tool = true}, model);
  if (fit.status == FitStatus::converged) return fit;
  throw InputError(
      {data.file, 0}, std::to_string(poses.size()),
      "calibration poses do not tell where base and tool are (" + fit.sentence + "): measure more of them");
}

std::string why_without(const JointCorrection& correction) {
  return correction.is_neutral() ? "the new poses show none" : "";
}

Calibration calibration_of_update(const DataSet& data, const Preparation& preparation, const Update& update) {
  const std::vector<std::size_t> fitted = poses_of(data, PoseSet::calibration);
  Calibration result{.robot = update.robot, .estimates = update.estimates, .joints = {}, .unseen = {}};
  result.joints = joint_summaries(preparation.targets, {}, result.robot);
  for (JointSummary& summary : result.joints)
    if (!summary.kept) summary.note = why_without(result.robot.corrections[static_cast<std::size_t>(summary.joint)]);
  result.index_before_mm2 = performance_index_mm2(preparation.declared.robot, data, fitted);
  result.index_after_mm2 = performance_index_mm2(result.robot, data, fitted);
  return result;
}

/// What both models' poses show; nothing where the old model does not state where its poses stood.
std::map<int, std::vector<int>> counts_beside(std::map<int, std::vector<int>> known,
                                              const std::map<int, std::vector<int>>& added) {
  for (auto& [joint, steps] : known) std::ranges::transform(steps, added.at(joint), steps.begin(), std::plus{});
  return known;
}

/// The rms error on validation poses while they were unseen; nothing where there are too few to judge by.
std::optional<double> unseen_rms_mm(const DataSet& data, const CorrectedRobot& robot) {
  constexpr std::size_t kFewest = 20;
  const std::vector<std::size_t> validation = poses_of(data, PoseSet::validation);
  if (validation.size() < kFewest) return std::nullopt;
  return error_figures(robot, data, validation).rms_mm;
}

double unseen_rms_mm(const DataSet& data, const CalibrateResult& result) {
  if (result.calibration.unseen) return result.calibration.unseen->after_mm;
  return error_figures(result.model.robot, data, poses_of(data, PoseSet::validation)).rms_mm;
}

}  // namespace

CalibrateResult update_model(const DataSet& data, const Job& job, const NamedModel& found_before,
                             const RoundWatcher& watch, const std::vector<NamedModel>& earlier) {
  constexpr std::size_t kManyPoses = 150;
  const auto begin = std::chrono::steady_clock::now();
  CalibratedModel prior = found_before.model;
  if (prior.fleet) prior.robot.tools = nominal_robot(data).tools;  // the new robot's: a fleet has none
  prior.robot = with_tools_of_stations(std::move(prior.robot), data);
  require_same_nominal_arm(prior, data);
  const std::vector<std::size_t> calibration = poses_of(data, PoseSet::calibration);
  CorrectedRobot old = prior.robot;
  old.described = data.robot;
  CalibrateResult result;
  Preparation& preparation = result.preparation;
  preparation.nominal = nominal_robot(data);
  preparation.registered = placed_in(data, calibration, preparation.nominal);
  preparation.declared = placed_in(data, calibration, old);
  result.before = preparation.declared.robot;
  LearnedDrift learned;
  if (!earlier.empty()) {
    std::vector<NamedModel> models{found_before};
    models.insert(models.end(), earlier.begin(), earlier.end());
    learned = learned_drift(models, data, calibration);
  }
  const auto updated_by = [&](const std::vector<std::size_t>& poses) {
    Update update = updated(prior, result.before, data, poses, job.declared, learned.drift);
    update.robot = without_negligible_corrections(data, std::move(update.robot));
    return update;
  };
  Update update = updated_by(calibration);
  const std::optional<double> unseen = unseen_rms_mm(data, update.robot);
  PredictionInterval interval = prediction_interval(data, update.fitted, update.robot);
  interval.along_path = follow_each_other(data);
  const std::vector<std::size_t> last = poses_of_last_fit(data);
  std::optional<UnseenValidation> seen_last;
  if (last != calibration) {
    const std::vector<std::size_t> validation = poses_of(data, PoseSet::validation);
    seen_last = UnseenValidation{error_figures(result.before, data, validation).rms_mm,
                                 error_figures(update.robot, data, validation).rms_mm, interval};
    update = updated_by(last);
  }
  result.calibration = calibration_of_update(data, preparation, update);
  result.calibration.unseen = seen_last;
  result.model = {.job = job.name,
                  .nominal = data.robot,
                  .method = job.method,
                  .declared = job.declared,
                  .robot = update.robot,
                  .estimates = update.estimates,
                  .joints = result.calibration.joints,
                  .posterior = update.fitted.posterior,
                  .interval = interval,
                  .measured = measured_ranges(data, result.calibration),
                  .measured_gaps = measured_gaps(data, result.calibration),
                  .pose_counts = counts_beside(prior.pose_counts, pose_counts(data, result.calibration)),
                  .pose_marks = marks_of_both(prior.pose_marks, pose_marks(data)),
                  .stations = stations_as_found(update.robot, data),
                  .data_name = data.name,
                  .data_sha256 = data.sha256,
                  .approach_recorded = prior.approach_recorded,
                  .seed = job.seed,
                  .version = DEMECAL_VERSION};
  if (!learned.sentence.empty()) result.remarks.push_back(learned.sentence);
  std::ranges::copy(update.sentences, std::back_inserter(result.remarks));
  if (calibration.size() >= kManyPoses && unseen && job.closed_loop.max_effects > 0) {
    Diagnosis anew = diagnose(data, job, std::nullopt, watch);
    result.end = anew.result.end;
    if (unseen_rms_mm(data, anew.result) < *unseen) {
      result = std::move(anew.result);
      result.remarks.emplace_back(
          "So many poses tell more by themselves than together with the old model: it was not used.");
    }
  }
  result.facts.interrupted = result.end == RunEnd::interrupted;
  result.facts.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace demecal::inline workflows
