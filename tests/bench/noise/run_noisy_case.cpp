#include "run_noisy_case.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <set>

#include "bad_poses.hpp"
#include "closed_loop/draw_truth.hpp"
#include "closed_loop/truth.hpp"
#include "data_check/check_data.hpp"
#include "data_check/searches.hpp"
#include "engine/thread_seconds.hpp"
#include "errors/input_error.hpp"
#include "noisy_measurement.hpp"
#include "prediction/measurement.hpp"
#include "workflows/workflows.hpp"

namespace demecal::bench {
namespace {

constexpr std::uint64_t kFault = 41, kFaultInAnySet = 42, kInjected = 43;  ///< of the case's random streams
constexpr double kBacklash_rad = 4e-4;                                     ///< of joint 2, of cases with bad poses
constexpr double kOfIntervals = 3.0;                                       ///< times the limit

constexpr std::array<const char*, 6> kInjectedKinds{"backlash",      "compliance",  "coupling",
                                                    "gear_harmonic", "axis_wobble", "thermal_offset"};

/// Kinds follow each other in turn, shifted after every second turn, so that each meets every arm.
const char* kind_of(int number) {
  return kInjectedKinds[static_cast<std::size_t>(number + number / 12) % kInjectedKinds.size()];
}

class NoisyCase {
 public:
  NoisyCase(const NoiseCase& one, const std::vector<Robot>& arms)
      : one_(one), declared_(one.declared(arms.size())), scenario_(noisy_scene(one, arms)) {
    if (one.condition.fault != Fault::none) scenario_.backlash.push_back({1, kBacklash_rad});
  }

  NoisyCaseFigures run() {
    const DataSet data = measured_noisily(one_, scenario_);
    NoisyCaseFigures figures{.plan = one_, .arm = data.robot.name, .clean = diagnosed(data, scenario_)};
    figures.false_effects = static_cast<int>(
        std::ranges::count_if(figures.clean.effects, [&](const Effect& effect) { return !is_there(effect); }));
    if (one_.condition.fault != Fault::none) spoil(data, figures);
    if (one_.condition.question == Question::power) inject_at({0.5, 1.0}, data, figures);
    if (one_.condition.question == Question::intervals) inject_at({kOfIntervals}, data, figures);
    return figures;
  }

 private:
  /// Whether the arm of the case, or its instrument, has the effect although the model lacks it.
  bool is_there(const Effect& effect) const {
    if (effect.kind == "backlash" && effect.joint == 1) return one_.condition.fault != Fault::none;
    return effect.kind == "drift" && (one_.condition.noise == Noise::warming || one_.condition.noise == Noise::drift);
  }

  /// What `demecal diagnose --force` does with the data, and how well; the truth is that of `scenario`.
  DiagnosisFigures diagnosed(DataSet data, const Scenario& scenario) const {
    const double begin = engine::thread_seconds();
    DiagnosisFigures figures;
    take_out_copies(data);
    figures.refused = check_data(data).verdict() == DataVerdict::contradiction;
    Job job;
    job.method = Method::diagnose;
    job.seed = one_.seed;
    job.declared = declared_;
    try {
      const Diagnosis diagnosis = diagnose(data, job, std::nullopt, {});
      const DataSet fresh = fresh_poses(one_, scenario);
      figures.clean_before_mm = clean_error_mm(one_, diagnosis.result.before, fresh);
      figures.clean_after_mm = clean_error_mm(one_, diagnosis.model.robot, fresh);
      figures.effects = diagnosis.model.robot.effects;
      figures.rounds = diagnosis.result.loop.rounds;
      figures.noise = diagnosis.result.loop.noise;
      figures.independent_m = diagnosis.result.loop.independent_m;
      figures.not_found = diagnosis.result.loop.not_found;
      if (!figures.rounds.empty()) figures.first_p = figures.rounds.front().p_family;
      count_within(data, diagnosis.result.model, figures);
    } catch (const InputError&) {
      figures.failed = true;
    }
    figures.seconds = engine::thread_seconds() - begin;
    return figures;
  }

  static void count_within(const DataSet& data, const CalibratedModel& model, DiagnosisFigures& figures) {
    for (const std::size_t index : poses_of(data, PoseSet::accept)) {
      const MeasuredPose& pose = data.poses[index];
      const double radius_m = radius95_m(*model.interval, *model.posterior, model.robot, data, pose);
      ++figures.accept;
      figures.within += tool_error_m(model.robot, data, pose) <= radius_m ? 1 : 0;
    }
  }

  /// The fault in calibration poses, for what it does to the model; then in any poses, for whether it is named.
  void spoil(const DataSet& good, NoisyCaseFigures& figures) const {
    std::vector<std::size_t> all(good.poses.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const std::vector<std::size_t> calibration =
        one_.condition.fault == Fault::gross ? all : poses_of(good, PoseSet::calibration);
    DataSet bad = good, named = good;
    RandomStream fault{one_.seed, kFault}, anywhere{one_.seed, kFaultInAnySet};
    put_fault(one_.condition.fault, bad, calibration, fault);
    figures.bad = diagnosed(bad, scenario_);
    const std::vector<std::string> ids = put_fault(one_.condition.fault, named, all, anywhere);
    std::set<std::string> found;
    for (const Finding& finding : check_data(named).findings) found.insert(finding.poses.begin(), finding.poses.end());
    figures.bad_poses_named = std::ranges::all_of(ids, [&](const std::string& id) { return found.contains(id); });
  }

  /// An effect of the case's kind at a random joint, at these shares of the limit that the arm without it was told.
  void inject_at(const std::vector<double>& shares, const DataSet& data, NoisyCaseFigures& figures) const {
    std::vector<NotFound> testable;
    std::ranges::copy_if(figures.clean.not_found, std::back_inserter(testable), &NotFound::testable);
    const std::vector<ArmState> states = states_of(data, PoseSet::calibration);
    RandomStream random{one_.seed, kInjected};
    const std::string kind = kind_of(one_.number);
    const std::optional<Effect> at_limit =
        draw_truth(kind, testable, data.robot, states,
                   [](const NotFound& measure, const Effect& effect) {
                     // Of another form its numbers are another quantity, of which the limit does not tell.
                     const bool told = effect.form == measure.effect.form;
                     return told ? measure.smallest_detectable : std::numeric_limits<double>::infinity();
                   },
                   random, {1.0, 1.0});
    if (!at_limit) return;
    for (const double share : shares) {
      InjectedEffect injected{.share_of_limit = share, .truth = *at_limit, .run = {}};
      for (double& value : injected.truth.values) value *= share;
      Scenario scenario = scenario_;
      inject(scenario, injected.truth);
      injected.run = diagnosed(measured_noisily(one_, scenario), scenario);
      judge(injected, data.robot, states);
      figures.injected.push_back(std::move(injected));
    }
  }

  static void judge(InjectedEffect& injected, const Robot& robot, const std::vector<ArmState>& states) {
    const Effect& truth = injected.truth;
    const auto is_it = [&](const Effect& effect) { return is_truth(effect, truth, robot, states); };
    injected.named = std::ranges::any_of(injected.run.effects, is_it);
    if (!injected.named) return;
    for (const Round& round : injected.run.rounds) {
      // Of another form or order the first coefficient is another quantity.
      const bool same = is_it(round.effect) && round.effect.form == truth.form &&
                        (truth.kind != "axis_wobble" || round.effect.setting("order") == truth.setting("order"));
      if (round.verdict != Verdict::added || !same || round.interval.empty()) continue;
      injected.covered = round.interval[0][0] <= truth.values[0] && truth.values[0] <= round.interval[0][1];
      return;
    }
  }

  NoiseCase one_;
  DeclaredModel declared_;
  Scenario scenario_;
};

}  // namespace

NoisyCaseFigures run_noisy_case(const NoiseCase& one, const std::vector<Robot>& arms) {
  return NoisyCase(one, arms).run();
}

}  // namespace demecal::bench
