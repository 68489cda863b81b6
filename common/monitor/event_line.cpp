#include "monitor/event_line.hpp"

#include <nlohmann/json.hpp>

#include "monitor/event_words.hpp"

namespace demecal {
namespace {

using Json = nlohmann::ordered_json;

std::string written(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string number_text(std::uint64_t number) {
  return number == 0 ? std::string() : std::to_string(number);
}

/// Adds its members to an object that begins with the event's word and time.
struct Members {
  Json& json;

  void operator()(const CalibrationData& m) const {
    json["run"] = number_text(m.run);
    json["job"] = m.job;
    json["seed"] = m.seed;
    json["population_size"] = m.parameters.population_size;
    json["generations"] = m.parameters.number_generations;
    Json joints = Json::array();
    for (const std::uint32_t joint : m.archipelago.joints) joints.push_back(joint + 1);
    json["joints"] = std::move(joints);
    json["islands_per_joint"] = m.archipelago.demes_per_joint;
    json["migration_interval"] = m.archipelago.migration_interval;
    json["migrants"] = m.archipelago.migrants;
  }

  void operator()(const Progress& m) const {
    json["run"] = number_text(m.run);
    json["joint"] = m.island.joint + 1;
    json["island"] = m.island.deme + 1;
    json["worker"] = m.worker;
    json["epoch"] = m.epoch;
    json["generation"] = m.generation;
    json["best_fitness"] = m.figures.best;
    json["median_fitness"] = m.figures.median;
    json["best_length"] = m.figures.best_length;
    json["diversity"] = m.figures.diversity;
    json["evaluations"] = m.evaluations;
    json["evaluations_per_s"] = m.evaluations_per_s;
    json["migrants_sent"] = m.migrants_sent;
    json["migrants_taken"] = m.migrants_taken;
    json["waited_share"] = m.waited_share;
  }

  void operator()(const Control& m) const {
    json["run"] = number_text(m.run);
    json["state"] = word_of(m.state);
    json["note"] = m.note;
  }

  void operator()(const WorkerStatus& m) const {
    json["worker"] = m.worker;
    json["host"] = m.host;
    json["process"] = m.process;
    json["slots"] = m.slots;
    json["version"] = m.version;
    json["leaving"] = m.leaving;
    json["only_run"] = number_text(m.only_run);
    json["waited_share"] = m.waited_share;
  }

  void operator()(const WorkerLost& m) const { json["worker"] = m.worker; }

  void operator()(const LoopNews& m) const {
    json["calibration"] = number_text(m.calibration);
    json["job"] = m.job;
    if (m.round == 0) {
      json["run"] = number_text(m.run);
      json["stage"] = word_of(m.stage);
      json["text"] = m.text;
      return;
    }
    json["round"] = m.round;
    json["verdict"] = word_of(m.verdict);
    json["kind"] = m.kind;
    json["joint"] = m.joint == 0 ? Json() : Json(m.joint);
    json["label"] = m.label;
    json["text"] = m.text;
    json["validation_before_mm"] = 1e3 * m.validation_before_m;
    json["validation_after_mm"] = 1e3 * m.validation_after_m;
  }

  void operator()(const CalibrationLost& m) const { json["calibration"] = number_text(m.calibration); }

  template <class Other>
  void operator()(const Other&) const {}
};

}  // namespace

std::string first_event_line() {
  return written(Json{{"event", "begin"}, {"demecal_events", kEventsVersion}, {"version", DEMECAL_VERSION}});
}

std::string event_line(const Message& message, double time_s) {
  const char* const word = event_word(message);
  if (*word == '\0') return {};
  Json json{{"event", word}, {"t_s", time_s}};
  std::visit(Members{json}, message);
  return written(json);
}

}  // namespace demecal
