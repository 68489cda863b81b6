// Random messages with every field filled, for round trips; they need not make sense in any run.
#pragma once

#include <limits>
#include <string>

#include "protocol/messages.hpp"
#include "random/random_stream.hpp"

namespace demecal {

class RandomMessages {
 public:
  /// `worker` is who says all that workers say.
  explicit RandomMessages(std::uint64_t seed, std::string worker = "worker")
      : random_{seed}, worker_(std::move(worker)) {}

  std::uint32_t number() { return static_cast<std::uint32_t>(1 + random_.index(1u << 31)); }
  IslandKey island() { return {small(6), small(1000)}; }
  double real() { return random_.real(-1e3, 1e3); }

  std::string text() {
    std::string result(random_.index(40), ' ');
    for (char& c : result) c = static_cast<char>('!' + random_.index(90));
    return result;
  }

  /// Any sequence of nodes: what travels need not be a valid tree.
  Tree tree() {
    Tree nodes(random_.index(30));
    for (Node& node : nodes) {
      node.primitive = kPrimitives[random_.index(kPrimitives.size())].primitive;
      if (node.primitive == Primitive::variable) node.variable = static_cast<std::uint8_t>(random_.index(256));
      if (node.primitive == Primitive::constant) node.value = real();
    }
    return nodes;
  }

  Population population(std::size_t most = 20) {
    Population individuals(random_.index(most));
    for (Individual& one : individuals)
      one = {tree(), random_.chance(0.1) ? std::numeric_limits<double>::infinity() : random_.real(), places()};
    return individuals;
  }

  IslandState state() {
    return {number(), number(), number(), number(), population(), population(), number(), number(), column()};
  }

  Migrants migrants() { return {number(), island(), number(), population(5), worker_}; }

  std::vector<Migrants> recent() {
    std::vector<Migrants> emigrations(random_.index(kMigrantEpochs + 1));
    for (Migrants& one : emigrations) one = migrants();
    return emigrations;
  }

  CalibrationData data() {
    CalibrationData data{number(), text(), number(), parameters(), archipelago(), {}};
    data.tables.resize(random_.index(7));
    for (TrainingTable& table : data.tables) {
      table = {{column(), column()}, column(), column()};
      table.loss = random_.chance(0.5) ? Loss::squared : Loss::absolute;
      table.seeds.resize(random_.index(3));
      for (Tree& seed : table.seeds) seed = tree();
      if (random_.chance(0.5)) table.limit = random_.real();
    }
    data.breeds = static_cast<Breeds>(random_.index(3));
    data.sets = sets();
    data.work = work();
    return data;
  }

  SetTraining sets() {
    SetTraining sets;
    sets.gram = column();
    sets.moment = column();
    sets.squares = real();
    sets.rows = real();
    sets.freedom = real();
    sets.poses = real();
    sets.columns = places();
    sets.naming_costs_nats = column();
    sets.causes = places();
    sets.cause_names.resize(random_.index(5));
    for (CauseName& name : sets.cause_names) name.text = text();
    sets.known = places();
    sets.variations = count();
    sets.most_causes = number();
    sets.most_effects = number();
    sets.most_freedom = real();
    sets.stream = number();
    return sets;
  }

  WorkInputs work() {
    WorkInputs work{static_cast<WorkKind>(random_.index(4)), places(), number(), {}, {}};
    work.lists.resize(random_.index(4));
    for (auto& list : work.lists) list = places();
    work.tables.resize(random_.index(4));
    for (WorkTable& table : work.tables) table = {number(), column()};
    return work;
  }

  IslandTask task() { return {number(), island(), number(), text(), state(), recent()}; }
  Progress progress() {
    return {number(), island(),       worker_,
            number(), number(),       {random_.real(), random_.real(), number(), random_.real()},
            number(), random_.real(), number(),
            number(), random_.real(), text(),
            before()};
  }
  PlacedProgress placed_progress() { return {text(), number(), random_.chance(0.5), progress()}; }
  std::vector<EpochFigures> before() {
    std::vector<EpochFigures> figures(random_.index(kMostReportedEpochs));
    for (EpochFigures& one : figures)
      one = {number(), number(), {random_.real(), random_.real(), number(), random_.real()}, number(), number()};
    return figures;
  }
  Checkpoint checkpoint() { return {number(), number(), island(), state(), recent(), worker_}; }
  Outcome outcome() {
    return {number(), number(), island(), worker_, number(), number(), number(), population(), column()};
  }
  WorkerStatus status() {
    return {worker_, text(), number(), number(), text(), random_.chance(0.5), number(), random_.real()};
  }
  LoopNews news() {
    using enum LoopNews::Stage;
    using enum LoopNews::Verdict;
    const LoopNews::Stage stages[]{preparing, evolving, closing, finished, interrupted, failed};
    const LoopNews::Verdict verdicts[]{added, rejected, none};
    return {number(), number(), number(), stages[random_.index(6)], text(),        text(), verdicts[random_.index(3)],
            text(),   number(), text(),   random_.real(),           random_.real()};
  }
  CauseFound cause() {
    return {number(), number(), text(), number(), text(), random_.real(), random_.real(), random_.real(), text()};
  }
  FinalFigures figures() {
    return {number(), text(), number(), number(), random_.real(), random_.real(), random_.real(), random_.real()};
  }
  /// Data of the run that a task is of: before them it is not delivered.
  CalibrationData data_of(const IslandTask& task) {
    CalibrationData of_run = data();
    of_run.run = task.run;
    return of_run;
  }
  /// Of a run that goes on.
  Control control() { return {number(), Control::State::running, text()}; }

  std::vector<double> column() {
    std::vector<double> values(random_.index(50));
    for (double& value : values) value = real();
    return values;
  }

  std::vector<std::uint32_t> places() {
    std::vector<std::uint32_t> values(random_.index(8));
    for (std::uint32_t& value : values) value = number();
    return values;
  }

 private:
  std::uint32_t small(std::size_t n) { return static_cast<std::uint32_t>(random_.index(n)); }
  int count() { return static_cast<int>(number()); }

  GpParameters parameters() {
    GpParameters p{count(), count(), count(), count(), count(), count(), count(), count(), count(),
                   real(),  real(),  real(),  real(),  real(),  {},      real(),  real()};
    p.functions.assign(random_.index(8), Primitive::cosine);
    p.constants = static_cast<ConstantPolicy>(random_.index(3));
    p.constant_steps = count();
    p.constant_share = real();
    p.linear_scaling = random_.chance(0.5);
    p.no_duplicates = random_.chance(0.5);
    p.restart_after = count();
    p.function_weights.assign(random_.index(8), real());
    p.shared_functions.resize(random_.index(3));
    for (SharedFunction& function : p.shared_functions) function = {tree(), static_cast<int>(random_.index(256))};
    p.shared_function_weight = real();
    return p;
  }

  Archipelago archipelago() {
    const Topology topologies[]{Topology::none, Topology::ring, Topology::full};
    Archipelago a{{}, number(), topologies[random_.index(3)], number(), number(), random_.chance(0.5)};
    for (std::uint32_t joint = 0; joint < 7; ++joint)
      if (random_.chance(0.5)) a.joints.push_back(joint);
    a.replacement = random_.chance(0.5) ? Replacement::random : Replacement::worst;
    a.spread = real();
    return a;
  }

  RandomStream random_;
  std::string worker_;
};

}  // namespace demecal
