#include "measure.hpp"

#include <algorithm>
#include <barrier>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "evolution/breeding.hpp"
#include "evolution/island.hpp"
#include "evolution/tree_generation.hpp"
#include "thread_seconds.hpp"
#include "workload.hpp"

namespace demecal::bench::engine {
namespace {

constexpr std::uint64_t kSeed = 5;

Archipelago alone() {
  Archipelago archipelago;
  archipelago.joints = {0};
  archipelago.demes_per_joint = 1;
  return archipelago;
}

class Stopwatch {
 public:
  double lap() {
    const double before = last_;
    last_ = thread_seconds();
    return last_ - before;
  }

 private:
  double last_ = thread_seconds();
};

void count_offspring(const Breeder& breeder, const SharedPopulation& population, EngineFigures& figures) {
  for (const NodeId root : population.roots) {
    const TreeExtent& extent = breeder.store()[root].whole;
    figures.functions += extent.functions();
    figures.nodes += extent.nodes;
  }
}

EngineFigures run_in_parts(const GpParameters& gp, const TrainingTable& table, double error_rows_per_s) {
  EngineFigures figures;
  Stopwatch watch;
  RandomStream random{kSeed};
  Breeder breeder(gp, table);
  SharedPopulation population = breeder.enter(ramped_half_and_half(random, gp, 1));
  figures.seconds.start = watch.lap();
  const std::uint64_t made_at_start = breeder.store().functions_made();
  double scored = 0.0;
  for (int generation = 0; generation < gp.number_generations; ++generation) {
    watch.lap();
    breeder.vary(random, population);
    figures.seconds.variation += watch.lap();
    breeder.bind();
    figures.seconds.binding += watch.lap();
    figures.functions_computed += static_cast<double>(breeder.known().evaluator().functions_bound());
    watch.lap();
    scored += static_cast<double>(breeder.evaluate(population));
    figures.seconds.evaluation += watch.lap();
    breeder.learn(population);
    figures.seconds.fitting += watch.lap();
    figures.fits = static_cast<double>(breeder.learning().fits());
    count_offspring(breeder, population, figures);
  }
  figures.functions_made = static_cast<double>(breeder.store().functions_made() - made_at_start);
  figures.bytes = breeder.store().bytes() + breeder.known().evaluator().bytes();
  figures.seconds.fitness = std::min(figures.seconds.evaluation,
                                     scored * static_cast<double>(padded(table.target.size())) / error_rows_per_s);
  figures.seconds.evaluation -= figures.seconds.fitness;
  return figures;
}

void run_island(const GpParameters& gp, const TrainingTable& table, std::uint64_t seed) {
  Island island(gp, alone(), table, {0, 0}, seed);
  while (!island.finished()) island.run_epoch({});
}

// Plain and recursive, with a branch at every node and row.
double walk(const Node*& node, double theta) {
  const Node& here = *node++;
  if (here.primitive == Primitive::constant) return here.value;
  if (here.primitive == Primitive::variable) return theta;
  const double left = walk(node, theta);
  return arity(here.primitive) == 1 ? value_of(here.primitive, left)
                                    : value_of(here.primitive, left, walk(node, theta));
}

}  // namespace

EngineFigures measure_parts(const GpParameters& gp, std::size_t rows, int runs, double error_rows_per_s) {
  const TrainingTable table = smooth_table(rows);
  EngineFigures best = run_in_parts(gp, table, error_rows_per_s);
  for (int run = 1; run < runs; ++run) {
    const EngineFigures figures = run_in_parts(gp, table, error_rows_per_s);
    if (figures.seconds.total() < best.seconds.total()) best = figures;
  }
  return best;
}

Speed measure_runs(const GpParameters& gp, std::size_t rows, int threads, int runs) {
  const TrainingTable table = smooth_table(rows);
  const auto count = static_cast<double>(evaluations(gp));
  Speed best;
  for (int run = 0; run < runs; ++run) {
    std::vector<double> seconds(static_cast<std::size_t>(threads));
    std::barrier start(threads + 1);
    std::vector<std::thread> workers;
    for (double& own : seconds) {
      workers.emplace_back([&] {
        start.arrive_and_wait();
        const double begin = thread_seconds();
        run_island(gp, table, kSeed);
        own = thread_seconds() - begin;
      });
    }
    start.arrive_and_wait();
    const auto begin = std::chrono::steady_clock::now();
    for (std::thread& worker : workers) worker.join();
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
    best.per_thread_second =
        std::max(best.per_thread_second, count / *std::max_element(seconds.begin(), seconds.end()));
    best.per_wall_second = std::max(best.per_wall_second, count * threads / wall.count());
  }
  return best;
}

double measure_tree_walk(std::size_t rows) {
  const TrainingTable table = smooth_table(rows);
  Island island(parameters(), alone(), table, {0, 0}, kSeed);
  while (!island.finished()) island.run_epoch({});
  const Population& population = island.state().population;
  const std::size_t count = std::max<std::size_t>(20, std::min(population.size(), 600'000 / rows));
  [[maybe_unused]] volatile double sink = 0.0;  // keeps the compiler from leaving the work out
  const double begin = thread_seconds();
  for (std::size_t i = 0; i < count; ++i) {
    double sum = 0.0;
    for (std::size_t row = 0; row < rows; ++row) {
      const Node* node = population[i].tree.data();
      sum += table.weight[row] * std::abs(table.target[row] - walk(node, table.variables[0][row]));
    }
    sink = sum;
  }
  return static_cast<double>(count) / (thread_seconds() - begin);
}

}  // namespace demecal::bench::engine
