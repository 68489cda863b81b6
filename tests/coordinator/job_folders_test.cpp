// The folder of served jobs: what is put there comes back, and no symbolic link, pipe or other file leads out of it.
#include "coordinator/jobs/job_folders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "errors/input_error.hpp"
#include "failing_files.hpp"

namespace demecal {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

const JobId kJob{"ann", "first"};

class JobFolder : public ::testing::Test {
 protected:
  JobFolder() {
    char name[] = "/tmp/demecal-jobs-XXXXXX";
    if (::mkdtemp(name) == nullptr) throw std::runtime_error("no scratch folder");
    root_ = name;
    outside_ = root_ / "outside";
    fs::create_directories(outside_);
    std::ofstream(outside_ / "secret") << "secret";
  }
  ~JobFolder() override { fs::remove_all(root_); }

  std::string jobs() const { return (root_ / "jobs").string(); }
  fs::path job() const { return root_ / "jobs/ann/first"; }

  fs::path root_, outside_;
};

TEST_F(JobFolder, GivesBackWhatWasPutThere) {
  const JobFolders folders(jobs());
  EXPECT_TRUE(folders.jobs().empty());
  folders.make(kJob);
  folders.make({"bob", "x"});
  EXPECT_THAT(folders.jobs(), ElementsAre(kJob, JobId{"bob", "x"}));
  const std::string bytes("1,2\0\n3", 6);
  folders.put_input(kJob, "b.csv", "old and longer than the next");
  folders.put_input(kJob, "b.csv", bytes);
  folders.put_input(kJob, "a.yaml", "");
  ASSERT_EQ(folders.inputs(kJob).size(), 2U);
  EXPECT_EQ(folders.inputs(kJob)[0].name, "a.yaml");
  EXPECT_EQ(folders.inputs(kJob)[1].bytes, 6U);
  EXPECT_EQ(folders.input(kJob, "b.csv"), bytes);
  folders.save(kJob, {JobState::failed, 12, 5, 6});
  EXPECT_EQ(JobFolders(jobs()).record(kJob).exit_code, 12);
  EXPECT_EQ(folders.record({"bob", "x"}).state, JobState::ready);
  EXPECT_EQ(fs::status(job()).permissions(), fs::perms::owner_all);
  folders.remove(kJob);
  EXPECT_THAT(folders.jobs(), ElementsAre(JobId{"bob", "x"}));
  EXPECT_THROW(folders.inputs(kJob), std::system_error);
}

TEST_F(JobFolder, OffersResultsThatItKnowsAndTheEndOfWhatWasSaid) {
  const JobFolders folders(jobs());
  folders.make(kJob);
  EXPECT_TRUE(folders.results(kJob).empty());
  fs::create_directory(job() / "results");
  for (const char* const name : {"model.yaml", "report.html", "run.journal", ".demecal-files", "other.txt"})
    std::ofstream(job() / "results" / name) << name;
  ASSERT_EQ(folders.results(kJob).size(), 2U);
  EXPECT_EQ(folders.results(kJob)[0].name, "report.html");
  EXPECT_EQ(folders.result(kJob, "model.yaml", 100), "model.yaml");
  EXPECT_EQ(folders.result(kJob, "model.yaml", 5), std::nullopt);
  for (const char* const name : {"run.journal", "other.txt", "../job.json", "report.json", ""})
    EXPECT_EQ(folders.open_result(kJob, name), nullptr) << name;
  EXPECT_TRUE(folders.can_go_on(kJob));
  EXPECT_EQ(folders.terminal(kJob, 100), "");
  std::ofstream(job() / "terminal.log") << "0123456789";
  EXPECT_EQ(folders.terminal(kJob, 4), "6789");
  { const OwnedDescriptor kept = folders.open_terminal(kJob, true); }
  EXPECT_EQ(folders.terminal(kJob, 100), "0123456789");
  { const OwnedDescriptor emptied = folders.open_terminal(kJob, false); }
  EXPECT_EQ(folders.terminal(kJob, 100), "");
}

TEST_F(JobFolder, IsNotLeftByLinks) {
  const JobFolders folders(jobs());
  folders.make(kJob);
  // Of a file, of the folder of results, of a job and of a user.
  fs::create_symlink(outside_ / "secret", job() / "input/link.csv");
  EXPECT_TRUE(folders.inputs(kJob).empty());
  EXPECT_THROW(folders.input(kJob, "link.csv"), std::system_error);
  fs::create_symlink(outside_ / "secret", job() / "terminal.log");
  EXPECT_EQ(folders.terminal(kJob, 100), "");
  EXPECT_THROW(folders.open_terminal(kJob, false), std::system_error);
  fs::create_symlink(outside_ / "secret", job() / "input/.being-written");
  EXPECT_THROW(folders.put_input(kJob, "x.csv", "overwritten"), std::system_error);
  fs::create_symlink(outside_, job() / "results");
  std::ofstream(outside_ / "model.yaml") << "secret";
  EXPECT_TRUE(folders.results(kJob).empty());
  EXPECT_EQ(folders.open_result(kJob, "model.yaml"), nullptr);
  fs::create_directory_symlink(outside_, root_ / "jobs/ann/linked");
  fs::create_directories(outside_ / "input");
  EXPECT_THROW(folders.put_input({"ann", "linked"}, "x.csv", "x"), std::system_error);
  EXPECT_THROW(folders.remove({"ann", "linked"}), std::system_error);
  fs::create_directory_symlink(outside_, root_ / "jobs/eve");
  EXPECT_THROW(folders.make({"eve", "job"}), std::system_error);
  EXPECT_THAT(folders.jobs(), ElementsAre(kJob));
  std::ifstream secret(outside_ / "secret");
  std::string text;
  secret >> text;
  EXPECT_EQ(text, "secret");
}

TEST_F(JobFolder, WaitsForNoPipe) {
  const JobFolders folders(jobs());
  folders.make(kJob);
  ASSERT_EQ(::mkfifo((job() / "input/pipe.csv").c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo((job() / "job.json").c_str(), 0600), 0);
  EXPECT_TRUE(folders.inputs(kJob).empty());
  EXPECT_EQ(folders.record(kJob).state, JobState::ready);
}

/// The error of what is tried; 0 where there is none.
template <typename Try>
int error_of(const Try& try_it) {
  errno = 0;  // as it is where the last call of the system went well
  try {
    try_it();
  } catch (const std::system_error& error) {
    return error.code().value() == 0 ? -1 : error.code().value();
  }
  return 0;
}

TEST_F(JobFolder, SaysWhyAFileCannotBeReadOrWritten) {
  const JobFolders folders(jobs());
  folders.make(kJob);
  ASSERT_EQ(::mkfifo((job() / "input/pipe.csv").c_str(), 0600), 0);
  EXPECT_EQ(error_of([&] { folders.input(kJob, "pipe.csv"); }), EINVAL);
  EXPECT_EQ(error_of([&] { folders.input(kJob, "missing.csv"); }), ENOENT);
  EXPECT_EQ(error_of([&] { folders.put_input(kJob, "a.csv", "1,2"); }), 0);
  const FailingFiles failing;
  EXPECT_EQ(error_of([&] { folders.input(kJob, "a.csv"); }), EIO);
  EXPECT_EQ(error_of([&] { folders.put_input(kJob, "b.csv", "1,2"); }), EIO);
}

TEST_F(JobFolder, KeepsNothingOfWhatWasNotWrittenWhole) {
  const JobFolders folders(jobs());
  folders.make(kJob);
  folders.put_input(kJob, "a.csv", "before");
  {
    const FailingFiles failing;
    EXPECT_EQ(error_of([&] { folders.put_input(kJob, "a.csv", "1,2"); }), EIO);
  }
  EXPECT_FALSE(fs::exists(job() / "input/.being-written")) << "it would fill a disk that is full";
  EXPECT_EQ(folders.input(kJob, "a.csv"), "before");
  std::ofstream(job() / "input/.being-written") << "half";
  std::ofstream(job() / ".being-written") << "half";
  folders.remove_unfinished(kJob);
  EXPECT_FALSE(fs::exists(job() / "input/.being-written") || fs::exists(job() / ".being-written"));
  EXPECT_EQ(folders.input(kJob, "a.csv"), "before");
}

TEST_F(JobFolder, MustBeAFolder) {
  EXPECT_THROW(JobFolders((outside_ / "secret").string()), InputError);
  EXPECT_THROW(JobFolders((outside_ / "secret/below").string()), InputError);
}

}  // namespace
}  // namespace demecal
