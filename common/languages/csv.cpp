// A table with a header: columns q1_deg .. (or joint1_deg, j1_rad, theta1_deg, a1_deg; _mm or _m where a joint slides),
// or x_mm, y_mm, z_mm (or _m) with or without qw, qx, qy, qz; joints where there are both. Of an arm on rails, poses
// have beside them where these stand (q1_mm ..). s1 .., payload_kg, temperature_celsius and time_s are a target's
// circumstances. Commas, semicolons or tabs separate.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
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
#include "languages/csv_fields.hpp"
#include "parsed_programs/language.hpp"
#include "parsed_programs/orientation.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline languages {
namespace {

struct UnitName {
  std::string_view ending;
  CellUnit unit;
};
constexpr std::array<UnitName, 2> kAngles{
    {{"_deg", {std::numbers::pi / 180.0, kDecimalsDeg}}, {"_rad", {1.0, kDecimalsRad}}}};
constexpr std::array<UnitName, 2> kLengths{{{"_mm", kMillimetres}, {"_m", {1.0, kDecimalsM}}}};
constexpr double kAbsoluteZero_celsius = -273.15;
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
  void read_header(std::size_t begin, std::size_t end) {
    const std::string_view line = text_.text().substr(begin, end - begin);
    for (const char separator : {',', ';', '\t'}) {
      separator_ = separator;
      if (line.find(separator) != std::string_view::npos) break;
    }
    header_ = begin;
    headings_ = csv_fields(text_, begin, end, separator_);
    for (const CsvField& field : headings_) {
      names_.push_back(lower_case(text_.text().substr(field.begin, field.size)));
    }
    find_columns();
  }

  /// The column of that name, where there is one; what is read must not stand there twice.
  const std::size_t* find(const std::string& name) {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) return nullptr;
    const auto again = std::find(found + 1, names_.end(), name);
    if (again != names_.end())
      refuse(static_cast<std::size_t>(again - names_.begin()), "is the name of two columns: one of them must go");
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

  /// Throws InputError at a heading.
  [[noreturn]] void refuse(std::size_t column, const std::string& rule) const {
    text_.fail(headings_[column].begin, headings_[column].size, rule);
  }

  /// A quantity stands in one column only, whatever its unit.
  void refuse_twice(const std::string& stem) const {
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const auto is_this = [&](const UnitName& unit) { return names_[i] == stem + std::string(unit.ending); };
      if (!std::ranges::any_of(kAngles, is_this) && !std::ranges::any_of(kLengths, is_this)) continue;
      if (first) refuse(i, "stands beside '" + names_[*first] + "', which is the same quantity: one column must go");
      first = i;
    }
  }

  void refuse_both(const ProgramColumns& one, const ProgramColumns& other) const {
    if (!one.empty() && !other.empty())
      refuse(other.front().index,
             "stands beside '" + names_[one.front().index] + "', which is the same quantity: one column must go");
  }

  /// Joint columns after the arm's last, where it has `joints` of them; 0: of this name there are not all.
  void refuse_joints_beyond(const std::string& stem, std::size_t joints) const {
    for (std::size_t i = 0; i < names_.size() && joints > 0; ++i) {
      const std::string& name = names_[i];
      const std::size_t unit = name.find('_', stem.size());
      if (!name.starts_with(stem) || unit == std::string::npos) continue;
      const auto number = cell_at(name, stem.size(), unit - stem.size(), {});
      const auto ends = [&](const UnitName& one) { return name.substr(unit) == one.ending; };
      if (!number || !(number->value > static_cast<double>(joints))) continue;
      if (std::ranges::any_of(kAngles, ends) || std::ranges::any_of(kLengths, ends))
        refuse(i, "the arm has " + std::to_string(joints) + " joints");
    }
  }

  ProgramColumns joint_columns(const std::string& stem) {
    ProgramColumns columns;
    for (std::size_t i = 0; i < arm_.joints.size(); ++i) refuse_twice(stem + std::to_string(i + 1));
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
      ProgramColumns found = joint_columns(stem);
      if (joints_.empty()) refuse_joints_beyond(stem, found.empty() ? 0 : arm_.joints.size());
      refuse_both(joints_, found);
      if (joints_.empty()) joints_ = std::move(found);
    }
    constexpr std::array<UnitName, 1> kNoUnit{{{"", kPlain}}};
    for (const char* axis : {"x", "y", "z"}) refuse_twice(axis);
    position_ = all_of({"x", "y", "z"}, kLengths);
    if (!position_.empty()) orientation_ = all_of({"qw", "qx", "qy", "qz"}, kNoUnit);
    if (joints_.empty() && !position_.empty()) find_rails();
    for (std::size_t i = 0; i < arm_.joints.size(); ++i)
      approach_.push_back(find("s" + std::to_string(i + 1), kNoUnit));
    if (!joints_.empty() || !position_.empty()) return;
    throw InputError({text_.source().file(), text_.place(header_).line}, "",
                     "the header has neither a column for every joint of the arm (q1_deg, q2_deg, ...) nor x_mm, y_mm, "
                     "z_mm; the unit stands in a column's name");
  }

  /// Where the rails of an arm of six joints on rails stand: columns of its first joints.
  void find_rails() {
    constexpr int kSix = 6;
    const int rails = arm_.size() - kSix;
    if (rails <= 0 || !has_six_revolute_joints(arm_, rails)) return;
    for (const char* stem : {"q", "j", "joint", "e", "q_", "joint_"}) {
      ProgramColumns found;
      for (int rail = 1; rail <= rails; ++rail) {
        if (const auto column = find(stem + std::to_string(rail), kLengths)) found.push_back(*column);
      }
      if (std::ssize(found) < rails) continue;
      refuse_both(rails_, found);
      rails_ = std::move(found);
    }
    if (!rails_.empty()) return;
    throw InputError(
        {text_.source().file(), text_.place(header_).line}, "",
        "the header has poses, but no column that says where the rail that carries the arm stands; add q1_mm" +
            std::string(rails > 1 ? ", q2_mm, ..." : ""));
  }

  std::vector<Cell> cells(const ProgramColumns& columns, const std::vector<CsvField>& row) const {
    std::vector<Cell> found;
    for (const Column& column : columns) {
      found.push_back(text_.number(row[column.index].begin, row[column.index].size, column.unit));
    }
    return found;
  }

  /// A number of this column that is not below `least`; `rule` says so.
  std::optional<double> circumstance(const std::string& name, const std::vector<CsvField>& row, double least,
                                     const std::string& rule) {
    const std::size_t* index = find(name);
    if (index == nullptr) return std::nullopt;
    const Cell cell = text_.number(row[*index].begin, row[*index].size, {});
    if (!(cell.value >= least)) text_.fail(cell.begin, cell.size, rule);
    return cell.value;
  }

  void read_row(std::size_t begin, std::size_t end) {
    const std::vector<CsvField> row = csv_fields(text_, begin, end, separator_);
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
      target.carried = cells(rails_, row);
      target.orientation = cells(orientation_, row);
      if (!orientation_.empty()) {
        require_quaternion(text_, target.orientation);
        target.form = OrientationForm::quaternion;
      }
    }
    target.approach = signs(row);
    target.payload_kg = circumstance("payload_kg", row, 0.0, "must be 0 or more");
    target.temperature_celsius =
        circumstance("temperature_celsius", row, kAbsoluteZero_celsius, "must not be below -273.15");
    target.time_s = circumstance("time_s", row, -std::numeric_limits<double>::infinity(), "");
    program_.targets.push_back(std::move(target));
  }

  /// Those that columns state; nothing where there are none.
  std::optional<ApproachSigns> signs(const std::vector<CsvField>& row) const {
    ApproachSigns approach = ApproachSigns::Constant(arm_.size(), std::numeric_limits<double>::quiet_NaN());
    bool stated = false;
    for (std::size_t joint = 0; joint < approach_.size(); ++joint) {
      if (!approach_[joint]) continue;
      const CsvField& field = row[approach_[joint]->index];
      const Cell sign = text_.number(field.begin, field.size, approach_[joint]->unit);
      if (sign.value != 0.0 && sign.value != 1.0 && sign.value != -1.0)
        text_.fail(sign.begin, sign.size, "must be -1, 0 or 1");
      approach[static_cast<Eigen::Index>(joint)] = sign.value;
      stated = true;
    }
    return stated ? std::optional(approach) : std::nullopt;
  }

  ProgramText text_;
  const Chain& arm_;
  Program program_;
  char separator_ = ',';
  std::size_t header_ = 0, line_end_ = 0, found_ = 0;
  std::vector<CsvField> headings_;
  std::vector<std::string> names_;
  ProgramColumns joints_, position_, orientation_, rails_;
  std::vector<std::optional<Column>> approach_;  ///< of every joint
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
