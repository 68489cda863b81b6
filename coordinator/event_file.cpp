#include "coordinator/event_file.hpp"

#include <filesystem>
#include <set>

#include "yaml/files.hpp"
#include "errors/input_error.hpp"
#include "monitor/watched.hpp"

namespace demecal {
namespace {

using Clock = std::chrono::steady_clock;

/// What a file holds that is gone on with.
struct Before {
  double end_s = 0.0;
  std::set<std::uint64_t> unended;  ///< calibrations that were broken off
};

void add(const Event& event, Before& before) {
  before.end_s = event.time_s;
  if (const auto* lost = std::get_if<CalibrationLost>(&event.message)) before.unended.erase(lost->calibration);
  const auto* news = std::get_if<LoopNews>(&event.message);
  if (news == nullptr || news->round != 0) return;
  before.unended.insert(news->calibration);
  if (is_over(news->stage)) before.unended.erase(news->calibration);
}

/// Cuts off what follows the last whole line; a file that cannot be gone on with goes.
Before prepare_to_resume(const std::string& path) {
  Before before;
  try {
    const std::string text = read_file(path);
    const std::size_t end = text.rfind('\n');
    std::filesystem::resize_file(path, end == std::string::npos ? 0 : end + 1);
    for (const Event& event : read_events(path)) add(event, before);
  } catch (const std::exception&) {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    return {};
  }
  return before;
}

}  // namespace

EventFile::EventFile(const std::string& path, bool resume) : begin_(Clock::now()) {
  const Before before = resume ? prepare_to_resume(path) : Before{};
  begin_ -= std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(before.end_s));
  file_.open(path, resume ? std::ios::app : std::ios::trunc);
  if (before.end_s <= 0.0) file_ << first_event_line() << std::endl;
  for (const std::uint64_t calibration : before.unended) note(CalibrationLost{calibration});
}

void EventFile::note(const Message& message) {
  const std::string line = event_line(message, std::chrono::duration<double>(Clock::now() - begin_).count());
  if (!line.empty() && file_) file_ << line << std::endl;
}

std::vector<Event> read_events(const std::string& path) {
  const std::string text = read_file(path);
  std::vector<Event> events;
  int line = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;
    ++line;
    if (auto event = read_event(text.substr(begin, end - begin), path, line)) events.push_back(std::move(*event));
    begin = end + 1;
  }
  return events;
}

}  // namespace demecal
