#include "coordinator/monitor_output.hpp"

#include <fmt/format.h>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <utility>

#include "coordinator/commands.hpp"
#include "coordinator/live_page.hpp"
#include "errors/input_error.hpp"
#include "monitor/events.hpp"
#include "recording/mcap.hpp"

namespace demecal {
namespace {

void put_line(const std::string& line) {
  if (line.empty()) return;
  std::puts(line.c_str());
  std::fflush(stdout);
}

std::uint64_t nanoseconds_of_day() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
}

/// `path`, unless something stands there that is worth keeping.
const std::string& replaceable(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string begin(8, '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(file.gcount()));
  if (begin.empty() || is_mcap(begin)) return path;
  throw ArgumentError(fmt::format("{} is no recording, and is not replaced: name another file", path));
}

}  // namespace

RecordingFile::RecordingFile(const std::string& path)
    : path_(replaceable(path)), file_(path, std::ios::binary | std::ios::trunc), recording_(nanoseconds_of_day()) {
  if (!file_) throw InputError({path, 0}, "", "cannot be written: is the folder there, and may files be made in it?");
}

void RecordingFile::write(const std::string& bytes) {
  if (bytes.empty() || !file_) return;
  file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file_.flush();
  if (!file_) fmt::print(stderr, "{}: cannot be written any more; what was recorded before is kept\n", path_);
}

MonitorOutput::MonitorOutput(const MonitorOptions& options) : options_(options), screen_(stdout, options.place) {
  if (!options_.record.empty()) recording_.emplace(options_.record);
  if (options_.ros2 != nullptr) ros2_.emplace(*options_.ros2);
  if (options_.json) put_line(first_event_line());
  const bool draws = !options_.json && !options_.once && options_.http.empty() && screen_.is_terminal();
  if (draws && Keyboard::is_there()) {
    keyboard_.emplace();
    screen_.tell_of_keys();
  }
  if (options_.http.empty()) return;
  const std::string arm = options_.data_file.empty() ? "" : arm_event(options_.data_file, options_.model_file);
  page_.emplace(options_.http, options_.token_file, options_.place);
  if (!arm.empty()) page_->show_arm(arm);
  put_line("live page of " + options_.place + ": " + page_->address());
}

void MonitorOutput::take(const Message& message, double now_s) {
  if (recording_) recording_->take(message, now_s);
  if (ros2_) ros2_->publish(message, event_line(message, now_s));
  if (page_) return page_->take(message, now_s);
  watched_.take(message, now_s);
  changed_ = true;
  if (options_.json) put_line(event_line(message, now_s));
}

void MonitorOutput::follow_keys() {
  for (auto key = keyboard_->key(); key; key = keyboard_->key()) {
    is_left_ = is_left_ || *key == 'q' || *key == 'Q';
    if (*key == '?') screen_.toggle_legend();
  }
}

void MonitorOutput::show(double now_s) {
  if (keyboard_) follow_keys();
  if (recording_) recording_->tick(now_s);
  if (page_) return page_->tick(now_s);
  if (!options_.json && !options_.once) screen_.offer(watched_, now_s, std::exchange(changed_, false));
}

void MonitorOutput::finish(double now_s) {
  if (recording_) recording_->finish();
  recording_.reset();
  if (options_.json || page_) return;
  if (options_.once) {
    screen_.print(watched_, now_s);
  } else {
    screen_.offer(watched_, now_s, changed_);
    screen_.settle(watched_, now_s);
  }
}

}  // namespace demecal
