#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "data/csv.hpp"
#include "data/data_set.hpp"
#include "data/text.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "preparation/joint_log.hpp"
#include "preparation/recorded_contacts.hpp"
#include "preparation/results.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline preparation {
namespace {

constexpr std::array<std::string_view, kStandings> kStandingNames{"touches",     "too_short",        "moving", "alone",
                                                                  "one_posture", "between_contacts", "far_out"};

std::size_t count_of(const RecordedContacts& found, Standing standing) {
  return static_cast<std::size_t>(
      std::ranges::count_if(found.standstills, [&](const auto& one) { return one.standing == standing; }));
}

/// Why a standstill is no pose, for people.
std::string reason(const RecordedContacts& found, const JudgedStandstill& one) {
  const std::string& contact = found.contacts[*one.contact].name;
  const double off_mm = millimetres(one.from_contact_m);
  switch (one.standing) {
    case Standing::touches:
      break;
    case Standing::too_short:
      return fmt::format("stood too briefly ({:.2f} s)", one.at.duration_s);
    case Standing::moving:
      return fmt::format("the tool went on by {:.2f} mm while it stood, {:.0f} mm from {}", millimetres(one.moved_m),
                         off_mm, contact);
    case Standing::alone:
      return fmt::format("alone in its place, {:.0f} mm from {}", off_mm, contact);
    case Standing::one_posture:
      return fmt::format("a place that is always visited with the same joints, {:.0f} mm from {}", off_mm, contact);
    case Standing::between_contacts:
      return fmt::format("{:.0f} mm from {}, and another contact is nearly as near", off_mm, contact);
    case Standing::far_out:
      return fmt::format("{:.0f} mm from {}, far beside its other poses", off_mm, contact);
  }
  return "";
}

/// Those that may have been meant as touches: not what is in the air by all that can be told.
std::string left_out_text(const Recordings& recordings, const RecordedContacts& found) {
  constexpr std::size_t kMostLines = 12;
  constexpr double kNear_m = 0.03;
  std::string text, lines;
  std::size_t count = 0, shown = 0;
  for (const JudgedStandstill& one : found.standstills) {
    if (one.standing == Standing::touches) continue;
    ++count;
    const bool in_air = one.standing == Standing::one_posture || one.from_contact_m > kNear_m;
    if (in_air || ++shown > kMostLines) continue;
    lines += fmt::format("    {}:{} ({:.1f} s): {}\n", recordings.logs[one.at.log].file, one.at.first_line,
                         one.at.start_s, reason(found, one));
  }
  if (count == 0) return "  every standstill is a pose\n";
  std::vector<std::string> parts;
  for (std::size_t i = 1; i < kStandings; ++i) {
    const std::size_t of_it = count_of(found, static_cast<Standing>(i));
    std::string words(kStandingNames[i]);
    std::ranges::replace(words, '_', ' ');
    if (of_it > 0) parts.push_back(fmt::format("{} {}", of_it, words));
  }
  text = fmt::format("  left out: {} (standstills.csv)\n", fmt::join(parts, ", "));
  if (!lines.empty()) text += "  not sure of:\n" + lines;
  if (shown > kMostLines) text += fmt::format("    and {} more\n", shown - kMostLines);
  return text;
}

/// Angles in deg, lengths in mm.
double shown(const Chain& arm, Eigen::Index joint, double value) {
  return is_revolute(arm, static_cast<int>(joint)) ? degrees(value) : millimetres(value);
}

std::vector<double> shown(const Chain& arm, const JointVector& values) {
  std::vector<double> list;
  for (Eigen::Index joint = 0; joint < values.size(); ++joint) list.push_back(shown(arm, joint, values[joint]));
  return list;
}

/// The largest of the joints that turn, and of those that slide: "0.0012 deg and 0.03 mm".
std::string largest_text(const Chain& arm, const JointVector& values, const char* per) {
  std::vector<std::string> parts;
  for (const bool revolute : {true, false}) {
    double most = 0.0;
    bool any = false;
    for (Eigen::Index joint = 0; joint < values.size(); ++joint) {
      if (is_revolute(arm, static_cast<int>(joint)) != revolute) continue;
      most = std::max(most, shown(arm, joint, values[joint]));
      any = true;
    }
    if (any) parts.push_back(fmt::format("{:.2g} {}{}", most, revolute ? "deg" : "mm", per));
  }
  return fmt::format("{}", fmt::join(parts, " and "));
}

std::string log_text(const Recordings& recordings, const RecordedContacts& found, std::size_t number) {
  const Chain& arm = recordings.robot.chain;
  const JointLog& log = recordings.logs[number];
  const LogNoise& noise = found.noise[number];
  return fmt::format("  {}: {} rows in {:.0f} s; joints scatter by {} and stand below {}\n", log.file,
                     log.times_s.size(), log.times_s.back() - log.times_s.front(), largest_text(arm, noise.sigma, ""),
                     largest_text(arm, noise.fastest, "/s"));
}

std::string mm_cell(double length_m) {
  return fmt::format("{:.3f}", millimetres(length_m));
}

}  // namespace

std::string_view to_string(Standing standing) {
  return kStandingNames[static_cast<std::size_t>(standing)];
}

DataSet recorded_data_set(const Recordings& recordings, const RecordedContacts& found) {
  DataSet data;
  data.name = recordings.name;
  data.robot = recordings.robot;
  data.frame = Frame::base;
  data.file = recordings.logs.front().file;
  data.contacts.distances = recordings.distances;
  std::vector<std::size_t> to_divide;
  for (const JudgedStandstill& one : found.standstills) {
    if (one.standing != Standing::touches) continue;
    const std::optional<PoseSet>& set = recordings.logs[one.at.log].set;
    MeasuredPose pose;
    pose.joints = one.at.joints;
    pose.approach = one.at.approach;
    pose.time_s = std::round(1e3 * (one.at.start_s + 0.5 * one.at.duration_s)) / 1e3;
    pose.set = set.value_or(PoseSet::calibration);
    pose.pose_id = "P" + std::to_string(data.poses.size() + 1);
    pose.contact = found.contacts[*one.contact].name;
    pose.line = one.at.first_line;
    if (!set) to_divide.push_back(data.poses.size());
    data.poses.push_back(std::move(pose));
  }
  RandomStream random{1};
  std::vector<MeasuredPose> divided;
  for (const std::size_t i : to_divide) divided.push_back(data.poses[i]);
  split_by_pose(divided, {}, [&random](std::size_t n) { return random.index(n); });
  for (std::size_t i = 0; i < to_divide.size(); ++i) data.poses[to_divide[i]].set = divided[i].set;
  return data;
}

std::string recorded_table(const Recordings& recordings, const RecordedContacts& found) {
  std::string text = fmt::format("{}: {} poses at {} {}\n", recordings.name, count_of(found, Standing::touches),
                                 found.contacts.size(), found.contacts.size() == 1 ? "contact" : "contacts");
  for (std::size_t log = 0; log < recordings.logs.size(); ++log) text += log_text(recordings, found, log);
  text += fmt::format("  {:<16}{:>6}{:>12}{:>14}   {}\n", "contact", "poses", "scatter mm", "to next mm",
                      "x, y, z mm by the nominal arm");
  for (const RecordedContact& contact : found.contacts) {
    const std::string next = contact.nearest_m ? fmt::format("{:.1f}", millimetres(*contact.nearest_m)) : "-";
    text += fmt::format("  {:<16}{:>6}{:>12.2f}{:>14}   {:.0f}, {:.0f}, {:.0f}\n", contact.name, contact.poses,
                        millimetres(contact.scatter_m), next, millimetres(contact.place_m.x()),
                        millimetres(contact.place_m.y()), millimetres(contact.place_m.z()));
  }
  text += "  scatter is the nominal arm's error, and the tool's: calibration is to lower it\n";
  text += left_out_text(recordings, found);
  for (const std::string& assumed : recordings.assumed) text += "  assumed: " + assumed + "\n";
  for (const std::string& note : found.notes) text += "  check: " + note + "\n";
  return text;
}

std::string recorded_json(const Recordings& recordings, const RecordedContacts& found,
                          const std::vector<std::string>& files) {
  using Json = nlohmann::ordered_json;
  const Chain& arm = recordings.robot.chain;
  Json json{{"name", recordings.name}, {"logs", Json::array()}, {"contacts", Json::array()}};
  for (std::size_t i = 0; i < recordings.logs.size(); ++i) {
    const JointLog& log = recordings.logs[i];
    json["logs"].push_back({{"file", log.file},
                            {"rows", log.times_s.size()},
                            {"duration_s", log.times_s.back() - log.times_s.front()},
                            {"step_s", found.noise[i].step_s},
                            {"noise_deg_or_mm", shown(arm, found.noise[i].sigma)},
                            {"stands_below_deg_or_mm_per_s", shown(arm, found.noise[i].fastest)}});
  }
  for (const RecordedContact& contact : found.contacts) {
    Json entry{{"name", contact.name}, {"poses", contact.poses}, {"scatter_mm", millimetres(contact.scatter_m)}};
    entry["next_mm"] = contact.nearest_m ? Json(millimetres(*contact.nearest_m)) : Json(nullptr);
    json["contacts"].push_back(std::move(entry));
  }
  for (std::size_t i = 0; i < kStandings; ++i)
    json["standstills"][std::string(kStandingNames[i])] = count_of(found, static_cast<Standing>(i));
  const Eigen::Vector3d tool_mm = 1e3 * found.tool_m;
  json["tool_mm"] = Json::array({tool_mm.x(), tool_mm.y(), tool_mm.z()});
  json["assumed"] = recordings.assumed;
  json["notes"] = found.notes;
  json["files"] = files;
  return json.dump() + '\n';
}

WrittenFile standstills_file(const Recordings& recordings, const RecordedContacts& found) {
  CsvTable table{"",
                 0,
                 {"pose", "contact", "standing", "log", "first_line", "last_line", "start_s", "duration_s", "x_mm",
                  "y_mm", "z_mm", "from_contact_mm", "moved_mm"},
                 {}};
  std::size_t poses = 0;
  for (const JudgedStandstill& one : found.standstills) {
    const bool touches = one.standing == Standing::touches;
    table.rows.push_back(
        {0,
         {touches ? "P" + std::to_string(++poses) : "", found.contacts[*one.contact].name,
          std::string(to_string(one.standing)), recordings.logs[one.at.log].file, std::to_string(one.at.first_line),
          std::to_string(one.at.last_line), fmt::format("{:.3f}", one.at.start_s),
          fmt::format("{:.3f}", one.at.duration_s), mm_cell(one.place_m.x()), mm_cell(one.place_m.y()),
          mm_cell(one.place_m.z()), mm_cell(one.from_contact_m), mm_cell(one.moved_m)}});
  }
  return {"standstills.csv", csv_text(table)};
}

}  // namespace demecal::inline preparation
