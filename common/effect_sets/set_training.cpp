#include "effect_sets/set_training.hpp"

#include <Eigen/Core>

namespace demecal::inline effect_sets {

SetTraining set_training(const ExplanationProblem& problem, const SetSearch& search) {
  SetTraining training{.gram = {problem.gram.data(), problem.gram.data() + problem.gram.size()},
                       .moment = {problem.moment.begin(), problem.moment.end()},
                       .squares = problem.squares,
                       .rows = problem.rows,
                       .freedom = problem.freedom,
                       .poses = problem.poses,
                       .columns = {},
                       .naming_costs_nats = problem.naming_costs_nats,
                       .causes = {problem.cause.begin(), problem.cause.end()},
                       .cause_names = {},
                       .known = {search.known.begin(), search.known.end()},
                       .variations = search.search.variations,
                       .most_causes = static_cast<std::uint32_t>(search.search.most_causes),
                       .most_effects = static_cast<std::uint32_t>(search.search.most_effects),
                       .most_freedom = search.search.most_freedom,
                       .stream = search.stream};
  for (const ColumnSpan& span : problem.spans) training.columns.push_back(static_cast<std::uint32_t>(span.count));
  for (const std::string& name : problem.cause_names) training.cause_names.push_back({name});
  return training;
}

ExplanationProblem problem_of(const SetTraining& training) {
  ExplanationProblem problem;
  const auto size = static_cast<Eigen::Index>(training.moment.size());
  problem.gram = Eigen::Map<const Eigen::MatrixXd>(training.gram.data(), size, size);
  problem.moment = Eigen::Map<const Eigen::VectorXd>(training.moment.data(), size);
  problem.squares = training.squares;
  problem.rows = training.rows;
  problem.freedom = training.freedom;
  problem.poses = training.poses;
  Eigen::Index first = 0;
  for (const std::uint32_t count : training.columns) {
    problem.spans.push_back({first, static_cast<Eigen::Index>(count)});
    first += static_cast<Eigen::Index>(count);
  }
  problem.naming_costs_nats = training.naming_costs_nats;
  problem.cause.assign(training.causes.begin(), training.causes.end());
  for (const CauseName& name : training.cause_names) problem.cause_names.push_back(name.text);
  return problem;
}

SetSearch search_of(const SetTraining& training) {
  return {.known = {training.known.begin(), training.known.end()},
          .search = {.variations = training.variations,
                     .most_causes = training.most_causes,
                     .most_effects = training.most_effects,
                     .most_freedom = training.most_freedom},
          .stream = training.stream};
}

}  // namespace demecal::inline effect_sets
