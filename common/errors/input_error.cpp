#include "errors/input_error.hpp"

namespace demecal::inline errors {
namespace {

std::string sentence(const InputError::Where& where, const std::string& value, const std::string& rule) {
  std::string text = where.file;
  if (where.line > 0) text += (text.empty() ? "line " : ":") + std::to_string(where.line);
  if (!text.empty()) text += ": ";
  if (!value.empty()) text += "'" + value + "': ";
  return text + rule;
}

}  // namespace

InputError::InputError(Where where, const std::string& value, const std::string& rule)
    : std::runtime_error(sentence(where, value, rule)), where_(std::move(where)), value_(value), rule_(rule) {}

}  // namespace demecal::inline errors
