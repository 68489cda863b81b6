#include "workload.hpp"

#include <cmath>

#include "random/random_stream.hpp"

namespace demecal::bench::engine {

TrainingTable smooth_table(std::size_t rows) {
  TrainingTable table{{std::vector<double>(rows)}, std::vector<double>(rows), std::vector<double>(rows, 1.0)};
  RandomStream random{20261121, rows};
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = random.real(-2.5, 2.5);
    table.variables[0][i] = t;
    table.target[i] = 3.0 * std::sin(t) + 1.2 * std::cos(2.0 * t) - 0.8 * t + 0.1 * random.normal();
  }
  return table;
}

GpParameters parameters() {
  GpParameters parameters;
  parameters.population_size = 1000;
  parameters.number_generations = 50;
  parameters.max_tree_nodes = 64;
  parameters.functions = {Primitive::add,  Primitive::subtract, Primitive::multiply,    Primitive::divide,
                          Primitive::sine, Primitive::cosine,   Primitive::square_root, Primitive::absolute};
  return parameters;
}

GpParameters fitting_parameters() {
  GpParameters fitting = parameters();
  fitting.constants = ConstantPolicy::lamarckian;
  fitting.constant_steps = 10;
  fitting.constant_share = 1.0;
  return fitting;
}

std::size_t evaluations(const GpParameters& parameters) {
  return static_cast<std::size_t>(parameters.population_size) *
         (1 + static_cast<std::size_t>(parameters.number_generations));
}

}  // namespace demecal::bench::engine
