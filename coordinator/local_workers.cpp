#include "coordinator/local_workers.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <thread>

namespace demecal {
namespace {

constexpr std::chrono::milliseconds kGrace{2000};
constexpr std::chrono::milliseconds kPoll{5};

/// In the child: becomes the worker, or ends with 127.
[[noreturn]] void become(const std::string& path, std::vector<char*>& arguments, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);       // not even a worker that hangs or is stopped may outlive its coordinator
  if (::getppid() != parent) ::_exit(127);  // the coordinator died before prctl
  const int nowhere = ::open("/dev/null", O_RDWR);
  ::dup2(nowhere, STDIN_FILENO);
  ::dup2(nowhere, STDOUT_FILENO);
  ::execv(path.c_str(), arguments.data());
  ::_exit(127);
}

pid_t start(const std::string& path, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{path};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error(std::string("cannot start a worker: ") + std::strerror(errno));
  if (child == 0) become(path, pointers, parent);
  return child;
}

}  // namespace

LocalWorkers::LocalWorkers(const std::string& path, const std::vector<std::string>& arguments, int count) {
  if (count > 0 && ::access(path.c_str(), X_OK) != 0)
    throw std::runtime_error("cannot start a worker: no program " + path);
  for (int i = 0; i < count; ++i) processes_.push_back(start(path, arguments));
}

LocalWorkers::~LocalWorkers() {
  for (const pid_t process : processes_) ::kill(process, SIGTERM);
  const auto deadline = std::chrono::steady_clock::now() + kGrace;
  while (any_alive() && std::chrono::steady_clock::now() < deadline) std::this_thread::sleep_for(kPoll);
  for (const pid_t process : processes_) {
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
  }
}

bool LocalWorkers::any_alive() {
  std::erase_if(processes_, [](pid_t process) { return ::waitpid(process, nullptr, WNOHANG) != 0; });
  return !processes_.empty();
}

std::string beside_this_program(const std::string& name) {
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / name).string();
}

}  // namespace demecal
