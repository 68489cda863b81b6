#include "transport/wire_shape.hpp"

#include <cstdint>
#include <string>

namespace demecal {
namespace {

// What stands one after the other: 1, 4 and 8 a number of so many bytes, ? a flag, ~n a code below n, $n, a text of at
// most n bytes, [...] a sequence.
const std::string kFormula = "[1][1][8]";
const std::string kIndividuals = "[" + kFormula + "8]";
const std::string kParameters = "44444444488888[1]88~3,48??4[8][" + kFormula + "1]8";
const std::string kArchipelago = "[4]4~3,44??~2,8";
const std::string kTables = "[[[8]][8][8]~2,[" + kFormula + "]8]";
const std::string kMigrants = "8444" + kIndividuals + "$255,";
const std::string kRecent = "[" + kMigrants + "]";
const std::string kState = "4488" + kIndividuals + kIndividuals + "4";

template <class Wire>
const std::string kShape;
template <>
const std::string kShape<wire::Part> = "4448[1]";
template <>
const std::string kShape<wire::CalibrationData> = "8$255,8" + kParameters + kArchipelago + kTables;
template <>
const std::string kShape<wire::IslandTask> = "8444$255," + kState + kRecent;
template <>
const std::string kShape<wire::Migrants> = kMigrants;
template <>
const std::string kShape<wire::Progress> = "844$255,44884888888[44884888]";
template <>
const std::string kShape<wire::Checkpoint> = "8444" + kState + kRecent + "$255,";
template <>
const std::string kShape<wire::Outcome> = "8444$255,488" + kIndividuals;
template <>
const std::string kShape<wire::WorkerStatus> = "$255,$255,44$255,?88";
template <>
const std::string kShape<wire::Control> = "8~3,$1023,";
template <>
const std::string kShape<wire::LoopNews> = "848~6,$255,$1023,~3,$63,4$255,88";

/// Goes over bytes and shape together. Shapes are constants, and nest no deeper than they are written.
class Comparison {
 public:
  Comparison(std::string_view bytes, Endian endian) : bytes_(bytes), endian_(endian) {}

  /// Whether what stands next in the bytes has this shape, up to its end or a closing bracket, which is taken off.
  bool take(std::string_view& shape) {
    while (!shape.empty()) {
      const char kind = shape.front();
      shape.remove_prefix(1);
      if (kind == ']') return true;
      const bool taken = kind == '['   ? take_sequence(shape)
                         : kind == '$' ? take_text(number_of(shape))
                         : kind == '~' ? take_code(number_of(shape))
                         : kind == '?' ? take_flag()
                                       : take_numbers(static_cast<std::size_t>(kind - '0'), 1);
      if (!taken) return false;
    }
    return true;
  }
  std::size_t left() const { return bytes_.size() - at_; }

 private:
  static std::uint32_t number_of(std::string_view& shape) {
    std::uint32_t number = 0;
    for (; shape.front() != ','; shape.remove_prefix(1))
      number = 10 * number + static_cast<std::uint32_t>(shape.front() - '0');
    shape.remove_prefix(1);
    return number;
  }

  bool take_numbers(std::size_t size, std::size_t count) {
    if (count == 0) return true;
    const std::size_t begin = (at_ + size - 1) / size * size;
    if (begin > bytes_.size() || (bytes_.size() - begin) / size < count) return false;
    at_ = begin + count * size;
    return true;
  }

  bool take_count(std::uint32_t& count) {
    if (!take_numbers(4, 1)) return false;
    count = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t place = endian_ == Endian::little ? at_ - 1 - i : at_ - 4 + i;
      count = (count << 8) | static_cast<std::uint8_t>(bytes_[place]);
    }
    return true;
  }

  bool take_flag() { return take_numbers(1, 1) && static_cast<std::uint8_t>(bytes_[at_ - 1]) <= 1; }

  bool take_code(std::uint32_t codes) {
    std::uint32_t code = 0;
    return take_count(code) && code < codes;
  }

  /// With a zero at its end, which counts and stands nowhere else.
  bool take_text(std::uint32_t most) {
    std::uint32_t size = 0;
    if (!take_count(size) || size == 0 || size > most + 1 || !take_numbers(1, size)) return false;
    return bytes_.substr(at_ - size, size).find('\0') == size - 1;
  }

  /// An element of a sequence takes four bytes or more where it is no number: counts are bounded before anything is
  /// claimed for them.
  bool take_sequence(std::string_view& shape) {
    std::uint32_t count = 0;
    if (!take_count(count)) return false;
    const bool of_numbers = shape[1] == ']';
    if (of_numbers) {
      const auto size = static_cast<std::size_t>(shape.front() - '0');
      shape.remove_prefix(2);
      return take_numbers(size, count);
    }
    const std::string_view element = shape;
    skip(shape);
    for (std::uint32_t i = 0; i < count; ++i) {
      std::string_view rest = element;
      if (!take(rest)) return false;
    }
    return true;
  }

  /// Takes off the element's shape with its bracket.
  static void skip(std::string_view& shape) {
    for (int open = 1; open > 0; shape.remove_prefix(1))
      open += shape.front() == '[' ? 1 : shape.front() == ']' ? -1 : 0;
  }

  std::string_view bytes_;
  Endian endian_;
  std::size_t at_ = 0;
};

}  // namespace

template <class Wire>
bool has_shape(std::string_view bytes, Endian endian) {
  constexpr std::size_t kFilling = 3;
  if (bytes.size() > kMostSample_bytes) return false;
  Comparison comparison(bytes, endian);
  std::string_view shape = kShape<Wire>;
  return comparison.take(shape) && comparison.left() <= kFilling;
}

template bool has_shape<wire::Part>(std::string_view, Endian);
template bool has_shape<wire::CalibrationData>(std::string_view, Endian);
template bool has_shape<wire::IslandTask>(std::string_view, Endian);
template bool has_shape<wire::Migrants>(std::string_view, Endian);
template bool has_shape<wire::Progress>(std::string_view, Endian);
template bool has_shape<wire::Checkpoint>(std::string_view, Endian);
template bool has_shape<wire::Outcome>(std::string_view, Endian);
template bool has_shape<wire::WorkerStatus>(std::string_view, Endian);
template bool has_shape<wire::Control>(std::string_view, Endian);
template bool has_shape<wire::LoopNews>(std::string_view, Endian);

}  // namespace demecal
