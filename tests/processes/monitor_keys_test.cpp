// Keys of a monitor at a terminal: q leaves it, ? explains its columns, and the terminal is given back however it ends.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include "program.hpp"

namespace demecal {
namespace {

using Patience = std::chrono::seconds;

/// A monitor of a domain where nobody is, at a terminal of its own.
class MonitorAtTerminal {
 public:
  explicit MonitorAtTerminal(int which, bool reads_terminal = true) {
    const std::string domain = private_domain(which), path = std::string(DEMECAL_BINARY_DIR) + "/bin/demecal";
    near_ = ::posix_openpt(O_RDWR | O_NOCTTY);
    ::grantpt(near_);
    ::unlockpt(near_);
    const std::string name = ::ptsname(near_);
    far_ = ::open(name.c_str(), O_RDWR | O_NOCTTY);
    winsize size{};
    size.ws_col = 100;
    size.ws_row = 30;
    ::ioctl(far_, TIOCSWINSZ, &size);
    ::fcntl(near_, F_SETFL, O_NONBLOCK);
    process_ = ::fork();
    if (process_ != 0) return;
    ::setsid();
    const int terminal = ::open(name.c_str(), O_RDWR);  // the session's own
    ::dup2(reads_terminal ? terminal : ::open("/dev/null", O_RDONLY), STDIN_FILENO);
    ::dup2(terminal, STDOUT_FILENO);
    ::dup2(terminal, STDERR_FILENO);
    ::execl(path.c_str(), path.c_str(), "monitor", "--domain", domain.c_str(), nullptr);
    ::_exit(127);
  }
  ~MonitorAtTerminal() {
    if (!ended_) {
      ::kill(process_, SIGKILL);
      ::waitpid(process_, nullptr, 0);
    }
    ::close(near_);
    ::close(far_);
  }
  MonitorAtTerminal(const MonitorAtTerminal&) = delete;
  MonitorAtTerminal& operator=(const MonitorAtTerminal&) = delete;

  void press(char key) { ASSERT_EQ(::write(near_, &key, 1), 1); }
  void signal(int number) const { ::kill(process_, number); }

  /// Whether the terminal is shown the text; what came before is forgotten then.
  bool shows(const std::string& text, Patience patience = Patience(20)) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < end) {
      take();
      if (const std::size_t at = shown_.find(text); at != std::string::npos) {
        shown_.erase(0, at + text.size());
        return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
  }

  /// As the shell sees it; -1 where it has not ended after that time.
  int exit_code(Patience patience = Patience(20)) {
    const auto end = std::chrono::steady_clock::now() + patience;
    int status = 0;
    while (::waitpid(process_, &status, WNOHANG) != process_) {
      take();
      if (std::chrono::steady_clock::now() > end) return -1;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    ended_ = true;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  /// Whether the terminal takes whole lines and shows what is typed, as shells leave it.
  bool is_given_back() const {
    termios mode{};
    return ::tcgetattr(far_, &mode) == 0 && (mode.c_lflag & ICANON) != 0 && (mode.c_lflag & ECHO) != 0;
  }

 private:
  void take() {
    char bytes[4096];
    for (ssize_t count = ::read(near_, bytes, sizeof bytes); count > 0; count = ::read(near_, bytes, sizeof bytes))
      shown_.append(bytes, static_cast<std::size_t>(count));
  }

  int near_ = -1, far_ = -1;
  pid_t process_ = -1;
  bool ended_ = false;
  std::string shown_;
};

constexpr const char* kOffer = "?: what the columns mean";

TEST(MonitorKeys, ExplainTheColumnsAndLeave) {
  MonitorAtTerminal monitor(150);
  ASSERT_TRUE(monitor.shows(kOffer));
  EXPECT_FALSE(monitor.is_given_back());
  monitor.press('?');
  EXPECT_TRUE(monitor.shows("gen: generations bred"));
  EXPECT_TRUE(monitor.shows("?: hide what the columns mean"));
  monitor.press('?');
  EXPECT_TRUE(monitor.shows(kOffer));
  monitor.press('x');
  EXPECT_TRUE(monitor.shows(kOffer)) << "any other key does nothing";
  monitor.press('q');
  EXPECT_EQ(monitor.exit_code(), 0);
  EXPECT_TRUE(monitor.is_given_back());
}

TEST(MonitorKeys, LeaveTheTerminalAsItWasHoweverTheMonitorEnds) {
  MonitorAtTerminal interrupted(151);
  ASSERT_TRUE(interrupted.shows(kOffer));
  interrupted.press('\x03');
  EXPECT_EQ(interrupted.exit_code(), 0);
  EXPECT_TRUE(interrupted.is_given_back());
  for (const int number : {SIGTERM, SIGHUP, SIGQUIT, SIGABRT}) {
    MonitorAtTerminal ended(151);
    ASSERT_TRUE(ended.shows(kOffer));
    ended.signal(number);
    EXPECT_EQ(ended.exit_code(), number == SIGTERM ? 0 : 128 + number);
    EXPECT_TRUE(ended.is_given_back()) << number;
  }
}

TEST(MonitorKeys, AreNotReadWhereStandardInputIsNoTerminal) {
  MonitorAtTerminal monitor(152, false);
  ASSERT_TRUE(monitor.shows("nobody is calibrating"));
  EXPECT_TRUE(monitor.is_given_back());
  EXPECT_FALSE(monitor.shows(kOffer, Patience(2)));
  monitor.press('\x03');
  EXPECT_EQ(monitor.exit_code(), 0);
}

}  // namespace
}  // namespace demecal
