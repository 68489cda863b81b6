#include <CLI/CLI.hpp>
#include <iostream>

#include "machine_rates.hpp"
#include "output.hpp"
#include "workload.hpp"

namespace {

using namespace demecal::bench::engine;
using demecal::GpParameters;

struct Options {
  std::vector<std::size_t> rows{30, 300, 3000, 30000};
  std::vector<int> threads{1, 2};
  int runs = 7;
  bool json = false;
};

EngineRow measure_row(const std::string& workload, const GpParameters& gp, std::size_t rows, int threads,
                      const Options& options, const RunFigures& parts, double tree_walk_per_s) {
  std::cerr << '\r' << rows << " rows, " << threads << " threads   " << std::flush;
  const int runs = rows > 10'000 ? std::min(options.runs, 2) : options.runs;
  return {workload, rows, threads, measure_runs(gp, rows, threads, runs), tree_walk_per_s, parts};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "How fast islands evolve on this machine: population 1000, 50 generations, tournament 5, depth 9, at most 64 "
      "nodes, {+ - * % SIN COS SQRTp ABS}. The best of several runs counts; run it on an idle machine."};
  Options options;
  app.add_flag("--json", options.json, "one JSON object a line instead of the table");
  app.add_option("--rows", options.rows, "numbers of rows")->capture_default_str()->check(CLI::Range(1, 1'000'000));
  app.add_option("--threads", options.threads, "islands side by side")->capture_default_str()->check(CLI::Range(1, 64));
  app.add_option("--runs", options.runs, "of which the best counts")->capture_default_str()->check(CLI::Range(1, 1000));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 10;
  }
  const MachineRates machine{measured_fma_per_s(), measured_sin_per_s(), measured_library_sin_per_s()};
  const double error_rows_per_s = measured_error_rows_per_s();
  std::vector<EngineRow> measured;
  for (const std::size_t rows : options.rows) {
    const RunFigures parts = measure_parts(parameters(), rows, rows > 10'000 ? 1 : options.runs, error_rows_per_s);
    const double tree_walk_per_s = measure_tree_walk(rows);
    for (const int threads : options.threads)
      measured.push_back(measure_row("run", parameters(), rows, threads, options, parts, tree_walk_per_s));
  }
  const RunFigures parts = measure_parts(fitting_parameters(), 30, std::min(options.runs, 3), error_rows_per_s);
  for (const int threads : options.threads)
    measured.push_back(measure_row("run_lm10", fitting_parameters(), 30, threads, options, parts, 0.0));
  std::cerr << '\n';
  if (options.json) {
    write_json(std::cout, measured, machine);
  } else {
    write_table(std::cout, measured, machine);
  }
}
