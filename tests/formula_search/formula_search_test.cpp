// Formulas outside the catalogue: found where they are the truth, preferred to sums that imitate them, and not found
// where there is nothing.
#include "formula_search/formula_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "calibration/formula_arm.hpp"
#include "calibration/island_evolution.hpp"
#include "closed_calibration/closed_calibration.hpp"
#include "closed_calibration/closing.hpp"
#include "formula_search/misfit.hpp"
#include "residuals/residual_field.hpp"

namespace demecal {
namespace {

constexpr int kPoses = 160;
const char* const kTruth = "0.0008 * q1 * SIN(q4) * COS(q2)";

Job job_with_corrections() {
  Job job;
  job.declared = {.registration = true, .joint_corrections = true};
  job.closed_loop.highest_ratio = 30;
  job.gp.population_size = 150;
  job.gp.number_generations = 50;
  return job;
}

/// An arm's data and the model that a search begins with: everything declared.
struct Beginning {
  explicit Beginning(DataSet measured)
      : data(std::move(measured)),
        of{data, job.declared, poses_of(data, PoseSet::calibration), poses_of(data, PoseSet::validation)} {
    const Preparation preparation = prepare(data, job);
    const Fit start = loop_start(data, preparation.declared, preparation.declared.robot);
    model = refined(of, diagnosed_model(of, start), 12);
  }

  FormulaSearch search(EvolverFunction evolver) const {
    return search_formulas(of, model, evolver, {job.seed, job.gp.number_generations}, job.closed_loop.family_error,
                           RandomStream{job.seed, 9});
  }

  Job job = job_with_corrections();
  DataSet data;
  DiagnosisProblem of;
  DiagnosedModel model;
};

/// What an effect does to its joint at poses, with unit coefficient.
Eigen::VectorXd values_at(const Tree& formula, const DataSet& data, const std::vector<std::size_t>& poses) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(poses.size()));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const JointVector& q = data.poses[poses[i]].joints;
    std::vector<double> variables(q.begin(), q.end());
    variables.resize(9, 0.0);
    values[static_cast<Eigen::Index>(i)] = evaluate(formula, variables);
  }
  return values;
}

double correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const Eigen::VectorXd x = a.array() - a.mean(), y = b.array() - b.mean();
  return x.dot(y) / (x.norm() * y.norm());
}

/// The joint errors of all formulas of a robot's joint 3 together.
Eigen::VectorXd formulas_at(const CorrectedRobot& robot, const DataSet& data, const std::vector<std::size_t>& poses) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(poses.size()));
  for (const Effect& effect : robot.effects) {
    if (effect.kind == "symbolic" && effect.joint == 2) sum += effect.value(0) * values_at(effect.formula, data, poses);
  }
  return sum;
}

ClosedCalibration closed_with_search(const DataSet& data, const Job& job, EvolverFunction evolver) {
  const Preparation preparation = prepare(data, job);
  std::vector<JointCandidates> none;
  for (const JointTraining& training : preparation.training) none.push_back({training, {}});
  return close_calibration(data, job, preparation, conclude(data, job, preparation, none), evolver, {});
}

TEST(EvolvedFormula, ComesBackAsAPersonWritesItInPlaceOfTheSumsThatImitateIt) {
  const DataSet data = formula_arm(kTruth, kPoses, 3);
  const Job job = job_with_corrections();
  const ClosedCalibration closed = closed_with_search(data, job, island_evolution(job.gp, 5));
  const CorrectedRobot& robot = closed.calibration.robot;
  ASSERT_EQ(robot.effects.size(), 1U);
  const Effect& found = robot.effects[0];
  const VariableNames names = symbolic_variables(puma());
  EXPECT_EQ(found.joint, 2);
  EXPECT_NEAR(found.value(0), 8e-4, 3e-5) << to_string(found.formula, names);
  EXPECT_EQ(found.formula.size(), parse("q1 * SIN(q4) * COS(q2)", names).size()) << to_string(found.formula, names);
  const std::vector<std::size_t> accept = poses_of(data, PoseSet::accept);
  EXPECT_GT(correlation(formulas_at(robot, data, accept), values_at(parse(kTruth, names), data, accept)), 0.98);
  EXPECT_LT(error_figures(robot, data, accept).rms_mm, 1.15 * 0.05 * std::sqrt(3.0));

  int added = 0, sums = 0;
  for (const Round& round : closed.loop.rounds) {
    sums += round.effect.kind == "symbolic" && round.reason.starts_with("taken back") ? 1 : 0;
    if (round.verdict != Verdict::added) continue;
    ++added;
    EXPECT_EQ(round.null_draws, 19);
    EXPECT_DOUBLE_EQ(round.p_family, 0.05);
  }
  EXPECT_EQ(added, 1);
  EXPECT_GE(sums, 1);
}

TEST(FormulaSearch, IsRunAgainOnEveryPermutation) {
  const Beginning beginning(formula_arm(kTruth, kPoses, 3));
  EvolverFunction islands = island_evolution(beginning.job.gp, 5);
  std::vector<std::vector<double>> targets;  // of joint 3
  const FormulaSearch search =
      beginning.search(EvolverFunction([&](const auto& trainings, const EvolutionTerms& terms) {
        targets.push_back(trainings[2].table.target);
        return islands.evolve(trainings, terms);
      }));
  ASSERT_EQ(search.null_nats.size(), 19U);
  ASSERT_EQ(targets.size(), 20U);
  for (std::size_t i = 1; i < targets.size(); ++i) EXPECT_NE(targets[i], targets[i - 1]);
  EXPECT_TRUE(std::ranges::is_sorted(search.null_nats));
  EXPECT_FALSE(search.formulas.empty());
}

TEST(FormulaSearch, FindsNothingInWhatACleanArmLeaves) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Beginning beginning(formula_arm("", kPoses, seed));
    EvolverFunction islands = island_evolution(beginning.job.gp, seed);
    std::size_t evolved = 0;
    const FormulaSearch search =
        beginning.search(EvolverFunction([&](const auto& trainings, const EvolutionTerms& terms) {
          EvolvedJoints found = islands.evolve(trainings, terms);
          for (const JointCandidates& joint : found.joints) evolved += joint.front.size();
          return found;
        }));
    EXPECT_GT(evolved, 20U);
    EXPECT_TRUE(search.formulas.empty()) << to_string(search.formulas[0].effect.formula, symbolic_variables(puma()));
  }
}

TEST(FormulaSearch, FindsNothingWhereEvolutionIsCutOff) {
  const Beginning beginning(formula_arm(kTruth, kPoses, 3));
  EvolverFunction islands = island_evolution(beginning.job.gp, 5);
  int evolutions = 0;
  const FormulaSearch search =
      beginning.search(EvolverFunction([&](const auto& trainings, const EvolutionTerms& terms) {
        return ++evolutions < 3 ? islands.evolve(trainings, terms) : EvolvedJoints{{}, false};
      }));
  EXPECT_EQ(evolutions, 3);
  EXPECT_TRUE(search.formulas.empty());
}

TEST(FormulaMisfit, AgreesWithTheProjectionOffTheModel) {
  const Beginning beginning(formula_arm(kTruth, kPoses, 3));
  const Linearization at = linearize(beginning.of, beginning.model);
  const FormulaTable table = formula_tables(beginning.of, at, at.projection.residual())[2];
  FormulaMisfit misfit(table.table.variables, at, table.joint, at.projection.residual());
  for (const char* text : {"q1 * SIN(q4)", "COS(q3)", "q1 * SIN(q4) * COS(q2)", "SIN(q5 + q6) - 0.2"}) {
    Effect effect{.kind = "symbolic", .joint = 2};
    effect.formula = parse(text, symbolic_variables(puma()));
    EffectColumns columns;
    columns.append({effect}, beginning.data.robot, at.fitted.states);
    columns.pack();
    const Projection::Trial trial =
        at.projection.trial(columns.dense(at.fitted, 0), RowMatrix::Zero(at.validation.rows(), 1));
    const double share = (at.projection.residual().squaredNorm() - trial.drop) / at.projection.residual().squaredNorm();
    EXPECT_NEAR(misfit.gain_nats(effect.formula), -0.5 * static_cast<double>(at.fitted.rows()) * std::log(share), 1e-6)
        << text;
    const Eigen::VectorXd explained = at.projection.residual() - misfit.residual(effect.formula);
    EXPECT_LT((explained - trial.fitted * trial.coefficients).norm(), 1e-6 * explained.norm()) << text;
  }
}

TEST(FormulaTables, HoldOnlyWhatThePosesKnow) {
  const Beginning beginning(formula_arm("", kPoses, 1));
  const Linearization at = linearize(beginning.of, beginning.model);
  const std::vector<FormulaTable> tables = formula_tables(beginning.of, at, at.projection.residual());
  ASSERT_EQ(tables.size(), 6U);
  for (const FormulaTable& table : tables) {  // no masses, no approaches, no temperature
    EXPECT_EQ(table.variables, (std::vector<std::uint8_t>{0, 1, 2, 3, 4, 5}));
    EXPECT_FALSE(table.reference_celsius);
    EXPECT_EQ(table.table.target.size(), at.fitted.poses.size());
  }
}

}  // namespace
}  // namespace demecal
