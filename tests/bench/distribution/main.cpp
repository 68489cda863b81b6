#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <iostream>
#include <memory>
#include <thread>
#include <utility>

#include "coordinator/workers.hpp"
#include "figures.hpp"
#include "hosting/worker.hpp"
#include "hosts_of_workers.hpp"
#include "load.hpp"

namespace {

using namespace demecal;
using namespace demecal::bench;

constexpr std::uint64_t kSeed = 20261121;
constexpr int kSlots = 8;  ///< of a worker of sleeping islands

struct Options {
  std::shared_ptr<DdsOptions> dds;
  int pairs = 7;
  int generations = 200;
  std::uint32_t epochs = 12;
  double sleep_s = 0.5;
  std::uint32_t slots = kSlots;  ///< of a worker that is served
  bool sleeping = true;
  int hosts = 0;  ///< in namespaces; 0: everything else instead
  int runs = 3;   ///< of each number of islands there
  bool json = false;
};

std::atomic<bool> stop{false};

/// A worker whose generations last longer than breeding takes.
void serve(const Options& options) {
  std::signal(SIGTERM, [](int) { stop = true; });
  WorkerOptions worker;
  worker.slots = options.slots;
  worker.host = "here";
  worker.process = static_cast<std::uint32_t>(::getpid());
  worker.name = "sleeper-" + std::to_string(worker.process);
  worker.after_generation = [&] { std::this_thread::sleep_for(std::chrono::duration<double>(options.sleep_s)); };
  const auto transport = join_dds(*options.dds, Role::worker, worker.name);
  Worker(*transport, worker).serve(stop);
}

void say(const std::string& text) {
  std::cerr << text << std::endl;
}

SpeedUp pairs_of(const Options& options) {
  const bench::WorkerProcesses one{beside_this_program("demecal-worker"), {}, 1, 1};
  bench::WorkerProcesses two = one;
  two.processes = 2;
  std::vector<DistributionFigures> ones, twos;
  for (int pair = 0; pair < options.pairs; ++pair) {
    say("pair " + std::to_string(pair + 1) + " of " + std::to_string(options.pairs));
    ones.push_back(measure(*options.dds, one, thesis_run(2, kSeed, options.generations)));
    const std::chrono::seconds idle(pair + 1 == options.pairs ? 4 : 0);
    twos.push_back(measure(*options.dds, two, thesis_run(2, kSeed, options.generations), idle));
  }
  return speed_up(std::move(ones), std::move(twos));
}

bench::WorkerProcesses sleeping_workers(const Options& options, int processes, int slots) {
  return {beside_this_program("demecal-bench-distribution"),
          {"--serve", "--sleep-s", std::to_string(options.sleep_s)},
          processes,
          slots};
}

std::vector<Sleeping> sleepers(const Options& options) {
  std::vector<Sleeping> all;
  for (const int islands : {8, 32, 64, 128}) {
    say(std::to_string(islands) + " sleeping islands");
    const CalibrationData run = sleeping_run(static_cast<std::uint32_t>(islands), options.epochs, kSeed);
    all.push_back({options.sleep_s, measure(*options.dds, sleeping_workers(options, islands / kSlots, kSlots), run)});
  }
  return all;
}

/// Of each number of islands the median run.
std::vector<Sleeping> sleepers_on_hosts(const Options& options) {
  const HostsOfWorkers hosts(options.hosts, options.dds->domain);
  std::vector<Sleeping> all;
  for (const int slots : {1, 2, 4}) {
    bench::WorkerProcesses workers = sleeping_workers(options, options.hosts, slots);
    workers.networks = hosts.networks();
    const CalibrationData run = sleeping_run(static_cast<std::uint32_t>(options.hosts * slots), options.epochs, kSeed);
    std::vector<Sleeping> runs;
    for (int number = 1; number <= options.runs; ++number) {
      say(fmt::format("{} hosts with {} sleeping islands each, run {} of {}", options.hosts, slots, number,
                      options.runs));
      runs.push_back({options.sleep_s, measure(hosts.dds(), workers, run)});
    }
    all.push_back(median_of(std::move(runs)));
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "What distribution costs on this machine: two workers against one, the middleware's share, and up to 128 islands "
      "that sleep instead of working. Speeds are ratios within a run; run it on an idle machine."};
  Options options;
  options.dds = add_dds_arguments(app);
  options.dds->domain = 97;
  app.get_option("--domain")->capture_default_str();
  bool worker = false;
  app.add_flag("--json", options.json, "one JSON object a line instead of the table");
  app.add_option("--pairs", options.pairs, "pairs of runs with one and two workers")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app.add_option("--generations", options.generations, "of the pairs; Table 6-1 has 200")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
  app.add_flag("!--no-sleeping", options.sleeping, "only the pairs, without islands that sleep");
  app.add_option("--epochs", options.epochs, "of sleeping islands")->capture_default_str()->check(CLI::Range(2, 10000));
  app.add_option("--sleep-s", options.sleep_s, "per epoch")->capture_default_str()->check(CLI::Range(0.001, 1.0));
  app.add_option(
         "--hosts", options.hosts,
         "instead of all else: sleeping islands on so many worker processes, each in a network namespace of its "
         "own as if on a computer of its own; as root, with ip (iproute2)")
      ->check(CLI::Range(kSlots, 25 * kSlots))
      ->check([](const std::string& text) {
        return std::stoi(text) % kSlots == 0 ? "" : fmt::format("a multiple of {} is wanted", kSlots);
      });
  app.add_option("--runs", options.runs, "of each number of islands on hosts; the median is shown")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app.add_flag("--serve", worker, "be a worker of sleeping islands")->group("");
  app.add_option("--slots", options.slots, "islands computed at once")->group("");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 10;
  }
  try {
    if (worker) {
      serve(options);
      return 0;
    }
    if (options.hosts > 0) {
      const std::vector<Sleeping> runs = sleepers_on_hosts(options);
      options.json ? write_hosts_json(std::cout, options.hosts, runs)
                   : write_hosts_table(std::cout, options.hosts, runs);
      return 0;
    }
    Distribution all{pairs_of(options), {}};
    if (options.sleeping) all.sleeping = sleepers(options);
    options.json ? write_json(std::cout, all) : write_table(std::cout, all);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 21;
  }
  return 0;
}
