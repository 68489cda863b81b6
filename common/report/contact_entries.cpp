#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "closed_calibration/one_place.hpp"
#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "kinematics/units.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "report/evaluation.hpp"
#include "report/length_entries.hpp"
#include "report/pose_places.hpp"
#include "report/report.hpp"

namespace demecal::inline report {
namespace {

std::optional<double> rms_mm(const DataSet& data, const CorrectedRobot& robot, const std::vector<std::size_t>& poses) {
  return if_finite(error_figures(robot, data, poses).rms_mm);
}

/// What calibration at one place cannot see; empty where there are several.
std::string one_place_sentence(const DataSet& data, const CorrectedRobot& robot) {
  if (contact_groups(data, poses_of(data, PoseSet::calibration)).size() == 1) return one_contact_sentence();
  const std::optional<double> apart_m = one_place_m(data, robot);
  if (!apart_m) return {};
  return fmt::format(
      "All contacts that calibration poses touch lie within {:.0f} mm: links and effects were found and judged at one "
      "place, and may be wrong by much more elsewhere. A second place, some 300 mm away, would show it.",
      millimetres(*apart_m));
}

/// Wires whose lengths the calibration poses find too long or too short; empty where none is by far.
std::string wire_zeros_sentence(const DataSet& data, const CorrectedRobot& robot) {
  constexpr double kNotable_m = 1e-3;
  constexpr std::size_t kTelling = 20;  ///< lengths of a wire that tell its zero
  const CorrectedRobot placed = with_own_contacts(robot, data);
  std::string wires;
  for (const auto& [group, poses] : contact_groups(data, poses_of(data, PoseSet::calibration))) {
    if (poses.size() < kTelling || !(data.poses[poses.front()].contact_length_m > 0.0)) continue;
    const double too_long_m = -placed.contacts.at(group).radius_m;
    if (std::abs(too_long_m) < kNotable_m) continue;
    wires += fmt::format("{}'{}' {:.1f} mm too {}", wires.empty() ? "" : ", ", group.contact,
                         millimetres(std::abs(too_long_m)), too_long_m > 0.0 ? "long" : "short");
  }
  if (wires.empty()) return {};
  return "Wires read, by all poses together: " + wires +
         ". The model allows for it; set their zeros before others use them.";
}

}  // namespace

bool touches_one_contact_alone(const DataSet& data) {
  const auto groups = contact_groups(data, poses_of(data, PoseSet::calibration));
  return groups.size() == 1 && !has_instrument(data);
}

std::string one_contact_sentence() {
  return "All calibration poses touch one contact: what moves all of them together is not seen, such as an error of "
         "the "
         "first joint that depends on its angle alone. No error over the workspace is predicted from one contact "
         "alone. A second contact elsewhere would show it.";
}

std::optional<WorkspaceEntry> without_figures_of_one_contact(std::optional<WorkspaceEntry> error, const DataSet& data) {
  if (error && touches_one_contact_alone(data)) {
    error->rms_mm.reset();
    error->p95_mm.reset();
  }
  return error;
}

std::vector<ContactEntry> contact_entries(const DataSet& data, const CorrectedRobot& registered,
                                          const CorrectedRobot& before, const CorrectedRobot& after) {
  std::vector<ContactEntry> entries;
  for (const auto& [group, poses] : contact_groups(data)) {
    entries.push_back({group.contact, std::string(to_string(group.set)),
                       std::string(to_string(data.contacts.form_of(group.contact).kind)), poses.size(),
                       rms_mm(data, registered, poses), rms_mm(data, before, poses), rms_mm(data, after, poses)});
  }
  return entries;
}

std::string second_place_sentence(const DataSet& data, const CalibratedModel& model,
                                  const std::vector<std::size_t>& poses) {
  constexpr std::size_t kMost = 4;
  if (touches_one_contact_alone(data) || !one_place_m(data, model.robot)) return {};
  const std::optional<SecondPlace> second = second_place(data, model, poses);
  if (!second) return {};
  Eigen::Index axis = 0;
  second->away_m.cwiseAbs().maxCoeff(&axis);
  std::vector<std::string> links;
  for (std::size_t i = 0; i < std::min(kMost, second->links.size()); ++i) links.push_back(second->links[i].name());
  const std::string most =
      links.empty() ? "" : fmt::format(", since this place hardly shows {}", fmt::join(links, ", "));
  return fmt::format(
      " With as many poses at the same contacts {:.0f} mm away along the base's {}{} the error predicted over the "
      "workspace would be {:.2f} mm (rms) in place of {:.2f} mm{}.",
      millimetres(second->away_m.norm()), second->away_m[axis] > 0.0 ? '+' : '-', "xyz"[axis],
      millimetres(second->both_m), millimetres(second->one_place_m), most);
}

std::vector<std::string> contact_notes(const DataSet& data, const CorrectedRobot& robot,
                                       const std::vector<LengthErrorEntry>& lengths,
                                       const std::vector<std::string>& fitted_sets, const std::string& second_place) {
  if (!has_contacts(data)) return {};
  std::vector<std::string> notes;
  for (std::string sentence : {unfitted_lengths_sentence(data, lengths, fitted_sets), untold_lengths_sentence(data)})
    if (!sentence.empty()) notes.push_back(std::move(sentence));
  if (!has_instrument(data)) {
    if (std::string sentence = one_place_sentence(data, robot); !sentence.empty()) {
      notes.push_back(sentence + second_place);
    }
    if (std::string sentence = wire_zeros_sentence(data, robot); !sentence.empty())
      notes.push_back(std::move(sentence));
    if (std::string sentence = unknown_scale_sentence(data); !sentence.empty()) notes.push_back(std::move(sentence));
    notes.emplace_back(
        "Contacts do not tell where the arm stands: its base is neither needed nor fitted, and the first joint's zero, "
        "height and what lies before its axis stay as described.");
  }
  notes.emplace_back(
      "Tool errors here are distances from where all poses of a contact and set have it on average: they show how well "
      "the poses agree, and not errors that they share.");
  return notes;
}

}  // namespace demecal::inline report
