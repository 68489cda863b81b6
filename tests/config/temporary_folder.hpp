// A folder that lives as long as a test, and files in it.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

#include "../errors/complaint.hpp"
#include "errors/check.hpp"
#include "yaml/files.hpp"

namespace demecal {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "demecal-test-XXXXXX").string();
    DEMECAL_CHECK(mkdtemp(name.data()) != nullptr, "name=" << name);
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    write_file(path_ / name, text);
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace demecal
