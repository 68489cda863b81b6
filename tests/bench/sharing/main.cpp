#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "calibration/shared_functions.hpp"
#include "evolution/island.hpp"
#include "evolution/model_archive.hpp"
#include "expression/evaluate.hpp"
#include "random/distributions.hpp"
#include "random/random_stream.hpp"

namespace {

using namespace demecal;

constexpr std::uint32_t kJoints = 4;
constexpr double kNoise = 0.01;
constexpr double kNeverCalled = 1e-9;

struct Options {
  int first_seed = 11, seeds = 10, generations = 200;
  bool lamarckian = false;
  bool json = false;
};

/// One way to evolve, by what it leaves on rows that were not learnt from (rms) and the nodes of what is chosen.
struct Figures {
  double rms = 0.0, nodes = 0.0;
  std::size_t functions = 0;
};

/// Rows of an error of the law that all joints share, a wave and its harmonic, with the joint's own coefficients.
TrainingTable rows_of_joint(std::uint64_t seed, std::uint32_t joint, std::uint64_t part) {
  RandomStream law{seed, joint, 1}, drawn{seed, joint, part};
  const double size = law.real(0.5, 2.0), phase = law.real(-3.0, 3.0);
  const double size2 = law.real(0.2, 0.8), phase2 = law.real(-3.0, 3.0);
  TrainingTable table;
  table.variables.resize(1);
  for (int row = 0; row < 60; ++row) {
    const double theta = drawn.real(-2.5, 2.5);
    const double error = size * std::sin(theta + phase) + size2 * std::sin(2.0 * theta + phase2);
    table.variables[0].push_back(theta);
    table.target.push_back(error + kNoise * drawn.normal());
    table.weight.push_back(1.0);
  }
  return table;
}

std::vector<JointTraining> trainings_of(std::uint64_t seed) {
  std::vector<JointTraining> trainings(kJoints);
  for (std::uint32_t joint = 0; joint < kJoints; ++joint) {
    trainings[joint].joint = joint;
    trainings[joint].table = rows_of_joint(seed, joint, 2);
    trainings[joint].range_rad = {-2.5, 2.5};
  }
  return trainings;
}

/// The front over a ring of two islands, in this thread.
Population front_of(const GpParameters& parameters, const JointTraining& training, std::uint64_t seed) {
  Archipelago archipelago;
  archipelago.joints = {training.joint};
  std::vector<Island> ring;
  for (const IslandKey& key : islands(archipelago))
    ring.emplace_back(parameters, archipelago, training.table, key, seed);
  while (!ring.front().finished()) {
    std::vector<Population> leaving;
    for (const Island& island : ring) leaving.push_back(island.state().epoch > 0 ? island.emigrants() : Population{});
    for (std::size_t i = 0; i < ring.size(); ++i) ring[i].run_epoch(leaving[(i + ring.size() - 1) % ring.size()]);
  }
  ParetoFront front;
  for (const Island& island : ring)
    for (const Individual& member : island.state().front) front.offer(member);
  return front.members();
}

/// Evolves in this thread.
class EvolverHere final : public Evolver {
 public:
  explicit EvolverHere(const Job& job) : job_(job) {}
  EvolvedJoints evolve(const std::vector<JointTraining>& trainings, const EvolutionTerms& terms) override {
    GpParameters parameters = job_.gp;
    parameters.number_generations = terms.generations;
    parameters.shared_functions = terms.functions;
    EvolvedJoints evolved;
    for (const JointTraining& training : trainings)
      evolved.joints.push_back({training, front_of(parameters, training, terms.seed)});
    return evolved;
  }

 private:
  const Job& job_;
};

StagedOutcome evolved(const Job& job, const std::vector<JointTraining>& trainings) {
  EvolverHere evolver(job);
  if (job.corrections.sharing.functions == 0)
    return {evolver.evolve(trainings, {job.seed, job.gp.number_generations}).joints, {}};
  return learn_in_stages(trainings, job, evolver);
}

/// Of each joint's formula that describes its rows most briefly; what is learnt from decides, other rows judge.
Figures measured(const Job& job, const std::vector<JointTraining>& trainings) {
  const StagedOutcome outcome = evolved(job, trainings);
  Figures figures;
  figures.functions = outcome.functions.size();
  double squares = 0.0;
  for (const JointCandidates& joint : outcome.candidates) {
    const Tree chosen = good_formulas(joint).front();
    const TrainingTable unseen = rows_of_joint(job.seed, joint.training.joint, 3);
    for (std::size_t row = 0; row < unseen.target.size(); ++row)
      squares += std::pow(unseen.target[row] - evaluate(chosen, {&unseen.variables[0][row], 1}), 2);
    figures.nodes += static_cast<double>(chosen.size());
  }
  figures.rms = std::sqrt(squares / (60.0 * kJoints));
  return figures;
}

using Ways = std::array<Figures, 3>;  ///< in one go; in stages; in stages with functions

Ways measured(const Options& options, int seed) {
  Job job;
  job.seed = static_cast<std::uint64_t>(seed);
  job.gp.number_generations = options.generations;
  if (options.lamarckian) job.gp.constants = ConstantPolicy::lamarckian;
  job.gp.constant_share = 0.1;
  const std::vector<JointTraining> trainings = trainings_of(job.seed);
  Ways ways;
  ways[0] = measured(job, trainings);
  job.corrections.sharing.functions = 3;
  ways[2] = measured(job, trainings);
  job.gp.shared_function_weight = kNeverCalled;
  ways[1] = measured(job, trainings);
  return ways;
}

std::string line(const std::string& head, const Ways& ways) {
  std::string text = fmt::format("{:>6}", head);
  for (const Figures& way : ways) text += fmt::format("   {:>10.4f} {:>7.0f}", way.rms, way.nodes);
  return text + "\n";
}

void write(const std::string& head, const Ways& ways, const Options& options) {
  if (!options.json) {
    std::cout << line(head, ways) << std::flush;
    return;
  }
  constexpr std::array kNames{"in_one_go", "in_stages", "with_functions"};
  nlohmann::ordered_json json{{"workload", "sharing"}, {"seed", head}};
  for (std::size_t i = 0; i < ways.size(); ++i)
    json[kNames[i]] = {{"unseen_rms", ways[i].rms}, {"nodes", ways[i].nodes}, {"functions", ways[i].functions}};
  std::cout << json.dump() << '\n';
}

Ways medians(const std::vector<Ways>& all) {
  Ways middle;
  for (std::size_t i = 0; i < middle.size(); ++i) {
    std::vector<double> rms, nodes;
    for (const Ways& ways : all) {
      rms.push_back(ways[i].rms);
      nodes.push_back(ways[i].nodes);
    }
    middle[i] = {median(rms), median(nodes), 0};
  }
  return middle;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Whether shared functions help joints whose errors follow one law with coefficients of their own: error on rows "
      "that were not learnt from, and nodes of the formulas chosen, after equally many generations in one go, in "
      "stages, and in stages with functions. Tables without an arm, in one thread."};
  Options options;
  app.add_flag("--json", options.json, "one JSON object a line instead of the table");
  app.add_flag("--lamarckian", options.lamarckian, "fit constants while formulas evolve");
  app.add_option("--seed", options.first_seed, "the first")->capture_default_str();
  app.add_option("--seeds", options.seeds, "how many")->capture_default_str()->check(CLI::Range(1, 1000));
  app.add_option("--generations", options.generations, "of each way")
      ->capture_default_str()
      ->check(CLI::Range(4, 100000));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 10;
  }
  if (!options.json)
    std::cout << "             in one go            in stages       with functions\n"
                 "  seed     unseen rms   nodes   unseen rms   nodes   unseen rms   nodes\n";
  std::vector<Ways> all;
  for (int seed = options.first_seed; seed < options.first_seed + options.seeds; ++seed) {
    all.push_back(measured(options, seed));
    write(std::to_string(seed), all.back(), options);
  }
  write("median", medians(all), options);
}
