// What the servers of this program have in common: where they listen, what every answer carries, and the files of the
// pages, which CMake takes from common/http/page and common/http/jobs_page into the program.
#pragma once

#include <httplib.h>
#include <string>
#include <string_view>
#include <vector>

#include "http/access.hpp"

namespace demecal::inline http {

/// Nothing may be fetched from elsewhere, no page may frame this one, and nothing is kept.
const httplib::Headers& strict_headers();

/// Answers with a sentence and ends the connection.
void refuse(httplib::Response& response, int status, const std::string& why);

/// What this machine calls itself; empty where it has no name.
std::string name_of_machine();

/// Binds the server there, to this port alone, and states which one was chosen. Throws InputError where it cannot.
void bind(httplib::Server& server, Endpoint& endpoint);

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
