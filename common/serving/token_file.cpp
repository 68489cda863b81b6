#include "serving/token_file.hpp"

#include <cstddef>
#include <set>
#include <sstream>
#include <utility>

#include "errors/input_error.hpp"
#include "serving/job_queue.hpp"

namespace demecal::inline serving {
namespace {

constexpr std::size_t kShortestToken = 16, kLongestToken = 128, kMostUsers = 256;
constexpr const char* kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~";

bool is_token(const std::string& text) {
  return text.size() >= kShortestToken && text.size() <= kLongestToken &&
         text.find_first_not_of(kLetters) == std::string::npos;
}

}  // namespace

std::map<std::string, std::string> parse_tokens(const std::string& text, const std::string& file) {
  std::map<std::string, std::string> tokens;
  std::set<std::string> known;
  std::istringstream lines(text);
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line);
    std::string user, token, more;
    words >> user >> token >> more;
    if (user.empty() || user.starts_with('#')) continue;
    const InputError::Where where{file, number};
    if (!is_plain_name(user))
      throw InputError(where, user, "must be a name of up to 64 letters a to z, digits and . _ -");
    if (!is_token(token) || !more.empty())
      throw InputError(where, user, "must be followed by one token of 16 to 128 letters, digits and -._~");
    if (!tokens.emplace(user, token).second) throw InputError(where, user, "stands twice");
    if (!known.insert(token).second) throw InputError(where, user, "has the token of another: each needs its own");
    if (tokens.size() > kMostUsers) throw InputError(where, "", "at most 256 users can be served");
  }
  if (tokens.empty()) throw InputError({file, 0}, "", "names no user: write a line `NAME TOKEN` for each");
  return tokens;
}

}  // namespace demecal::inline serving
