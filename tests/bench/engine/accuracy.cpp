#include "accuracy.hpp"

#include <cmath>
#include <limits>

#include "evolution/island.hpp"
#include "evolution/model_archive.hpp"
#include "expression/text.hpp"
#include "thread_seconds.hpp"

namespace demecal::bench::engine {
namespace {

TrainingTable noisy_rows(std::uint64_t seed, std::uint64_t part, std::size_t rows) {
  TrainingTable table{{std::vector<double>(rows)}, std::vector<double>(rows), std::vector<double>(rows, 1.0)};
  RandomStream random{seed, part};
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = random.real(-2.5, 2.5);
    const double y = 0.003 * std::sin(t) + 0.0012 * std::cos(2.0 * t) - 0.0008 * t + 1e-4 * random.normal();
    table.variables[0][i] = t;
    table.target[i] = y / AccuracyLesson::kScale;
  }
  return table;
}

double rmse(const TrainingTable& table, const Tree& tree) {
  double sum = 0.0;
  for (std::size_t i = 0; i < table.target.size(); ++i)
    sum += std::pow(table.target[i] - evaluate(tree, {&table.variables[0][i], 1}), 2);
  return AccuracyLesson::kScale * std::sqrt(sum / static_cast<double>(table.target.size()));
}

Tree fitted_law(const TrainingTable& training) {
  NodeStore store;
  ConstantFit fit(training, accuracy_parameters());
  return store.tree(
      fit.by_squares(store, store.enter(parse("3 * SIN(theta) + 1.2 * COS(2 * theta) - 0.8 * theta"))).root);
}

Archipelago one_island() {
  Archipelago archipelago;
  archipelago.joints = {0};
  archipelago.demes_per_joint = std::numeric_limits<std::uint32_t>::max();
  archipelago.topology = Topology::none;
  archipelago.migration_interval = 1;
  return archipelago;
}

}  // namespace

AccuracyLesson accuracy_lesson(std::uint64_t seed) {
  return {noisy_rows(seed, 1, 30), noisy_rows(seed, 2, 30), noisy_rows(seed, 3, 1000)};
}

GpParameters accuracy_parameters() {
  GpParameters parameters;
  parameters.population_size = 40;
  parameters.number_generations = 10;
  parameters.initial_max_tree_depth2 = 3;
  parameters.min_tree_depth = 1;
  parameters.max_tree_nodes = 31;
  parameters.functions = {Primitive::add, Primitive::subtract, Primitive::multiply, Primitive::sine, Primitive::cosine};
  parameters.constants = ConstantPolicy::lamarckian;
  parameters.linear_scaling = true;
  return parameters;
}

AccuracyFigures measure_accuracy(std::uint64_t seed, double seconds) {
  const AccuracyLesson lesson = accuracy_lesson(seed);
  const GpParameters parameters = accuracy_parameters();
  const Archipelago archipelago = one_island();
  AccuracyFigures figures;
  figures.seed = seed;
  figures.seconds = seconds;
  figures.ms_to_target = std::numeric_limits<double>::quiet_NaN();
  figures.law_rmse = rmse(lesson.validation, fitted_law(lesson.training));
  const double begin = thread_seconds();
  const auto elapsed = [&] { return thread_seconds() - begin; };
  ModelArchive archive(lesson.training, lesson.validation, parameters);
  for (std::uint32_t deme = 0; elapsed() < seconds; ++deme) {
    Island island(parameters, archipelago, lesson.training, {0, deme}, seed);
    while (!island.finished() && elapsed() < seconds) {
      island.run_epoch({});
      archive.offer(island.state().front);
      if (!std::isnan(figures.ms_to_target)) continue;
      const Individual* const model = archive.chosen();
      if (model != nullptr && rmse(lesson.validation, model->tree) <= AccuracyFigures::kTarget)
        figures.ms_to_target = 1e3 * elapsed();
    }
  }
  const Individual* const model = archive.chosen();
  figures.validation_rmse = rmse(lesson.validation, model->tree);
  figures.unseen_rmse = rmse(lesson.unseen, model->tree);
  figures.nodes = model->tree.size();
  return figures;
}

}  // namespace demecal::bench::engine
