#include "expression/tree.hpp"
#include "primitives/primitive.hpp"
#include "protocol/field_kinds.hpp"
#include "protocol/message_bytes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/fields.hpp"

namespace demecal::inline protocol {
namespace {

constexpr std::size_t kMostFormulaNodes = 65535;
/// Behind which a sample's content stands (RTPS 2.3, 10.2): two bytes that name its form, two of options.
constexpr std::size_t kEncapsulation_bytes = 4;
constexpr std::size_t kFilling_bytes = 3;

std::optional<Tree> tree_of(const FlatFormula& formula) {
  if (formula.primitives.size() > kMostFormulaNodes) return std::nullopt;
  auto variable = formula.variables.begin();
  auto constant = formula.constants.begin();
  Tree tree;
  tree.reserve(formula.primitives.size());
  for (const std::uint8_t code : formula.primitives) {
    if (code >= kPrimitives.size()) return std::nullopt;
    Node node{static_cast<Primitive>(code)};
    if (node.primitive == Primitive::variable) {
      if (variable == formula.variables.end()) return std::nullopt;
      node.variable = *variable++;
    }
    if (node.primitive == Primitive::constant) {
      if (constant == formula.constants.end() || !std::isfinite(*constant)) return std::nullopt;
      node.value = *constant++;
    }
    tree.push_back(node);
  }
  if (variable != formula.variables.end() || constant != formula.constants.end()) return std::nullopt;
  return tree;
}

/// Reads fields in CDR, and goes no further than the first that is none.
class Decoder {
 public:
  Decoder(std::string_view bytes, std::endian order) : bytes_(bytes), swaps_(order != std::endian::native) {}

  template <class Field>
  void operator()(const char*, Field&& field) {
    if (sound_) get(field);
  }
  /// The message, where all of it was there and at most so many bytes are left.
  template <class Plain>
  std::optional<Plain> read(std::size_t most_left) {
    std::optional<Plain> message(std::in_place);
    get(*message);
    if (!sound_ || bytes_.size() - at_ > most_left) message.reset();
    return message;
  }

 private:
  bool demand(bool condition) { return sound_ = sound_ && condition; }

  /// Whether so many numbers of this size follow. Goes to the first.
  bool reach(std::size_t count, std::size_t size) {
    const std::size_t begin = (at_ + size - 1) / size * size;
    if (demand(begin <= bytes_.size() && (bytes_.size() - begin) / size >= count)) at_ = begin;
    return sound_;
  }

  template <Number N>
  void get(N& number) {
    if (!reach(1, sizeof number)) return;
    if constexpr (std::is_same_v<N, bool>) {
      demand(bytes_[at_] == 0 || bytes_[at_] == 1);
      number = bytes_[at_] == 1;
    } else {
      std::memcpy(&number, bytes_.data() + at_, sizeof number);
      if (swaps_) number = swapped(number);
    }
    at_ += sizeof number;
  }
  template <Enumeration E>
  void get(E& value) {
    std::uint32_t code = 0;
    get(code);
    if (demand(code < count_of_values<E>())) value = static_cast<E>(code);
  }
  void get(Primitive& primitive) {
    std::uint8_t code = 0;
    get(code);
    if (demand(code < kPrimitives.size())) primitive = static_cast<Primitive>(code);
  }
  void get(Tree& tree) {
    FlatFormula formula;
    get(formula);
    if (!sound_) return;
    std::optional<Tree> read = tree_of(formula);
    if (demand(read.has_value())) tree = std::move(*read);
  }
  /// Memory is claimed for numbers when all are there, for other elements one by one as they are read: each of those
  /// takes four bytes or more, but a primitive.
  template <class Element>
  void get(std::vector<Element>& elements) {
    constexpr std::size_t kLeast_bytes = std::is_same_v<Element, Primitive> ? 1 : 4;
    std::uint32_t count = 0;
    get(count);
    elements.clear();
    if (count == 0) return;
    if constexpr (Number<Element>) {
      if (!reach(count, sizeof(Element))) return;
      elements.resize(count);
      std::memcpy(elements.data(), bytes_.data() + at_, count * sizeof(Element));
      at_ += count * sizeof(Element);
      if (swaps_) std::ranges::transform(elements, elements.begin(), swapped<Element>);
    } else {
      demand(count <= (bytes_.size() - at_) / kLeast_bytes);
      for (std::uint32_t i = 0; i < count && sound_; ++i) get(elements.emplace_back());
    }
  }
  template <Listed Part>
  void get(Part& part) {
    visit_fields(*this, part);
  }
  template <FieldKind kind, class Field>
  void get(const SpecialField<kind, Field>& special) {
    if constexpr (kind == FieldKind::octet) {
      std::uint8_t byte = 0;
      get(byte);
      special.field = byte;
    } else if constexpr (kind == FieldKind::word) {
      std::string text;
      get(BoundedField<kMostWord, std::string&>{text});
      demand(find_word(text, special.field));
    } else {
      get(special.field);
      if constexpr (kind == FieldKind::from_one) count_from_zero(special.field);
      if constexpr (kind == FieldKind::required) demand(is_given(special.field));
    }
  }
  /// With a zero at its end, which counts and stands nowhere else.
  template <std::size_t most>
  void get(const BoundedField<most, std::string&>& text) {
    std::uint32_t size = 0;
    get(size);
    if (!demand(size > 0 && size <= most + 1) || !reach(size, 1)) return;
    const std::string_view read = bytes_.substr(at_, size);
    at_ += size;
    if (demand(read.find('\0') == size - 1)) text.field = printable(read.substr(0, size - 1));
  }
  template <std::size_t most, class Element>
  void get(const BoundedField<most, std::vector<Element>&>& sequence) {
    get(sequence.field);
    demand(sequence.field.size() <= most);
  }
  template <std::size_t most, class Rows, class NumberOf>
  void get(const ColumnField<most, Rows, NumberOf>& column) {
    std::uint32_t count = 0;
    get(count);
    if (!demand(count <= most && (column.is_first || count == column.rows.size()))) return;
    if (column.is_first) column.rows.assign(count, {});
    for (auto& row : column.rows) get(column.number(row));
  }

  void count_from_zero(std::uint32_t& index) { demand(index-- > 0); }
  void count_from_zero(std::vector<std::uint32_t>& indices) {
    for (std::uint32_t& index : indices) count_from_zero(index);
  }
  static bool is_given(std::uint64_t number) { return number != 0; }
  template <std::size_t most>
  static bool is_given(const BoundedField<most, std::string&>& text) {
    return !text.field.empty();
  }

  std::string_view bytes_;
  bool swaps_;
  std::size_t at_ = 0;
  bool sound_ = true;
};

}  // namespace

template <class Plain>
std::optional<Plain> from_bytes(std::string_view bytes) {
  if (bytes.size() > kMostSample_bytes) return std::nullopt;
  return Decoder(bytes, std::endian::little).read<Plain>(0);
}

template <class Plain>
std::optional<Plain> from_sample(std::string_view bytes) {
  if (bytes.size() < kEncapsulation_bytes || bytes.size() > kMostSample_bytes) return std::nullopt;
  if (bytes[0] != 0 || (bytes[1] != 0 && bytes[1] != 1)) return std::nullopt;
  const std::endian order = bytes[1] == 1 ? std::endian::little : std::endian::big;
  return Decoder(bytes.substr(kEncapsulation_bytes), order).read<Plain>(kFilling_bytes);
}

#define DEMECAL_DECODE(Plain)                                 \
  template std::optional<Plain> from_bytes(std::string_view); \
  template std::optional<Plain> from_sample(std::string_view)
DEMECAL_DECODE(CalibrationData);
DEMECAL_DECODE(IslandTask);
DEMECAL_DECODE(Migrants);
DEMECAL_DECODE(Progress);
DEMECAL_DECODE(Checkpoint);
DEMECAL_DECODE(Outcome);
DEMECAL_DECODE(WorkerStatus);
DEMECAL_DECODE(Control);
DEMECAL_DECODE(LoopNews);
DEMECAL_DECODE(CauseFound);
DEMECAL_DECODE(FinalFigures);
DEMECAL_DECODE(MessagePart);
DEMECAL_DECODE(PlacedProgress);
#undef DEMECAL_DECODE

namespace {

/// A character of UTF-8: how many bytes it takes, and its number; 0 bytes where there is none.
struct Character {
  std::size_t bytes = 0;
  std::uint32_t number = 0;
};

std::uint32_t bits(char byte) {
  return static_cast<std::uint8_t>(byte);
}

/// RFC 3629: no overlong forms, no surrogates, nothing above 10FFFF.
Character first_character(std::string_view text) {
  struct Form {
    std::uint32_t mask, lead, smallest;
  };
  constexpr std::array<Form, 4> kForms{
      {{0x80, 0x00, 0}, {0xE0, 0xC0, 0x80}, {0xF0, 0xE0, 0x800}, {0xF8, 0xF0, 0x10000}}};
  for (std::size_t bytes = 1; bytes <= kForms.size() && bytes <= text.size(); ++bytes) {
    const Form& form = kForms[bytes - 1];
    if ((bits(text[0]) & form.mask) != form.lead) continue;
    std::uint32_t number = bits(text[0]) & ~form.mask & 0xFF;
    for (std::size_t i = 1; i < bytes; ++i) {
      if ((bits(text[i]) & 0xC0) != 0x80) return {};
      number = (number << 6) | (bits(text[i]) & 0x3F);
    }
    const bool is_surrogate = number >= 0xD800 && number <= 0xDFFF;
    if (number < form.smallest || number > 0x10FFFF || is_surrogate) return {};
    return {bytes, number};
  }
  return {};
}

bool is_shown(std::uint32_t number) {
  const bool is_control = number < 0x20 || (number >= 0x7F && number < 0xA0);
  const bool separates = number == 0x2028 || number == 0x2029;
  const bool turns = number == 0x200E || number == 0x200F || (number >= 0x202A && number <= 0x202E) ||
                     (number >= 0x2066 && number <= 0x2069);
  return !is_control && !separates && !turns;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const Character character = first_character(text);
    const std::size_t bytes = character.bytes == 0 ? 1 : character.bytes;
    if (character.bytes != 0 && is_shown(character.number)) {
      shown += text.substr(0, bytes);
    } else {
      shown += '?';
    }
    text.remove_prefix(bytes);
  }
  return shown;
}

bool is_printable(std::string_view text) {
  return printable(text) == text;
}

}  // namespace demecal::inline protocol
