#include "coordinator/child_process.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "yaml/files.hpp"

namespace demecal {
namespace {

constexpr rlim_t kLargestFile = rlim_t{1} << 30;
constexpr int kUnknownEnd = 127;

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
  if (exit_code_) return exit_code_;
  const pid_t ended = ::waitpid(process_, &status, WNOHANG);
  if (ended == process_) exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (ended < 0) exit_code_ = kUnknownEnd;
  return exit_code_;
}

namespace {

constexpr std::chrono::seconds kLongestWait{60};
constexpr std::chrono::milliseconds kExitPollInterval{20};

std::vector<std::string> command_line(const std::string& printer, const std::string& page, const std::string& scratch,
                                      const std::string& pdf) {
  if (std::filesystem::path(printer).filename() == "weasyprint") return {printer, page, pdf};
  std::vector<std::string> words{printer,
                                 "--headless",
                                 "--disable-gpu",
                                 "--no-pdf-header-footer",
                                 "--user-data-dir=" + scratch + "/profile",
                                 "--print-to-pdf=" + pdf,
                                 "file://" + page};
  if (::geteuid() == 0) words.insert(words.begin() + 1, "--no-sandbox");  // a browser refuses root otherwise
  return words;
}

}  // namespace

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "demecal-scratch-XXXXXX").string();
  if (::mkdtemp(name.data()) != nullptr) path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

bool runs_well(std::vector<std::string> words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) return false;
  if (child == 0) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
    ::execv(pointers.front(), pointers.data());
    ::_exit(127);
  }
  const auto end = std::chrono::steady_clock::now() + kLongestWait;
  int status = 0;
  pid_t ended = 0;
  while ((ended = ::waitpid(child, &status, WNOHANG)) == 0) {
    if (std::chrono::steady_clock::now() > end) {
      ::kill(-child, SIGKILL);
      ::waitpid(child, &status, 0);
      return false;
    }
    std::this_thread::sleep_for(kExitPollInterval);
  }
  return ended == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::optional<std::string> find_program(const std::vector<std::string>& names) {
  const char* const path = std::getenv("PATH");
  for (const std::string& name : names) {
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
      const std::string file = (folder.empty() ? "." : folder) + "/" + name;
      if (::access(file.c_str(), X_OK) == 0 && !std::filesystem::is_directory(file)) return file;
    }
  }
  return std::nullopt;
}

std::optional<std::string> find_printer() {
  return find_program({"weasyprint", "chromium", "chromium-browser", "google-chrome"});
}

std::optional<std::string> printed(const std::string& printer, const std::string& page_file) {
  const ScratchFolder scratch;
  if (scratch.path().empty()) return std::nullopt;
  const std::string pdf = scratch.path() + "/printed";
  const std::string page = std::filesystem::absolute(page_file).string();
  if (!runs_well(command_line(printer, page, scratch.path(), pdf)) || !std::filesystem::exists(pdf))
    return std::nullopt;
  std::string bytes = read_file(pdf);
  if (!bytes.starts_with("%PDF-")) return std::nullopt;
  return bytes;
}

}  // namespace demecal
