#include "tables/guess_columns.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "data/columns.hpp"
#include "data/text.hpp"
#include "tables/layout.hpp"
#include "tables/time_stamp.hpp"

namespace demecal::inline tables {
namespace {

constexpr std::size_t kMostJoints = 9;

/// What a recorder of ROS topics heads positions of a joint with, "/joint_states/NAME/position", is its name.
std::string without_topic(std::string name) {
  constexpr std::string_view kPosition = "/position";
  if (!name.ends_with(kPosition)) return name;
  name.resize(name.size() - kPosition.size());
  const std::size_t stroke = name.rfind('/');
  return stroke == std::string::npos ? name : name.substr(stroke + 1);
}

/// A name in small letters, without signs between them and without a unit at its end: "Joint_1_deg" becomes "joint1".
std::string plain_name(std::string_view column) {
  std::string name = without_topic(lower_case(column));
  const std::size_t ending = name.rfind('_');
  if (ending != std::string::npos && find_heading_unit(name.substr(ending + 1))) name.resize(ending);
  std::erase_if(name, [](char c) { return std::string_view(" _-.:$").find(c) != std::string_view::npos; });
  return name;
}

/// Columns by their plain names; of equal names the first.
class NamedColumns {
 public:
  explicit NamedColumns(const CsvTable& table) {
    for (const std::string& column : table.columns) names_.push_back(plain_name(column));
  }

  std::optional<std::size_t> find(std::string_view name) const {
    const auto found = std::ranges::find(names_, name);
    if (found == names_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names_.begin());
  }

  std::optional<std::size_t> first_of(std::initializer_list<std::string_view> names) const {
    for (const std::string_view name : names) {
      if (const auto found = find(name)) return found;
    }
    return std::nullopt;
  }

  const std::vector<std::string>& names() const { return names_; }

  /// All of the names; empty where one is missing.
  std::vector<std::size_t> all_of(const std::vector<std::string>& names) const {
    std::vector<std::size_t> columns;
    for (const std::string& name : names) {
      const auto found = find(name);
      if (!found) return {};
      columns.push_back(*found);
    }
    return columns;
  }

 private:
  std::vector<std::string> names_;
};

constexpr std::array<std::string_view, 16> kJointStems{
    "q",       "j",          "joint",         "axis",     "a", "theta",         "rax",   "robax",
    "actualq", "jointangle", "jointposition", "position", "t", "fieldposition", "achse", "gelenk"};
constexpr std::array<std::string_view, 4> kJointEndings{"", "angle", "position", "pos"};

std::vector<std::string> numbered_names(std::string_view stem, std::size_t from, std::size_t count,
                                        std::string_view ending = "") {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i)
    names.push_back(std::string(stem) + std::to_string(from + i) + std::string(ending));
  return names;
}

/// The first column named PREFIXjointN for a number, with the same prefix for all, which is no word for something else
/// of joints than where they stand: "panda_joint1".
std::vector<std::size_t> prefixed_joints(const NamedColumns& named, std::size_t from, std::size_t joints) {
  constexpr std::array<std::string_view, 8> kOtherwise{"vel",    "eff",  "acc",    "cur",
                                                       "torque", "temp", "target", "desired"};
  const std::string first = "joint" + std::to_string(from);
  for (const std::string& name : named.names()) {
    if (!name.ends_with(first)) continue;
    const std::string prefix = name.substr(0, name.size() - first.size());
    if (std::ranges::any_of(kOtherwise, [&](auto word) { return prefix.find(word) != std::string::npos; })) continue;
    auto columns = named.all_of(numbered_names(prefix + "joint", from, joints));
    if (!columns.empty()) return columns;
  }
  return {};
}

/// Words at the beginning, before the number and at the end of a heading.
struct WordsAround {
  std::string_view before{}, between{}, after{};
};

/// Joints counted from one, or from zero as recorders of UR arms do.
std::vector<std::size_t> numbered_joints(const NamedColumns& named, std::size_t joints, const WordsAround& words) {
  for (const std::string_view ending : kJointEndings) {
    const std::string behind = std::string(ending).append(words.after);
    for (const std::size_t from : {std::size_t{1}, std::size_t{0}}) {
      for (const std::string_view stem : kJointStems) {
        const std::string ahead = std::string(words.before).append(stem).append(words.between);
        auto columns = named.all_of(numbered_names(ahead, from, joints, behind));
        if (!columns.empty()) return columns;
      }
    }
  }
  return {};
}

/// Those that say that they are commanded before any others: programs command, and encoders tell nearly the same.
std::vector<std::size_t> joint_columns(const NamedColumns& named, std::size_t joints) {
  for (const std::string_view word :
       {"cmd", "command", "commanded", "target", "desired", "setpoint", "reference", "ref", "soll"}) {
    for (const WordsAround& words :
         {WordsAround{.before = word}, WordsAround{.between = word}, WordsAround{.after = word}}) {
      auto columns = numbered_joints(named, joints, words);
      if (!columns.empty()) return columns;
    }
  }
  const auto bare = numbered_joints(named, joints, {});
  if (!bare.empty()) return bare;
  for (const std::size_t from : {std::size_t{1}, std::size_t{0}}) {
    auto columns = prefixed_joints(named, from, joints);
    if (!columns.empty()) return columns;
  }
  return {};
}

/// Rails under the names of external axes, before the joints of the arm that they carry.
std::vector<std::size_t> joints_on_rails(const NamedColumns& named, std::size_t joints, std::size_t rails) {
  if (rails == 0 || rails >= joints) return {};
  const std::vector<std::size_t> carried = joint_columns(named, joints - rails);
  if (carried.empty()) return {};
  std::vector<std::vector<std::string>> choices;
  for (const std::string_view stem : {"e", "eax", "extax", "ext", "externalaxis", "zusatzachse"})
    choices.push_back(numbered_names(stem, 1, rails));
  for (const std::string stem : {"eax", "extax"}) {  // as RAPID names them
    std::vector<std::string>& names = choices.emplace_back();
    for (std::size_t rail = 0; rail < rails; ++rail) names.push_back(stem + static_cast<char>('a' + rail));
  }
  for (const char* alone : {"rail", "track", "lineartrack", "linearaxis", "linearachse", "lineareinheit"})
    if (rails == 1) choices.push_back({alone});
  for (const std::vector<std::string>& names : choices) {
    std::vector<std::size_t> columns = named.all_of(names);
    if (columns.empty()) continue;
    columns.insert(columns.end(), carried.begin(), carried.end());
    return columns;
  }
  return {};
}

std::vector<std::size_t> three_columns(const NamedColumns& named,
                                       std::initializer_list<std::array<const char*, 3>> choices) {
  for (const auto& names : choices) {
    auto columns = named.all_of({names.begin(), names.end()});
    if (!columns.empty()) return columns;
  }
  return {};
}

GuessedColumns by_names(const CsvTable& table, std::size_t joints, const std::vector<std::string>& joint_names,
                        std::size_t rails) {
  const NamedColumns named(table);
  GuessedColumns guess;
  std::vector<std::string> plain;
  for (const std::string& name : joint_names) plain.push_back(plain_name(name));
  if (!plain.empty()) guess.joints = named.all_of(plain);
  if (guess.joints.empty()) guess.joints = joint_columns(named, joints);
  if (guess.joints.empty()) guess.joints = joints_on_rails(named, joints, rails);
  // Beside columns that say so themselves, bare ones are what was wanted rather than what was measured.
  guess.position = three_columns(named, {{"measuredx", "measuredy", "measuredz"},
                                         {"xmeasured", "ymeasured", "zmeasured"},
                                         {"measx", "measy", "measz"},
                                         {"xmeas", "ymeas", "zmeas"},
                                         {"actualx", "actualy", "actualz"},
                                         {"xactual", "yactual", "zactual"},
                                         {"actx", "acty", "actz"},
                                         {"xact", "yact", "zact"},
                                         {"x", "y", "z"},
                                         {"posx", "posy", "posz"},
                                         {"px", "py", "pz"}});
  guess.sigma = three_columns(
      named, {{"sx", "sy", "sz"}, {"ux", "uy", "uz"}, {"sigmax", "sigmay", "sigmaz"}, {"stdx", "stdy", "stdz"}});
  guess.orientation = named.all_of({"qw", "qx", "qy", "qz"});
  guess.approach = named.all_of(numbered_names("s", 1, joints));
  for (const std::string_view stem : {"torque", "tau", "jointtorque"}) {
    if (guess.torque.empty()) guess.torque = named.all_of(numbered_names(stem, 1, joints));
  }
  guess.pose = named.first_of({"poseid", "pose", "pointid", "pointname", "point", "name", "pointno", "label",
                               "pointlabel", "punktid", "punktname", "punktnr", "punkt", "id", "nr", "no"});
  guess.time = named.first_of({"time", "timestamp", "datetime", "t", "stamp", "zeit", "zeitstempel"});
  guess.set = named.find("set");
  guess.payload = named.first_of({"payload", "payloadkg"});
  guess.temperature = named.first_of({"temperature", "temperaturecelsius", "temp"});
  guess.contact = named.first_of({"contact", "contactid", "socket"});
  guess.target = named.first_of({"targetid", "target"});
  return guess;
}

/// What the fields of a column are, all of them.
template <typename Is>
bool holds(const CsvTable& table, std::size_t column, const Is& is) {
  return std::ranges::all_of(table.rows, [&](const CsvRow& row) { return is(row.fields[column]); });
}

GuessedColumns by_contents(const CsvTable& table, std::size_t joints) {
  std::vector<std::size_t> numbers;
  GuessedColumns guess;
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    if (holds(table, column, is_numeric)) {
      numbers.push_back(column);
    } else if (!guess.time &&
               holds(table, column, [](const auto& field) { return parse_time_stamp(field).has_value(); })) {
      guess.time = column;
    } else if (!guess.pose) {
      guess.pose = column;
    }
  }
  const auto take = [&](std::size_t from, std::size_t count) {
    return std::vector<std::size_t>(numbers.begin() + static_cast<std::ptrdiff_t>(from),
                                    numbers.begin() + static_cast<std::ptrdiff_t>(from + count));
  };
  if (numbers.size() == 3 && joints != 3) guess.position = take(0, 3);
  if (numbers.size() == joints && joints != 3) guess.joints = take(0, joints);
  if (numbers.size() == joints + 3) {
    guess.joints = take(0, joints);
    guess.position = take(joints, 3);
  }
  return guess;
}

}  // namespace

GuessedColumns guess_columns(const CsvTable& table, std::size_t joints, const std::vector<std::string>& joint_names,
                             std::size_t rails) {
  return table.header_line > 0 ? by_names(table, joints, joint_names, rails) : by_contents(table, joints);
}

std::string_view likely_unit(Quantity quantity, double largest) {
  constexpr double kMostAngle_rad = 2.0 * std::numbers::pi + 0.2, kMostLength_m = 20.0;
  if (quantity == Quantity::angle) return largest > kMostAngle_rad ? "deg" : "rad";
  return largest > kMostLength_m ? "mm" : "m";
}

std::size_t count_joint_columns(const CsvTable& table) {
  const NamedColumns named(table);
  for (std::size_t joints = kMostJoints; joints > 1; --joints) {
    if (!joint_columns(named, joints).empty()) return joints;
  }
  return 0;
}

}  // namespace demecal::inline tables
