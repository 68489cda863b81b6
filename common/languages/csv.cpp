// A table with a header: columns q1_deg .. (or joint1_deg, j1_rad, theta1_deg, a1_deg; _mm or _m where a joint slides),
// or x_mm, y_mm, z_mm (or _m) with or without qw, qx, qy, qz; joints where there are both. s1 .., payload_kg,
// temperature_celsius and time_s are a target's circumstances. Commas, semicolons or tabs separate.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "languages/languages.hpp"
#include "parsed_programs/orientation.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {
namespace {

/// The bytes of a field, without quotes and the spaces around it.
struct Field {
  std::size_t begin, size;
};

struct UnitName {
  std::string_view ending;
  CellUnit unit;
};
constexpr std::array<UnitName, 2> kAngles{
    {{"_deg", {std::numbers::pi / 180.0, kDecimalsDeg}}, {"_rad", {1.0, kDecimalsRad}}}};
constexpr std::array<UnitName, 2> kLengths{{{"_mm", kMillimetres}, {"_m", {1.0, kDecimalsM}}}};
constexpr CellUnit kPlain{1.0, kDecimalsQuaternion};

struct Column {
  std::size_t index;
  CellUnit unit;
};
using ProgramColumns = std::vector<Column>;

class CsvTargets {
 public:
  explicit CsvTargets(const ReaderInput& input) : text_(input.source, {}), arm_(input.arm) {}

  Program read() {
    const std::string_view bytes = text_.text();
    std::size_t begin = bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    for (; begin < bytes.size(); begin = line_end_ + 1) {
      line_end_ = std::min(bytes.find('\n', begin), bytes.size());
      const std::size_t end = line_end_ > begin && bytes[line_end_ - 1] == '\r' ? line_end_ - 1 : line_end_;
      std::size_t first = begin;
      const std::string_view line = text_.trimmed(first, end);
      if (line.empty() || line.front() == '#') continue;
      names_.empty() ? read_header(begin, end) : read_row(begin, end);
    }
    if (names_.empty()) throw InputError({text_.source().file(), 0}, "", "is empty; a header row is expected");
    return std::move(program_);
  }

 private:
  Field quoted(std::size_t begin, std::size_t end, std::size_t& at) const {
    const std::size_t quote = text_.text().find('"', begin + 1);
    if (quote >= end) text_.fail(begin, end - begin, "opens a quote that its line does not close");
    at = text_.text().find_first_not_of(" \t", quote + 1);
    return {begin + 1, quote - begin - 1};
  }

  std::vector<Field> fields(std::size_t begin, std::size_t end) const {
    const std::string_view line = text_.text().substr(0, end);
    std::vector<Field> found;
    for (std::size_t at = begin;; ++at) {
      const std::string_view blanks = separator_ == '\t' ? " " : " \t";
      std::size_t first = std::min(line.find_first_not_of(blanks, at), end);
      if (first < end && line[first] == '"') {
        found.push_back(quoted(first, end, at));
        at = std::min(at, end);
        if (at < end && line[at] != separator_) text_.fail(at, 1, "is text after a closing quote");
      } else {
        at = std::min(line.find(separator_, first), end);
        const std::string_view value = text_.text().substr(first, at - first);
        found.push_back({first, value.find_last_not_of(" \t") + 1});
      }
      if (at == end) return found;
    }
  }

  void read_header(std::size_t begin, std::size_t end) {
    const std::string_view line = text_.text().substr(begin, end - begin);
    for (const char separator : {',', ';', '\t'}) {
      separator_ = separator;
      if (line.find(separator) != std::string_view::npos) break;
    }
    header_ = begin;
    for (const Field& field : fields(begin, end)) {
      names_.push_back(lower_case(text_.text().substr(field.begin, field.size)));
    }
    find_columns();
  }

  /// The column of that name, where there is one.
  const std::size_t* find(const std::string& name) {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) return nullptr;
    found_ = static_cast<std::size_t>(found - names_.begin());
    return &found_;
  }

  /// The column that begins so and ends in one of the units.
  std::optional<Column> find(const std::string& stem, std::span<const UnitName> units) {
    for (const UnitName& unit : units) {
      if (const std::size_t* index = find(stem + std::string(unit.ending))) return Column{*index, unit.unit};
    }
    return std::nullopt;
  }

  ProgramColumns joint_columns(const std::string& stem) {
    ProgramColumns columns;
    for (std::size_t i = 0; i < arm_.joints.size(); ++i) {
      const bool revolute = is_revolute(arm_.joints[i]);
      const auto column = find(stem + std::to_string(i + 1), revolute ? kAngles : kLengths);
      if (!column) return {};
      columns.push_back(*column);
    }
    return columns;
  }

  /// All of these names, or nothing.
  ProgramColumns all_of(const std::vector<std::string>& stems, std::span<const UnitName> units) {
    ProgramColumns columns;
    for (const std::string& stem : stems) {
      const auto column = find(stem, units);
      if (!column) return {};
      columns.push_back(*column);
    }
    return columns;
  }

  void find_columns() {
    for (const char* stem : {"q", "j", "joint", "theta", "axis", "a", "q_", "joint_", "theta_"}) {
      if (joints_.empty()) joints_ = joint_columns(stem);
    }
    constexpr std::array<UnitName, 1> kNoUnit{{{"", kPlain}}};
    position_ = all_of({"x", "y", "z"}, kLengths);
    if (!position_.empty()) orientation_ = all_of({"qw", "qx", "qy", "qz"}, kNoUnit);
    std::vector<std::string> signs;
    for (std::size_t i = 0; i < arm_.joints.size(); ++i) signs.push_back("s" + std::to_string(i + 1));
    approach_ = all_of(signs, kNoUnit);
    if (!joints_.empty() || !position_.empty()) return;
    throw InputError({text_.source().file(), text_.place(header_).line}, "",
                     "the header has neither a column for every joint of the arm (q1_deg, q2_deg, ...) nor x_mm, y_mm, "
                     "z_mm; the unit stands in a column's name");
  }

  std::vector<Cell> cells(const ProgramColumns& columns, const std::vector<Field>& row) const {
    std::vector<Cell> found;
    for (const Column& column : columns) {
      found.push_back(text_.number(row[column.index].begin, row[column.index].size, column.unit));
    }
    return found;
  }

  std::optional<double> circumstance(const std::string& name, const std::vector<Field>& row) {
    const std::size_t* index = find(name);
    if (index == nullptr) return std::nullopt;
    return text_.number(row[*index].begin, row[*index].size, {}).value;
  }

  void read_row(std::size_t begin, std::size_t end) {
    const std::vector<Field> row = fields(begin, end);
    if (row.size() != names_.size()) {
      text_.fail(begin, end - begin,
                 "has " + std::to_string(row.size()) + " fields, but the header has " + std::to_string(names_.size()) +
                     " columns");
    }
    const ProgramColumns& columns = joints_.empty() ? position_ : joints_;
    Target target{.place = text_.place(row[columns.front().index].begin)};
    for (const char* name : {"name", "pose_id", "id"}) {
      const std::size_t* index = target.name.empty() ? find(name) : nullptr;
      if (index != nullptr) target.name = text_.text().substr(row[*index].begin, row[*index].size);
    }
    target.joints = cells(joints_, row);
    if (joints_.empty()) {
      target.position = cells(position_, row);
      target.orientation = cells(orientation_, row);
      if (!orientation_.empty()) {
        require_quaternion(text_, target.orientation);
        target.form = OrientationForm::quaternion;
      }
    }
    if (!approach_.empty()) target.approach = signs(row);
    target.payload_kg = circumstance("payload_kg", row);
    target.temperature_celsius = circumstance("temperature_celsius", row);
    target.time_s = circumstance("time_s", row);
    program_.targets.push_back(std::move(target));
  }

  ApproachSigns signs(const std::vector<Field>& row) const {
    ApproachSigns approach(arm_.size());
    Eigen::Index joint = 0;
    for (const Column& column : approach_) {
      const Cell sign = text_.number(row[column.index].begin, row[column.index].size, {});
      if (sign.value != 0.0 && sign.value != 1.0 && sign.value != -1.0) {
        text_.fail(sign.begin, sign.size, "must be -1, 0 or 1");
      }
      approach[joint++] = sign.value;
    }
    return approach;
  }

  ProgramText text_;
  const Chain& arm_;
  Program program_;
  char separator_ = ',';
  std::size_t header_ = 0, line_end_ = 0, found_ = 0;
  std::vector<std::string> names_;
  ProgramColumns joints_, position_, orientation_, approach_;
};

std::string csv_text(std::span<const ProgrammedStop> stops, const Chain& arm) {
  std::string text = "name";
  for (int i = 0; i < arm.size(); ++i) text += ",q" + std::to_string(i + 1) + (is_revolute(arm, i) ? "_deg" : "_mm");
  text += ",waits\n";
  for (const ProgrammedStop& stop : stops)
    text += stop.name + ',' + joints_text(arm, stop.joints, ",") + (stop.waits ? ",1\n" : ",0\n");
  return text;
}

}  // namespace

Language csv_language() {
  return {.name = "csv",
          .title = "CSV",
          .file_endings = {"csv"},
          .signs = {"q1_", "x_mm"},
          .comment = "#",
          .read = [](const ReaderInput& input) { return CsvTargets(input).read(); },
          .write = csv_text};
}

}  // namespace demecal::inline languages
