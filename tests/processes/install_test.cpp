// What `cmake --install` puts in place: a program outside the tree builds against it and calibrates with it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

const std::string kSource = DEMECAL_SOURCE_DIR, kBuild = DEMECAL_BINARY_DIR;

/// The build, installed below a folder of its own.
class Installed : public ::testing::Test {
 protected:
  Installed() {
    const Ended installed = run("/bin/sh", {"-c", "cmake --install " + kBuild + " --prefix " + prefix()});
    EXPECT_EQ(installed.code, 0) << installed.err;
  }

  std::string prefix() const { return job_.path("prefix"); }

  SmallJob job_;
};

TEST_F(Installed, HasProgramsPagesCompletionsConfigurationsAndTheProtocol) {
  for (const std::string file :
       {"bin/demecal", "bin/demecal-worker", "share/man/man1/demecal.1", "share/man/man1/demecal-calibrate.1",
        "share/man/man1/demecal-worker.1", "share/bash-completion/completions/demecal",
        "share/zsh/site-functions/_demecal", "share/demecal/jobs/demo.yaml",
        "share/demecal/data/puma761-demo/dataset.yaml", "share/demecal/idl/calibration.idl",
        "share/demecal/scripts/security", "lib/systemd/system/demecal-worker.service", "include/demecal/demecal.hpp"}) {
    EXPECT_TRUE(std::filesystem::exists(prefix() + "/" + file)) << file;
  }
}

TEST_F(Installed, HasAPageForEveryCommand) {
  const Ended help =
      run("/bin/sh", {"-c", prefix() + "/bin/demecal --completion bash | grep -o 'compgen -W .[a-z ]*'"});
  ASSERT_EQ(help.code, 0) << help.err;
  const Ended missing =
      run("/bin/sh", {"-c", "for command in " + help.out.substr(help.out.find('\'') + 1) + "; do test -s " + prefix() +
                                "/share/man/man1/demecal-$command.1 || echo $command; done"});
  EXPECT_EQ(missing.out, "");
}

TEST_F(Installed, CalibratesItsExampleWithoutTheSource) {
  const Ended ended = run(prefix() + "/bin/demecal", {"calibrate", prefix() + "/share/demecal/jobs/demo.yaml", "--out",
                                                      job_.path("result"), "--domain", private_domain(), "--quiet"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("with the effects found"));
}

TEST_F(Installed, LetsAProgramOutsideTheTreeCalibrate) {
  const std::string build = job_.path("consumer");
  const Ended built = run("/bin/sh", {"-c", "cmake -S " + kSource + "/tests/consumer -B " + build +
                                                " -DCMAKE_PREFIX_PATH=" + prefix() + " && cmake --build " + build});
  ASSERT_EQ(built.code, 0) << built.out << built.err;
  const Ended ended = run(build + "/consumer", {job_.data(), job_.path("model.yaml")});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("mm rms on validation poses"));
  const Ended evaluated = run("demecal", {"evaluate", job_.path("model.yaml"), job_.data()});
  EXPECT_EQ(evaluated.code, 0) << evaluated.err;
}

}  // namespace
}  // namespace demecal
