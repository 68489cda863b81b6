#include <utility>

#include "transport/wire_population.hpp"

namespace demecal {
namespace {

wire::ConstantPolicy encode(ConstantPolicy policy) {
  switch (policy) {
    case ConstantPolicy::none:
      return wire::UNFITTED;
    case ConstantPolicy::lamarckian:
      return wire::LAMARCKIAN;
    case ConstantPolicy::baldwin:
      break;
  }
  return wire::BALDWIN;
}

std::optional<ConstantPolicy> decode(wire::ConstantPolicy policy) {
  switch (policy) {
    case wire::UNFITTED:
      return ConstantPolicy::none;
    case wire::LAMARCKIAN:
      return ConstantPolicy::lamarckian;
    case wire::BALDWIN:
      return ConstantPolicy::baldwin;
  }
  return std::nullopt;
}

wire::SharedFunction encode(const SharedFunction& function) {
  wire::SharedFunction encoded;
  encoded.body(encode(function.body));
  encoded.coefficients(static_cast<std::uint8_t>(function.coefficients));
  return encoded;
}

std::optional<SharedFunction> decode(const wire::SharedFunction& function) {
  auto body = demecal::decode(function.body());
  if (!body) return std::nullopt;
  return SharedFunction{std::move(*body), function.coefficients()};
}

wire::GpParameters encode(const GpParameters& p) {
  wire::GpParameters encoded;
  encoded.population_size(p.population_size);
  encoded.number_generations(p.number_generations);
  encoded.tournament_size(p.tournament_size);
  encoded.initial_max_tree_depth1(p.initial_max_tree_depth1);
  encoded.initial_max_tree_depth2(p.initial_max_tree_depth2);
  encoded.max_tree_depth(p.max_tree_depth);
  encoded.max_tree_nodes(p.max_tree_nodes);
  encoded.min_tree_depth(p.min_tree_depth);
  encoded.invalid_attempts(p.invalid_attempts);
  encoded.crossover_rate(p.crossover_rate);
  encoded.mutation_rate(p.mutation_rate);
  encoded.terminal_crossover_rate(p.terminal_crossover_rate);
  encoded.terminal_mutation_rate(p.terminal_mutation_rate);
  encoded.shrink_mutation_rate(p.shrink_mutation_rate);
  for (const Primitive function : p.functions) encoded.functions().push_back(static_cast<std::uint8_t>(function));
  encoded.constants_lower(p.constants_lower);
  encoded.constants_upper(p.constants_upper);
  encoded.constants(encode(p.constants));
  encoded.constant_steps(p.constant_steps);
  encoded.constant_share(p.constant_share);
  encoded.linear_scaling(p.linear_scaling);
  encoded.no_duplicates(p.no_duplicates);
  encoded.restart_after(p.restart_after);
  encoded.function_weights(p.function_weights);
  for (const SharedFunction& function : p.shared_functions) encoded.shared_functions().push_back(encode(function));
  encoded.shared_function_weight(p.shared_function_weight);
  return encoded;
}

std::optional<GpParameters> decode(const wire::GpParameters& p) {
  GpParameters decoded;
  decoded.population_size = p.population_size();
  decoded.number_generations = p.number_generations();
  decoded.tournament_size = p.tournament_size();
  decoded.initial_max_tree_depth1 = p.initial_max_tree_depth1();
  decoded.initial_max_tree_depth2 = p.initial_max_tree_depth2();
  decoded.max_tree_depth = p.max_tree_depth();
  decoded.max_tree_nodes = p.max_tree_nodes();
  decoded.min_tree_depth = p.min_tree_depth();
  decoded.invalid_attempts = p.invalid_attempts();
  decoded.crossover_rate = p.crossover_rate();
  decoded.mutation_rate = p.mutation_rate();
  decoded.terminal_crossover_rate = p.terminal_crossover_rate();
  decoded.terminal_mutation_rate = p.terminal_mutation_rate();
  decoded.shrink_mutation_rate = p.shrink_mutation_rate();
  decoded.functions.clear();
  for (const std::uint8_t code : p.functions()) {
    if (code >= kPrimitives.size()) return std::nullopt;
    decoded.functions.push_back(static_cast<Primitive>(code));
  }
  decoded.constants_lower = p.constants_lower();
  decoded.constants_upper = p.constants_upper();
  const auto constants = decode(p.constants());
  if (!constants) return std::nullopt;
  decoded.constants = *constants;
  decoded.constant_steps = p.constant_steps();
  decoded.constant_share = p.constant_share();
  decoded.linear_scaling = p.linear_scaling();
  decoded.no_duplicates = p.no_duplicates();
  decoded.restart_after = p.restart_after();
  decoded.function_weights = p.function_weights();
  for (const wire::SharedFunction& wired : p.shared_functions()) {
    auto function = decode(wired);
    if (!function) return std::nullopt;
    decoded.shared_functions.push_back(std::move(*function));
  }
  decoded.shared_function_weight = p.shared_function_weight();
  return decoded;
}

wire::Topology encode(Topology topology) {
  switch (topology) {
    case Topology::none:
      return wire::NONE;
    case Topology::ring:
      return wire::RING;
    case Topology::full:
      break;
  }
  return wire::FULL;
}

std::optional<Topology> decode(wire::Topology topology) {
  switch (topology) {
    case wire::NONE:
      return Topology::none;
    case wire::RING:
      return Topology::ring;
    case wire::FULL:
      return Topology::full;
  }
  return std::nullopt;
}

wire::Archipelago encode(const Archipelago& a) {
  wire::Archipelago encoded;
  for (const std::uint32_t joint : a.joints) encoded.joints().push_back(to_wire_index(joint));
  encoded.demes_per_joint(a.demes_per_joint);
  encoded.topology(encode(a.topology));
  encoded.migration_interval(a.migration_interval);
  encoded.migrants(a.migrants);
  encoded.between_joints(a.between_joints);
  encoded.asynchronous(a.asynchronous);
  encoded.replacement(a.replacement == Replacement::worst ? wire::WORST_LEAVE : wire::ANY_LEAVE);
  encoded.spread(a.spread);
  return encoded;
}

std::optional<Replacement> decode(wire::Replacement replacement) {
  switch (replacement) {
    case wire::WORST_LEAVE:
      return Replacement::worst;
    case wire::ANY_LEAVE:
      return Replacement::random;
  }
  return std::nullopt;
}

std::optional<Archipelago> decode(const wire::Archipelago& a) {
  const auto topology = decode(a.topology());
  const auto replacement = decode(a.replacement());
  if (!topology || !replacement) return std::nullopt;
  std::vector<std::uint32_t> joints;
  for (const std::uint32_t joint : a.joints()) {
    if (joint == 0) return std::nullopt;
    joints.push_back(joint - 1);
  }
  return Archipelago{std::move(joints),      a.demes_per_joint(), *topology,
                     a.migration_interval(), a.migrants(),        a.between_joints(),
                     a.asynchronous(),       *replacement,        a.spread()};
}

wire::TrainingTable encode(const TrainingTable& table) {
  wire::TrainingTable encoded;
  encoded.variables().resize(table.variables.size());
  for (std::size_t i = 0; i < table.variables.size(); ++i) encoded.variables()[i].values(table.variables[i]);
  encoded.target_scaled(table.target);
  encoded.weight(table.weight);
  encoded.loss(table.loss == Loss::absolute ? wire::ABSOLUTE_ERROR : wire::SQUARED_ERROR);
  for (const Tree& seed : table.seeds) encoded.seeds().push_back(encode(seed));
  encoded.limit(table.limit);
  return encoded;
}

std::optional<Loss> decode(wire::Loss loss) {
  switch (loss) {
    case wire::ABSOLUTE_ERROR:
      return Loss::absolute;
    case wire::SQUARED_ERROR:
      return Loss::squared;
  }
  return std::nullopt;
}

std::optional<TrainingTable> decode(const wire::TrainingTable& table) {
  TrainingTable decoded;
  for (const wire::Column& column : table.variables()) decoded.variables.push_back(column.values());
  decoded.target = table.target_scaled();
  decoded.weight = table.weight();
  const auto loss = decode(table.loss());
  if (!loss) return std::nullopt;
  decoded.loss = *loss;
  for (const wire::Formula& formula : table.seeds()) {
    auto seed = demecal::decode(formula);
    if (!seed) return std::nullopt;
    decoded.seeds.push_back(std::move(*seed));
  }
  decoded.limit = table.limit();
  return decoded;
}

}  // namespace

wire::CalibrationData encode(const CalibrationData& message) {
  wire::CalibrationData encoded;
  encoded.run(message.run);
  encoded.job(message.job);
  encoded.seed(message.seed);
  encoded.parameters(encode(message.parameters));
  encoded.archipelago(encode(message.archipelago));
  for (const TrainingTable& table : message.tables) encoded.tables().push_back(encode(table));
  return encoded;
}

std::optional<CalibrationData> decode(const wire::CalibrationData& message) {
  auto parameters = decode(message.parameters());
  auto archipelago = decode(message.archipelago());
  if (!parameters || !archipelago || message.run() == 0) return std::nullopt;
  CalibrationData decoded{message.run(),          decode_text(message.job()), message.seed(),
                          std::move(*parameters), std::move(*archipelago),    {}};
  for (const wire::TrainingTable& wired : message.tables()) {
    auto table = decode(wired);
    if (!table) return std::nullopt;
    decoded.tables.push_back(std::move(*table));
  }
  return decoded;
}

}  // namespace demecal
