#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "coordinator/commands.hpp"
#include "coordinator/displays.hpp"
#include "coordinator/event_log.hpp"
#include "coordinator/monitor_output.hpp"
#include "coordinator/workers.hpp"
#include "dds/dds_transport.hpp"
#include "errors/input_error.hpp"
#include "monitor/events.hpp"
#include "monitor/watched.hpp"
#include "protocol/messages.hpp"
#include "recording/event_recording.hpp"
#include "recording/mcap.hpp"
#include "transport/transport.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

using MonitorClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kRefreshInterval{100};
/// What comes late to whoever joins has come by then, save for what workers repeat.
constexpr double kSettled_s = 0.5;

double watched_s_since(MonitorClock::time_point begin) {
  return std::chrono::duration<double>(MonitorClock::now() - begin).count();
}

/// Whether nothing is missing that somebody will publish: of an evolution its data, and the workers that its islands
/// name.
bool is_complete(const Watched& watched, double now_s) {
  const WatchedCalibration* calibration = watched.calibration();
  if (calibration == nullptr || now_s - calibration->seen_s < kSettled_s) return false;
  if (calibration->stage.stage != LoopNews::Stage::evolving) return calibration->stage.calibration != 0;
  const WatchedRun* run = watched.run();
  return run != nullptr && run->has_data() && !watched.workers().empty() &&
         std::ranges::all_of(run->islands,
                             [&](const auto& island) { return watched.worker(island.second.worker) != nullptr; });
}

/// Shows on standard output what the transport, a watcher's, brings, until `stop` is set. Done; or, where `once` saw
/// nobody, no_worker.
ExitCode watch(Transport& transport, const std::atomic<bool>& stop, const MonitorOptions& options) {
  const MonitorClock::time_point begin = MonitorClock::now();
  MonitorOutput output(options);
  while (!stop && !output.is_left()) {
    const auto message = transport.receive(kRefreshInterval);
    const double now_s = watched_s_since(begin);
    if (message) output.take(*message, now_s);
    output.show(now_s);
    const bool is_late = MonitorClock::now() - begin >= options.patience;
    if (options.once && (is_late || is_complete(output.watched(), now_s))) break;
  }
  output.finish(watched_s_since(begin));
  return !options.once || output.watched().has_seen_anything() ? ExitCode::done : ExitCode::no_worker;
}

/// Shows a recorded run: the file of events, or the folder that holds it. Throws InputError where it cannot be read.
ExitCode replay(const std::string& path, const std::atomic<bool>& stop, const MonitorOptions& options) {
  const bool is_folder = std::filesystem::is_directory(path);
  const std::string file = is_folder ? path + "/" + kEventFile : path;
  if (is_folder && !std::filesystem::exists(file)) {
    throw InputError({path, 0}, "", fmt::format("holds no {}: only `calibrate` records it", kEventFile));
  }
  const std::string bytes = read_file(file);
  const RecordedEvents recording = is_mcap(bytes) ? read_recording(bytes, file) : RecordedEvents{read_events(file), {}};
  for (const std::string& loss : recording.losses) fmt::print(stderr, "{}: {}\n", file, loss);
  const MonitorClock::time_point begin = MonitorClock::now();
  MonitorOutput output(options);
  double time_s = 0.0;
  for (const Event& event : recording.events) {
    time_s = std::max(time_s, event.time_s);
    while (!stop && !output.is_left() && !options.once && watched_s_since(begin) * options.speed < time_s) {
      output.show(watched_s_since(begin) * options.speed);
      const std::chrono::duration<double> left(time_s / options.speed - watched_s_since(begin));
      std::this_thread::sleep_for(std::min<std::chrono::duration<double>>(left, kRefreshInterval));
    }
    if (stop || output.is_left()) break;
    output.take(event.message, time_s);
  }
  output.finish(time_s);
  while (!options.http.empty() && !stop) {  // it may be looked at for as long as one likes
    output.show(time_s += std::chrono::duration<double>(kRefreshInterval).count());
    std::this_thread::sleep_for(kRefreshInterval);
  }
  return ExitCode::done;
}

struct MonitorRequest {
  MonitorOptions options;
  std::string recorded;
  double wait_s = 5.0;
  bool ros2 = false;
  std::shared_ptr<DdsOptions> dds;
};

ExitCode run_monitor(MonitorRequest& request) {
  if (request.ros2) {
    if (!request.dds->security.empty()) {
      throw ArgumentError("--ros2 publishes what every program may read, and so not with --security");
    }
    request.options.ros2 = request.dds.get();
  }
  const std::atomic<bool>& stop = watch_for_interrupt();
  if (!request.recorded.empty()) {
    request.options.place = request.recorded;
    return replay(request.recorded, stop, request.options);
  }
  request.options.place = "domain " + std::to_string(request.dds->domain);
  request.options.patience = std::chrono::milliseconds(std::llround(1e3 * request.wait_s));
  const auto transport = join_dds(*request.dds, Role::watcher, "monitor-" + std::to_string(::getpid()));
  return watch(*transport, stop, request.options);
}

}  // namespace

void add_monitor(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<MonitorRequest>();
  CLI::App* command = app.add_subcommand("monitor", "show what goes on in a domain, or a recorded run");
  command->add_flag("--json", request->options.json, "a line of JSON for each event");
  command->add_flag("--once", request->options.once, "the present state, then end; 20 where nobody is there");
  CLI::Option* wait = command->add_option("--wait", request->wait_s, "seconds that --once waits for the whole state")
                          ->check(number_from(0.1, 3600.0))
                          ->capture_default_str();
  CLI::Option* recorded = command->add_option(
      "--replay", request->recorded,
      "show a recorded run: a folder that calibrate or diagnose wrote, its events.jsonl, or what --record wrote");
  command->add_option("--speed", request->options.speed, "of --replay: how much faster than it was")
      ->needs(recorded)
      ->check(number_from(1e-3, 1e6))
      ->capture_default_str();
  CLI::Option* http = command
                          ->add_option("--http", request->options.http,
                                       "serve a live page to browsers until interrupted: PORT of this machine (0: any "
                                       "that is free), or ADDRESS:PORT, where others see it who have the token")
                          ->type_name("[ADDRESS:]PORT")
                          ->excludes("--json")
                          ->excludes("--once");
  command
      ->add_option("--token-file", request->options.token_file,
                   "of --http: the token that is to be shown stands there (default: none on this machine alone, "
                   "otherwise one that is drawn)")
      ->needs(http);
  CLI::Option* data = command
                          ->add_option("--data", request->options.data_file,
                                       "of --http: the data set whose arm and poses the page shows, with their errors")
                          ->type_name("DATASET.yaml")
                          ->needs(http);
  command
      ->add_option("--model", request->options.model_file,
                   "of --data: a model of that arm, whose errors are shown, too")
      ->type_name("MODEL.yaml")
      ->needs(data);
  command
      ->add_option("--record", request->options.record,
                   "write what is seen to this file, for --replay and for viewers of MCAP files, until interrupted")
      ->type_name("FILE.mcap")
      ->excludes("--once");
  command
      ->add_flag(
          "--ros2", request->ros2,
          "publish what is seen for programs of ROS 2: rt/demecal/..., by idl/ros2.idl, and rt/demecal/events, a "
          "std_msgs/String of JSON each")
      ->excludes("--once");
  request->dds = add_dds_arguments(*command);
  wait->excludes(recorded)->excludes(http);
  command->callback([request, &exit_code] { exit_code = run_monitor(*request); });
}

}  // namespace demecal
