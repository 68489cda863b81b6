// JSON: values that know where they stand and may be missing, and structs as objects by one list of their fields.
#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace demecal::inline report {

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
  std::optional<bool> boolean() const;
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

// A struct has its list as
//   void fields(auto& visit, Like<Point> auto& point) {
//     visit("x_mm", point.x_mm, "y_mm", point.y_mm);
//     visit.when(!point.name.empty(), "name", point.name);
//     visit.within("size", [&](auto& size) { size("mm", point.size_mm); });
//   }
// beside which json_of() and read_json() may be overloaded for types of another form.

/// `Given` is `Listed`, const or not.
template <class Given, class Listed>
concept Like = std::same_as<std::remove_const_t<Given>, Listed>;

template <class Value>
inline constexpr bool is_optional = false;
template <class Value>
inline constexpr bool is_optional<std::optional<Value>> = true;
template <class Value>
inline constexpr bool is_vector = false;
template <class Value>
inline constexpr bool is_vector<std::vector<Value>> = true;

class JsonWriter;
class JsonReader;

/// Null for what is absent or not finite.
template <class Value>
nlohmann::ordered_json json_of(const Value& value);
/// What is missing or null leaves nothing: an empty text, list or optional, 0, false; as a double no number (NaN).
template <class Value>
void read_json(const JsonValue& json, Value& value);

/// True within a list that is being read.
template <class Visit>
inline constexpr bool kReads = std::is_same_v<Visit, JsonReader>;

/// Sets the keys of an object in the order of the list.
class JsonWriter {
 public:
  explicit JsonWriter(nlohmann::ordered_json& object) : object_(object) {}

  template <class Value, class... Others>
  void operator()(const char* key, const Value& value, const Others&... others) {
    object_[key] = json_of(value);
    if constexpr (sizeof...(others) > 0) (*this)(others...);
  }
  /// The key is there only where `wanted`.
  template <class Value>
  void when(bool wanted, const char* key, const Value& value) {
    if (wanted) (*this)(key, value);
  }
  /// An object of its own, with the fields that `list` visits.
  template <class List>
  void within(const char* key, const List& list) {
    nlohmann::ordered_json inner = nlohmann::ordered_json::object();
    JsonWriter write(inner);
    list(write);
    object_[key] = std::move(inner);
  }

 private:
  nlohmann::ordered_json& object_;
};

class JsonReader {
 public:
  explicit JsonReader(JsonValue object) : object_(std::move(object)) {}

  bool has(const char* key) const { return object_[key].exists(); }

  template <class Value, class... Others>
  void operator()(const char* key, Value&& value, Others&&... others) {
    read_json(object_[key], value);
    if constexpr (sizeof...(others) > 0) (*this)(others...);
  }
  template <class Value>
  void when(bool, const char* key, Value& value) {
    (*this)(key, value);
  }
  template <class List>
  void within(const char* key, const List& list) {
    JsonReader read(object_[key]);
    list(read);
  }

 private:
  JsonValue object_;
};

template <class Value>
nlohmann::ordered_json json_of(const Value& value) {
  if constexpr (std::is_floating_point_v<Value>) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
  } else if constexpr (std::is_arithmetic_v<Value> || std::is_convertible_v<Value, std::string>) {
    return value;
  } else if constexpr (is_optional<Value>) {
    return value ? json_of(*value) : nlohmann::ordered_json(nullptr);
  } else if constexpr (is_vector<Value>) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const auto& element : value) list.push_back(json_of(element));
    return list;
  } else {
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    JsonWriter write(object);
    fields(write, value);
    return object;
  }
}

template <class Value>
void read_json(const JsonValue& json, Value& value) {
  if constexpr (std::is_same_v<Value, bool>) {
    value = json.boolean().value_or(false);
  } else if constexpr (std::is_floating_point_v<Value>) {
    value = json.number().value_or(std::numeric_limits<Value>::quiet_NaN());
  } else if constexpr (std::is_integral_v<Value>) {
    // Numbers of 32 bits are taken where they can be counted with a sign, too.
    constexpr std::uint64_t kMost = sizeof(Value) > 4 ? std::numeric_limits<std::uint64_t>::max()
                                                      : std::numeric_limits<std::make_signed_t<Value>>::max();
    const std::uint64_t count = json.count().value_or(0);
    if (count > kMost) json.refuse("is too large");
    value = static_cast<Value>(count);
  } else if constexpr (std::is_same_v<Value, std::string>) {
    value = json.text();
  } else if constexpr (is_optional<Value>) {
    value.reset();
    if (json.exists()) read_json(json, value.emplace());
  } else if constexpr (is_vector<Value>) {
    value.clear();
    for (const JsonValue& element : json.elements()) {
      if (std::is_arithmetic_v<typename Value::value_type> && !element.exists()) continue;
      read_json(element, value.emplace_back());
    }
  } else {
    JsonReader read(json);
    fields(read, value);
  }
}

/// Text of bytes that may not be UTF-8, since names come from files: they are replaced, lest there be no text.
inline std::string to_text(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace demecal::inline report
