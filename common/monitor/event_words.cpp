#include "monitor/event_words.hpp"

namespace demecal {
namespace {

struct WordOf {
  const char* operator()(const CalibrationData&) const { return "run"; }
  const char* operator()(const Progress&) const { return "progress"; }
  const char* operator()(const Control&) const { return "run_state"; }
  const char* operator()(const WorkerStatus&) const { return "worker"; }
  const char* operator()(const WorkerLost&) const { return "worker_lost"; }
  const char* operator()(const LoopNews& news) const { return news.round == 0 ? "stage" : "round"; }
  const char* operator()(const CalibrationLost&) const { return "calibration_lost"; }
  template <class Other>
  const char* operator()(const Other&) const {
    return "";
  }
};

}  // namespace

const char* event_word(const Message& message) {
  return std::visit(WordOf{}, message);
}

std::string word_of(LoopNews::Stage stage) {
  constexpr const char* kWords[] = {"preparing", "evolving", "closing", "finished", "interrupted", "failed"};
  return kWords[static_cast<std::size_t>(stage)];
}

std::string word_of(LoopNews::Verdict verdict) {
  constexpr const char* kWords[] = {"added", "rejected", "none"};
  return kWords[static_cast<std::size_t>(verdict)];
}

std::string word_of(Control::State state) {
  constexpr const char* kWords[] = {"running", "finished", "cancelled"};
  return kWords[static_cast<std::size_t>(state)];
}

}  // namespace demecal
