#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "preparation/joint_log.hpp"
#include "preparation/recorded_contacts.hpp"
#include "preparation/touched_places.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "errors/input_error.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline preparation {
namespace {

constexpr double kClearGap = 1.6;  ///< ratio of mean distances between and within places
constexpr double kErrorsOfArm_m = 5e-3;
constexpr double kSureApart = 2.0;  ///< times the scatter of two contacts together
constexpr double kToolElsewhere_m = 5e-3;
constexpr std::size_t kFewPoses = 6;

std::string gap_note(const PlaceGroups& groups) {
  if (groups.nearest_apart_m >= kClearGap * std::max(groups.widest_within_m, kErrorsOfArm_m)) return "";
  return fmt::format(
      "no clear gap between places that are one and places that are not ({:.0f} and {:.0f} mm): look at "
      "standstills.csv, and set log.gap_mm",
      millimetres(groups.widest_within_m), millimetres(groups.nearest_apart_m));
}

void add_near_contacts(const RecordedContacts& found, std::vector<std::string>& notes) {
  for (std::size_t i = 0; i < found.contacts.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const RecordedContact &one = found.contacts[j], &other = found.contacts[i];
      const double apart_m = (one.place_m - other.place_m).norm();
      if (apart_m >= kSureApart * (one.scatter_m + other.scatter_m)) continue;
      notes.push_back(fmt::format(
          "contacts {} and {} are {:.1f} mm apart, and their poses scatter by {:.1f} and {:.1f} mm: some may be at the "
          "other one",
          one.name, other.name, millimetres(apart_m), millimetres(one.scatter_m), millimetres(other.scatter_m)));
    }
  }
}

/// Sums over contacts of squared distances from the mean of each, as the tool point taken and as the robot file's
/// place their poses.
struct Scatters {
  double taken_m2 = 0.0, nominal_m2 = 0.0;
};
Scatters scatters(const Recordings& recordings, const RecordedContacts& found) {
  std::map<std::size_t, std::vector<const JudgedStandstill*>> poses;
  for (const JudgedStandstill& one : found.standstills)
    if (one.standing == Standing::touches) poses[*one.contact].push_back(&one);
  Scatters sums;
  for (const auto& [contact, standstills] : poses) {
    const double share = 1.0 / static_cast<double>(standstills.size());
    Eigen::Vector3d taken_m = Eigen::Vector3d::Zero(), nominal_m = Eigen::Vector3d::Zero();
    for (const JudgedStandstill* one : standstills) {
      taken_m += share * one->place_m;
      nominal_m += share * tool_position(recordings.robot.chain, one->at.joints);
    }
    for (const JudgedStandstill* one : standstills) {
      sums.taken_m2 += (one->place_m - taken_m).squaredNorm();
      sums.nominal_m2 += (tool_position(recordings.robot.chain, one->at.joints) - nominal_m).squaredNorm();
    }
  }
  return sums;
}

std::string tool_note(const Recordings& recordings, const RecordedContacts& found) {
  constexpr double kFarWorse = 2.0;
  const double off_m = (found.tool_m - recordings.robot.chain.tool_m).norm();
  const Scatters sums = scatters(recordings, found);
  if (off_m < kToolElsewhere_m || sums.nominal_m2 < kFarWorse * sums.taken_m2) return "";
  return fmt::format(
      "the standstills agree best with the tool point at [{:.1f}, {:.1f}, {:.1f}] mm in the flange's frame, {:.0f} mm "
      "from where the robot file has it. It was taken to group them and for nothing else: correct tool_mm, or let the "
      "calibration declare `tool`",
      millimetres(found.tool_m.x()), millimetres(found.tool_m.y()), millimetres(found.tool_m.z()), millimetres(off_m));
}

}  // namespace

void check_names(const Recordings& recordings, const RecordedContacts& found) {
  std::vector<std::string> names;
  for (const RecordedContact& contact : found.contacts) names.push_back(contact.name);
  if (!recordings.names.empty() && recordings.names.size() != names.size())
    throw InputError({recordings.file, recordings.names_line}, "",
                     fmt::format("log.names names {} contacts, but {} were found in the log: leave the key out, and "
                                 "look at standstills.csv",
                                 recordings.names.size(), names.size()));
  for (std::size_t i = 0; i < recordings.distances.size(); ++i) {
    for (const std::string& name : {recordings.distances[i].first, recordings.distances[i].second}) {
      if (std::ranges::find(names, name) != names.end()) continue;
      throw InputError({recordings.file, recordings.distance_lines[i]}, name,
                       fmt::format("is none of the contacts that were found in the log: {}", fmt::join(names, ", ")));
    }
  }
}

std::vector<std::string> grouping_notes(const Recordings& recordings, const RecordedContacts& found,
                                        const PlaceGroups& groups,
                                        const std::vector<std::optional<std::size_t>>& contact_of_group) {
  std::vector<std::string> notes;
  if (std::string tool = tool_note(recordings, found); !tool.empty()) notes.push_back(std::move(tool));
  if (std::string gap = gap_note(groups); !gap.empty() && !recordings.gap_m) notes.push_back(std::move(gap));
  for (const DoubtfulSplit& split : groups.doubtful) {
    const auto& contact = contact_of_group[split.group];
    if (contact)
      notes.push_back(
          fmt::format("contact {} may be two, {:.1f} mm apart, with {} and {} poses: if so, set log.gap_mm "
                      "below that",
                      found.contacts[*contact].name, millimetres(split.apart_m), split.first, split.second));
  }
  add_near_contacts(found, notes);
  for (const RecordedContact& contact : found.contacts)
    if (contact.poses < kFewPoses)
      notes.push_back(fmt::format("contact {} has only {} poses: its own place takes three numbers of them",
                                  contact.name, contact.poses));
  return notes;
}

}  // namespace demecal::inline preparation
