#include "preparation/marked_names.hpp"

#include <sstream>
#include <string_view>

#include "errors/input_error.hpp"

namespace demecal {
namespace {

/// The length of "#name[i]" that a line begins with and a comma follows; 0 where there is none.
std::size_t marked_name(std::string_view line) {
  const std::size_t comma = line.find(',');
  if (!line.starts_with('#') || comma == std::string_view::npos) return 0;
  const std::string_view name = line.substr(0, comma);
  const bool indexed = name.ends_with(']') && name.find('[') > 1 && name.find_first_of(" \t\"") == name.npos;
  return indexed ? comma : 0;
}

}  // namespace

std::string with_marked_names(const std::string& text, const std::string& file) {
  std::istringstream lines(text);
  std::string quoted;
  std::size_t number = 0, first_marked = 0, plain = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (const std::size_t name = marked_name(line); name > 0) {
      if (first_marked == 0) first_marked = number;
      line.insert(name, "\"").insert(0, "\"");
    } else if (line.find_first_not_of(" \t\r") != std::string::npos && line[0] != '#') {
      ++plain;
    }
    quoted += line + '\n';
  }
  if (first_marked == 0) return text;
  if (plain <= 1) return quoted;  // the header
  throw InputError({file, first_marked}, "",
                   "begins with # as comments do, and other rows do not; leave the # of its name out, or put a space "
                   "after it where a comment is meant");
}

}  // namespace demecal
