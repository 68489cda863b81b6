#include "report/json.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "errors/input_error.hpp"

namespace demecal::inline report {
namespace {

using Json = nlohmann::ordered_json;

std::string excerpt(const Json& value) {
  constexpr std::size_t kShown = 40;
  const std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() <= kShown ? text : text.substr(0, kShown) + "...";
}

/// Line and column, from 1, of the byte before which reading stopped.
InputError fault_at(std::size_t byte, const std::string& text, const std::string& file) {
  const std::size_t end = std::min(byte == 0 ? 0 : byte - 1, text.size());
  const auto stop = text.begin() + static_cast<std::ptrdiff_t>(end);
  const auto line = static_cast<std::size_t>(std::count(text.begin(), stop, '\n')) + 1;
  const std::size_t line_break = end == 0 ? std::string::npos : text.rfind('\n', end - 1);
  const std::size_t column = line_break == std::string::npos ? end + 1 : end - line_break;
  const char* const rule = end == text.size() ? "ends before its JSON is complete" : "is not JSON from column {}";
  return {{file, line}, "", fmt::format(fmt::runtime(rule), column)};
}

}  // namespace

JsonValue JsonValue::parse(const std::string& text, const std::string& file) {
  try {
    const auto document = std::make_shared<const Json>(Json::parse(text));
    return {document, document.get(), file, ""};
  } catch (const Json::parse_error& fault) {
    throw fault_at(fault.byte, text, file);
  } catch (const Json::out_of_range&) {
    throw InputError({file, 0}, "", "holds a number too large to be read");
  }
}

JsonValue::JsonValue(Document document, const Json* value, std::string file, std::string path)
    : document_(std::move(document)),
      value_(value != nullptr && value->is_null() ? nullptr : value),
      file_(std::move(file)),
      path_(std::move(path)) {}

JsonValue JsonValue::child(const Json* value, const std::string& step) const {
  return {document_, value, file_, path_ + step};
}

void JsonValue::refuse(const std::string& rule) const {
  throw InputError({file_, 0}, exists() ? excerpt(*value_) : "",
                   (path_.empty() ? "the whole document" : path_) + " " + rule);
}

JsonValue JsonValue::operator[](const std::string& key) const {
  const std::string step = (path_.empty() ? "" : ".") + key;
  if (!exists()) return child(nullptr, step);
  if (!value_->is_object()) refuse("must be an object");
  const auto found = value_->find(key);
  return child(found == value_->end() ? nullptr : &*found, step);
}

std::vector<JsonValue> JsonValue::elements() const {
  std::vector<JsonValue> found;
  if (!exists()) return found;
  if (!value_->is_array()) refuse("must be a list");
  for (const Json& element : *value_) found.push_back(child(&element, fmt::format("[{}]", found.size())));
  return found;
}

std::vector<std::pair<std::string, JsonValue>> JsonValue::members() const {
  std::vector<std::pair<std::string, JsonValue>> found;
  if (!exists()) return found;
  if (!value_->is_object()) refuse("must be an object");
  for (const auto& [key, value] : value_->items()) found.emplace_back(key, child(&value, "." + key));
  return found;
}

std::optional<double> JsonValue::number() const {
  if (!exists()) return std::nullopt;
  if (!value_->is_number()) refuse("must be a number");
  return value_->get<double>();
}

std::optional<std::uint64_t> JsonValue::count() const {
  if (!exists()) return std::nullopt;
  if (!value_->is_number_unsigned()) refuse("must be a whole number, not negative");
  return value_->get<std::uint64_t>();
}

std::optional<bool> JsonValue::boolean() const {
  if (!exists()) return std::nullopt;
  if (!value_->is_boolean()) refuse("must be true or false");
  return value_->get<bool>();
}

std::string JsonValue::text() const {
  if (!exists()) return {};
  if (!value_->is_string()) refuse("must be a text");
  return value_->get<std::string>();
}

std::vector<std::string> JsonValue::texts() const {
  std::vector<std::string> found;
  for (const JsonValue& element : elements()) found.push_back(element.text());
  return found;
}

std::vector<double> JsonValue::numbers() const {
  std::vector<double> found;
  for (const JsonValue& element : elements()) {
    if (const auto number = element.number()) found.push_back(*number);
  }
  return found;
}

}  // namespace demecal::inline report
