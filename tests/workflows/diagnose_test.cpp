// A diagnosis tells what a declared model lacks, and takes up a model that was found before.
#include "workflows/workflows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>

#include "config/model_file.hpp"
#include "errors/input_error.hpp"
#include "kinematics/units.hpp"
#include "workflows/lacking_puma.hpp"

namespace demecal {
namespace {

Job diagnosing_job(const DeclaredModel& declared) {
  Job job = short_looping_job();
  job.method = Method::diagnose;
  job.declared = declared;
  return job;
}

const DeclaredModel kSmooth{.registration = true, .joint_corrections = true};

TEST(Diagnose, NamesUndeclaredBacklashBesideSmoothCorrections) {
  const DataSet data = simulate(lacking_puma(true));
  const Diagnosis diagnosis = diagnose(data, diagnosing_job(kSmooth), {}, {});
  const std::vector<Effect>& effects = diagnosis.result.model.robot.effects;
  EXPECT_TRUE(std::ranges::any_of(effects, is_backlash_of_joint_2));
  EXPECT_TRUE(diagnosis.result.before.effects.empty());
  EXPECT_TRUE(diagnosis.result.model.joints[0].kept);
}

TEST(Diagnose, NamesAJointThatGivesWayByLoggedTorquesWhereMassesAreNotKnown) {
  Scenario scenario = lacking_puma(false);
  scenario.joint_errors.clear();
  scenario.compliance = {{1, 1e-5}};
  scenario.torque_log = TorqueLog{.noise = 0.5, .friction = 2.0};
  DataSet data = simulate(scenario);
  ASSERT_FALSE(data.robot.masses.empty());
  data.robot.masses.clear();
  const DeclaredModel links{.registration = true, .tool = true, .joint_offset = true, .geometry = true};
  const CalibratedModel model = diagnose(data, diagnosing_job(links), {}, {}).result.model;
  ASSERT_EQ(model.robot.effects.size(), 1u);
  const Effect& effect = model.robot.effects[0];
  EXPECT_TRUE(effect.kind == "compliance" && effect.joint == 1 && effect.form == "logged");
  EXPECT_NEAR(effect.value(0), 1e-5, 4.0 * effect.standard_errors.at(0) + 2e-7);
  const double logged_mm = accept_rms(model.robot, data);
  for (MeasuredPose& pose : data.poses) pose.torque.reset();
  EXPECT_LT(accept_rms(model.robot, data), 1.05 * logged_mm);  // the weights that they told of are enough
}

TEST(Diagnose, NamesABalancerThatPullsItsJointAndNoneThatDoesNot) {
  Scenario scenario = lacking_puma(false);
  scenario.joint_errors.clear();
  scenario.robot.balancers = {{1, 0.25, 0.4, radians(80.0)}};
  const DeclaredModel links{.registration = true, .tool = true, .joint_offset = true, .geometry = true};
  const auto effects = [&] {
    return diagnose(simulate(scenario), diagnosing_job(links), {}, {}).result.model.robot.effects;
  };
  EXPECT_TRUE(effects().empty());
  scenario.balance_springs = {{1, 0.25, 0.4, radians(80.0), 2000.0, 8000.0, 1e-6}};
  const std::vector<Effect> found = effects();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].kind == "balancer" && found[0].joint == 1);
  EXPECT_NEAR(found[0].value(0), 2e-3, 4.0 * found[0].standard_errors.at(0));
  EXPECT_NEAR(found[0].value(1), 8e-3, 4.0 * found[0].standard_errors.at(1));
}

TEST(Diagnose, FindsNothingMoreInTheModelThatItLeft) {
  const DataSet data = simulate(lacking_puma(true));
  const Job job = diagnosing_job(kSmooth);
  const CalibratedModel first = diagnose(data, job, {}, {}).result.model;
  const CalibrateResult again = diagnose(data, job, first, {}).result;
  EXPECT_EQ(again.model.robot.effects.size(), first.robot.effects.size());
  const auto accept = poses_of(data, PoseSet::accept);
  EXPECT_NEAR(error_figures(again.model.robot, data, accept).rms_mm, error_figures(first.robot, data, accept).rms_mm,
              0.01);
}

TEST(Diagnose, StopsAfterTheRoundAtWhichItIsTold) {
  const DataSet data = simulate(lacking_puma(true));
  int rounds = 0;
  const CalibrateResult result =
      diagnose(data, diagnosing_job(kSmooth), {}, [&](const Round&) { return ++rounds < 1; }).result;
  EXPECT_EQ(rounds, 1);
  EXPECT_EQ(result.end, RunEnd::interrupted);
  EXPECT_TRUE(result.facts.interrupted);
  EXPECT_EQ(result.loop.rounds.size(), 1U);
}

TEST(UpdateModel, SaysThatItWasInterruptedThoughItKeepsTheOldModel) {
  Scenario scenario = lacking_puma(true);
  scenario.poses = {160, 60, 0};
  const DataSet data = simulate(scenario);
  const CalibratedModel found = diagnose(data, diagnosing_job(kSmooth), {}, {}).result.model;
  const Job bare = diagnosing_job({.registration = true});  // which leaves a model of its own worse than the old one
  int rounds = 0;
  const CalibrateResult result = update_model(data, bare, {"found", found}, [&](const Round&) { return ++rounds < 1; });
  EXPECT_EQ(rounds, 1);
  EXPECT_TRUE(result.loop.rounds.empty());
  EXPECT_EQ(result.end, RunEnd::interrupted);
  EXPECT_TRUE(result.facts.interrupted);
}

TEST(Diagnose, DeclaresByDefaultWhatThePosesDetermine) {
  Scenario scenario = lacking_puma(true);
  EXPECT_TRUE(declared_by_default(simulate(scenario)).geometry);
  scenario.poses = {15, 0, 0};
  EXPECT_TRUE(declared_by_default(simulate(scenario)).geometry) << "makers state links, which is known beside";
  scenario.poses = {10, 0, 0};
  const DeclaredModel few = declared_by_default(simulate(scenario));
  EXPECT_FALSE(few.geometry);
  EXPECT_TRUE(few.joint_offset);
  scenario.poses = {3, 0, 0};
  const DeclaredModel hardly = declared_by_default(simulate(scenario));
  EXPECT_TRUE(hardly.registration);
  EXPECT_FALSE(hardly.tool);
}

TEST(Diagnose, RefusesAModelOfAnotherArm) {
  const DataSet data = simulate(lacking_puma(true));
  const Job job = diagnosing_job({.registration = true});
  CalibratedModel model = diagnose(data, job, {}, {}).result.model;
  model.nominal.chain.joints[1].a_m += 0.001;
  EXPECT_THROW(diagnose(data, job, model, {}), InputError);
}

TEST(Diagnose, WorksOnFewPosesWithoutValidation) {
  Scenario scenario = lacking_puma(true);
  scenario.poses = {15, 0, 0};
  const DataSet data = simulate(scenario);
  const CalibrateResult result = diagnose(data, diagnosing_job(declared_by_default(data)), {}, {}).result;
  EXPECT_NE(result.loop.stopped, StopReason::not_run);
}

TEST(CalibrateWithoutEvolution, IsTheDiagnosisOfWhatTheJobDeclaresWhoeverEvolvesItsExplanations) {
  const DataSet data = simulate(lacking_puma(true));
  Job job = diagnosing_job(kSmooth);
  job.closed_loop.candidates = {"backlash"};
  job.explanations.variations = 500;
  const std::atomic<bool> interrupt{false};
  int asked = 0;
  const auto threads = [&asked]() -> std::unique_ptr<WorkerPool> {
    ++asked;
    return std::make_unique<InProcessWorkerPool>(2);
  };
  const CalibrateResult result = calibrate(data, job, threads, interrupt, {});
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(result.end, RunEnd::finished);
  EXPECT_EQ(result.facts.evaluations, 0U);
  EXPECT_EQ(result.facts.evolved_sets, 500U);
  EXPECT_EQ(model_text(result.model), model_text(diagnose(data, job, {}, {}).result.model));
  EXPECT_TRUE(std::ranges::any_of(result.model.robot.effects, is_backlash_of_joint_2));
  job.explanations.variations = 0;
  const CalibrateResult alone = calibrate(data, job, threads, interrupt, {});
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(model_text(alone.model), model_text(diagnose(data, job, {}, {}).result.model));
}

/// Interrupts as soon as an island has reported.
class InterruptsAtProgress final : public CalibrationObserver {
 public:
  explicit InterruptsAtProgress(std::atomic<bool>& interrupt) : interrupt_(interrupt) {}
  void on_progress(const Progress&) override { interrupt_ = true; }

 private:
  std::atomic<bool>& interrupt_;
};

TEST(CalibrateWithoutEvolution, IsInterruptedAmidTheSearchForExplanations) {
  const DataSet data = simulate(lacking_puma(true));
  Job job = diagnosing_job(kSmooth);
  job.closed_loop.candidates = {"backlash"};
  job.explanations.variations = 2000000;
  std::atomic<bool> interrupt{false};
  InterruptsAtProgress observer(interrupt);
  CalibrateOptions options;
  options.observer = &observer;
  const CalibrateResult result = calibrate(
      data, job, [] { return std::make_unique<InProcessWorkerPool>(2); }, interrupt, options);
  EXPECT_EQ(result.end, RunEnd::interrupted);
  EXPECT_TRUE(result.facts.interrupted);
  EXPECT_LT(result.facts.evolved_sets, 2000000U);
  EXPECT_FALSE(result.model.robot.effects.empty());
}

TEST(CalibrateWithoutEvolution, IsInterruptedAfterARound) {
  const std::atomic<bool> interrupt{true};
  const CalibrateResult result =
      calibrate(simulate(lacking_puma(true)), diagnosing_job(kSmooth), nullptr, interrupt, {});
  EXPECT_EQ(result.end, RunEnd::interrupted);
  EXPECT_EQ(result.loop.rounds.size(), 1U);
}

TEST(AlikeTool, IsTheStatedOneOrTheIdentifiedOne) {
  CalibratedModel model;
  model.nominal.chain.tool_m = {0.02, 0.01, 0.15};
  model.robot.tools[""] = Eigen::Isometry3d(Eigen::Translation3d(0.025, 0.01, 0.16));
  DataSet data;
  const auto is_taken = [&](const Eigen::Vector3d& tool_m) {
    data.robot.chain.tool_m = tool_m;
    try {
      require_alike_tool(model, data);
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("--refit-base"), std::string::npos) << error.what();
      return false;
    }
    return true;
  };
  EXPECT_TRUE(is_taken({0.02, 0.01, 0.15}));
  EXPECT_TRUE(is_taken({0.025, 0.01, 0.16}));
  EXPECT_TRUE(is_taken(Eigen::Vector3d::Zero())) << "nothing is stated";
  EXPECT_FALSE(is_taken({0.02, 0.01, 0.18}));
  model.robot.tools[""] = Eigen::Isometry3d(Eigen::Translation3d(0.02, 0.01, 0.179));
  EXPECT_TRUE(is_taken({0.02, 0.01, 0.18})) << "the model's robot was described wrongly";
}

}  // namespace
}  // namespace demecal
