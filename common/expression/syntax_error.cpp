#include "expression/syntax_error.hpp"

#include "errors/input_error.hpp"

namespace demecal {

void refuse_at(std::string_view text, std::size_t at, const std::string& expected) {
  constexpr std::size_t kShown = 80;
  std::string shown(text.substr(0, kShown));
  if (text.size() > kShown) shown += "...";
  throw InputError({}, shown, "column " + std::to_string(at + 1) + ": expected " + expected);
}

}  // namespace demecal
