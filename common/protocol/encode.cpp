#include "expression/tree.hpp"
#include "primitives/primitive.hpp"
#include "protocol/field_kinds.hpp"
#include "protocol/finding_fields.hpp"
#include "protocol/message_bytes.hpp"
#include "protocol/messages.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "protocol/fields.hpp"

namespace demecal::inline protocol {
namespace {

FlatFormula flat(const Tree& tree) {
  FlatFormula formula;
  formula.primitives.reserve(tree.size());
  for (const Node& node : tree) {
    formula.primitives.push_back(static_cast<std::uint8_t>(node.primitive));
    if (node.primitive == Primitive::variable) formula.variables.push_back(node.variable);
    if (node.primitive == Primitive::constant) formula.constants.push_back(node.value);
  }
  return formula;
}

/// Appends fields in CDR.
class Encoder {
 public:
  explicit Encoder(std::endian order) : swaps_(order != std::endian::native) {}

  template <class Field>
  void operator()(const char*, const Field& field) {
    put(field);
  }
  std::string release() { return std::move(bytes_); }

 private:
  template <Number N>
  void put(N number) {
    append(swaps_ ? std::array{swapped(number)} : std::array{number});
  }
  template <Enumeration E>
  void put(E value) {
    put(static_cast<std::uint32_t>(value));
  }
  void put(Primitive primitive) { put(static_cast<std::uint8_t>(primitive)); }
  void put(const Tree& tree) { put(flat(tree)); }
  template <class Element>
  void put(const std::vector<Element>& elements) {
    put(static_cast<std::uint32_t>(elements.size()));
    if constexpr (Number<Element>) {
      if (!swaps_) return append(elements);
    }
    for (const Element& element : elements) put(element);
  }
  template <Listed Part>
  void put(const Part& part) {
    visit_fields(*this, part);
  }
  template <FieldKind kind, class Field>
  void put(const SpecialField<kind, Field>& special) {
    if constexpr (kind == FieldKind::from_one) {
      put(from_one_of(special.field));
    } else if constexpr (kind == FieldKind::octet) {
      put(static_cast<std::uint8_t>(special.field));
    } else if constexpr (kind == FieldKind::word) {
      const std::string text = word_of(special.field);
      put(BoundedField<kMostWord, const std::string&>{text});
    } else {
      put(special.field);
    }
  }
  template <std::size_t most>
  void put(const BoundedField<most, const std::string&>& text) {
    const std::string_view kept = std::string_view(text.field.c_str()).substr(0, most);
    put(static_cast<std::uint32_t>(kept.size() + 1));
    bytes_.append(kept).push_back('\0');
  }
  template <std::size_t most, class Element>
  void put(const BoundedField<most, const std::vector<Element>&>& sequence) {
    put(sequence.field);
  }
  template <std::size_t most, class Rows, class NumberOf>
  void put(const ColumnField<most, Rows, NumberOf>& column) {
    put(static_cast<std::uint32_t>(column.rows.size()));
    for (const auto& row : column.rows) put(column.number(row));
  }

  /// Numbers as they are, behind what aligns the first.
  template <class Numbers>
  void append(const Numbers& numbers) {
    constexpr std::size_t kSize = sizeof(typename Numbers::value_type);
    if (numbers.empty()) return;
    bytes_.resize((bytes_.size() + kSize - 1) / kSize * kSize);
    bytes_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * kSize);
  }

  static std::uint32_t from_one_of(std::uint32_t index) { return index + 1; }
  static std::vector<std::uint32_t> from_one_of(std::vector<std::uint32_t> indices) {
    for (std::uint32_t& index : indices) ++index;
    return indices;
  }

  bool swaps_;
  std::string bytes_;
};

/// Appends the key fields alone.
class KeyEncoder {
 public:
  template <class Field>
  void operator()(const char*, const Field&) {}
  template <class Field>
  void operator()(const char* name, const SpecialField<FieldKind::key, Field>& key) {
    encoder_(name, key);
    is_long_ = is_long_ || is_text<Field>();
  }
  SampleKey release() { return {encoder_.release(), is_long_}; }

 private:
  template <class Field>
  static constexpr bool is_text() {
    using Value = std::remove_cvref_t<Field>;
    if constexpr (requires(Value value) { value.field; }) {
      return is_text<decltype(Value::field)>();
    } else {
      return std::is_same_v<Value, std::string>;
    }
  }

  Encoder encoder_{std::endian::big};
  bool is_long_ = false;
};

/// Sums up what a message's fields claim of memory beside themselves.
class Scales {
 public:
  template <class Field>
  void operator()(const char*, const Field& field) {
    weigh(field);
  }
  std::size_t bytes() const { return bytes_; }

 private:
  template <class Value>
  void weigh(const Value& value) {
    if constexpr (requires { value.field; }) {
      weigh(value.field);
    } else if constexpr (requires { value.is_first; }) {
      if (value.is_first) weigh(value.rows);
    } else if constexpr (Listed<const Value>) {
      visit_fields(*this, value);
    } else if constexpr (requires { value.begin(); }) {
      bytes_ += value.size() * sizeof(typename Value::value_type);
      for (const auto& element : value) weigh(element);
    }
  }

  std::size_t bytes_ = 0;
};

}  // namespace

template <class Plain>
std::string to_bytes(const Plain& message) {
  Encoder encoder(std::endian::little);
  visit_fields(encoder, message);
  return encoder.release();
}

template <class Plain>
std::string to_sample(const Plain& message) {
  return std::string("\0\1\0\0", 4) + to_bytes(message);
}

template <class Plain>
SampleKey key_bytes(const Plain& message) {
  KeyEncoder encoder;
  visit_fields(encoder, message);
  return encoder.release();
}

std::size_t weight_bytes(const Message& message) {
  return std::visit(
      [](const auto& plain) {
        Scales scales;
        if constexpr (Listed<decltype(plain)>) visit_fields(scales, plain);
        return sizeof(Message) + scales.bytes();
      },
      message);
}

#define DEMECAL_ENCODE(Plain)                   \
  template std::string to_bytes(const Plain&);  \
  template std::string to_sample(const Plain&); \
  template SampleKey key_bytes(const Plain&)
DEMECAL_ENCODE(CalibrationData);
DEMECAL_ENCODE(IslandTask);
DEMECAL_ENCODE(Migrants);
DEMECAL_ENCODE(Progress);
DEMECAL_ENCODE(Checkpoint);
DEMECAL_ENCODE(Outcome);
DEMECAL_ENCODE(WorkerStatus);
DEMECAL_ENCODE(Control);
DEMECAL_ENCODE(LoopNews);
DEMECAL_ENCODE(CauseFound);
DEMECAL_ENCODE(FinalFigures);
DEMECAL_ENCODE(MessagePart);
DEMECAL_ENCODE(PlacedProgress);
#undef DEMECAL_ENCODE

}  // namespace demecal::inline protocol
