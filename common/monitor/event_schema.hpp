// The members of an event's line as JSON Schema, by the same lists that write and read them.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <type_traits>

#include "monitor/event_members.hpp"
#include "report/json.hpp"

namespace demecal::inline monitor {

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
