#include "output.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <ostream>

namespace demecal::bench::engine {
namespace {

double share(double part, const EngineFigures& figures) {
  return part / figures.seconds.total();
}

}  // namespace

double found_in_store(const EngineFigures& figures) {
  return 1.0 - figures.functions_made / figures.functions;
}

double node_rows_per_s(const EngineRow& row) {
  return row.parts.functions_computed * static_cast<double>(row.rows) / row.parts.seconds.evaluation;
}

void write_table(std::ostream& out, const std::vector<EngineRow>& rows, const MachineRates& machine) {
  out << fmt::format(
      "One core: {:.2g} fused multiply-adds/s, {:.2g} sines/s (the C library's: {:.2g}/s).\n"
      "Evaluations are offspring made, equal ones included; a whole run makes 51,000.\n\n",
      machine.fma_per_s, machine.sin_per_s, machine.library_sin_per_s);
  out << "workload                    evaluations/s           tree     node x rows/s   of     found\n"
         "             rows threads     wall  per thread      walk  computed   meant  sines in store   start variation "
         "binding "
         "values fitness fitting  memory\n";
  for (const EngineRow& row : rows) {
    const EngineFigures& parts = row.parts;
    const TimeSplit& seconds = parts.seconds;
    out << fmt::format(
        "{:<10} {:>6} {:>7} {:>8.0f} {:>11.0f} {:>9.0f} {:>9.2g} {:>7.2g} {:>6.2f} {:>7.0f}% {:>6.0f}% {:>8.0f}% "
        "{:>6.0f}% "
        "{:>5.0f}% {:>6.0f}% {:>6.0f}% {:>4.1f} MB\n",
        row.workload, row.rows, row.threads, row.speed.per_wall_second, row.speed.per_thread_second,
        row.tree_walk_per_s, node_rows_per_s(row), parts.nodes * static_cast<double>(row.rows) / seconds.total(),
        node_rows_per_s(row) / machine.sin_per_s, 100.0 * found_in_store(parts), 100.0 * share(seconds.start, parts),
        100.0 * share(seconds.variation, parts), 100.0 * share(seconds.binding, parts),
        100.0 * share(seconds.evaluation, parts), 100.0 * share(seconds.fitness, parts),
        100.0 * share(seconds.fitting, parts), 1e-6 * static_cast<double>(parts.bytes));
  }
}

void write_json(std::ostream& out, const std::vector<EngineRow>& rows, const MachineRates& machine) {
  for (const EngineRow& row : rows) {
    const EngineFigures& parts = row.parts;
    const TimeSplit& seconds = parts.seconds;
    out << nlohmann::ordered_json{{"workload", row.workload},
                                  {"rows", row.rows},
                                  {"threads", row.threads},
                                  {"evaluations_per_s", row.speed.per_wall_second},
                                  {"evaluations_per_thread_s", row.speed.per_thread_second},
                                  {"tree_walk_evaluations_per_s", row.tree_walk_per_s},
                                  {"node_rows_per_s", node_rows_per_s(row)},
                                  {"meant_node_rows_per_s",
                                   parts.nodes * static_cast<double>(row.rows) / seconds.total()},
                                  {"found_in_store", found_in_store(parts)},
                                  {"fma_per_s", machine.fma_per_s},
                                  {"sin_per_s", machine.sin_per_s},
                                  {"library_sin_per_s", machine.library_sin_per_s},
                                  {"time_share",
                                   {{"start", share(seconds.start, parts)},
                                    {"variation", share(seconds.variation, parts)},
                                    {"binding", share(seconds.binding, parts)},
                                    {"evaluation", share(seconds.evaluation, parts)},
                                    {"fitness", share(seconds.fitness, parts)},
                                    {"fitting", share(seconds.fitting, parts)}}},
                                  {"fits", parts.fits},
                                  {"memory_bytes", parts.bytes}}
               .dump()
        << '\n';
  }
}

void write_table(std::ostream& out, const std::vector<AccuracyFigures>& seeds) {
  out << fmt::format(
      "\nA smooth law in 30 noisy rows, the model chosen on 30 others. Root mean squares of errors, in 1e-4; the "
      "noise's "
      "is 1.\n"
      "                      after {:g} s\n"
      "  seed  ms to {:.2g}  validation  unseen  nodes  the law itself, fitted\n",
      seeds.front().seconds, 1e4 * AccuracyFigures::kTarget);
  for (const AccuracyFigures& seed : seeds)
    out << fmt::format("{:>6} {:>10.1f} {:>11.2f} {:>7.2f} {:>6} {:>23.2f}\n", seed.seed, seed.ms_to_target,
                       1e4 * seed.validation_rmse, 1e4 * seed.unseen_rmse, seed.nodes, 1e4 * seed.law_rmse);
}

void write_json(std::ostream& out, const std::vector<AccuracyFigures>& seeds) {
  for (const AccuracyFigures& seed : seeds)
    out << nlohmann::ordered_json{{"workload", "accuracy"},
                                  {"seed", seed.seed},
                                  {"ms_to_target", seed.ms_to_target},
                                  {"validation_rmse_after_10s", seed.validation_rmse},
                                  {"seconds", seed.seconds},
                                  {"unseen_rmse", seed.unseen_rmse},
                                  {"law_validation_rmse", seed.law_rmse},
                                  {"nodes", seed.nodes}}
               .dump()
        << '\n';
}

}  // namespace demecal::bench::engine
