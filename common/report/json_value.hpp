// Reading JSON that may lack keys: every value knows where it stands, and what is of the wrong kind is a user's error.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace demecal {

/// A value of a document, or the place where it is missing; null counts as missing. All functions that return a value
/// of some kind return nothing where it is missing, and throw InputError{file, value, "PATH must be ..."} where it is
/// of another kind.
class JsonValue {
 public:
  /// The whole of `text`. Throws InputError naming file, line and column where it is no JSON.
  static JsonValue parse(const std::string& text, const std::string& file);

  bool exists() const { return value_ != nullptr; }
  /// The member of an object; missing where the object or the key is.
  JsonValue operator[](const std::string& key) const;
  std::vector<JsonValue> elements() const;                         ///< of an array
  std::vector<std::pair<std::string, JsonValue>> members() const;  ///< of an object, in the order of the file
  std::optional<double> number() const;
  std::optional<std::uint64_t> count() const;  ///< a whole number that is not negative
  std::optional<bool> truth() const;
  std::string text() const;                ///< empty where missing
  std::vector<std::string> texts() const;  ///< of an array of texts
  std::vector<double> numbers() const;     ///< of an array of numbers

  /// An error about this value: `rule` goes on from the value's path, as in "must be a number".
  [[noreturn]] void refuse(const std::string& rule) const;

 private:
  using Document = std::shared_ptr<const nlohmann::ordered_json>;
  JsonValue(Document document, const nlohmann::ordered_json* value, std::string file, std::string path);
  JsonValue child(const nlohmann::ordered_json* value, const std::string& step) const;

  Document document_;
  const nlohmann::ordered_json* value_;
  std::string file_;
  std::string path_;
};

}  // namespace demecal
