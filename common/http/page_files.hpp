// The files of the live page, which CMake takes from common/http/page into the program.
#pragma once

#include <string_view>
#include <vector>

namespace demecal::inline http {

struct PageFile {
  const char* path;
  const char* type;
  std::string_view text;
};

const std::vector<PageFile>& page_files();

}  // namespace demecal::inline http
