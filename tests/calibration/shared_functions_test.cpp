// Stages between which joints come to share functions: what each is given, and that what joints have in common is
// found.
#include "calibration/shared_functions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "expression/shared_function.hpp"
#include "expression/tree.hpp"
#include "island_evolution.hpp"

namespace demecal {
namespace {

using ::testing::IsEmpty;

/// Errors of one structure, each joint's with coefficients of its own, measured with little noise.
JointTraining waving_joint(std::uint32_t joint, double size, double turns, double phase) {
  RandomStream random{861, joint};
  JointTraining training;
  training.joint = joint;
  training.table.variables.resize(1);
  for (int row = 0; row < 40; ++row) {
    const double theta = random.real(-2.0, 2.0);
    training.table.variables[0].push_back(theta);
    training.table.target.push_back(size * std::sin(turns * theta + phase) + 0.01 * random.normal());
    training.table.weight.push_back(1.0);
  }
  training.range_rad = {-2.0, 2.0};
  return training;
}

Job sharing_job(int functions, int stages) {
  Job job;
  job.seed = 6;
  job.gp.population_size = 100;
  job.gp.number_generations = 45;
  job.gp.constants = ConstantPolicy::lamarckian;
  job.gp.constant_share = 0.2;
  job.gp.functions = {Primitive::add, Primitive::multiply, Primitive::sine};
  job.corrections.sharing = {functions, stages};
  return job;
}

EvolverFunction on_islands(const Job& job) {
  return EvolverFunction([job](const std::vector<JointTraining>& training, const EvolutionTerms& terms) {
    GpParameters parameters = job.gp;
    parameters.number_generations = terms.generations;
    parameters.shared_functions = terms.functions;
    EvolvedJoints evolved;
    for (const JointTraining& joint : training)
      evolved.joints.push_back({joint, evolved_front(parameters, joint, terms.seed)});
    return evolved;
  });
}

TEST(FunctionStages, FindTheStructureOfJointsWhoseErrorsShareIt) {
  const std::vector<JointTraining> training{waving_joint(0, 1.5, 2.0, 0.7), waving_joint(1, 0.8, 2.3, -0.4),
                                            waving_joint(3, 2.1, 1.7, 1.1)};
  const Job job = sharing_job(2, 3);
  EvolverFunction evolver = on_islands(job);
  const StagedOutcome outcome = learn_in_stages(training, job, evolver);
  ASSERT_FALSE(outcome.functions.empty());
  EXPECT_LE(outcome.functions.size(), 2U);
  std::set<Tree, Precedes> bodies;
  for (const SharedFunction& function : outcome.functions) bodies.insert(function.body);
  EXPECT_EQ(bodies.size(), outcome.functions.size());  // each is defined once
  for (const JointCandidates& joint : outcome.candidates) {
    const FoldedFormula best = folded(good_formulas(joint).front(), outcome.functions);
    EXPECT_TRUE(std::ranges::binary_search(functions_called(best), std::size_t{0})) << to_string(best);
    EXPECT_LT(joint.front.back().fitness, 0.02 * 40) << to_string(joint.front.back().tree);
  }
  EXPECT_EQ(definition_text(outcome.functions[0], 0), "F1(c1, c2, a1) = SIN(c1 * a1 + c2)");
}

/// What stages were given, in the place of islands that find the same formulas again and again.
struct Told {
  std::vector<EvolutionTerms> terms;
  std::vector<std::vector<Tree>> seeds;  ///< of the first joint
  std::size_t cut_off_after = 1000;      ///< so many stages
  EvolverFunction evolver{[this](const std::vector<JointTraining>& training, const EvolutionTerms& given) {
    terms.push_back(given);
    seeds.push_back(training.front().table.seeds);
    EvolvedJoints evolved{{}, terms.size() < cut_off_after};
    const double stage = static_cast<double>(terms.size());
    for (const JointTraining& joint : training) {
      evolved.joints.push_back(
          {joint,
           {{parse("theta"), 9.0},
            {parse("0.3 * SIN(2 * theta + 0.5)"), 5.0 + stage},
            {parse("0.3 * SIN(2 * theta + 0.5) + TANH(0.1 * SIN(3 * theta + 0.2))"), 4.0 - stage}}});
    }
    return evolved;
  }};
};

std::vector<JointTraining> two_joints() {
  return {waving_joint(0, 1.0, 2.0, 0.0), waving_joint(1, 1.0, 2.0, 0.5)};
}

TEST(FunctionStages, DivideTheGenerationsAndDifferInTheirRandomNumbers) {
  for (const int stages : {2, 4, 7, 100}) {
    const Job job = sharing_job(2, stages);
    Told told;
    learn_in_stages(two_joints(), job, told.evolver);
    ASSERT_EQ(told.terms.size(), static_cast<std::size_t>(std::min(stages, 45)));
    int generations = 0;
    std::set<std::uint64_t> seeds;
    for (const EvolutionTerms& terms : told.terms) {
      generations += terms.generations;
      seeds.insert(terms.seed);
    }
    EXPECT_EQ(generations, 45);
    EXPECT_EQ(seeds.size(), told.terms.size());
    EXPECT_EQ(told.terms.front().seed, job.seed);
  }
}

TEST(FunctionStages, BeginAsTheJobSaysAndGoOnFromTheFrontWithFunctions) {
  const Job job = sharing_job(2, 3);
  std::vector<JointTraining> training = two_joints();
  training[0].table.seeds = {parse("COS(theta)")};
  Told told;
  const StagedOutcome outcome = learn_in_stages(training, job, told.evolver);
  ASSERT_EQ(told.terms.size(), 3U);
  EXPECT_THAT(told.terms[0].functions, IsEmpty());
  EXPECT_EQ(told.seeds[0], training[0].table.seeds);
  EXPECT_FALSE(told.terms[1].functions.empty());
  EXPECT_EQ(told.terms[2].functions, outcome.functions);
  ASSERT_EQ(told.seeds[1].size(), 3U);
  EXPECT_EQ(told.seeds[1].back(), parse("theta"));  // the fittest come first
  EXPECT_EQ(outcome.candidates[0].training.table.seeds, training[0].table.seeds);
}

TEST(FunctionStages, KeepTheBestOfEachLengthOverAllStages) {
  const Job job = sharing_job(2, 3);
  Told told;
  const StagedOutcome outcome = learn_in_stages(two_joints(), job, told.evolver);
  for (const JointCandidates& joint : outcome.candidates) {
    ASSERT_EQ(joint.front.size(), 3U);
    EXPECT_EQ(joint.front[1].fitness, 6.0);  // of the first stage
    EXPECT_EQ(joint.front[2].fitness, 1.0);  // of the last
  }
}

TEST(FunctionStages, EndWithWhatWasReachedWhereTheyMayNotGoOn) {
  const Job job = sharing_job(2, 3);
  Told told;
  told.cut_off_after = 2;
  const StagedOutcome outcome = learn_in_stages(two_joints(), job, told.evolver);
  EXPECT_EQ(told.terms.size(), 2U);
  EXPECT_EQ(outcome.candidates.size(), 2U);
  EXPECT_EQ(outcome.functions, told.terms[1].functions);
}

TEST(FunctionStages, OfOneJointShareNothingAndGoOn) {
  const Job job = sharing_job(2, 3);
  Told told;
  const StagedOutcome outcome = learn_in_stages({waving_joint(0, 1.0, 2.0, 0.0)}, job, told.evolver);
  EXPECT_EQ(told.terms.size(), 3U);
  EXPECT_THAT(outcome.functions, IsEmpty());
}

TEST(GoodFormulas, AreFewDifferentAndTheBriefestDescriptionFirst) {
  Population front;
  for (int i = 0; i < 20; ++i) {
    Tree tree = variable_tree(0);
    for (int k = 0; k <= i; ++k) tree = apply(Primitive::sine, tree);
    front.push_back({tree, 30.0 - 0.01 * i});
    front.push_back({apply(Primitive::multiply, constant_tree(1.0), tree), 29.9995 - 0.01 * i});
  }
  const std::vector<Tree> good = good_formulas({waving_joint(0, 1.0, 1.0, 0.0), front});
  ASSERT_EQ(good.size(), 8U);
  for (std::size_t i = 0; i < good.size(); ++i) EXPECT_EQ(good[i].size(), i + 2);  // length costs more than it gains
}

}  // namespace
}  // namespace demecal
