#include <unistd.h>

#include <cmath>
#include <memory>
#include <string>

#include "coordinator/commands.hpp"
#include "coordinator/dds_arguments.hpp"
#include "coordinator/interrupt.hpp"
#include "coordinator/monitor.hpp"

namespace demecal {
namespace {

struct MonitorRequest {
  MonitorOptions options;
  std::string recorded;
  double wait_s = 5.0;
  std::shared_ptr<DdsOptions> dds;
};

ExitCode run(MonitorRequest& request) {
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
                          ->check(CLI::Range(0.1, 3600.0))
                          ->capture_default_str();
  CLI::Option* recorded = command->add_option(
      "--replay", request->recorded, "show a recorded run: a folder that calibrate wrote, or its events.jsonl");
  command->add_option("--speed", request->options.speed, "of --replay: how much faster than it was")
      ->needs(recorded)
      ->check(CLI::Range(1e-3, 1e6))
      ->capture_default_str();
  request->dds = add_dds_arguments(*command);
  wait->excludes(recorded);
  command->callback([request, &exit_code] { exit_code = run(*request); });
}

}  // namespace demecal
