// The fields of what islands learn or draw from, as fields.hpp lists those of messages.
#pragma once

#include "effect_sets/set_training.hpp"
#include "evolution/archipelago.hpp"
#include "fitness/fitness.hpp"
#include "fitness/parameters.hpp"
#include "protocol/field_kinds.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal::inline protocol {

template <class Visitor, Fields<GpParameters> M>
void visit_fields(Visitor& visit, M& m) {
  visit("population_size", m.population_size);
  visit("number_generations", m.number_generations);
  visit("tournament_size", m.tournament_size);
  visit("initial_max_tree_depth1", m.initial_max_tree_depth1);
  visit("initial_max_tree_depth2", m.initial_max_tree_depth2);
  visit("max_tree_depth", m.max_tree_depth);
  visit("max_tree_nodes", m.max_tree_nodes);
  visit("min_tree_depth", m.min_tree_depth);
  visit("invalid_attempts", m.invalid_attempts);
  visit("crossover_rate", m.crossover_rate);
  visit("mutation_rate", m.mutation_rate);
  visit("terminal_crossover_rate", m.terminal_crossover_rate);
  visit("terminal_mutation_rate", m.terminal_mutation_rate);
  visit("shrink_mutation_rate", m.shrink_mutation_rate);
  visit("functions", m.functions);
  visit("constants_lower", m.constants_lower);
  visit("constants_upper", m.constants_upper);
  visit("constants", m.constants);
  visit("constant_steps", m.constant_steps);
  visit("constant_share", m.constant_share);
  visit("linear_scaling", m.linear_scaling);
  visit("no_duplicates", m.no_duplicates);
  visit("restart_after", m.restart_after);
  visit("function_weights", m.function_weights);
  visit("shared_functions", m.shared_functions);
  visit("shared_function_weight", m.shared_function_weight);
}

template <class Visitor, Fields<Archipelago> M>
void visit_fields(Visitor& visit, M& m) {
  visit("joints", from_one(m.joints));
  visit("demes_per_joint", m.demes_per_joint);
  visit("topology", m.topology);
  visit("migration_interval", m.migration_interval);
  visit("migrants", m.migrants);
  visit("between_joints", m.between_joints);
  visit("asynchronous", m.asynchronous);
  visit("replacement", m.replacement);
  visit("spread", m.spread);
}

template <class Visitor, Fields<TrainingTable> M>
void visit_fields(Visitor& visit, M& m) {
  visit("variables", m.variables);
  visit("target_scaled", m.target);
  visit("weight", m.weight);
  visit("loss", m.loss);
  visit("seeds", m.seeds);
  visit("limit", m.limit);
}

template <class Visitor, Fields<CauseName> M>
void visit_fields(Visitor& visit, M& m) {
  visit("text", bounded<255>(m.text));
}

template <class Visitor, Fields<SetTraining> M>
void visit_fields(Visitor& visit, M& m) {
  visit("gram", m.gram);
  visit("moment", m.moment);
  visit("squares", m.squares);
  visit("rows", m.rows);
  visit("freedom", m.freedom);
  visit("poses", m.poses);
  visit("columns", m.columns);
  visit("naming_costs_nats", m.naming_costs_nats);
  visit("causes", m.causes);
  visit("cause_names", m.cause_names);
  visit("known", m.known);
  visit("variations", m.variations);
  visit("most_causes", m.most_causes);
  visit("most_effects", m.most_effects);
  visit("most_freedom", m.most_freedom);
  visit("stream", m.stream);
}

template <class Visitor, Fields<WorkTable> M>
void visit_fields(Visitor& visit, M& m) {
  visit("rows", m.rows);
  visit("numbers", m.numbers);
}

template <class Visitor, Fields<WorkInputs> M>
void visit_fields(Visitor& visit, M& m) {
  visit("kind", m.kind);
  visit("numbers_of_pieces", m.numbers_of_pieces);
  visit("stream", m.stream);
  visit("lists", m.lists);
  visit("tables", m.tables);
}

}  // namespace demecal::inline protocol
