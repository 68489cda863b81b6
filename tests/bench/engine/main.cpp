#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "accuracy.hpp"
#include "machine_rates.hpp"
#include "output.hpp"
#include "workload.hpp"

namespace {

using namespace demecal::bench::engine;
using demecal::GpParameters;

struct Options {
  std::vector<std::string> workloads{"run", "run_lm10", "accuracy"};
  std::vector<std::size_t> rows{30, 300, 3000, 30000};
  std::vector<int> threads{1, 2};
  int runs = 7;
  int seeds = 10;
  double seconds = 10.0;
  bool json = false;

  bool wants(const std::string& workload) const {
    return std::find(workloads.begin(), workloads.end(), workload) != workloads.end();
  }
};

void add_rows(const std::string& workload, const GpParameters& gp, std::size_t rows, int runs, const Options& options,
              std::vector<EngineRow>& measured) {
  const EngineFigures parts = measure_parts(gp, rows, rows > 10'000 ? 1 : runs, measured_error_rows_per_s());
  const double tree_walk_per_s = measure_tree_walk(rows);
  for (const int threads : options.threads) {
    std::cerr << '\r' << workload << ", " << rows << " rows, " << threads << " threads   " << std::flush;
    const Speed speed = measure_runs(gp, rows, threads, rows > 10'000 ? std::min(runs, 2) : runs);
    measured.push_back({workload, rows, threads, speed, tree_walk_per_s, parts});
  }
}

std::vector<EngineRow> measure_speed(const Options& options) {
  std::vector<EngineRow> measured;
  if (options.wants("run"))
    for (const std::size_t rows : options.rows) add_rows("run", parameters(), rows, options.runs, options, measured);
  if (options.wants("run_lm10"))
    add_rows("run_lm10", fitting_parameters(), 30, std::min(options.runs, 3), options, measured);
  return measured;
}

std::vector<AccuracyFigures> measure_seeds(const Options& options) {
  std::vector<AccuracyFigures> measured;
  const int seeds = options.wants("accuracy") ? options.seeds : 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    std::cerr << "\raccuracy, seed " << seed << "               " << std::flush;
    measured.push_back(measure_accuracy(static_cast<std::uint64_t>(seed), options.seconds));
  }
  return measured;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "How fast islands evolve on this machine: population 1000, 50 generations, tournament 5, depth 9, at most 64 "
      "nodes, {+ - * % SIN COS SQRTp ABS}; the same with ten Levenberg-Marquardt steps on every individual's constants "
      "(run_lm10); and how soon and how truly a smooth law is found in 30 noisy rows (accuracy, seeds from 1). The "
      "best "
      "of several runs counts; run it on an idle machine."};
  Options options;
  app.add_flag("--json", options.json, "one JSON object a line instead of the tables");
  app.add_option("--workloads", options.workloads, "what is measured")
      ->capture_default_str()
      ->check(CLI::IsMember({"run", "run_lm10", "accuracy"}));
  app.add_option("--rows", options.rows, "numbers of rows, of run")
      ->capture_default_str()
      ->check(CLI::Range(1, 1'000'000));
  app.add_option("--threads", options.threads, "islands side by side")->capture_default_str()->check(CLI::Range(1, 64));
  app.add_option("--runs", options.runs, "of which the best counts")->capture_default_str()->check(CLI::Range(1, 1000));
  app.add_option("--seeds", options.seeds, "of accuracy")->capture_default_str()->check(CLI::Range(1, 1000));
  app.add_option("--seconds", options.seconds, "of processor time for each seed")
      ->capture_default_str()
      ->check(CLI::Range(0.001, 3600.0));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 10;
  }
  const MachineRates machine{measured_fma_per_s(), measured_sin_per_s(), measured_library_sin_per_s()};
  const std::vector<EngineRow> speed = measure_speed(options);
  const std::vector<AccuracyFigures> accuracy = measure_seeds(options);
  std::cerr << '\n';
  if (options.json) {
    write_json(std::cout, speed, machine);
    write_json(std::cout, accuracy);
  } else {
    if (!speed.empty()) write_table(std::cout, speed, machine);
    if (!accuracy.empty()) write_table(std::cout, accuracy);
  }
}
