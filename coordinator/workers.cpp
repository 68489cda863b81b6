#include "coordinator/workers.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "scheduling/worker_pool.hpp"
#include "transport/transport.hpp"

namespace demecal {
namespace {

constexpr std::chrono::milliseconds kTerminationGrace{2000};
constexpr std::chrono::milliseconds kPollInterval{5};

/// In the child: becomes the worker, or ends with 127.
[[noreturn]] void become(const std::string& path, std::vector<char*>& arguments, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);       // not even a worker that hangs or is stopped may outlive its coordinator
  if (::getppid() != parent) ::_exit(127);  // the coordinator died before prctl
  const int nowhere = ::open("/dev/null", O_RDWR);
  ::dup2(nowhere, STDIN_FILENO);
  ::dup2(nowhere, STDOUT_FILENO);
  ::execv(path.c_str(), arguments.data());
  ::_exit(127);
}

pid_t start(const std::string& path, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{path};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error(std::string("cannot start a worker: ") + std::strerror(errno));
  if (child == 0) become(path, pointers, parent);
  return child;
}

/// `text` as --workers takes it. Throws CLI::ValidationError for anything else.
void take_workers(const std::string& text, WorkerArguments& workers) {
  constexpr int kMostWorkers = 256;
  static const std::string kInProcess = "in-process";
  workers.in_process = text.starts_with(kInProcess);
  std::string number = text;
  if (workers.in_process) {
    const std::string rest = text.substr(kInProcess.size());
    workers.count = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    if (rest.empty()) return;
    number = rest.starts_with(':') ? rest.substr(1) : "";
  }
  int count = -1;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), count);
  const int least = workers.in_process ? 1 : 0;
  if (error != std::errc() || end != number.data() + number.size() || count < least || count > kMostWorkers) {
    throw CLI::ValidationError(
        "--workers", fmt::format("'{}' is neither 0 to {} nor in-process nor in-process:1 to in-process:{}", text,
                                 kMostWorkers, kMostWorkers));
  }
  workers.count = count;
}

}  // namespace

void add_worker_arguments(CLI::App& command, WorkerArguments& workers) {
  const auto take = [&workers](const std::string& text) { take_workers(text, workers); };
  command
      .add_option_function<std::string>(
          "--workers", take,
          "local worker processes; 0 waits for workers started elsewhere; in-process or in-process:N breeds on as many "
          "threads of this process, without DDS: nobody else can work or watch")
      ->type_name("N|in-process")
      ->default_str("one per core");  // not their number: the manual page is of every machine
  workers.dds = add_dds_arguments(command);
}

MakeWorkerPool worker_pool_maker(const WorkerArguments& arguments) {
  return [&arguments]() -> std::unique_ptr<WorkerPool> {
    if (arguments.in_process) return std::make_unique<InProcessWorkerPool>(static_cast<std::uint32_t>(arguments.count));
    return std::make_unique<DdsWorkerPool>(*arguments.dds, arguments.count);
  };
}

std::unique_ptr<Transport> join_as_reporter(const WorkerArguments& arguments) {
  constexpr const char* kName = "reporter";
  return arguments.in_process ? join(make_exchange(), Role::reporter, kName)
                              : join_dds(*arguments.dds, Role::reporter, kName);
}

std::string to_string(const WorkerArguments& arguments, double worker_timeout_s) {
  if (arguments.in_process)
    return fmt::format("{} thread{} of this process", arguments.count, arguments.count == 1 ? "" : "s");
  return fmt::format("DDS domain {}, {}", arguments.dds->domain,
                     arguments.count > 0 ? fmt::format("{} local workers", arguments.count)
                                         : fmt::format("waiting up to {:g} s for workers", worker_timeout_s));
}

LocalWorkers::LocalWorkers(const std::string& path, const std::vector<std::string>& arguments, int count) {
  if (count > 0 && ::access(path.c_str(), X_OK) != 0)
    throw std::runtime_error("cannot start a worker: no program " + path);
  for (int i = 0; i < count; ++i) processes_.push_back(start(path, arguments));
}

LocalWorkers::~LocalWorkers() {
  for (const pid_t process : processes_) ::kill(process, SIGTERM);
  const auto deadline = std::chrono::steady_clock::now() + kTerminationGrace;
  while (any_alive() && std::chrono::steady_clock::now() < deadline) std::this_thread::sleep_for(kPollInterval);
  for (const pid_t process : processes_) {
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
  }
}

bool LocalWorkers::any_alive() {
  std::erase_if(processes_, [](pid_t process) { return ::waitpid(process, nullptr, WNOHANG) != 0; });
  return !processes_.empty();
}

std::string beside_this_program(const std::string& name) {
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / name).string();
}

DdsWorkerPool::DdsWorkerPool(const DdsOptions& options, int local_workers)
    : options_(options),
      local_workers_(local_workers),
      transport_(join_dds(options, Role::coordinator, "coordinator")) {}

void DdsWorkerPool::launch(RunId run) {
  if (workers_ && workers_->any_alive()) return;
  std::vector<std::string> arguments = dds_arguments(options_);
  arguments.insert(arguments.end(), {"--only-run", std::to_string(run)});
  int processes = local_workers_;
  if (!options_.security.empty() && processes > 0) {
    arguments.insert(arguments.end(), {"--slots", std::to_string(processes)});
    processes = 1;
  }
  workers_.emplace(beside_this_program("demecal-worker"), arguments, processes);
}

}  // namespace demecal
