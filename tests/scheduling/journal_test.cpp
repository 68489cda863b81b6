// A journal gives a run back as far as it was, whatever became of its end, and serves no other job.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>

#include "../config/temporary_folder.hpp"
#include "in_memory_run.hpp"
#include "scheduling/run_journal.hpp"

namespace demecal {
namespace {

using Start = RunJournal::Start;
using ::testing::HasSubstr;

const JobIdentity kIdentity{
    .data_sha256 = "dd", .job_sha256 = "jj", .seed = 3, .version = "0.9", .asynchronous = false};

std::string journal_path(const TemporaryFolder& folder) {
  return (folder.path() / "run.journal").string();
}

/// Records the whole run in the journal, a snapshot after every few messages.
class Recording : public RunObserver {
 public:
  explicit Recording(RunJournal& journal) : journal_(journal) {}
  void on_progress(const Progress& progress) override { journal_.on_progress(progress); }
  void on_checkpoint(const Checkpoint& checkpoint) override {
    journal_.on_checkpoint(checkpoint);
    if (++checkpoints_ % 4 == 0) journal_.finish();
  }
  void on_outcome(const Outcome& outcome) override { journal_.on_outcome(outcome); }

 private:
  RunJournal& journal_;
  int checkpoints_ = 0;
};

RunResult run_recorded(const CalibrationData& data, RunState state, RunJournal& journal) {
  journal.begin(state.data());
  const auto exchange = make_exchange();
  WorkerThread worker(exchange, "worker", 1, kAllCheckpoints);
  const auto transport = join(exchange, Role::coordinator, "coordinator");
  Recording recording(journal);
  const std::atomic<bool> interrupt{false};
  RunResult result = EvolutionRun(*transport, std::move(state), recording).run(interrupt, {});
  journal.finish();
  EXPECT_EQ(result.fronts.size(), islands(data.archipelago).size());
  return result;
}

/// The journal of a whole run, as bytes.
std::string whole_journal(const CalibrationData& data) {
  const TemporaryFolder folder;
  RunJournal journal(folder.path().string(), kIdentity, Start::anew);
  run_recorded(data, RunState(data), journal);
  return read_file(journal_path(folder));
}

TEST(RunJournal, OfAFinishedRunHoldsItsResult) {
  const CalibrationData data = small_run(1);
  const TemporaryFolder folder;
  RunResult result;
  {
    RunJournal journal(folder.path().string(), kIdentity, Start::anew);
    EXPECT_FALSE(journal.recorded(data).has_value());
    result = run_recorded(data, RunState(data), journal);
  }
  const RunJournal journal(folder.path().string(), kIdentity, Start::resume);
  const auto recorded = journal.recorded(data);
  ASSERT_TRUE(recorded.has_value());
  EXPECT_TRUE(recorded->all_finished());
  const RunResult again = recorded->result(RunEnd::finished);
  EXPECT_TRUE(same_fronts(result, again));
  EXPECT_EQ(result.history, again.history);
  EXPECT_EQ(result.evaluations, again.evaluations);
  CalibrationData other = data;
  other.seed = 99;
  EXPECT_FALSE(journal.recorded(other).has_value());
}

TEST(RunJournal, HoldsNothingOfAnEvolutionThatItWasToldToForgetButWhatCameSince) {
  const CalibrationData data = small_run(5);
  const TemporaryFolder folder;
  const auto epochs_recorded = [&] {
    const auto recorded = RunJournal(folder.path().string(), kIdentity, Start::resume).recorded(data);
    return recorded ? recorded->epoch(islands(data.archipelago).front()) : 0;
  };
  {
    RunJournal journal(folder.path().string(), kIdentity, Start::anew);
    run_recorded(data, RunState(data), journal);
  }
  const std::uint32_t whole = epochs_recorded();
  EXPECT_GT(whole, 0U);
  {
    RunJournal journal(folder.path().string(), kIdentity, Start::resume);
    journal.begin(data);
    journal.forget();
  }
  EXPECT_EQ(epochs_recorded(), 0U);
  {
    RunJournal journal(folder.path().string(), kIdentity, Start::resume);
    run_recorded(data, RunState(data), journal);
  }
  EXPECT_EQ(epochs_recorded(), whole);
}

TEST(RunJournal, TornAnywhereIsGoneOnFromWithTheSameResult) {
  const CalibrationData data = small_run(2);
  const RunResult undisturbed = run_in_memory(data, 1);
  const std::string whole = whole_journal(data);
  RandomStream random{7};
  for (int i = 0; i < 12; ++i) {
    const TemporaryFolder folder;
    folder.write("run.journal", whole.substr(0, random.index(whole.size())));
    RunJournal journal(folder.path().string(), kIdentity, Start::resume);
    RunState state = journal.recorded(data).value_or(RunState(data));
    state.rename(5000);
    EXPECT_TRUE(same_fronts(undisturbed, run_recorded(data, std::move(state), journal)));
    EXPECT_EQ(read_journal(read_file(journal_path(folder))).end, JournalEnd::clean);
  }
}

TEST(RunJournal, SavesWork) {
  const CalibrationData data = small_run(3);
  const std::string whole = whole_journal(data);
  std::uint32_t most = 0;
  for (const Checkpoint& one : read_journal(whole.substr(0, whole.size() / 4 * 3)).evolutions.at(0).checkpoints()) {
    most = std::max(most, one.state.epoch);
  }
  EXPECT_GT(most, 1U);
}

TEST(RunJournal, RefusesAnotherJobAndSaysWhatDiffers) {
  const TemporaryFolder folder;
  { const RunJournal journal(folder.path().string(), kIdentity, Start::anew); }
  const auto complaint_of = [&](const JobIdentity& present) {
    return complaint([&] { RunJournal(folder.path().string(), present, Start::resume); });
  };
  EXPECT_EQ(complaint_of(kIdentity), "");
  JobIdentity present = kIdentity;
  present.data_sha256 = "other";
  EXPECT_THAT(complaint_of(present), HasSubstr("the poses, the data set or the robot have changed"));
  present = kIdentity;
  present.job_sha256 = "other";
  EXPECT_THAT(complaint_of(present), HasSubstr("the job"));
  present = kIdentity;
  present.seed = 4;
  EXPECT_THAT(complaint_of(present), HasSubstr("its seed is 3, not 4"));
  present = kIdentity;
  present.version = "1.0";
  EXPECT_THAT(complaint_of(present), HasSubstr("demecal 0.9, and this is 1.0"));
  present = kIdentity;
  present.asynchronous = true;
  EXPECT_THAT(complaint_of(present), HasSubstr("of a synchronous run"));
}

TEST(RunJournal, OfAnotherFileOrNoneBeginsAtTheStart) {
  for (const std::string before : {"", "demecal journal 5\n", "demecal jou", "something else\n"}) {
    const TemporaryFolder folder;
    folder.write("run.journal", before);
    const RunJournal journal(folder.path().string(), kIdentity, Start::resume);
    EXPECT_THAT(journal.found(), HasSubstr("begins at its start"));
    EXPECT_EQ(read_journal(read_file(journal_path(folder))).identity, kIdentity);
  }
}

TEST(RunJournal, IsWrittenAnewWhenMostOfItIsOutOfDate) {
  CalibrationData data = small_run(4);
  data.parameters.number_generations = 60;
  data.archipelago.migration_interval = 1;
  const TemporaryFolder folder;
  RunResult result;
  {
    RunJournal journal(folder.path().string(), kIdentity, Start::anew, 10000);
    result = run_recorded(data, RunState(data), journal);
  }
  EXPECT_LT(read_file(journal_path(folder)).size(), whole_journal(data).size() / 2);
  const RunJournal journal(folder.path().string(), kIdentity, Start::resume);
  const RunResult again = journal.recorded(data).value().result(RunEnd::finished);
  EXPECT_TRUE(same_fronts(result, again));
  EXPECT_EQ(result.history, again.history);
}

TEST(JournalFile, IsHeldByOne) {
  const TemporaryFolder folder;
  const JournalFile held(journal_path(folder));
  EXPECT_THAT(complaint([&] { JournalFile again(journal_path(folder)); }), HasSubstr("another demecal"));
}

/// No file may grow beyond `bytes` while this lives, as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST(JournalFile, OnAFullDiskFailsWithASentenceAndLosesNothingOfWhatWasWritten) {
  const TemporaryFolder folder;
  JournalFile file(journal_path(folder));
  file.append("what was written");
  std::string sentence;
  {
    const FullDisk full(100);
    try {
      file.append(std::string(200, 'x'));
    } catch (const std::runtime_error& error) {
      sentence = error.what();
    }
    EXPECT_THROW(file.replace(std::string(200, 'x')), std::runtime_error);
  }
  EXPECT_THAT(sentence, HasSubstr("run.journal: the journal cannot be written: File too large"));
  EXPECT_EQ(read_file(journal_path(folder)), "what was written");
  file.append(", and more");
  EXPECT_EQ(file.read(), "what was written, and more");
}

TEST(JournalFile, IsReplacedAtOnceAndStaysHeld) {
  const TemporaryFolder folder;
  JournalFile file(journal_path(folder));
  file.append("long and out of date");
  file.replace("short");
  file.append(" and sweet");
  EXPECT_EQ(read_file(journal_path(folder)), "short and sweet");
  EXPECT_EQ(file.size(), 15U);
  EXPECT_THROW(JournalFile(journal_path(folder)), InputError);
  file.remove();
  EXPECT_FALSE(std::filesystem::exists(journal_path(folder)));
}

}  // namespace
}  // namespace demecal
