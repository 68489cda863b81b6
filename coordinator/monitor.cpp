#include "coordinator/monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "coordinator/event_file.hpp"
#include "coordinator/monitor_screen.hpp"
#include "errors/input_error.hpp"
#include "monitor/watched.hpp"

namespace demecal {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kTick{100};
/// What comes late to whoever joins has come by then, save for what workers repeat.
constexpr double kSettled_s = 0.5;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Whether nothing is missing that somebody will tell: of an evolution its data, and the workers that its islands name.
bool is_complete(const Watched& watched, double now_s) {
  const WatchedCalibration* calibration = watched.calibration();
  if (calibration == nullptr || now_s - calibration->seen_s < kSettled_s) return false;
  if (calibration->stage.stage != LoopNews::Stage::evolving) return calibration->stage.calibration != 0;
  const WatchedRun* run = watched.run();
  return run != nullptr && run->has_data() && !watched.workers().empty() &&
         std::ranges::all_of(run->islands,
                             [&](const auto& island) { return watched.worker(island.second.worker) != nullptr; });
}

/// Messages on their way to people or programs.
class Output {
 public:
  explicit Output(const MonitorOptions& options) : options_(options), screen_(stdout, options.place) {
    if (options_.json) put(first_event_line());
  }

  void take(const Message& message, double now_s) {
    watched_.take(message, now_s);
    changed_ = true;
    if (options_.json) put(event_line(message, now_s));
  }
  /// To be called now and then.
  void show(double now_s) {
    if (!options_.json && !options_.once) screen_.offer(watched_, now_s, std::exchange(changed_, false));
  }
  /// The state as it is left.
  void finish(double now_s) {
    if (options_.json) return;
    if (options_.once) {
      screen_.print(watched_, now_s);
    } else {
      screen_.offer(watched_, now_s, changed_);
      screen_.settle(watched_, now_s);
    }
  }
  const Watched& watched() const { return watched_; }

 private:
  static void put(const std::string& line) {
    if (line.empty()) return;
    std::puts(line.c_str());
    std::fflush(stdout);
  }

  const MonitorOptions& options_;
  MonitorScreen screen_;
  Watched watched_;
  bool changed_ = true;
};

}  // namespace

ExitCode watch(Transport& transport, const std::atomic<bool>& stop, const MonitorOptions& options) {
  const Clock::time_point begin = Clock::now();
  Output output(options);
  while (!stop) {
    const auto message = transport.receive(kTick);
    const double now_s = seconds_since(begin);
    if (message) output.take(*message, now_s);
    output.show(now_s);
    const bool is_late = Clock::now() - begin >= options.patience;
    if (options.once && (is_late || is_complete(output.watched(), now_s))) break;
  }
  output.finish(seconds_since(begin));
  return !options.once || output.watched().has_seen_anything() ? ExitCode::done : ExitCode::no_worker;
}

ExitCode replay(const std::string& path, const std::atomic<bool>& stop, const MonitorOptions& options) {
  const bool is_folder = std::filesystem::is_directory(path);
  const std::string file = is_folder ? path + "/" + kEventFile : path;
  if (is_folder && !std::filesystem::exists(file)) {
    throw InputError({path, 0}, "", fmt::format("holds no {}: only `calibrate` records it", kEventFile));
  }
  const std::vector<Event> events = read_events(file);
  const Clock::time_point begin = Clock::now();
  Output output(options);
  double time_s = 0.0;
  for (const Event& event : events) {
    time_s = std::max(time_s, event.time_s);
    while (!stop && !options.once && seconds_since(begin) * options.speed < time_s) {
      output.show(seconds_since(begin) * options.speed);
      const std::chrono::duration<double> left(time_s / options.speed - seconds_since(begin));
      std::this_thread::sleep_for(std::min<std::chrono::duration<double>>(left, kTick));
    }
    if (stop) break;
    output.take(event.message, time_s);
  }
  output.finish(time_s);
  return ExitCode::done;
}

}  // namespace demecal
