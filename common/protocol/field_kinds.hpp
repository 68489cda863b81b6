// What lists of fields are made of: kinds of fields, the values of enumerations, and numbers.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "protocol/messages.hpp"

namespace demecal::inline protocol {

/// `M` is `Message`, constant or not.
template <class M, class Message>
concept Fields = std::same_as<std::remove_const_t<M>, Message>;

// A field of a list is a reference to its value, within one or more of these where it is of a special kind.
enum class FieldKind { key, required, from_one, octet };
template <FieldKind kind, class Field>
struct SpecialField {
  Field field;
};
template <std::size_t most, class Field>
struct BoundedField {
  Field field;
};

/// Samples of equal keys are one instance.
template <class Field>
SpecialField<FieldKind::key, Field> key(Field&& field) {
  return {std::forward<Field>(field)};
}
/// A message in which it is 0 or empty is none.
template <class Field>
SpecialField<FieldKind::required, Field> required(Field&& field) {
  return {std::forward<Field>(field)};
}
/// Counts from 0 inside and from 1 on the wire.
template <class Field>
SpecialField<FieldKind::from_one, Field> from_one(Field&& field) {
  return {std::forward<Field>(field)};
}
/// A number that takes one byte on the wire.
template <class Field>
SpecialField<FieldKind::octet, Field> octet(Field&& field) {
  return {std::forward<Field>(field)};
}
/// At most so many bytes of text, or elements. Longer text is cut off when sent; more is refused when received.
template <std::size_t most, class Field>
BoundedField<most, Field> bounded(Field&& field) {
  return {std::forward<Field>(field)};
}

/// An enumeration's name and values as idl/calibration.idl has them; the values are numbered as in C++.
struct EnumerationList {
  std::string_view name;
  std::string_view values;  ///< ", " between them
};
template <class Enumeration>
inline constexpr EnumerationList kEnumeration{};
template <>
inline constexpr EnumerationList kEnumeration<ConstantPolicy>{"ConstantPolicy", "UNFITTED, LAMARCKIAN, BALDWIN"};
template <>
inline constexpr EnumerationList kEnumeration<Topology>{"Topology", "NONE, RING, FULL"};
template <>
inline constexpr EnumerationList kEnumeration<Replacement>{"Replacement", "WORST_LEAVE, ANY_LEAVE"};
template <>
inline constexpr EnumerationList kEnumeration<Loss>{"Loss", "ABSOLUTE_ERROR, SQUARED_ERROR"};
template <>
inline constexpr EnumerationList kEnumeration<Breeds>{"Breeds", "FORMULAS, SETS"};
template <>
inline constexpr EnumerationList kEnumeration<Control::State>{"RunState", "RUNNING, FINISHED, CANCELLED"};
template <>
inline constexpr EnumerationList kEnumeration<LoopNews::Stage>{
    "Stage", "PREPARING, EVOLVING, CLOSING, DONE, INTERRUPTED, FAILED"};
template <>
inline constexpr EnumerationList kEnumeration<LoopNews::Verdict>{"RoundVerdict", "ADDED, REJECTED, NOTHING"};

template <class T>
concept Number = std::is_arithmetic_v<T>;
template <class T>
concept Enumeration = std::is_enum_v<T>;

/// How many values the enumeration's list has.
template <Enumeration E>
constexpr std::uint32_t count_of_values() {
  return 1 + static_cast<std::uint32_t>(std::ranges::count(kEnumeration<E>.values, ','));
}

/// With its bytes in the other order.
template <Number N>
N swapped(N number) {
  auto bytes = std::bit_cast<std::array<char, sizeof number>>(number);
  std::ranges::reverse(bytes);
  return std::bit_cast<N>(bytes);
}

}  // namespace demecal::inline protocol
