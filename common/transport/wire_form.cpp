#include "transport/wire_form.hpp"

#include <utility>

#include "transport/wire_population.hpp"

namespace demecal {
namespace {

/// The key that messages of an island share.
template <class Wire, class Plain>
void encode_island(Wire& encoded, const Plain& message) {
  encoded.run(message.run);
  encoded.joint(to_wire_index(message.island.joint));
  encoded.deme(to_wire_index(message.island.deme));
}

std::optional<Control::State> decode(wire::RunState state) {
  switch (state) {
    case wire::RUNNING:
      return Control::State::running;
    case wire::FINISHED:
      return Control::State::finished;
    case wire::CANCELLED:
      return Control::State::cancelled;
  }
  return std::nullopt;
}

wire::RunState encode(Control::State state) {
  switch (state) {
    case Control::State::running:
      return wire::RUNNING;
    case Control::State::finished:
      return wire::FINISHED;
    case Control::State::cancelled:
      break;
  }
  return wire::CANCELLED;
}

/// The island of a message that has a run and one of each.
template <class Wire>
std::optional<IslandKey> decode_island(const Wire& message) {
  if (message.run() == 0 || message.joint() == 0 || message.deme() == 0) return std::nullopt;
  return IslandKey{message.joint() - 1, message.deme() - 1};
}

}  // namespace

wire::IslandTask encode(const IslandTask& message) {
  wire::IslandTask encoded;
  encode_island(encoded, message);
  encoded.attempt(message.attempt);
  encoded.worker(message.worker);
  encoded.start(encode(message.start));
  encoded.recent(encode(message.recent));
  return encoded;
}

std::optional<IslandTask> decode(const wire::IslandTask& message) {
  const auto island = decode_island(message);
  auto start = decode(message.start());
  auto recent = decode(message.recent());
  if (!island || !start || !recent) return std::nullopt;
  return IslandTask{message.run(),     *island,           message.attempt(), decode_text(message.worker()),
                    std::move(*start), std::move(*recent)};
}

wire::Migrants encode(const Migrants& message) {
  wire::Migrants encoded;
  encode_island(encoded, message);
  encoded.epoch(message.epoch);
  encoded.individuals(encode(message.individuals));
  encoded.worker(message.worker);
  return encoded;
}

std::optional<Migrants> decode(const wire::Migrants& message) {
  const auto island = decode_island(message);
  auto individuals = decode(message.individuals());
  if (!island || !individuals) return std::nullopt;
  return Migrants{message.run(), *island, message.epoch(), std::move(*individuals), decode_text(message.worker())};
}

wire::EpochFigures encode(const EpochFigures& figures) {
  wire::EpochFigures encoded;
  encoded.epoch(figures.epoch);
  encoded.generation(figures.generation);
  encoded.best(figures.figures.best);
  encoded.median(figures.figures.median);
  encoded.best_length(figures.figures.best_length);
  encoded.diversity(figures.figures.diversity);
  encoded.evaluations(figures.evaluations);
  encoded.migrants_taken(figures.migrants_taken);
  return encoded;
}

EpochFigures decode(const wire::EpochFigures& figures) {
  return {figures.epoch(),
          figures.generation(),
          {figures.best(), figures.median(), figures.best_length(), figures.diversity()},
          figures.evaluations(),
          figures.migrants_taken()};
}

wire::Progress encode(const Progress& message) {
  wire::Progress encoded;
  encode_island(encoded, message);
  encoded.worker(message.worker);
  encoded.epoch(message.epoch);
  encoded.generation(message.generation);
  encoded.best(message.figures.best);
  encoded.median(message.figures.median);
  encoded.best_length(message.figures.best_length);
  encoded.evaluations(message.evaluations);
  encoded.evaluations_per_s(message.evaluations_per_s);
  encoded.migrants_taken(message.migrants_taken);
  encoded.diversity(message.figures.diversity);
  encoded.migrants_sent(message.migrants_sent);
  encoded.waited_share(message.waited_share);
  for (const EpochFigures& figures : message.before) encoded.before().push_back(encode(figures));
  return encoded;
}

std::optional<Progress> decode(const wire::Progress& message) {
  const auto island = decode_island(message);
  if (!island || message.before().size() >= kMostToldEpochs) return std::nullopt;
  std::vector<EpochFigures> before;
  for (const wire::EpochFigures& figures : message.before()) before.push_back(decode(figures));
  return Progress{message.run(),
                  *island,
                  decode_text(message.worker()),
                  message.epoch(),
                  message.generation(),
                  {message.best(), message.median(), message.best_length(), message.diversity()},
                  message.evaluations(),
                  message.evaluations_per_s(),
                  message.migrants_taken(),
                  message.migrants_sent(),
                  message.waited_share(),
                  std::move(before)};
}

wire::Checkpoint encode(const Checkpoint& message) {
  wire::Checkpoint encoded;
  encode_island(encoded, message);
  encoded.attempt(message.attempt);
  encoded.state(encode(message.state));
  encoded.recent(encode(message.recent));
  encoded.worker(message.worker);
  return encoded;
}

std::optional<Checkpoint> decode(const wire::Checkpoint& message) {
  const auto island = decode_island(message);
  auto state = decode(message.state());
  auto recent = decode(message.recent());
  if (!island || !state || !recent) return std::nullopt;
  return Checkpoint{message.run(),     message.attempt(),  *island,
                    std::move(*state), std::move(*recent), decode_text(message.worker())};
}

wire::Outcome encode(const Outcome& message) {
  wire::Outcome encoded;
  encode_island(encoded, message);
  encoded.attempt(message.attempt);
  encoded.worker(message.worker);
  encoded.generations(message.generations);
  encoded.evaluations(message.evaluations);
  encoded.migrants_taken(message.migrants_taken);
  encoded.front(encode(message.front));
  return encoded;
}

std::optional<Outcome> decode(const wire::Outcome& message) {
  const auto island = decode_island(message);
  auto front = decode(message.front());
  if (!island || !front) return std::nullopt;
  return Outcome{message.run(),
                 message.attempt(),
                 *island,
                 decode_text(message.worker()),
                 message.generations(),
                 message.evaluations(),
                 message.migrants_taken(),
                 std::move(*front)};
}

wire::WorkerStatus encode(const WorkerStatus& message) {
  wire::WorkerStatus encoded;
  encoded.worker(message.worker);
  encoded.host(message.host);
  encoded.process(message.process);
  encoded.slots(message.slots);
  encoded.version(message.version);
  encoded.leaving(message.leaving);
  encoded.only_run(message.only_run);
  encoded.waited_share(message.waited_share);
  return encoded;
}

std::optional<WorkerStatus> decode(const wire::WorkerStatus& message) {
  if (message.worker().size() == 0) return std::nullopt;
  return WorkerStatus{
      decode_text(message.worker()),  decode_text(message.host()), message.process(),  message.slots(),
      decode_text(message.version()), message.leaving(),           message.only_run(), message.waited_share()};
}

wire::Control encode(const Control& message) {
  wire::Control encoded;
  encoded.run(message.run);
  encoded.state(encode(message.state));
  encoded.note(message.note);
  return encoded;
}

std::optional<Control> decode(const wire::Control& message) {
  const auto state = decode(message.state());
  if (!state || message.run() == 0) return std::nullopt;
  return Control{message.run(), *state, decode_text(message.note())};
}

}  // namespace demecal
