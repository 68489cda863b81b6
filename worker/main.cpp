// demecal-worker: evolves islands for whichever coordinator serves its domain.
#include <malloc.h>
#include <semaphore.h>
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "dds/dds_transport.hpp"
#include "errors/input_error.hpp"
#include "hosting/worker.hpp"
#include "manual/manual.hpp"
#include "protocol/message_bytes.hpp"
#include "protocol/messages.hpp"
#include "transport/transport.hpp"

namespace {

constexpr unsigned kLongestStop_s = 2;
constexpr const char* kWorkerExitStatus =
    "0: asked to end. 10: wrong arguments. 11: wrong options or certificates. 21: it failed. 130: asked to end twice.";

std::atomic<bool> stop{false};
sem_t stop_asked;

/// The first asks for an end, which the alarm sees to where the work takes too long to notice; the second does not ask.
void on_signal(int) {
  if (stop.exchange(true)) ::_exit(130);
  ::alarm(kLongestStop_s);
  ::sem_post(&stop_asked);
}

void on_alarm(int) {
  ::_exit(0);
}

/// Wakes a worker that waits for messages when it is asked to end: a signal's own handler may not.
class Waker {
 public:
  explicit Waker(demecal::Transport& transport)
      : thread_([&transport] {
          while (::sem_wait(&stop_asked) != 0) {
          }
          transport.wake();
        }) {}
  ~Waker() { ::sem_post(&stop_asked); }
  Waker(const Waker&) = delete;
  Waker& operator=(const Waker&) = delete;

 private:
  std::jthread thread_;
};

/// Gives back memory that runs left: what one thread claims and another frees stays claimed otherwise.
void trim_memory() {
  ::malloc_trim(0);
}

std::string host_name() {
  char name[128] = "unknown";
  ::gethostname(name, sizeof name - 1);
  return demecal::printable(name);
}

/// Unique among all workers that may meet: host, process and the moment it started.
std::string unique_name(const std::string& host) {
  const auto moment = std::chrono::system_clock::now().time_since_epoch().count();
  return host + "-" + std::to_string(::getpid()) + "-" + std::to_string(moment % 1'000'000'000);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"demecal-worker: evolves islands for whichever coordinator serves its domain", "demecal-worker"};
  demecal::WorkerOptions options;
  const auto dds = demecal::add_dds_arguments(app);
  app.add_option("--slots", options.slots, "islands computed at once")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--only-run", options.only_run, "serve the coordinator of this run alone");
  app.set_version_flag("--version", DEMECAL_VERSION);
  demecal::add_manual(app, kWorkerExitStatus, [](const std::string& text) { std::fputs(text.c_str(), stdout); });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 10;
  }
  ::sem_init(&stop_asked, 0, 0);
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGALRM, on_alarm);
  options.host = host_name();
  options.process = static_cast<std::uint32_t>(::getpid());
  options.name = unique_name(options.host);
  options.after_runs = trim_memory;
  try {
    const auto transport = demecal::join_dds(*dds, demecal::Role::worker, options.name);
    const Waker waker(*transport);
    demecal::Worker(*transport, options).serve(stop);
  } catch (const demecal::InputError& error) {
    std::fprintf(stderr, "demecal-worker: %s\n", error.what());
    return 11;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "demecal-worker: %s\n", error.what());
    return 21;
  }
  return 0;
}
