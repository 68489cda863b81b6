// Programs that are started: how they ended, and that what nobody knows the end of counts as no success.
#include "coordinator/child_process.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace demecal {
namespace {

namespace fs = std::filesystem;

/// While it lives the system forgets children as they end, as for programs that were started with SIGCHLD ignored.
class ForgottenChildren {
 public:
  ForgottenChildren() : before_(::signal(SIGCHLD, SIG_IGN)) {}
  ~ForgottenChildren() { ::signal(SIGCHLD, before_); }
  ForgottenChildren(const ForgottenChildren&) = delete;
  ForgottenChildren& operator=(const ForgottenChildren&) = delete;

 private:
  void (*before_)(int);
};

class StartedProgram : public ::testing::Test {
 protected:
  StartedProgram() {
    char name[] = "/tmp/demecal-child-XXXXXX";
    if (::mkdtemp(name) == nullptr) throw std::runtime_error("no scratch folder");
    folder_ = name;
  }
  ~StartedProgram() override { fs::remove_all(folder_); }

  /// A printer by the name of one that writes a PDF and ends with this code.
  std::string printer(int exit_code) const {
    const fs::path file = folder_ / "weasyprint";
    std::ofstream(file) << "#!/bin/sh\nprintf %%PDF-1.7 > \"$2\"\nexit " << exit_code << '\n';
    fs::permissions(file, fs::perms::owner_all);
    return file.string();
  }
  std::optional<int> end_of(const std::string& command) const {
    ChildProcess child("/bin/sh", {"-c", command}, folder_.string(), 1);
    for (int i = 0; i < 500 && !child.exit_code(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return child.exit_code();
  }

  fs::path folder_;
};

TEST_F(StartedProgram, TellsHowItEnded) {
  EXPECT_EQ(end_of("exit 0"), 0);
  EXPECT_EQ(end_of("exit 3"), 3);
  EXPECT_EQ(end_of("kill -9 $$"), 128 + 9);
  EXPECT_EQ(printed(printer(0), "page.html"), "%PDF-1.7");
  EXPECT_EQ(printed(printer(3), "page.html"), std::nullopt);
}

TEST_F(StartedProgram, IsNoSuccessWhereNobodyKnowsItsEnd) {
  const ForgottenChildren forgotten;
  EXPECT_EQ(end_of("exit 0"), 127);
  EXPECT_EQ(printed(printer(3), "page.html"), std::nullopt);
}

}  // namespace
}  // namespace demecal
