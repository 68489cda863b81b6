// Served jobs where files cannot be read or written: one job's trouble is told to its user, and ends nothing else.
#include "coordinator/jobs/job_service.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "errors/input_error.hpp"
#include "failing_files.hpp"

namespace demecal {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Listed = nlohmann::json;

class ServedJobs : public ::testing::Test {
 protected:
  ServedJobs() {
    char name[] = "/tmp/demecal-served-XXXXXX";
    if (::mkdtemp(name) == nullptr) throw std::runtime_error("no scratch folder");
    root_ = name;
  }
  ~ServedJobs() override { fs::remove_all(root_); }

  /// A service whose runs are of a program that ends well at once.
  JobServiceOptions options() const {
    JobServiceOptions options;
    options.folder = root_.string();
    options.program = "/bin/true";
    return options;
  }
  fs::path job(const std::string& name) const { return root_ / "ann" / name; }
  /// As a run does.
  void leave_results(const std::string& name, const std::vector<std::string>& files) const {
    fs::create_directories(job(name) / "results");
    for (const std::string& file : files) std::ofstream(job(name) / "results" / file) << file;
  }
  /// From now on job.json cannot be written: where it is made, there is a folder.
  void break_record(const std::string& name) const { fs::create_directory(job(name) / ".being-written"); }
  void mend_record(const std::string& name) const { fs::remove(job(name) / ".being-written"); }

  static ServiceAnswer post(JobService& service, const std::vector<std::string>& path, const std::string& body = "") {
    return service.answer({.user = "ann", .changes = true, .path = path, .parameters = {}, .body = body});
  }
  static void make_job(JobService& service, const std::string& name) {
    ASSERT_EQ(post(service, {"jobs", name, "make"}).status, 200);
    ASSERT_EQ(post(service, {"jobs", name, "files", "job.yaml"}, "demecal_job: 1\n").status, 200);
  }
  static Listed jobs(JobService& service) {
    const ServiceAnswer answer =
        service.answer({.user = "ann", .changes = false, .path = {"jobs"}, .parameters = {}, .body = ""});
    return Listed::parse(answer.body)["jobs"];
  }
  static std::string state(JobService& service, const std::string& name) {
    for (const Listed& one : jobs(service)) {
      if (one["name"] == name) return one["state"];
    }
    return "missing";
  }
  /// Whether the job comes to that state.
  static bool becomes(JobService& service, const std::string& name, const std::string& wanted) {
    for (int i = 0; i < 500 && state(service, name) != wanted; ++i) {
      service.tick();
      ::usleep(10'000);
    }
    return state(service, name) == wanted;
  }

  fs::path root_;
};

TEST_F(ServedJobs, WaitOnlyWhereThatIsSaved) {
  JobService service(options());
  make_job(service, "first");
  make_job(service, "second");
  break_record("first");
  const ServiceAnswer refused = post(service, {"jobs", "first", "run"});
  EXPECT_EQ(refused.status, 500);
  EXPECT_THAT(refused.body, HasSubstr("ann/first/job.json"));
  EXPECT_EQ(state(service, "first"), "ready");
  EXPECT_NO_THROW(service.tick());
  EXPECT_EQ(post(service, {"jobs", "second", "run"}).status, 200);
  EXPECT_TRUE(becomes(service, "second", "done"));
  mend_record("first");
  EXPECT_EQ(post(service, {"jobs", "first", "run"}).status, 200);
  EXPECT_TRUE(becomes(service, "first", "done"));
}

TEST_F(ServedJobs, EndNoOtherWhereTheirRecordsCannotBeWritten) {
  JobService service(options());
  make_job(service, "first");
  make_job(service, "second");
  EXPECT_EQ(post(service, {"jobs", "first", "run"}).status, 200);
  EXPECT_EQ(post(service, {"jobs", "second", "run"}).status, 200);
  break_record("first");
  ::testing::internal::CaptureStderr();
  EXPECT_NO_THROW(service.tick());
  EXPECT_TRUE(becomes(service, "second", "done"));
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(state(service, "first"), "failed");
  EXPECT_THAT(said, HasSubstr("ann/first/job.json"));
  EXPECT_EQ(said.find("job.json"), said.rfind("job.json")) << said;
}

TEST_F(ServedJobs, AreStoppedWhereThatCannotBeSaved) {
  JobService service(options());
  make_job(service, "first");
  EXPECT_EQ(post(service, {"jobs", "first", "run"}).status, 200);
  break_record("first");
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(post(service, {"jobs", "first", "stop"}).status, 200);
  EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("ann/first/job.json"));
  EXPECT_EQ(state(service, "first"), "ready");
}

TEST_F(ServedJobs, AreNotThereWhereTheyCouldNotBeMade) {
  JobService service(options());
  make_job(service, "first");
  fs::create_directories(job("second"));
  break_record("second");
  EXPECT_EQ(post(service, {"jobs", "second", "make"}).status, 500);
  EXPECT_EQ(state(service, "second"), "missing");
  mend_record("second");
  EXPECT_EQ(post(service, {"jobs", "second", "make"}).status, 200);
}

TEST_F(ServedJobs, KeepTheirStateWhereAnUploadCannotBeSaved) {
  JobService service(options());
  make_job(service, "first");
  EXPECT_EQ(post(service, {"jobs", "first", "run"}).status, 200);
  EXPECT_TRUE(becomes(service, "first", "done"));
  break_record("first");
  EXPECT_EQ(post(service, {"jobs", "first", "files", "job.yaml"}, "demecal_job: 1\n").status, 500);
  EXPECT_EQ(state(service, "first"), "done");
}

TEST_F(ServedJobs, OfferNothingOfAnEarlierRun) {
  JobServiceOptions of_run = options();
  for (const char* const program : {"/bin/true", "/bin/false"}) {
    of_run.program = program;
    JobService service(of_run);
    if (program == std::string("/bin/true")) make_job(service, "first");
    leave_results("first", {"certificate.html", "certificate.pdf", "certificate.xml", "model.yaml", "notes.txt"});
    EXPECT_EQ(jobs(service)[0]["results"].size(), 4U);
    EXPECT_EQ(post(service, {"jobs", "first", "run"}).status, 200);
    EXPECT_TRUE(becomes(service, "first", program == std::string("/bin/true") ? "done" : "failed"));
    EXPECT_TRUE(jobs(service)[0]["results"].empty()) << jobs(service)[0];
    EXPECT_TRUE(fs::exists(job("first") / "results/notes.txt"));
  }
}

TEST_F(ServedJobs, KeepWhatARunReachedThatGoesOnButItsCertificate) {
  {
    JobService(options()).answer(
        {.user = "ann", .changes = true, .path = {"jobs", "first", "make"}, .parameters = {}, .body = {}});
  }
  leave_results("first", {"certificate.pdf", "model.yaml", "events.jsonl", "run.journal"});
  std::ofstream(job("first") / "input/job.yaml") << "demecal_job: 1\n";
  std::ofstream(job("first") / "job.json") << record_text({.state = JobState::interrupted, .exit_code = 130});
  JobService service(options());
  ASSERT_EQ(jobs(service)[0]["goes_on"], true);
  EXPECT_EQ(post(service, {"jobs", "first", "run"}).status, 200);
  EXPECT_TRUE(becomes(service, "first", "done"));
  EXPECT_EQ(jobs(service)[0]["results"].size(), 2U) << jobs(service)[0];
}

TEST_F(ServedJobs, AreOfOneServerAtATime) {
  {
    JobService service(options());
    make_job(service, "first");
    EXPECT_THROW(JobService other(options()), InputError);
    EXPECT_EQ(state(service, "first"), "ready");
  }
  JobService next(options());
  EXPECT_EQ(state(next, "first"), "ready");
}

TEST_F(ServedJobs, LoseAnUploadedFileThatIsRemoved) {
  JobService service(options());
  make_job(service, "first");
  const std::vector<std::string> remove{"jobs", "first", "files", "job3.yaml", "remove"};
  EXPECT_EQ(post(service, remove).status, 404);
  EXPECT_EQ(post(service, {"jobs", "first", "files", "job3.yaml"}, "demecal_job: 1\n").status, 200);
  const ServiceAnswer refused = post(service, {"jobs", "first", "run"});
  EXPECT_EQ(refused.status, 422);
  EXPECT_THAT(refused.body, HasSubstr("job3.yaml"));
  for (const char* const name : {"..", "../job.json", ".being-written", ""})
    EXPECT_EQ(post(service, {"jobs", "first", "files", name, "remove"}).status, 404) << name;
  EXPECT_EQ(service.answer({.user = "bob", .changes = true, .path = remove, .parameters = {}, .body = ""}).status, 404);
  EXPECT_EQ(post(service, remove).status, 200);
  EXPECT_EQ(jobs(service)[0]["files"].size(), 1U);
  EXPECT_EQ(post(service, {"jobs", "first", "run"}).status, 200);
  EXPECT_EQ(post(service, {"jobs", "first", "files", "job.yaml", "remove"}).status, 409);  // it waits
  ASSERT_TRUE(becomes(service, "first", "done"));
  // A full disk is no reason to keep a file.
  break_record("first");
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(post(service, {"jobs", "first", "files", "job.yaml", "remove"}).status, 200);
  EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("ann/first/job.json"));
  EXPECT_EQ(state(service, "first"), "ready");
  EXPECT_TRUE(jobs(service)[0]["files"].empty());
}

TEST_F(ServedJobs, AreLeftOutWhereTheirRecordsCannotBeRead) {
  {
    JobService service(options());
    make_job(service, "first");
  }
  {
    const FailingFiles failing;
    ::testing::internal::CaptureStderr();
    JobService service(options());
    EXPECT_THAT(::testing::internal::GetCapturedStderr(), HasSubstr("ann/first/job.json"));
    EXPECT_THAT(jobs(service), IsEmpty());
  }
  ::testing::internal::CaptureStderr();
  JobService service(options());
  EXPECT_EQ(state(service, "first"), "ready");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace demecal
