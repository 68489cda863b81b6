// Kawasaki AS: the locations of .TRANS (x, y, z in mm and O, A, T in degrees, turns about z, the new y and the new z)
// and of .JOINTS (a number per joint), and those that programs write as TRANS(...) and #PPOINT(...). Numbers of
// external axes behind them are kept; the first of joints are the rails that carry the arm, as many as it has.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "kinematics/chain.hpp"
#include "parsed_programs/given_numbers.hpp"
#include "parsed_programs/language.hpp"
#include "parsed_programs/orientation.hpp"
#include "parsed_programs/payload_values.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"
#include "staubli_kawasaki/kawasaki_as_program.hpp"
#include "staubli_kawasaki/location_frames.hpp"
#include "staubli_kawasaki/location_names.hpp"

namespace demecal::inline staubli_kawasaki {
namespace {

constexpr CellUnit kOatAngle{std::numbers::pi / 180.0, kDecimalsDeg};
constexpr std::array<CellUnit, 6> kTransUnits{kMillimetres, kMillimetres, kMillimetres,
                                              kOatAngle,    kOatAngle,    kOatAngle};

/// Public documentation leaves open whether transformations are counted from the rail's base or move along with it.
constexpr const char* kOnRail = "a rail carries the arm, and it is not told whether the pose moves along with it";

enum class AsSection { none, program, transformations, joints, system };

AsSection section_of(const std::string& word) {
  if (word == ".program") return AsSection::program;
  if (word == ".trans") return AsSection::transformations;
  if (word == ".joints") return AsSection::joints;
  return word == ".sysdata" ? AsSection::system : AsSection::none;
}

class AsReader {
 public:
  explicit AsReader(const ReaderInput& input)
      : text_(input.source, {.comment = ';'}), code_(text_.code()), arm_(input.arm), controller_(input.controller) {
    rails_ = static_cast<std::size_t>(rails_of(input.arm, input.source.file(), "Kawasaki's AS"));
  }

  Program read() {
    for (std::size_t begin = 0; begin < code_.size();) {
      const std::size_t end = std::min(code_.find('\n', begin), code_.size());
      read_line(begin, end);
      begin = end + 1;
    }
    for (const LocationLiteral& literal : statements_.literals()) read_literal(literal);
    for (const auto& [begin, what] : statements_.computed()) {
      note_unknown_motion(program_, begin, {.name = "", .place = text_.place(begin)},
                          '\'' + what + "' is computed when the program runs");
    }
    for (const auto& [begin, joints] : statements_.block_steps()) {
      note_unknown_motion(program_, begin, {.name = "", .place = text_.place(begin)},
                          "the block step goes to " + joints.substr(0, 60) +
                              ", which is not corrected; a step such as "
                              "JMOVE #PPOINT(..) is");
    }
    statements_.note_approaches(text_, program_);
    const std::vector<std::size_t>& stopped = statements_.stopped();
    program_.joints_lost_at.insert(program_.joints_lost_at.end(), stopped.begin(), stopped.end());
    finish();
    statements_.way().note_routines(text_, program_);
    return std::move(program_);
  }

 private:
  void read_line(std::size_t begin, std::size_t end) {
    const std::string_view line = text_.trimmed(begin, end);
    end = begin + line.size();
    if (line.empty() || line.starts_with(".*")) return;
    if (line.front() == '.' && (line.size() < 2 || !is_digit(line[1]))) {
      const std::size_t word = std::min(line.find_first_of(" \t("), line.size());
      section_ = section_of(lower_case(line.substr(0, word)));
      const bool begins = section_ == AsSection::program;
      statements_.way().begin_program(text_, begin, begins ? program_name(text_, text_.skip_spaces(begin + word)) : "");
      return;
    }
    if (section_ == AsSection::program) statements_.read_line(text_, begin, end);
    if (section_ == AsSection::system) statements_.read_system_line(text_, begin, end);
    if (section_ == AsSection::transformations || section_ == AsSection::joints) read_location(begin, end);
  }

  /// "NAME x y z o a t".
  void read_location(std::size_t begin, std::size_t end) {
    const std::string name = location_name(text_, begin, end);
    if (name.empty()) return text_.fail(begin, end - begin, "must be a location: its name, then its numbers");
    std::vector<BracketItem> numbers;
    constexpr std::string_view kSeparators = " \t,=";
    const std::string_view code = code_.substr(0, end);
    for (std::size_t at = begin + name.size(); (at = code.find_first_not_of(kSeparators, at)) < end;) {
      const std::size_t next = std::min(code.find_first_of(kSeparators, at), end);
      numbers.push_back({at, next - at, false, {}});
      at = next;
    }
    Target target{.name = name, .place = text_.place(begin)};
    make_target(std::move(target), numbers, section_ == AsSection::joints, Numbers::required);
  }

  void read_literal(const LocationLiteral& literal) {
    Target target{.name = literal.name, .place = text_.place(literal.begin)};
    const std::size_t made = program_.targets.size();
    make_target(std::move(target), literal.list.items, literal.of_joints, Numbers::or_expressions);
    if (program_.targets.size() == made) return;
    // A point that is given numbers is no motion to it.
    if (!literal.use && statements_.uses(location_key(literal.name)).empty())
      program_.joints_lost_at.push_back(program_.targets.back().order);
    if (!literal.use) return;
    take_uses({*literal.use}, program_.targets.back());
  }

  void make_target(Target target, std::vector<BracketItem> numbers, bool of_joints, Numbers required) {
    const std::size_t needed = of_joints ? arm_.joints.size() : kTransUnits.size();
    if (numbers.size() < needed) {
      const std::string rule = "has " + std::to_string(numbers.size()) + " numbers; a location " +
                               (of_joints ? "of this arm's joints" : "(x, y, z, O, A, T)") + " has " +
                               std::to_string(needed);
      if (required == Numbers::or_expressions) return skip_target(program_, target, "it " + rule);
      const std::size_t begin = numbers.empty() ? code_.size() : numbers.front().begin;
      text_.fail(std::min(begin, code_.size()), 1, target.name + ' ' + rule);
    }
    numbers.resize(needed);
    std::vector<CellUnit> units(kTransUnits.begin(), kTransUnits.end());
    if (of_joints) {  // the six that turn come first, the rails' behind them
      units = joint_units(arm_, static_cast<int>(rails_));
      units.resize(needed, kMillimetres);
    }
    auto cells = cells_of(text_, numbers, units, required, program_, target);
    if (!cells) return;
    if (of_joints) {
      const auto behind = cells->end() - static_cast<std::ptrdiff_t>(rails_);
      target.carried.assign(behind, cells->end());
      target.joints.assign(cells->begin(), behind);
    } else {
      target.position.assign(cells->begin(), cells->begin() + 3);
      target.orientation.assign(cells->begin() + 3, cells->end());
      target.form = OrientationForm::zyz_angles;
    }
    target.order = target.begin();
    program_.targets.push_back(std::move(target));
  }

  /// The tool of this name: a location of the program or, where none has the name, one that the controller keeps.
  std::optional<Eigen::Isometry3d> tool(const std::string& name) const {
    const bool here = std::any_of(program_.targets.begin(), program_.targets.end(),
                                  [&](const Target& target) { return location_key(target.name) == name; });
    const auto kept = controller_.tools.find(name);
    return here || kept == controller_.tools.end() ? location(name) : std::optional(kept->second);
  }

  std::optional<Eigen::Isometry3d> kept_frame(const std::string& name) const {
    const auto kept = controller_.frames.find(name);
    return kept == controller_.frames.end() ? std::nullopt : std::optional(kept->second);
  }

  /// The pose of the only location of this name.
  std::optional<Eigen::Isometry3d> location(const std::string& name) const {
    const Target* found = nullptr;
    for (const Target& target : program_.targets) {
      if (!target.is_pose() || location_key(target.name) != name) continue;
      if (found != nullptr) return std::nullopt;
      found = &target;
    }
    if (found == nullptr || !statements_.not_sent_to(name).empty()) return std::nullopt;
    return stated_tool_pose(*found);
  }

  /// Gives targets their frames and motions, and takes those out that are no places to go to.
  void finish() {
    statements_.way().finish();
    statements_.take_departures(text_, program_);
    std::map<std::string, std::optional<Eigen::Isometry3d>> tools;
    const AsStatements::Lookup lookup{[&](const std::string& name) {
                                        const auto [found, fresh] = tools.try_emplace(name);
                                        if (fresh) found->second = tool(name);
                                        return found->second;
                                      },
                                      [&](const std::string& name) { return kept_frame(name); }};
    const StatedFrames frames = statements_.frames(lookup);
    note_untold_locations(
        text_, statements_.uses(), [&](const std::string& name) { return statements_.not_sent_to(name); }, program_);
    end_at_unknown_statements(statements_.unknown(), program_);
    std::vector<Target> targets = program_.targets, kept;
    GivenNumbers given;
    const FrameFlow& way = statements_.way().flow();
    for (const Target& target : targets) given.give(location_key(target.name), target.begin());
    std::stable_sort(targets.begin(), targets.end(),
                     [](const Target& one, const Target& other) { return one.begin() < other.begin(); });
    for (Target& target : targets) {
      const std::string name = location_key(target.name);
      if (!name.empty() && statements_.is_frame(name)) {
        leave_frame(target, statements_.uses(name), program_);
        continue;
      }
      std::string why = name.empty() ? "" : statements_.not_sent_to(name);
      if (why.empty() && target.is_pose() && !statements_.sets_configuration().empty())
        why = "the program sets the arm's configuration (" + statements_.sets_configuration() +
              "), and where it holds is not followed";
      if (why.empty() && statements_.displaces()) why = kAltered;
      if (!why.empty()) {
        skip_target(program_, target, why);
        for (const TargetUse& use : statements_.uses(name)) program_.joints_lost_at.push_back(use.begin);
        continue;
      }
      const bool pose = target.is_pose();
      target.frames = name.empty() ? statements_.frames_at(target.order, pose, lookup) : frames;
      std::vector<TargetUse> uses = name.empty() ? std::vector<TargetUse>{} : statements_.uses(name);
      std::erase_if(uses, [&](const TargetUse& use) { return !given.may_be(name, target.begin(), use.begin, way); });
      for (const TargetUse& use : uses)
        if (!given.at(name, use.begin, way)) program_.joints_lost_at.push_back(use.begin);
      for (TargetUse& use : uses) use.frames = statements_.frames_at(use.begin, pose, lookup);
      if (!uses.empty()) take_uses(uses, target);
      if (rails_ > 0 && pose) target.frames.unknown_frame = kOnRail;
      kept.push_back(std::move(target));
    }
    program_.targets = std::move(kept);
  }

  ProgramText text_;
  std::string_view code_;
  const Chain& arm_;
  const ControllerData& controller_;
  std::size_t rails_ = 0;
  Program program_;
  AsSection section_ = AsSection::none;
  AsStatements statements_{text_};
};

std::string as_text(std::span<const ProgrammedStop> stops, const Chain& arm) {
  std::string motions, points;
  for (const ProgrammedStop& stop : stops) {
    const auto carried = carried_stop(arm, stop.joints);
    if (!carried) return {};
    motions += "  JMOVE #" + stop.name + "\n  BREAK\n" + (stop.waits ? "  PAUSE\n" : "");
    points += '#' + stop.name + "  " + joints_text(carried->arm, carried->joints, "  ");
    for (const std::string& place : rail_texts(*carried)) points += "  " + place;
    points += '\n';
  }
  return ".PROGRAM measure()\n" + motions + ".END\n.JOINTS\n" + points + ".END\n";
}

}  // namespace

Language kawasaki_as_language() {
  return {.name = "kawasaki_as",
          .title = "Kawasaki AS",
          .file_endings = {"as"},
          .signs = {".trans", ".joints"},
          .other_endings = {"pg"},
          .comment = ".*",
          .openings = {".program", ".sysdata", ".reals", ".strings", ".netconf"},
          .payload_statements = {{"weight ", number_argument}},
          .of_several_files = true,
          .read = [](const ReaderInput& input) { return AsReader(input).read(); },
          .write = as_text};
}

}  // namespace demecal::inline staubli_kawasaki
