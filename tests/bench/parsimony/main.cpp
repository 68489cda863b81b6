#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "calibration/calibration.hpp"
#include "config/job_file.hpp"
#include "data_files/data_set_file.hpp"
#include "evolution/island.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"

namespace {

using namespace demecal;

struct Options {
  std::string job = DEMECAL_SOURCE_DIR "/configs/jobs/demo.yaml";
  int seeds = 10;
  bool json = false;
};

/// What is reported beside what fits the calibration poses' targets best.
struct Figures {
  int seed = 0;
  double nodes = 0.0, nodes_of_best = 0.0;    ///< of the joints that are corrected
  double rms_mm = 0.0, rms_of_best_mm = 0.0;  ///< on the validation poses

  double node_ratio() const { return nodes / nodes_of_best; }
  double error_ratio() const { return rms_mm / rms_of_best_mm; }
};

Archipelago archipelago_of(const Job& job, std::uint32_t joint) {
  Archipelago archipelago;
  archipelago.joints = {joint};
  archipelago.demes_per_joint = job.islands.per_joint;
  archipelago.topology = job.islands.topology;
  archipelago.migration_interval = job.islands.migration_interval;
  archipelago.migrants = job.islands.migrants;
  return archipelago;
}

/// The front over a joint's islands, in this thread.
Population evolved(const Job& job, const JointTraining& training) {
  const Archipelago archipelago = archipelago_of(job, training.joint);
  std::vector<Island> all;
  for (const IslandKey& key : islands(archipelago))
    all.emplace_back(job.gp, archipelago, training.table, key, job.seed);
  while (!all.front().finished()) {
    std::vector<Population> leaving;
    for (const Island& island : all) leaving.push_back(island.state().epoch > 0 ? island.emigrants() : Population{});
    for (Island& island : all) {
      Population immigrants;
      for (const IslandKey& source : sources(archipelago, island.key()))
        immigrants.insert(immigrants.end(), leaving[source.deme].begin(), leaving[source.deme].end());
      island.run_epoch(immigrants);
    }
  }
  ParetoFront front;
  for (const Island& island : all)
    for (const Individual& member : island.state().front) front.offer(member);
  return front.members();
}

Figures measure(const DataSet& data, Job job, int seed) {
  job.seed = static_cast<std::uint64_t>(seed);
  const Preparation preparation = prepare(data, job);
  std::vector<JointCandidates> candidates;
  for (const JointTraining& training : preparation.training) candidates.push_back({training, evolved(job, training)});
  const CorrectedRobot reported = conclude(data, job, preparation, candidates).robot;
  CorrectedRobot best = preparation.declared.robot;
  Figures figures;
  figures.seed = seed;
  for (const JointCandidates& joint : candidates) {
    JointCorrection& fittest = best.corrections[joint.training.joint];
    fittest = correction_from(joint.training, joint.front.back().tree);
    const JointCorrection& kept = reported.corrections[joint.training.joint];
    if (kept.is_neutral()) continue;
    figures.nodes += static_cast<double>(kept.formula().size());
    figures.nodes_of_best += static_cast<double>(fittest.formula().size());
  }
  const std::vector<std::size_t> validation = poses_of(data, PoseSet::validation);
  figures.rms_mm = error_figures(reported, data, validation).rms_mm;
  figures.rms_of_best_mm = error_figures(best, data, validation).rms_mm;
  return figures;
}

void write(const Figures& one, bool json) {
  if (json)
    std::cout << nlohmann::ordered_json{{"workload", "parsimony"},
                                        {"seed", one.seed},
                                        {"nodes", one.nodes},
                                        {"nodes_of_best_on_training", one.nodes_of_best},
                                        {"validation_rms_mm", one.rms_mm},
                                        {"validation_rms_of_best_on_training_mm", one.rms_of_best_mm}}
                     .dump()
              << '\n';
  else
    std::cout << fmt::format("{:>6} {:>9.0f} {:>9.0f} {:>9.2f} {:>12.4f} {:>9.4f} {:>9.3f}\n", one.seed, one.nodes,
                             one.nodes_of_best, one.node_ratio(), one.rms_mm, one.rms_of_best_mm, one.error_ratio());
}

void write_medians(const std::vector<Figures>& all, bool json) {
  std::vector<double> nodes, errors;
  for (const Figures& one : all) {
    nodes.push_back(one.node_ratio());
    errors.push_back(one.error_ratio());
  }
  if (json)
    std::cout << nlohmann::ordered_json{{"workload", "parsimony_median"},
                                        {"node_ratio", median(nodes)},
                                        {"validation_rms_ratio", median(errors)}}
                     .dump()
              << '\n';
  else
    std::cout << fmt::format("median                     {:>9.2f}                        {:>9.3f}\n", median(nodes),
                             median(errors));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "How much shorter the reported joint corrections are than those that fit the calibration poses best, and how "
      "well "
      "either predicts the validation poses: the whole way of a direct calibration but the closed loop, in one "
      "thread."};
  Options options;
  app.add_flag("--json", options.json, "one JSON object a line instead of the table");
  app.add_option("--job", options.job, "whose data and parameters are taken")->check(CLI::ExistingFile);
  app.add_option("--seeds", options.seeds, "from 1")->capture_default_str()->check(CLI::Range(1, 1000));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 10;
  }
  const Job job = load_job(options.job);
  const DataSet data = load_data_set(job.data_files.front());
  if (!options.json)
    std::cout << "                 nodes                validation rms, mm\n"
                 "  seed  reported      best     ratio     reported      best     ratio\n";
  std::vector<Figures> all;
  for (int seed = 1; seed <= options.seeds; ++seed) {
    all.push_back(measure(data, job, seed));
    write(all.back(), options.json);
  }
  write_medians(all, options.json);
}
