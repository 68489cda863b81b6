#include "program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <thread>

namespace demecal {
namespace {

constexpr std::chrono::milliseconds kPoll{5};

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string scratch_file() {
  char name[] = "/tmp/demecal-test-XXXXXX";
  ::close(::mkstemp(name));
  return name;
}

/// Holds the domain until this process ends: tests beside one another claim theirs by locks on files.
bool claim(int domain) {
  const std::string lock = "/tmp/demecal-test-domain-" + std::to_string(domain);
  const int file = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file >= 0 && ::flock(file, LOCK_EX | LOCK_NB) == 0) return true;
  if (file >= 0) ::close(file);
  return false;
}

[[noreturn]] void become(const std::string& path, std::vector<char*>& arguments, pid_t network, const std::string& out,
                         const std::string& err) {
  if (network != 0) {
    const std::string space = "/proc/" + std::to_string(network) + "/ns/net";
    if (::setns(::open(space.c_str(), O_RDONLY | O_CLOEXEC), CLONE_NEWNET) != 0) ::_exit(126);
  }
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(::open(out.c_str(), O_WRONLY), STDOUT_FILENO);
  ::dup2(::open(err.c_str(), O_WRONLY), STDERR_FILENO);
  ::execv(path.c_str(), arguments.data());
  ::_exit(127);
}

}  // namespace

StartedProgram::StartedProgram(const std::string& name, const std::vector<std::string>& arguments, pid_t network)
    : out_path_(scratch_file()), err_path_(scratch_file()) {
  const bool is_path = name.find('/') != std::string::npos;
  const std::string path = is_path ? name : std::string(DEMECAL_BINARY_DIR) + "/bin/" + name;
  std::vector<std::string> words{path};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  [[maybe_unused]] static const int kSet = ::setenv("DEMECAL_DOMAIN", private_domain().c_str(), 0);
  process_ = ::fork();
  if (process_ == 0) become(path, pointers, network, out_path_, err_path_);
}

StartedProgram::~StartedProgram() {
  if (!has_ended()) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  std::remove(out_path_.c_str());
  std::remove(err_path_.c_str());
}

void StartedProgram::signal(int number) const {
  ::kill(process_, number);
}

bool StartedProgram::has_ended() {
  if (!ended_) ended_ = ::waitpid(process_, &status_, WNOHANG) == process_;
  return ended_;
}

bool StartedProgram::ends_within(std::chrono::milliseconds patience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!has_ended() && std::chrono::steady_clock::now() < deadline) std::this_thread::sleep_for(kPoll);
  return ended_;
}

std::vector<pid_t> StartedProgram::children() const {
  const std::string process = std::to_string(process_);
  std::ifstream list("/proc/" + process + "/task/" + process + "/children");
  return {std::istream_iterator<pid_t>(list), {}};
}

Ended StartedProgram::wait(std::chrono::seconds patience) {
  ends_within(patience);
  Ended ended{-1, contents(out_path_), contents(err_path_)};
  if (ended_) ended.code = WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
  return ended;
}

std::string StartedProgram::err_so_far() const {
  return contents(err_path_);
}

std::string StartedProgram::out_so_far() const {
  return contents(out_path_);
}

bool StartedProgram::wait_for_out(const std::string& text, std::chrono::seconds patience) {
  return wait_for(out_path_, text, patience);
}

bool StartedProgram::wait_for_err(const std::string& text, std::chrono::seconds patience) {
  return wait_for(err_path_, text, patience);
}

bool StartedProgram::wait_for(const std::string& path, const std::string& text, std::chrono::seconds patience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (std::chrono::steady_clock::now() < deadline) {
    const bool over = has_ended();
    if (contents(path).find(text) != std::string::npos) return true;
    if (over) return false;
    std::this_thread::sleep_for(kPoll);
  }
  return false;
}

Ended run(const std::string& name, const std::vector<std::string>& arguments) {
  return StartedProgram(name, arguments).wait();
}

std::string private_domain(int which) {
  static std::mutex one_at_a_time;
  static std::map<int, int> claimed;
  const std::lock_guard lock(one_at_a_time);
  if (const auto known = claimed.find(which); known != claimed.end()) return std::to_string(known->second);
  constexpr int kDomains = 200;
  for (int i = 0; i < kDomains; ++i) {
    const int domain = 1 + (::getpid() + 29 * which + i) % kDomains;
    if (!claim(domain)) continue;
    claimed[which] = domain;
    return std::to_string(domain);
  }
  ADD_FAILURE() << "no DDS domain is free";
  return "0";
}

}  // namespace demecal
