// VAL II (thesis 6.1.1, Appendix C): all points between .LOCATIONS and .END, of any number of programs. `#name[i]` is
// a precision point: a number per joint, in degrees (mm). Other names are transformation points: nine numbers of
// rotation, the axes x, y, z of the tool one after the other, and three of translation: in sixteenths of a mm where
// all are whole and the axes are not of length 1, in mm otherwise.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "kinematics/chain.hpp"
#include "parsed_programs/language.hpp"
#include "parsed_programs/orientation.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"
#include "staubli_kawasaki/location_frames.hpp"
#include "staubli_kawasaki/location_names.hpp"
#include "staubli_kawasaki/val2_program.hpp"

namespace demecal::inline staubli_kawasaki {
namespace {

constexpr double kSixteenthMm = 1e-3 / 16.0;
constexpr std::size_t kRotationNumbers = 9, kTransformationNumbers = 12;

struct Token {
  std::size_t begin, size;
};

/// A location's name and the numbers after it, on its line or on those that follow.
struct Location {
  Token name;
  std::vector<Token> numbers;
};

std::string rotation_rule() {
  return "begins nine numbers that are no rotation: three axes of one length at right angles are needed";
}

class Val2Reader {
 public:
  explicit Val2Reader(const ReaderInput& input)
      : text_(input.source, {.comment = ';'}), arm_(input.arm), controller_(input.controller) {}

  Program read() {
    const std::string_view code = text_.code();
    for (std::size_t begin = 0; begin < code.size();) {
      const std::size_t end = std::min(code.find('\n', begin), code.size());
      read_line(begin, end);
      begin = end + 1;
    }
    finish();
    statements_.complete(program_, controller_);
    return std::move(program_);
  }

 private:
  void read_line(std::size_t begin, std::size_t end) {
    const std::string_view line = text_.trimmed(begin, end);
    end = begin + line.size();
    if (line.starts_with('.') && (line.size() < 2 || !is_digit(line[1]))) {
      finish();
      const std::size_t word = std::min(line.find_first_of(" \t"), line.size());
      const std::string heading = lower_case(line.substr(0, word));
      in_locations_ = heading == ".locations";
      const bool begins = heading == ".program";
      statements_.way().begin_program(text_, begin, begins ? program_name(text_, text_.skip_spaces(begin + word)) : "");
      return;
    }
    if (!in_locations_) return statements_.read_line(begin, end);
    if (line.empty()) return;
    if (line.front() == '#' || text_.begins_word(begin)) begin = read_name(begin, end);
    read_numbers(begin, end);
  }

  /// Begins a location, and returns where its name, indices included, ends.
  std::size_t read_name(std::size_t begin, std::size_t end) {
    finish();
    const std::string_view code = text_.code();
    std::size_t at = begin;
    while (at < end && code.substr(at, 1).find_first_of(" \t,=") != 0) {
      if (code[at] == '[') at = std::min(code.find(']', at), end);
      if (at == end) text_.fail(begin, end - begin, "opens a bracket that its line does not close");
      ++at;
    }
    location_ = {{begin, at - begin}, {}};
    open_ = true;
    return at;
  }

  void read_numbers(std::size_t begin, std::size_t end) {
    constexpr std::string_view kSeparators = " \t,=";
    const std::string_view code = text_.code().substr(0, end);
    for (std::size_t at = begin; (at = code.find_first_not_of(kSeparators, at)) < end;) {
      const std::size_t next = std::min(code.find_first_of(kSeparators, at), end);
      if (!open_) text_.fail(at, next - at, "stands before the name of a location");
      text_.number(at, next - at, {});
      location_.numbers.push_back({at, next - at});
      at = next;
    }
  }

  /// Makes a target of the location that was begun.
  void finish() {
    if (!open_) return;
    open_ = false;
    const std::string name(text_.text().substr(location_.name.begin, location_.name.size));
    Target target{.name = name, .place = text_.place(location_.name.begin)};
    name.front() == '#' ? read_precision_point(target) : read_transformation(target);
    program_.targets.push_back(std::move(target));
  }

  void require_numbers(std::size_t expected, const std::string& of_what) const {
    if (location_.numbers.size() == expected) return;
    text_.fail(location_.name.begin, location_.name.size,
               "has " + std::to_string(location_.numbers.size()) + " numbers; " + of_what + " has " +
                   std::to_string(expected));
  }

  void read_precision_point(Target& target) const {
    require_numbers(arm_.joints.size(), "a precision point of this arm");
    const std::vector<CellUnit> units = joint_units(arm_);
    for (std::size_t i = 0; i < units.size(); ++i) {
      target.joints.push_back(text_.number(location_.numbers[i].begin, location_.numbers[i].size, units[i]));
    }
  }

  void read_transformation(Target& target) const {
    require_numbers(kTransformationNumbers, "a transformation point (nine of rotation, three of translation)");
    target.form = OrientationForm::columns;
    for (std::size_t i = 0; i < kRotationNumbers; ++i) {
      target.orientation.push_back(text_.number(location_.numbers[i].begin, location_.numbers[i].size, {}));
    }
    const double length = axis_length(target.orientation);
    const bool counted =
        length > 1.5 && std::none_of(location_.numbers.begin(), location_.numbers.end(), [&](Token at) {
          return text_.code().substr(at.begin, at.size).find_first_of(".eE") != std::string_view::npos;
        });
    const CellUnit unit = counted ? CellUnit{kSixteenthMm, 0} : kMillimetres;
    for (std::size_t i = kRotationNumbers; i < kTransformationNumbers; ++i) {
      target.position.push_back(text_.number(location_.numbers[i].begin, location_.numbers[i].size, unit));
    }
  }

  /// The length of the rotation's axes, whatever it is scaled by.
  double axis_length(const std::vector<Cell>& cells) const {
    Eigen::Matrix3d axes;
    for (Eigen::Index i = 0; i < 9; ++i) axes(i % 3, i / 3) = cells[static_cast<std::size_t>(i)].value;
    const double length = std::sqrt(axes.squaredNorm() / 3.0);
    const Eigen::Matrix3d product = axes.transpose() * axes / (length * length);
    const bool rotation = length > 0.0 && (product - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 0.02;
    if (!rotation || !(axes.determinant() > 0.0)) {
      text_.fail(location_.numbers.front().begin, location_.numbers.front().size, rotation_rule());
    }
    return length;
  }

  ProgramText text_;
  const Chain& arm_;
  const ControllerData& controller_;
  Program program_;
  bool in_locations_ = false, open_ = false;
  Location location_{};
  Val2Statements statements_{text_};
};

std::string val2_text(std::span<const ProgrammedStop> stops, const Chain& arm) {
  std::string moves = ".PROGRAM measure\n", points = ".LOCATIONS\n";
  for (const ProgrammedStop& stop : stops) {
    moves += "  MOVE #" + stop.name + "\n  BREAK\n";
    if (stop.waits) moves += "  PAUSE\n";
    points += '#' + stop.name + ' ' + joints_text(arm, stop.joints, " ") + '\n';
  }
  return moves + ".END\n" + points + ".END\n";
}

}  // namespace

Language val2_language() {
  return {.name = "val2",
          .title = "VAL II",
          .file_endings = {"v2", "val", "val2", "pg", "lc"},
          .signs = {".locations", ".program"},
          .comment = ";",
          .headers = {".program", ".locations"},
          .of_several_files = true,
          .read = [](const ReaderInput& input) { return Val2Reader(input).read(); },
          .write = val2_text};
}

}  // namespace demecal::inline staubli_kawasaki
