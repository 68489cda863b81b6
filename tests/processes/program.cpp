#include "program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <iterator>
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

[[noreturn]] void become(const std::string& path, std::vector<char*>& arguments, const std::string& out,
                         const std::string& err) {
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(::open(out.c_str(), O_WRONLY), STDOUT_FILENO);
  ::dup2(::open(err.c_str(), O_WRONLY), STDERR_FILENO);
  ::execv(path.c_str(), arguments.data());
  ::_exit(127);
}

}  // namespace

Program::Program(const std::string& name, const std::vector<std::string>& arguments)
    : out_path_(scratch_file()), err_path_(scratch_file()) {
  const std::string path = std::string(DEMECAL_BINARY_DIR) + "/bin/" + name;
  std::vector<std::string> words{path};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  process_ = ::fork();
  if (process_ == 0) become(path, pointers, out_path_, err_path_);
}

Program::~Program() {
  if (!has_ended()) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  std::remove(out_path_.c_str());
  std::remove(err_path_.c_str());
}

void Program::signal(int number) const {
  ::kill(process_, number);
}

bool Program::has_ended() {
  if (!ended_) ended_ = ::waitpid(process_, &status_, WNOHANG) == process_;
  return ended_;
}

Ended Program::wait(std::chrono::seconds patience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!has_ended() && std::chrono::steady_clock::now() < deadline) std::this_thread::sleep_for(kPoll);
  Ended ended{-1, contents(out_path_), contents(err_path_)};
  if (ended_) ended.code = WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
  return ended;
}

std::string Program::err_so_far() const {
  return contents(err_path_);
}

bool Program::wait_for_err(const std::string& text, std::chrono::seconds patience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (std::chrono::steady_clock::now() < deadline) {
    const bool over = has_ended();
    if (err_so_far().find(text) != std::string::npos) return true;
    if (over) return false;
    std::this_thread::sleep_for(kPoll);
  }
  return false;
}

Ended run(const std::string& name, const std::vector<std::string>& arguments) {
  return Program(name, arguments).wait();
}

std::string private_domain() {
  return std::to_string(1 + ::getpid() % 200);
}

}  // namespace demecal
