#include "scheduling/run_journal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "errors/input_error.hpp"

namespace demecal::inline scheduling {
namespace {

constexpr std::chrono::milliseconds kSnapshotInterval{250};
/// A snapshot, or a disk, that took long is followed by as many times as long without one.
constexpr int kRest = 20;
constexpr std::size_t kShortenAtGrowth = 4;
/// Runs before these have been ended by those who resumed in between.
constexpr std::ptrdiff_t kMostLeft = 8;

std::string journal_path(const std::string& folder) {
  return folder + "/run.journal";
}

std::string how_far(const std::vector<RunState>& evolutions) {
  std::size_t finished = 0, all = 0, islands_finished = 0;
  for (const RunState& state : evolutions) {
    finished += state.all_finished() ? 1 : 0;
    all += islands(state.data().archipelago).size();
    islands_finished += state.outcomes().size();
  }
  return fmt::format("{} of {} evolution{} begun and {} of their {} islands had finished", finished, evolutions.size(),
                     evolutions.size() == 1 ? "" : "s", islands_finished, all);
}

}  // namespace

RunJournal::RunJournal(const std::string& folder, const JobIdentity& identity, Start start,
                       std::size_t shorten_from_bytes)
    : file_(journal_path(folder)), identity_(identity), shorten_from_bytes_(shorten_from_bytes) {
  if (start == Start::resume) {
    take_up();
  } else if (file_.size() > 0) {
    found_ = fmt::format("{} of a run that was broken off is replaced; --resume goes on from one", file_.path());
  }
  if (evolutions_.empty()) begin_anew();
}

void RunJournal::begin_anew() {
  file_.cut(0);
  file_.append(journal_of(identity_, {}));
  file_.sync();
}

void RunJournal::take_up() {
  RecordedJob job = read_journal(file_.read());
  if (!job.identity) {
    found_ = fmt::format("{} holds no run: this one begins at its start", file_.path());
    return;
  }
  if (const auto other = difference(*job.identity, identity_)) {
    throw InputError({file_.path(), 0}, "", fmt::format("the run there cannot be resumed: {}", *other));
  }
  file_.cut(job.sound_bytes);
  evolutions_ = std::move(job.evolutions);
  left_.assign(job.runs.end() - std::min(std::ssize(job.runs), kMostLeft), job.runs.end());
  found_ = fmt::format("going on from {}: {}{}", file_.path(), how_far(evolutions_),
                       job.end == JournalEnd::clean ? "" : "; what follows a damaged record is left out");
}

std::optional<RunState> RunJournal::recorded(const CalibrationData& data) const {
  const auto found =
      std::ranges::find_if(evolutions_, [&](const RunState& state) { return same_evolution(state.data(), data); });
  if (found == evolutions_.end()) return std::nullopt;
  return *found;
}

void RunJournal::begin(const CalibrationData& data) {
  const auto found =
      std::ranges::find_if(evolutions_, [&](const RunState& state) { return same_evolution(state.data(), data); });
  present_ = static_cast<std::uint32_t>(found - evolutions_.begin());
  if (found == evolutions_.end()) evolutions_.emplace_back(data);
  reached_.clear();
  file_.append(begin_record(present_, data));
  sync_where_due();
}

void RunJournal::forget() {
  evolutions_.at(present_) = RunState(evolutions_.at(present_).data());
  file_.append(forget_record(present_));
  sync_where_due();
}

void RunJournal::finish() {
  write_snapshot();
  sync_where_due();
}

/// A process that dies loses nothing that it appended; the disk is waited for lest a computer that dies lose much.
void RunJournal::sync_where_due() {
  const Clock::time_point begin = Clock::now();
  if (begin < next_sync_) return;
  file_.sync();
  const Clock::time_point end = Clock::now();
  next_sync_ = end + std::max<Clock::duration>(kSnapshotInterval, kRest * (end - begin));
}

void RunJournal::on_progress(const Progress& progress) {
  unwritten_ += progress_record(present_, progress);
}

void RunJournal::on_checkpoint(const Checkpoint& checkpoint) {
  reached_[checkpoint.island] = checkpoint;
}

void RunJournal::on_outcome(const Outcome& outcome) {
  file_.append(outcome_record(present_, outcome));
}

void RunJournal::on_tick() {
  const Clock::time_point begin = Clock::now();
  if (begin < next_snapshot_) return;
  write_snapshot();
  file_.sync();
  const Clock::time_point end = Clock::now();
  next_snapshot_ = end + std::max<Clock::duration>(kSnapshotInterval, kRest * (end - begin));
}

void RunJournal::write_snapshot() {
  std::vector<Checkpoint> checkpoints;
  for (const auto& [island, checkpoint] : reached_) checkpoints.push_back(checkpoint);
  if (!checkpoints.empty()) unwritten_ += snapshot_record(present_, checkpoints);
  file_.append(unwritten_);
  unwritten_.clear();
  reached_.clear();
  if (file_.size() > std::max(shorten_from_bytes_, kShortenAtGrowth * shortened_bytes_)) shorten();
}

void RunJournal::shorten() {
  file_.replace(journal_of(identity_, read_journal(file_.read()).evolutions));
  shortened_bytes_ = file_.size();
}

}  // namespace demecal::inline scheduling
