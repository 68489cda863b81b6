#include "disturbed_job.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>

namespace demecal {
namespace {

constexpr int kMostResumed = 2;
/// Between two disturbances. These are the schedule: nothing is taken for true because they are over.
constexpr double kShortest_s = 0.03, kLongest_s = 0.4;
constexpr std::chrono::seconds kPatience{120};

}  // namespace

Disturbances& Disturbances::operator+=(const Disturbances& other) {
  killed += other.killed;
  stopped += other.stopped;
  continued += other.continued;
  left += other.left;
  joined += other.joined;
  resumed += other.resumed;
  crashed += other.crashed;
  return *this;
}

DisturbedJob::DisturbedJob(const SmallJob& job, const std::string& out, const std::string& domain, std::uint64_t seed)
    : job_(job), out_(out), domain_(domain), random_{seed, 99}, local_workers_(static_cast<int>(random_.index(3))) {
  const std::size_t workers = 1 + random_.index(3);
  if (random_.chance(0.5)) start_coordinator(false);
  for (std::size_t i = 0; i < workers; ++i) add();
  if (!coordinator_) start_coordinator(false);
}

Ended DisturbedJob::run() {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < deadline) {
    const auto calm = std::chrono::milliseconds(static_cast<int>(1e3 * random_.real(kShortest_s, kLongest_s)));
    if (coordinator_->ends_within(calm)) break;
    disturb();
  }
  for (Worker& worker : workers_) note_crash(worker, std::chrono::milliseconds(0));
  return coordinator_->wait(std::chrono::seconds(0));
}

void DisturbedJob::note_crash(Worker& worker, std::chrono::milliseconds patience) {
  constexpr int kSignalled = 128;
  if (!worker.program->ends_within(patience)) return;
  const int code = worker.program->wait().code;
  for (const int own : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL}) happened_.crashed += code == kSignalled + own;
}

void DisturbedJob::start_coordinator(bool resume) {
  std::vector<std::string> arguments{
      "calibrate", job_.job(),      "--out", job_.path(out_), "--workers", std::to_string(local_workers_), "--domain",
      domain_,     "--max-effects", "0"};
  if (resume) arguments.insert(arguments.end(), {"--resume", job_.path(out_)});
  coordinator_ = std::make_unique<StartedProgram>("demecal", arguments);
}

void DisturbedJob::disturb() {
  switch (random_.index(9)) {
    case 0:
    case 1:
      return kill_worker();
    case 2:
      return stop_worker();
    case 3:
    case 4:
      return continue_one();
    case 5:
      return dismiss();
    case 6:
      return add();
    case 7:
      return kill_local_worker();
    default:
      return kill_coordinator();
  }
}

void DisturbedJob::add() {
  const std::string slots = std::to_string(1 + random_.index(2));
  workers_.push_back({std::make_unique<StartedProgram>(
      "demecal-worker", std::vector<std::string>{"--domain", domain_, "--slots", slots})});
  ++happened_.joined;
}

void DisturbedJob::kill_worker() {
  const auto victim = workers_.begin() + static_cast<std::ptrdiff_t>(random_.index(workers_.size()));
  note_crash(*victim, std::chrono::milliseconds(0));
  victim->program->signal(SIGKILL);
  workers_.erase(victim);
  ++happened_.killed;
  keep_one();
}

void DisturbedJob::stop_worker() {
  Worker& worker = workers_[random_.index(workers_.size())];
  if (worker.stopped) return;
  worker.program->signal(SIGSTOP);
  worker.stopped = true;
  ++happened_.stopped;
  keep_one();
}

void DisturbedJob::continue_one() {
  const auto worker = std::ranges::find_if(workers_, [](const Worker& one) { return one.stopped; });
  if (worker == workers_.end()) return;
  worker->program->signal(SIGCONT);
  worker->stopped = false;
  ++happened_.continued;
}

void DisturbedJob::dismiss() {
  const auto worker = workers_.begin() + static_cast<std::ptrdiff_t>(random_.index(workers_.size()));
  if (worker->stopped) return;
  worker->program->signal(SIGTERM);
  note_crash(*worker, kPatience);
  workers_.erase(worker);
  ++happened_.left;
  keep_one();
}

void DisturbedJob::kill_local_worker() {
  const std::vector<pid_t> children = coordinator_->children();
  if (children.empty()) return;
  ::kill(children[random_.index(children.size())], SIGKILL);
  ++happened_.killed;
}

void DisturbedJob::kill_coordinator() {
  if (happened_.resumed >= kMostResumed) return;
  coordinator_->signal(SIGKILL);
  coordinator_->wait();
  start_coordinator(std::filesystem::exists(job_.path(out_)));  // one that was killed at once has left none to resume
  ++happened_.resumed;
}

void DisturbedJob::keep_one() {
  if (std::ranges::all_of(workers_, [](const Worker& worker) { return worker.stopped; })) add();
}

}  // namespace demecal
