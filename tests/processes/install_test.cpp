// What `cmake --install` puts in place: a program outside the tree builds against it and calibrates with it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

const std::string kSource = DEMECAL_SOURCE_DIR, kBuild = DEMECAL_BINARY_DIR;

Ended patiently(const std::string& program, const std::vector<std::string>& arguments) {
  return StartedProgram(program, arguments).wait(std::chrono::seconds(400));
}

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
        "share/zsh/site-functions/_demecal", "share/fish/vendor_completions.d/demecal.fish",
        "share/demecal/jobs/demo.yaml", "share/demecal/data/puma761-demo/dataset.yaml",
        "share/demecal/idl/calibration.idl", "share/demecal/scripts/security", "share/doc/demecal/README.md",
        "share/doc/demecal/docs/GUIDE.md", "share/doc/demecal/configs/dds/README.md",
        "lib/systemd/system/demecal-worker.service", "include/demecal/demecal.hpp"}) {
    EXPECT_TRUE(std::filesystem::exists(prefix() + "/" + file)) << file;
  }
}

TEST_F(Installed, HasAPageForEveryCommand) {
  const std::string pages = prefix() + "/share/man/man1/demecal-";
  const Ended missing =
      run("/bin/sh", {"-c", "for command in $(" + prefix() +
                                "/bin/demecal --help | sed '1,/^Subcommands/d' | awk '{print $1}'); do "
                                "test -s " +
                                pages + "$command.1 || echo $command; done"});
  EXPECT_EQ(missing.code, 0) << missing.err;
  EXPECT_EQ(missing.out, "");
}

TEST_F(Installed, CalibratesItsExampleWithoutTheSource) {
  const Ended ended =
      patiently(prefix() + "/bin/demecal", {"calibrate", prefix() + "/share/demecal/jobs/demo.yaml", "--out",
                                            job_.path("result"), "--domain", private_domain(), "--quiet"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("with the effects found"));
}

TEST_F(Installed, LetsAProgramOutsideTheTreeCalibrate) {
  const std::string build = job_.path("consumer");
  const Ended built =
      patiently("/bin/sh", {"-c", "cmake -S " + kSource + "/tests/consumer -B " + build +
                                      " -DCMAKE_PREFIX_PATH=" + prefix() + " && cmake --build " + build});
  ASSERT_EQ(built.code, 0) << built.out << built.err;
  const Ended ended = patiently(build + "/consumer", {job_.data(), job_.path("model.yaml")});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("mm rms on validation poses"));
  const Ended evaluated = run("demecal", {"evaluate", job_.path("model.yaml"), job_.data()});
  EXPECT_EQ(evaluated.code, 0) << evaluated.err;
}

}  // namespace
}  // namespace demecal
