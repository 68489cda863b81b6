// How members of messages stand in a line of JSON where that is not as they are; and the members of an event's line as
// JSON Schema, by the same lists that write and read them.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <string>
#include <type_traits>

#include "protocol/message_bytes.hpp"
#include "report/json.hpp"

namespace demecal::inline monitor {

// `Member` may be const: what is written is not changed. The compilers of the fuzzer and of the checker deduce the
// arguments of an aggregate by a guide alone.

/// A number of more digits than some readers keep, as text; 0 is empty.
template <class Member>
struct AsText {
  Member& number;
};
template <class Member>
AsText(Member&) -> AsText<Member>;

template <class Member>
nlohmann::ordered_json json_of(const AsText<Member>& as_text) {
  return as_text.number == 0 ? std::string() : std::to_string(as_text.number);
}
template <class Member>
void read_json(const JsonValue& json, AsText<Member>& as_text) {
  const std::string text = json.text();
  const char* const end = text.data() + text.size();
  as_text.number = 0;
  const auto [stop, fault] = std::from_chars(text.data(), end, as_text.number);
  if (!text.empty() && (fault != std::errc() || stop != end)) json.refuse("must be a number");
}

/// Counts from 1 in the line, from 0 inside.
template <class Member>
struct FromOne {
  Member& place;
};
template <class Member>
FromOne(Member&) -> FromOne<Member>;

template <class Member>
nlohmann::ordered_json json_of(const FromOne<Member>& from_one) {
  return from_one.place + 1;
}
template <class Member>
void read_json(const JsonValue& json, FromOne<Member>& from_one) {
  read_json(json, from_one.place);
  if (from_one.place == 0) json.refuse("must be a whole number from 1");
  --from_one.place;
}

/// A text of a file that anybody may have written, fit for a terminal once it is read.
template <class Member>
struct Shown {
  Member& text;
};
template <class Member>
Shown(Member&) -> Shown<Member>;

template <class Member>
nlohmann::ordered_json json_of(const Shown<Member>& shown) {
  return shown.text;
}
template <class Member>
void read_json(const JsonValue& json, Shown<Member>& shown) {
  shown.text = printable(json.text());
}

/// A figure that is `missing` where it is null, times `scale` in the line.
template <class Member>
struct FigureOr {
  Member& figure;
  double missing = 0.0, scale = 1.0;
};
template <class Member>
FigureOr(Member&, double = 0.0, double = 1.0) -> FigureOr<Member>;

template <class Member>
nlohmann::ordered_json json_of(const FigureOr<Member>& figure_or) {
  return report::json_of(figure_or.scale * figure_or.figure);
}
template <class Member>
void read_json(const JsonValue& json, FigureOr<Member>& figure_or) {
  figure_or.figure = json.number().value_or(figure_or.missing) / figure_or.scale;
}

/// An enumeration by its words.
template <class Member, class Words>
struct OneOf {
  Member& value;
  const Words& words;
};
template <class Member, class Words>
OneOf(Member&, const Words&) -> OneOf<Member, Words>;

template <class Member, class Words>
nlohmann::ordered_json json_of(const OneOf<Member, Words>& one_of) {
  return one_of.words.at(static_cast<std::size_t>(one_of.value));
}
template <class Member, class Words>
void read_json(const JsonValue& json, OneOf<Member, Words>& one_of) {
  const std::string word = json.text();
  for (std::size_t i = 0; i < one_of.words.size(); ++i) {
    if (word != one_of.words[i]) continue;
    one_of.value = static_cast<Member>(i);
    return;
  }
  json.refuse("is not a word that stands there");
}

using SchemaJson = nlohmann::ordered_json;

/// A plain member by its type.
template <class Value>
SchemaJson schema_of(const Value&) {
  if constexpr (std::is_same_v<Value, bool>) {
    return {{"type", "boolean"}};
  } else if constexpr (std::is_integral_v<Value>) {
    return {{"type", "integer"}};
  } else if constexpr (std::is_floating_point_v<Value>) {
    return {{"type", "number"}};
  } else if constexpr (is_vector<Value>) {
    return {{"type", "array"}, {"items", schema_of(typename Value::value_type{})}};
  } else if constexpr (is_optional<Value>) {
    return schema_of(typename Value::value_type{});
  } else {
    static_assert(std::is_same_v<Value, std::string>);
    return {{"type", "string"}};
  }
}
template <class Member>
SchemaJson schema_of(const AsText<Member>&) {
  return {{"type", "string"}};
}
template <class Member>
SchemaJson schema_of(const FromOne<Member>&) {
  return {{"type", "integer"}, {"minimum", 1}};
}
template <class Member>
SchemaJson schema_of(const Shown<Member>&) {
  return {{"type", "string"}};
}
template <class Member>
SchemaJson schema_of(const FigureOr<Member>&) {
  return {{"type", "number"}};
}
template <class Member, class Words>
SchemaJson schema_of(const OneOf<Member, Words>& one_of) {
  return {{"type", "string"}, {"enum", one_of.words}};
}

class SchemaWriter {
 public:
  template <class Value, class... Others>
  void operator()(const char* key, const Value& value, const Others&... others) {
    properties_[key] = schema_of(value);
    if constexpr (sizeof...(others) > 0) (*this)(others...);
  }

  SchemaJson schema(const std::string& title) const {
    return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
            {"title", title},
            {"type", "object"},
            {"properties", properties_}};
  }

 private:
  SchemaJson properties_ = SchemaJson::object();
};

}  // namespace demecal::inline monitor
