// The files of the pages, which CMake takes from common/http/page and common/http/jobs_page into the program.
#pragma once

#include <string_view>
#include <vector>

namespace demecal::inline http {

struct PageFile {
  const char* path;
  const char* type;
  std::string_view text;
};

/// Of the live page.
const std::vector<PageFile>& page_files();
/// Of the page of jobs.
const std::vector<PageFile>& jobs_page_files();

}  // namespace demecal::inline http
