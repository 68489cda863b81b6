#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "errors/input_error.hpp"
#include "monitor/event_line.hpp"
#include "monitor/event_words.hpp"
#include "protocol/printable.hpp"
#include "report/json_value.hpp"

namespace demecal {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// Text of a file that anybody may have written, fit for a terminal.
std::string shown(const JsonValue& json) {
  return printable(json.text());
}

/// A number that is written as text; 0 where it is empty or missing.
std::uint64_t named_number(const JsonValue& json) {
  const std::string text = json.text();
  std::uint64_t number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (!text.empty() && (fault != std::errc() || end != text.data() + text.size())) json.refuse("must be a number");
  return number;
}

std::uint32_t small_count(const JsonValue& json) {
  const std::uint64_t count = json.count().value_or(0);
  if (count > std::numeric_limits<std::int32_t>::max()) json.refuse("is too large");
  return static_cast<std::uint32_t>(count);
}

/// Counts from 1 in the line, from 0 inside.
std::uint32_t place(const JsonValue& json) {
  const std::uint32_t number = small_count(json);
  if (number == 0) json.refuse("must be a whole number from 1");
  return number - 1;
}

template <class Value, std::size_t size>
Value one_of(const JsonValue& json, const std::array<Value, size>& values) {
  for (const Value value : values)
    if (word_of(value) == json.text()) return value;
  json.refuse("is not a word that stands there");
}

Message read_run(const JsonValue& json) {
  CalibrationData data;
  data.run = named_number(json["run"]);
  data.job = shown(json["job"]);
  data.seed = json["seed"].count().value_or(0);
  data.parameters.population_size = static_cast<int>(small_count(json["population_size"]));
  data.parameters.number_generations = static_cast<int>(small_count(json["generations"]));
  for (const JsonValue& joint : json["joints"].elements()) data.archipelago.joints.push_back(place(joint));
  data.archipelago.demes_per_joint = small_count(json["islands_per_joint"]);
  data.archipelago.migration_interval = small_count(json["migration_interval"]);
  data.archipelago.migrants = small_count(json["migrants"]);
  return data;
}

Message read_progress(const JsonValue& json) {
  Progress progress;
  progress.run = named_number(json["run"]);
  progress.island = {place(json["joint"]), place(json["island"])};
  progress.worker = shown(json["worker"]);
  progress.epoch = small_count(json["epoch"]);
  progress.generation = small_count(json["generation"]);
  progress.figures = {json["best_fitness"].number().value_or(kInfinity),
                      json["median_fitness"].number().value_or(kInfinity), small_count(json["best_length"]),
                      json["diversity"].number().value_or(0.0)};
  progress.evaluations = json["evaluations"].count().value_or(0);
  progress.evaluations_per_s = json["evaluations_per_s"].number().value_or(0.0);
  progress.migrants_sent = json["migrants_sent"].count().value_or(0);
  progress.migrants_taken = json["migrants_taken"].count().value_or(0);
  progress.waited_share = json["waited_share"].number().value_or(0.0);
  return progress;
}

Message read_run_state(const JsonValue& json) {
  using State = Control::State;
  return Control{named_number(json["run"]),
                 one_of(json["state"], std::array{State::running, State::finished, State::cancelled}),
                 shown(json["note"])};
}

Message read_worker(const JsonValue& json) {
  return WorkerStatus{.worker = shown(json["worker"]),
                      .host = shown(json["host"]),
                      .process = small_count(json["process"]),
                      .slots = small_count(json["slots"]),
                      .version = shown(json["version"]),
                      .leaving = json["leaving"].truth().value_or(false),
                      .only_run = named_number(json["only_run"]),
                      .waited_share = json["waited_share"].number().value_or(0.0)};
}

LoopNews read_news(const JsonValue& json) {
  LoopNews news;
  news.calibration = named_number(json["calibration"]);
  news.job = shown(json["job"]);
  news.text = shown(json["text"]);
  return news;
}

Message read_stage(const JsonValue& json) {
  using enum LoopNews::Stage;
  LoopNews news = read_news(json);
  news.run = named_number(json["run"]);
  news.stage = one_of(json["stage"], std::array{preparing, evolving, closing, finished, interrupted, failed});
  return news;
}

Message read_round(const JsonValue& json) {
  using enum LoopNews::Verdict;
  LoopNews news = read_news(json);
  news.round = small_count(json["round"]);
  if (news.round == 0) json["round"].refuse("must be a whole number from 1");
  news.verdict = one_of(json["verdict"], std::array{added, rejected, none});
  news.kind = shown(json["kind"]);
  news.joint = small_count(json["joint"]);
  news.label = shown(json["label"]);
  news.validation_before_m = 1e-3 * json["validation_before_mm"].number().value_or(kNotANumber);
  news.validation_after_m = 1e-3 * json["validation_after_mm"].number().value_or(kNotANumber);
  return news;
}

Message read_worker_lost(const JsonValue& json) {
  return WorkerLost{shown(json["worker"])};
}

Message read_calibration_lost(const JsonValue& json) {
  return CalibrationLost{named_number(json["calibration"])};
}

struct Reader {
  const char* word;
  Message (*read)(const JsonValue&);
};
constexpr std::array<Reader, 8> kReaders{{{"run", read_run},
                                          {"progress", read_progress},
                                          {"run_state", read_run_state},
                                          {"worker", read_worker},
                                          {"worker_lost", read_worker_lost},
                                          {"stage", read_stage},
                                          {"round", read_round},
                                          {"calibration_lost", read_calibration_lost}}};

std::optional<Event> read(const JsonValue& json) {
  const std::string word = json["event"].text();
  if (word.empty()) json["event"].refuse("must be the word of an event");
  if (word == "begin" && json["demecal_events"].count() != std::uint64_t{kEventsVersion}) {
    json["demecal_events"].refuse("must be " + std::to_string(kEventsVersion));
  }
  for (const Reader& reader : kReaders) {
    if (word == reader.word) return Event{json["t_s"].number().value_or(0.0), reader.read(json)};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Event> read_event(const std::string& text, const std::string& file, int line) {
  try {
    return read(JsonValue::parse(text, file));
  } catch (const InputError& error) {
    throw InputError({file, static_cast<std::size_t>(line)}, error.value(), error.rule());
  }
}

}  // namespace demecal
