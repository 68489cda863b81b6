#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "coordinator/commands.hpp"
#include "coordinator/jobs/job_folders.hpp"
#include "coordinator/jobs/job_service.hpp"
#include "coordinator/workers.hpp"
#include "dds/dds_transport.hpp"
#include "errors/input_error.hpp"
#include "http/access.hpp"
#include "http/user_server.hpp"
#include "serving/token_file.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

constexpr std::chrono::milliseconds kServiceTick{50};
constexpr mode_t kForOthers = 0077;

struct ServeRequest {
  std::string folder, address = "127.0.0.1", token_file;
  int port = 8470;
  double longest_run_h = 24.0;
  WorkerArguments workers;
};

/// Throws InputError where others than its owner may read the file, since they could then ask as its users.
std::vector<UserToken> tokens_in(const std::string& file) {
  const OwnedDescriptor opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat found {};
  if (opened.get() < 0 || ::fstat(opened.get(), &found) != 0)
    throw InputError({file, 0}, "", std::string("cannot be read: ") + std::strerror(errno));
  if (!S_ISREG(found.st_mode) || (found.st_mode & kForOthers) != 0)
    throw InputError({file, 0}, fmt::format("{:o}", found.st_mode & 07777U),
                     "must be a file that only its owner may read: chmod 600 " + file);
  std::vector<UserToken> tokens;
  for (const auto& [user, token] : parse_tokens(read_file(file), file)) tokens.push_back({user, token});
  return tokens;
}

Endpoint endpoint_of(const ServeRequest& request) {
  const bool is_ipv6 = request.address.find(':') != std::string::npos && !request.address.starts_with('[');
  const std::string address = is_ipv6 ? '[' + request.address + ']' : request.address;
  try {
    return parse_endpoint(address + ':' + std::to_string(request.port), "--listen");
  } catch (const InputError& error) {
    throw ArgumentError(error.what());
  }
}

/// The options of the runs that say where their workers come from, as this command was given them.
std::vector<std::string> run_arguments(const ServeRequest& request) {
  std::vector<std::string> arguments;
  const std::string count = std::to_string(request.workers.count);
  if (request.workers.in_process) return {"--workers", "in-process:" + count};
  arguments = dds_arguments(*request.workers.dds);
  arguments.insert(arguments.end(), {"--workers", count});
  return arguments;
}

ExitCode run_serve(const ServeRequest& request) {
  UserServerOptions options;
  options.endpoint = endpoint_of(request);
  if (!request.token_file.empty()) options.tokens = tokens_in(request.token_file);
  if (options.tokens.empty() && !is_loopback(options.endpoint.address))
    throw ArgumentError("--listen " + request.address +
                        ": others than programs of this machine must show a token: name a file of them with --tokens");
  ::umask(kForOthers);
  JobServiceOptions jobs;
  jobs.folder = request.folder;
  jobs.program = std::filesystem::read_symlink("/proc/self/exe").string();
  jobs.signs_in = !options.tokens.empty();
  jobs.run_arguments = run_arguments(request);
  jobs.longest_run = std::chrono::seconds(static_cast<std::int64_t>(3600.0 * request.longest_run_h));
  JobService service(std::move(jobs));
  const std::atomic<bool>& stop = watch_for_interrupt();
  {
    const UserServer server(options, [&](const ServiceRequest& asked) { return service.answer(asked); });
    fmt::print("{}: jobs of {} at {}/\n", request.folder,
               options.tokens.empty() ? "whoever uses this machine" : fmt::format("{} users", options.tokens.size()),
               origin_of(server.endpoint()));
    if (!is_loopback(options.endpoint.address))
      fmt::print(stderr,
                 "tokens and data travel unencrypted: beyond a network that you trust, put a proxy with TLS or an ssh "
                 "tunnel before it\n");
    std::fflush(stdout);
    while (!stop) {
      service.tick();
      std::this_thread::sleep_for(kServiceTick);
    }
  }
  service.shut_down();
  return ExitCode::done;
}

}  // namespace

void add_serve(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<ServeRequest>();
  CLI::App* command = app.add_subcommand("serve", "upload, run, stop and compare calibrations from a browser");
  command->add_option("--dir", request->folder, "folder of the jobs, a folder for each user in it; made where missing")
      ->required()
      ->type_name("JOBS");
  command->add_option("--port", request->port, "port to listen on; 0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command
      ->add_option("--listen", request->address,
                   "numeric address to listen on; elsewhere than on this machine alone (127.0.0.1, ::1) --tokens is "
                   "needed")
      ->type_name("ADDRESS")
      ->capture_default_str();
  command
      ->add_option("--tokens", request->token_file,
                   "file with a line `NAME TOKEN` for each user, readable by its owner alone; each sees only their own "
                   "jobs")
      ->type_name("FILE");
  command->add_option("--longest-run-h", request->longest_run_h, "hours after which a run is interrupted")
      ->check(number_from(0.001, 8760.0))
      ->capture_default_str();
  add_worker_arguments(*command, request->workers);
  command->callback([request, &exit_code] { exit_code = run_serve(*request); });
}

}  // namespace demecal
