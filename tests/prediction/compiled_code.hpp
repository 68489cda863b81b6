// A folder for exported code, and what programs made of it print.
#pragma once

#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace demecal {

/// A folder of this test that is gone afterwards.
class CodeFolder {
 public:
  CodeFolder() : path_(std::filesystem::temp_directory_path() / ("demecal-code-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~CodeFolder() { std::filesystem::remove_all(path_); }
  CodeFolder(const CodeFolder&) = delete;
  CodeFolder& operator=(const CodeFolder&) = delete;

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }
  std::string path(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// What the command printed; its exit code in `code`.
inline std::string output_of(const std::string& command, int& code) {
  std::string text;
  FILE* const pipe = ::popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> chunk;
  while (const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), pipe)) text.append(chunk.data(), count);
  code = ::pclose(pipe);
  return text;
}

inline bool there_is(const std::string& program) {
  int code = 0;
  output_of("command -v " + program, code);
  return code == 0;
}

}  // namespace demecal
