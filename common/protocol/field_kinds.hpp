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
#include "shared_work/shared_work.hpp"

namespace demecal::inline protocol {

/// `M` is `Message`, constant or not.
template <class M, class Message>
concept Fields = std::same_as<std::remove_const_t<M>, Message>;

template <class T>
concept Number = std::is_arithmetic_v<T>;
template <class T>
concept Enumeration = std::is_enum_v<T>;

// A field of a list is a reference to its value, within one or more of these where it is of a special kind.
enum class FieldKind { key, required, from_one, octet, word };
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
/// An enumeration that travels as its word (kWords).
template <class Field>
SpecialField<FieldKind::word, Field> word(Field&& field) {
  return {std::forward<Field>(field)};
}
/// One number of each element of `rows`, which travel as a sequence of their own. `number` gives the reference to it.
/// The first column of some rows says how many there are, the others must have as many.
template <std::size_t most, class Rows, class NumberOf>
struct ColumnField {
  Rows& rows;
  NumberOf number;
  bool is_first = false;
};
template <std::size_t most, class Rows, class NumberOf>
ColumnField<most, Rows, NumberOf> first_column(Rows& rows, NumberOf number) {
  return {rows, number, true};
}
template <std::size_t most, class Rows, class NumberOf>
ColumnField<most, Rows, NumberOf> column(Rows& rows, NumberOf number) {
  return {rows, number, false};
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
template <class E>
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
inline constexpr EnumerationList kEnumeration<Breeds>{"Breeds", "FORMULAS, SETS, WORK"};
template <>
inline constexpr EnumerationList kEnumeration<WorkKind>{"WorkKind", "AGREEMENTS, GAINS, RESAMPLINGS, PRODUCTS"};

/// The words of an enumeration that people read, in the order of its values: on monitoring topics and in events.
template <class E>
inline constexpr std::array<const char*, 0> kWords{};
template <>
inline constexpr std::array kWords<Control::State>{"running", "finished", "cancelled"};
template <>
inline constexpr std::array kWords<LoopNews::Stage>{"preparing", "evolving",    "closing",
                                                    "finished",  "interrupted", "failed"};
template <>
inline constexpr std::array kWords<LoopNews::Verdict>{"added", "rejected", "none"};
/// Bytes of the longest of all words on the wire.
inline constexpr std::size_t kMostWord = 15;

template <Enumeration E>
const char* word_of(E value) {
  return kWords<E>.at(static_cast<std::size_t>(value));
}
/// Whether `text` is a word of the enumeration, which `value` is set to.
template <Enumeration E>
bool find_word(std::string_view text, E& value) {
  const auto found = std::ranges::find(kWords<E>, text);
  if (found == kWords<E>.end()) return false;
  value = static_cast<E>(found - kWords<E>.begin());
  return true;
}

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
