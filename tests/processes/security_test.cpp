// Calibrations that show certificates: who has a good one takes part, who has none or another's is refused, and it is
// said.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

class Security : public testing::Test {
 protected:
  /// Makes a folder of certificates with an authority of its own.
  std::string certificates(const std::string& name) {
    const Ended ended = StartedProgram(std::string(DEMECAL_SOURCE_DIR) + "/scripts/security", {job_.path(name)}).wait();
    EXPECT_EQ(ended.code, 0) << ended.err;
    return job_.path(name);
  }
  static std::vector<std::string> with(std::vector<std::string> arguments, const std::string& folder) {
    arguments.insert(arguments.end(), {"--domain", private_domain(300)});
    if (!folder.empty()) arguments.insert(arguments.end(), {"--security", folder});
    return arguments;
  }
  std::vector<std::string> calibrate(const std::string& job, const std::string& out, int workers,
                                     const std::string& folder) const {
    return with({"calibrate", job, "--out", job_.path(out), "--workers", std::to_string(workers), "--max-effects", "0"},
                folder);
  }
  static std::unique_ptr<StartedProgram> worker(const std::string& folder) {
    return std::make_unique<StartedProgram>("demecal-worker", with({}, folder));
  }

  const SmallJob job_;
};

TEST_F(Security, SecuredCalibrationsGiveTheSameModel) {
  const std::string folder = certificates("certificates");
  ASSERT_EQ(run("demecal", calibrate(job_.job(), "open", 2, "")).code, 0);
  const std::string model = job_.text("open/model.yaml");
  ASSERT_FALSE(model.empty());
  ASSERT_EQ(run("demecal", calibrate(job_.job(), "local", 2, folder)).code, 0);
  EXPECT_EQ(job_.text("local/model.yaml"), model);
  const auto one = worker(folder), two = worker(folder), three = worker(folder);
  const Ended ended = run("demecal", calibrate(job_.job(), "apart", 0, folder));
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(job_.text("apart/model.yaml"), model);
}

TEST_F(Security, WorkersWithForeignCertificatesAndWithoutAnyAreRefusedAndNamed) {
  const SmallJob endless(1000000);
  const std::string folder = certificates("certificates"), foreign = certificates("foreign");
  StartedProgram coordinator("demecal", calibrate(endless.job(), "out", 0, folder));
  ASSERT_TRUE(coordinator.wait_for_err("waiting"));
  const auto stranger = worker(foreign), naked = worker("");
  EXPECT_TRUE(coordinator.wait_for_err("-" + std::to_string(naked->process()) + "-"));
  EXPECT_TRUE(coordinator.wait_for_err("is refused: it shows no certificate"));
  EXPECT_TRUE(coordinator.wait_for_err("-" + std::to_string(stranger->process()) + "-"));
  const std::string said = coordinator.err_so_far();
  EXPECT_TRUE(said.find("it has not proved its identity") != std::string::npos ||
              said.find("its certificate is not valid") != std::string::npos)
      << said;
  EXPECT_EQ(said.find("joined"), std::string::npos) << said;
  EXPECT_TRUE(naked->wait_for_err("it demands a certificate, which --security would show"));
  const auto welcome = worker(folder);
  EXPECT_TRUE(coordinator.wait_for_err("joined"));
  EXPECT_TRUE(coordinator.wait_for_err("-" + std::to_string(welcome->process()) + "-"));
  const Ended seen = run("demecal", with({"monitor", "--once", "--json", "--wait", "20"}, folder));
  EXPECT_EQ(seen.code, 0) << seen.err;
  EXPECT_NE(seen.out.find("\"progress\""), std::string::npos) << seen.out;
}

TEST_F(Security, AFolderThatLacksAFileOrHoldsAnothersIsTheUsersErrorAndNamed) {
  const std::string folder = certificates("certificates"), foreign = certificates("foreign");
  for (const std::string file : {"authority.pem", "governance.p7s", "worker.pem", "worker.key", "worker.p7s"}) {
    const std::string path = folder + "/" + file;
    std::filesystem::rename(path, path + ".away");
    const Ended lacking = run("demecal-worker", with({}, folder));
    EXPECT_EQ(lacking.code, 11);
    EXPECT_NE(lacking.err.find(path + ": is missing or unreadable"), std::string::npos) << lacking.err;
    std::filesystem::copy(foreign + "/" + file, path);
    const Ended mixed = run("demecal-worker", with({}, folder));
    EXPECT_EQ(mixed.code, 11) << file;
    EXPECT_NE(mixed.err.find("not accepted"), std::string::npos) << file << ": " << mixed.err;
    std::filesystem::rename(path + ".away", path);
  }
  EXPECT_EQ(run("demecal-worker", with({"--discovery-server", "127.0.0.1:11811"}, folder)).code, 10);
}

}  // namespace
}  // namespace demecal
