// A run in one process that everything befalls that can befall one: workers die, hang, leave, come and come back,
// messages stray, and the coordinator dies and is resumed from its journal. Which, and when, is drawn from a seed.
#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "faulty_transport.hpp"
#include "in_memory_run.hpp"
#include "mortal_transport.hpp"
#include "scheduling/run_journal.hpp"

namespace demecal {

/// What befell a run.
struct Disturbances {
  int killed = 0, stopped = 0, returned = 0, left = 0, joined = 0, resumed = 0, begun_anew = 0;
  std::string told;  ///< in order
};

class DisturbedRun : public RunObserver {
 public:
  DisturbedRun(const CalibrationData& data, const std::string& folder, std::uint64_t seed)
      : data_(data),
        folder_(folder),
        random_{seed, 4711},
        faults_{.drop = random_.real(0.0, 0.5), .duplicate = random_.real(0.0, 0.3), .delay = random_.real(0.0, 0.3)} {
    // The network promises to tell of workers in order, and lets all else stray.
    faults_.may_stray = [](const Message& message) {
      return !std::holds_alternative<WorkerStatus>(message) && !std::holds_alternative<WorkerLost>(message);
    };
    const std::size_t workers = 1 + random_.index(3);
    for (std::size_t i = 0; i < workers; ++i) add();
  }

  /// Until it has finished, as often as the coordinator dies or finds that it is stuck.
  RunResult run() {
    while (true) {
      try {
        RunResult result = run_once();
        if (result.end != RunEnd::stuck) return result;
        ++happened_.begun_anew;
        std::filesystem::remove(folder_ + "/run.journal");
      } catch (const CoordinatorDied&) {
        if (++happened_.resumed % 2 == 1) tear_journal();
      }
    }
  }
  const Disturbances& happened() const { return happened_; }
  /// Gives a run up that takes longer than any should.
  void on_tick() override { given_up_ = given_up_ || ++ticks_ > kMostTicks; }

  void on_progress(const Progress& progress) override {
    journal_->on_progress(progress);
    if (--calm_ > 0) return;
    calm_ = 1 + static_cast<int>(random_.index(15));
    disturb();
  }
  void on_checkpoint(const Checkpoint& checkpoint) override { journal_->on_checkpoint(checkpoint); }
  void on_outcome(const Outcome& outcome) override { journal_->on_outcome(outcome); }

 private:
  struct CoordinatorDied {};
  static constexpr int kMostTicks = 300 * kPatience;

  /// A worker, and its end of the network, which outlives its thread.
  struct Host {
    std::string name;
    MortalTransport* network;
    std::unique_ptr<WorkerThread> worker;
    bool stopped = false;
  };

  RunResult run_once() {
    const JobIdentity identity{.data_sha256 = "d", .job_sha256 = "j", .seed = data_.seed, .version = "v"};
    journal_.emplace(folder_, identity, RunJournal::Start::resume);
    RunState state = journal_->recorded(data_).value_or(RunState(data_));
    auto mortal = std::make_unique<MortalTransport>(join(exchange_, Role::coordinator, "coordinator"));
    network_ = mortal.get();
    for (const Host& host : hosts_)
      if (host.stopped) network_->tell_lost(host.name);
    FaultyTransport transport(std::move(mortal), faults_, random_.index(1000000));
    transport.publish(Control{state.data().run, Control::State::cancelled, ""});
    state.rename(++run_);
    journal_->begin(state.data());
    const RunResult result =
        EvolutionRun(transport, std::move(state), *this).run(given_up_, {.news = std::chrono::seconds(1)});
    network_ = nullptr;
    return result;
  }

  void disturb() {
    switch (random_.index(8)) {
      case 0:
        return kill();
      case 1:
        return stop();
      case 2:
      case 3:
        return go_on();
      case 4:
        return leave();
      case 5:
        return add();
      case 6:
        return journal_->finish();
      default:
        if (happened_.resumed >= 3) return;
        tell("coordinator dies");
        network_->die();
        throw CoordinatorDied{};
    }
  }

  void add() {
    const std::string name = "worker-" + std::to_string(happened_.joined++);
    auto mortal = std::make_unique<MortalTransport>(join(exchange_, Role::worker, name));
    MortalTransport* network = mortal.get();
    auto faulty = std::make_unique<FaultyTransport>(std::move(mortal), faults_, random_.index(1000000));
    const auto slots = static_cast<std::uint32_t>(1 + random_.index(2));
    tell("add " + name);
    const std::chrono::milliseconds interval(random_.index(3) * 20);  // between checkpoints; 0: one after each epoch
    hosts_.push_back({name, network, std::make_unique<WorkerThread>(std::move(faulty), name, slots, interval)});
  }
  void kill() {
    const std::size_t at = random_.index(hosts_.size());
    tell("kill " + hosts_[at].name);
    hosts_[at].network->die();
    network_->tell_lost(hosts_[at].name);  // it may never have come to say who it is
    hosts_.erase(hosts_.begin() + static_cast<std::ptrdiff_t>(at));
    ++happened_.killed;
    keep_one();
  }
  void leave() {
    const std::size_t at = random_.index(hosts_.size());
    if (hosts_[at].stopped) return;
    tell("dismiss " + hosts_[at].name);
    hosts_.erase(hosts_.begin() + static_cast<std::ptrdiff_t>(at));
    ++happened_.left;
    keep_one();
  }
  /// Its liveliness runs out, as the network tells; it knows nothing of that.
  void stop() {
    Host& host = hosts_[random_.index(hosts_.size())];
    if (host.stopped) return;
    tell("stop " + host.name);
    host.stopped = true;
    host.network->stop();
    network_->tell_lost(host.name);
    ++happened_.stopped;
    keep_one();
  }
  /// It comes back with what it did meanwhile, and the network tells that it lives.
  void go_on() {
    const auto host = std::ranges::find_if(hosts_, [](const Host& one) { return one.stopped; });
    if (host == hosts_.end()) return;
    tell("continue " + host->name);
    host->stopped = false;
    host->network->go_on();
    network_->tell_back({.worker = host->name, .host = "here", .process = 1, .slots = 1, .version = "v"});
    ++happened_.returned;
  }
  void keep_one() {
    if (std::ranges::all_of(hosts_, [](const Host& host) { return host.stopped; })) add();
  }
  void tear_journal() {
    journal_.reset();
    const std::string path = folder_ + "/run.journal";
    const auto size = std::filesystem::file_size(path);
    std::filesystem::resize_file(path, size - std::min<std::uintmax_t>(size, random_.index(3000)));
  }

  void tell(const std::string& what) { happened_.told += what + '\n'; }

  CalibrationData data_;
  std::string folder_;
  RandomStream random_;
  Faults faults_;
  Disturbances happened_;
  RunId run_ = 1;
  int calm_ = 3, ticks_ = 0;
  std::atomic<bool> given_up_{false};
  std::optional<RunJournal> journal_;
  std::shared_ptr<Exchange> exchange_ = make_exchange();
  MortalTransport* network_ = nullptr;  ///< the coordinator's, while a run goes on
  std::vector<Host> hosts_;
};

}  // namespace demecal
