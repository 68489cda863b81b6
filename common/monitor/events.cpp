#include "monitor/events.hpp"

#include <array>
#include <limits>

#include "errors/input_error.hpp"
#include "monitor/event_members.hpp"
#include "monitor/state_json.hpp"
#include "protocol/field_kinds.hpp"

namespace demecal::inline monitor {
namespace {

constexpr std::array kBreeds{"formulas", "sets", "work"};

}  // namespace

// Not in an anonymous namespace: json_of() and read_json() find these by their arguments.

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

template <class Visit>
void fields(Visit& visit, Like<CalibrationData> auto& m) {
  visit("run", AsText{m.run}, "job", Shown{m.job}, "seed", m.seed, "population_size", m.parameters.population_size,
        "generations", m.parameters.number_generations);
  std::vector<std::uint32_t> joints;
  for (const std::uint32_t joint : m.archipelago.joints) joints.push_back(joint + 1);
  visit("joints", joints);
  if constexpr (kReads<Visit>) {
    for (const std::uint32_t joint : joints) m.archipelago.joints.push_back(joint - 1);
  }
  visit("islands_per_joint", m.archipelago.demes_per_joint, "migration_interval", m.archipelago.migration_interval,
        "migrants", m.archipelago.migrants);
  if constexpr (kReads<Visit>) {
    if (!visit.has("breeds")) return;  // recordings of versions that bred formulas alone
  }
  visit("breeds", OneOf{m.breeds, kBreeds});
}

void fields(auto& visit, Like<Progress> auto& m) {
  visit("run", AsText{m.run}, "joint", FromOne{m.island.joint}, "island", FromOne{m.island.deme}, "worker",
        Shown{m.worker}, "epoch", m.epoch, "generation", m.generation);
  visit("best_fitness", FigureOr{m.figures.best, kInfinity}, "median_fitness", FigureOr{m.figures.median, kInfinity},
        "best_length", m.figures.best_length, "diversity", FigureOr{m.figures.diversity}, "evaluations", m.evaluations,
        "evaluations_per_s", FigureOr{m.evaluations_per_s}, "migrants_sent", m.migrants_sent, "migrants_taken",
        m.migrants_taken, "waited_share", FigureOr{m.waited_share}, "best_formula", Shown{m.best_formula});
}

void fields(auto& visit, Like<Control> auto& m) {
  visit("run", AsText{m.run}, "state", OneOf{m.state, kWords<Control::State>}, "note", Shown{m.note});
}

void fields(auto& visit, Like<WorkerStatus> auto& m) {
  visit("worker", Shown{m.worker}, "host", Shown{m.host}, "process", m.process, "slots", m.slots, "version",
        Shown{m.version}, "leaving", m.leaving, "only_run", AsText{m.only_run}, "waited_share",
        FigureOr{m.waited_share});
}

void fields(auto& visit, Like<WorkerLost> auto& m) {
  visit("worker", Shown{m.worker});
}

void fields(auto& visit, Like<CalibrationLost> auto& m) {
  visit("calibration", AsText{m.calibration});
}

void stage_fields(auto& visit, Like<LoopNews> auto& m) {
  visit("calibration", AsText{m.calibration}, "job", Shown{m.job}, "run", AsText{m.run}, "stage",
        OneOf{m.stage, kWords<LoopNews::Stage>}, "text", Shown{m.text});
}

/// A joint that is 0 where there is none, and null in the line.
template <class Visit>
void joint_field(Visit& visit, auto& place) {
  std::optional<std::uint32_t> joint;
  if (place != 0) joint = place;
  visit("joint", joint);
  if constexpr (kReads<Visit>) place = joint.value_or(0);
}

template <class Visit>
void round_fields(Visit& visit, Like<LoopNews> auto& m) {
  std::uint32_t round = m.round == 0 ? 0 : m.round - 1;
  visit("calibration", AsText{m.calibration}, "job", Shown{m.job}, "round", FromOne{round});
  visit("verdict", OneOf{m.verdict, kWords<LoopNews::Verdict>}, "kind", Shown{m.kind});
  joint_field(visit, m.joint);
  visit("label", Shown{m.label}, "text", Shown{m.text});
  visit("validation_before_mm", FigureOr{m.validation_before_m, kUnknown, 1e3}, "validation_after_mm",
        FigureOr{m.validation_after_m, kUnknown, 1e3});
  if constexpr (kReads<Visit>) m.round = round + 1;
}

void fields(auto& visit, Like<CauseFound> auto& m) {
  visit("calibration", AsText{m.calibration}, "number", m.number, "cause", Shown{m.cause});
  joint_field(visit, m.joint);
  visit("label", Shown{m.label}, "without_mm", FigureOr{m.without_m, kUnknown, 1e3}, "with_mm",
        FigureOr{m.with_m, kUnknown, 1e3}, "share_of_error", FigureOr{m.share_of_error, kUnknown}, "advice",
        Shown{m.advice});
}

void fields(auto& visit, Like<FinalFigures> auto& m) {
  visit("calibration", AsText{m.calibration}, "job", Shown{m.job}, "causes", m.causes, "effects", m.effects);
  visit("validation_before_mm", FigureOr{m.validation_before_m, kUnknown, 1e3}, "validation_after_mm",
        FigureOr{m.validation_after_m, kUnknown, 1e3}, "accept_before_mm", FigureOr{m.accept_before_m, kUnknown, 1e3},
        "accept_after_mm", FigureOr{m.accept_after_m, kUnknown, 1e3});
}

namespace {

/// The word of a kind of message, and how its members stand after it.
struct EventKind {
  const char* word;
  bool (*is_its)(const Message&);
  void (*write)(JsonWriter&, const Message&);
  Message (*read)(JsonReader&);
  void (*describe)(SchemaWriter&);
};

template <class Plain>
constexpr EventKind plain_kind(const char* word) {
  return {word, [](const Message& message) { return std::holds_alternative<Plain>(message); },
          [](JsonWriter& write, const Message& message) { fields(write, std::get<Plain>(message)); },
          [](JsonReader& read) -> Message {
            Plain message;
            fields(read, message);
            return message;
          },
          [](SchemaWriter& describe) {
            Plain message;
            fields(describe, message);
          }};
}

bool is_loop_round(const Message& message) {
  const LoopNews* const news = std::get_if<LoopNews>(&message);
  return news != nullptr && news->round > 0;
}

bool is_stage(const Message& message) {
  return std::holds_alternative<LoopNews>(message) && !is_loop_round(message);
}

constexpr EventKind kEventKinds[] = {
    plain_kind<CalibrationData>("run"),
    plain_kind<Progress>("progress"),
    plain_kind<Control>("run_state"),
    plain_kind<WorkerStatus>("worker"),
    plain_kind<WorkerLost>("worker_lost"),
    {"stage", is_stage,
     [](JsonWriter& write, const Message& message) { stage_fields(write, std::get<LoopNews>(message)); },
     [](JsonReader& read) -> Message {
       LoopNews news;
       stage_fields(read, news);
       return news;
     },
     [](SchemaWriter& describe) {
       LoopNews news;
       stage_fields(describe, news);
     }},
    {"round", is_loop_round,
     [](JsonWriter& write, const Message& message) { round_fields(write, std::get<LoopNews>(message)); },
     [](JsonReader& read) -> Message {
       LoopNews news;
       round_fields(read, news);
       return news;
     },
     [](SchemaWriter& describe) {
       LoopNews news;
       round_fields(describe, news);
     }},
    plain_kind<CauseFound>("cause"),
    plain_kind<FinalFigures>("final_figures"),
    plain_kind<CalibrationLost>("calibration_lost")};

std::optional<Event> read(const JsonValue& json) {
  const std::string word = json["event"].text();
  if (word.empty()) json["event"].refuse("must be the word of an event");
  if (word == "begin" && json["demecal_events"].count() != std::uint64_t{kEventsVersion}) {
    json["demecal_events"].refuse("must be " + std::to_string(kEventsVersion));
  }
  for (const EventKind& kind : kEventKinds) {
    if (word != kind.word) continue;
    JsonReader reader(json);
    return Event{json["t_s"].number().value_or(0.0), kind.read(reader)};
  }
  return std::nullopt;
}

}  // namespace

std::string to_string(LoopNews::Stage stage) {
  return word_of(stage);
}

std::string to_string(LoopNews::Verdict verdict) {
  return word_of(verdict);
}

std::string to_string(Control::State state) {
  return word_of(state);
}

std::string first_event_line() {
  return one_line({{"event", "begin"}, {"demecal_events", kEventsVersion}, {"version", DEMECAL_VERSION}});
}

std::string one_line(const nlohmann::ordered_json& json) {
  std::string line = to_text(json, -1);
  line.pop_back();
  return line;
}

nlohmann::ordered_json event_json(const Message& message, double time_s) {
  for (const EventKind& kind : kEventKinds) {
    if (!kind.is_its(message)) continue;
    nlohmann::ordered_json json{{"event", kind.word}, {"t_s", time_s}};
    JsonWriter write(json);
    kind.write(write, message);
    return json;
  }
  return {};
}

std::vector<EventSchema> event_schemas() {
  std::vector<EventSchema> schemas;
  for (const EventKind& kind : kEventKinds) {
    SchemaWriter describe;
    describe("event", std::string(), "t_s", 0.0);
    kind.describe(describe);
    schemas.push_back({kind.word, one_line(describe.schema(kind.word))});
  }
  return schemas;
}

std::string event_line(const Message& message, double time_s) {
  const nlohmann::ordered_json json = event_json(message, time_s);
  return json.is_null() ? std::string() : one_line(json);
}

std::optional<Event> read_event(const std::string& text, const std::string& file, int line) {
  try {
    return read(JsonValue::parse(text, file));
  } catch (const InputError& error) {
    throw InputError({file, static_cast<std::size_t>(line)}, error.value(), error.rule());
  }
}

}  // namespace demecal::inline monitor
