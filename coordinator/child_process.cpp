#include "coordinator/child_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

namespace demecal {
namespace {

constexpr rlim_t kLargestFile = rlim_t{1} << 30;

/// In the child: becomes the program, or ends with 127. Only what is safe between fork and exec of a program with
/// threads.
[[noreturn]] void run_in(const char* folder, char* const* words, int said, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGINT);
  ::signal(SIGPIPE, SIG_DFL);
  if (::getppid() != parent || ::chdir(folder) != 0) ::_exit(127);
  const rlimit files{kLargestFile, kLargestFile};
  ::setrlimit(RLIMIT_FSIZE, &files);
  const int nowhere = ::open("/dev/null", O_RDONLY);
  if (::dup2(nowhere, STDIN_FILENO) < 0 || ::dup2(said, STDOUT_FILENO) < 0 || ::dup2(said, STDERR_FILENO) < 0)
    ::_exit(127);
  ::close_range(STDERR_FILENO + 1, ~0U, 0);  // browsers' connections, among others
  ::execv(words[0], words);
  ::_exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::string& path, const std::vector<std::string>& arguments,
                           const std::string& folder, int said) {
  std::vector<std::string> words{path};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ < 0) throw std::runtime_error(std::string("cannot start a run: ") + std::strerror(errno));
  if (process_ == 0) run_in(folder.c_str(), pointers.data(), said, parent);
}

ChildProcess::~ChildProcess() {
  if (exit_code()) return;
  ::kill(-process_, SIGKILL);
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

void ChildProcess::interrupt() {
  if (is_interrupted_ || exit_code()) return;
  is_interrupted_ = ::kill(process_, SIGINT) == 0;
}

std::optional<int> ChildProcess::exit_code() {
  int status = 0;
  if (!exit_code_ && ::waitpid(process_, &status, WNOHANG) == process_)
    exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return exit_code_;
}

}  // namespace demecal
