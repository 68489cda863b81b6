// The fields of every message, listed once: how it travels, is kept in a journal and is weighed follows from its list.
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "effect_sets/set_training.hpp"
#include "evolution/archipelago.hpp"
#include "evolution/island.hpp"
#include "evolution/population.hpp"
#include "expression/shared_function.hpp"
#include "fitness/fitness.hpp"
#include "fitness/parameters.hpp"
#include "protocol/field_kinds.hpp"
#include "protocol/finding_fields.hpp"
#include "protocol/messages.hpp"
#include "protocol/training_fields.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal::inline protocol {

// A list calls `visit(name, field)` for each field, in the order of idl/calibration.idl, which a test holds to the
// lists.

/// A tree as it travels: variables and constants stand apart from the functions that they are arguments of.
struct FlatFormula {
  std::vector<std::uint8_t> primitives;
  std::vector<std::uint8_t> variables;
  std::vector<double> constants;
};

template <class Visitor, Fields<MessagePart> M>
void visit_fields(Visitor& visit, M& m) {
  visit("place", key(m.place));
  visit("index", key(m.index));
  visit("count", m.count);
  visit("message", m.message);
  visit("bytes", m.bytes);
}

template <class Visitor, Fields<FlatFormula> M>
void visit_fields(Visitor& visit, M& m) {
  visit("primitives", m.primitives);
  visit("variables", m.variables);
  visit("constants", m.constants);
}

template <class Visitor, Fields<Individual> M>
void visit_fields(Visitor& visit, M& m) {
  visit("formula", m.tree);
  visit("fitness", m.fitness);
  visit("effects", m.effects);
}

template <class Visitor, Fields<SharedFunction> M>
void visit_fields(Visitor& visit, M& m) {
  visit("body", m.body);
  visit("coefficients", octet(m.coefficients));
}

template <class Visitor, Fields<CalibrationData> M>
void visit_fields(Visitor& visit, M& m) {
  visit("run", required(m.run));
  visit("job", bounded<255>(m.job));
  visit("seed", m.seed);
  visit("parameters", m.parameters);
  visit("archipelago", m.archipelago);
  visit("tables", m.tables);
  visit("breeds", m.breeds);
  visit("sets", m.sets);
  visit("work", m.work);
}

/// What messages of an island begin with.
template <class Visitor, class M>
void visit_island(Visitor& visit, M& m) {
  visit("run", required(m.run));
  visit("joint", from_one(m.island.joint));
  visit("deme", from_one(m.island.deme));
}

template <class Visitor, Fields<Migrants> M>
void visit_fields(Visitor& visit, M& m) {
  visit_island(visit, m);
  visit("epoch", m.epoch);
  visit("individuals", m.individuals);
  visit("worker", bounded<255>(m.worker));
}

template <class Visitor, Fields<IslandState> M>
void visit_fields(Visitor& visit, M& m) {
  visit("epoch", m.epoch);
  visit("generation", m.generation);
  visit("evaluations", m.evaluations);
  visit("migrants_taken", m.migrants_taken);
  visit("population", m.population);
  visit("front", m.front);
  visit("without_gain", m.without_gain);
  visit("draws", m.draws);
  visit("numbers", m.numbers);
}

template <class Visitor, Fields<IslandTask> M>
void visit_fields(Visitor& visit, M& m) {
  visit_island(visit, m);
  visit("attempt", m.attempt);
  visit("worker", bounded<255>(m.worker));
  visit("start", m.start);
  visit("recent", m.recent);
}

template <class Visitor, Fields<Progress> M>
void visit_fields(Visitor& visit, M& m) {
  visit_island(visit, m);
  visit("worker", bounded<255>(m.worker));
  visit("epoch", m.epoch);
  visit("generation", m.generation);
  visit("best", m.figures.best);
  visit("median", m.figures.median);
  visit("best_length", m.figures.best_length);
  visit("evaluations", m.evaluations);
  visit("evaluations_per_s", m.evaluations_per_s);
  visit("migrants_taken", m.migrants_taken);
  visit("diversity", m.figures.diversity);
  visit("migrants_sent", m.migrants_sent);
  visit("waited_share", m.waited_share);
  visit("best_formula", bounded<kMostFormulaText>(m.best_formula));
  constexpr std::size_t kMostBefore = kMostReportedEpochs - 1;
  auto& before = m.before;
  visit("before_epoch", first_column<kMostBefore>(
                            before, [](auto& one) -> auto& { return one.epoch; }));
  visit("before_generation", column<kMostBefore>(
                                 before, [](auto& one) -> auto& { return one.generation; }));
  visit("before_best", column<kMostBefore>(
                           before, [](auto& one) -> auto& { return one.figures.best; }));
  visit("before_median", column<kMostBefore>(
                             before, [](auto& one) -> auto& { return one.figures.median; }));
  visit("before_best_length", column<kMostBefore>(
                                  before, [](auto& one) -> auto& { return one.figures.best_length; }));
  visit("before_diversity", column<kMostBefore>(
                                before, [](auto& one) -> auto& { return one.figures.diversity; }));
  visit("before_evaluations", column<kMostBefore>(
                                  before, [](auto& one) -> auto& { return one.evaluations; }));
  visit("before_migrants_taken", column<kMostBefore>(
                                     before, [](auto& one) -> auto& { return one.migrants_taken; }));
}

template <class Visitor, Fields<PlacedProgress> M>
void visit_fields(Visitor& visit, M& m) {
  visit("writer", key(bounded<255>(m.writer)));
  visit("place", key(m.place));
  visit("over", m.over);
  visit_fields(visit, m.progress);
}

template <class Visitor, Fields<Checkpoint> M>
void visit_fields(Visitor& visit, M& m) {
  visit_island(visit, m);
  visit("attempt", m.attempt);
  visit("state", m.state);
  visit("recent", m.recent);
  visit("worker", bounded<255>(m.worker));
}

template <class Visitor, Fields<Outcome> M>
void visit_fields(Visitor& visit, M& m) {
  visit_island(visit, m);
  visit("attempt", m.attempt);
  visit("worker", bounded<255>(m.worker));
  visit("generations", m.generations);
  visit("evaluations", m.evaluations);
  visit("migrants_taken", m.migrants_taken);
  visit("front", m.front);
  visit("numbers", m.numbers);
}

template <class Visitor, Fields<WorkerStatus> M>
void visit_fields(Visitor& visit, M& m) {
  visit("worker", key(required(bounded<255>(m.worker))));
  visit("host", bounded<255>(m.host));
  visit("process", m.process);
  visit("slots", m.slots);
  visit("version", bounded<255>(m.version));
  visit("leaving", m.leaving);
  visit("only_run", m.only_run);
  visit("waited_share", m.waited_share);
}

template <class Visitor, Fields<Control> M>
void visit_fields(Visitor& visit, M& m) {
  visit("run", key(required(m.run)));
  visit("state", word(m.state));
  visit("note", bounded<1023>(m.note));
}

template <class Visitor, Fields<LoopNews> M>
void visit_fields(Visitor& visit, M& m) {
  visit("calibration", key(required(m.calibration)));
  visit("round", key(m.round));
  visit("run", m.run);
  visit("stage", word(m.stage));
  visit("job", bounded<255>(m.job));
  visit("text", bounded<1023>(m.text));
  visit("verdict", word(m.verdict));
  visit("kind", bounded<63>(m.kind));
  visit("joint", m.joint);
  visit("label", bounded<255>(m.label));
  visit("validation_before_m", m.validation_before_m);
  visit("validation_after_m", m.validation_after_m);
}

/// Whether a type's fields are listed here: it travels, or is part of what does.
template <class M>
concept Listed = requires(int& visitor, M& m) {
  visit_fields(visitor, m);
};

}  // namespace demecal::inline protocol
