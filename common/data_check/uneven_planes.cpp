#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data_check/searches.hpp"
#include "data_check/touched_contacts.hpp"
#include "kinematics/units.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/corrected_robot.hpp"
#include "random/distributions.hpp"
#include "trials/finding.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kMuchMore = 3.0;  ///< times what touches of other contacts scatter by
constexpr double kNotFlat_m = 5e-5;
constexpr std::size_t kFewestOnPlane = 10, kFewestElsewhere = 6;

/// How far touches are from their contact, those that hardly show it apart.
std::vector<double> distances_m(const TouchedContacts& touched, const ContactGroup& group) {
  std::vector<double> all = touched.errors_m(group);
  std::erase_if(all, [](double error_m) { return error_m <= 0.0; });
  return all;
}

/// What touches of all other contacts scatter by along a coordinate (median); nothing where they are too few.
std::optional<double> scatter_elsewhere_m(const TouchedContacts& touched, const ContactGroup& plane) {
  std::vector<double> elsewhere_m;
  for (const auto& [group, members] : touched.groups()) {
    if (group.set != PoseSet::calibration || group.contact == plane.contact) continue;
    for (const double distance_m : distances_m(touched, group))
      elsewhere_m.push_back(distance_m / normal_length_quantile(rows_of(touched.kind_of(group)), 0.5));
  }
  if (elsewhere_m.size() < kFewestElsewhere) return std::nullopt;
  return median(std::move(elsewhere_m));
}

/// Of two planes, parallel to the fitted one, that all touches lie between.
double height_m(const TouchedContacts& touched, const ContactGroup& group, const CorrectedRobot& robot) {
  const ContactPlace plane = touched.place(group);
  double lowest = 0.0, highest = 0.0;
  for (const std::size_t pose : touched.kept(group)) {
    const double off_m = contact_residual(plane, touch_of(robot, touched.data().poses[pose]))[0];
    lowest = std::min(lowest, off_m);
    highest = std::max(highest, off_m);
  }
  return highest - lowest;
}

Finding of_uneven_plane(const std::string& plane, std::vector<std::string> touches, double own_m, double others_m,
                        double height) {
  const std::size_t count = touches.size();
  return {.kind = FindingKind::uneven_plane,
          .poses = std::move(touches),
          .as_given_mm = millimetres(own_m),
          .if_changed_mm = millimetres(others_m),
          .sentence = fmt::format(
              "Plane '{0}' is not flat, or was touched otherwise than the rest: its {1} calibration touches scatter by "
              "{2} about it, those of other contacts by {3}. As it is it bends the fitted arm. They lie between two "
              "planes {4} apart: lay a straightedge across it, and state contacts.flatness_mm: {{{0}: {5:.2g}}} if it "
              "shows as much, so that its touches weigh less.",
              plane, count, distance_text(own_m), distance_text(others_m), distance_text(height), millimetres(height))};
}

}  // namespace

std::vector<Finding> find_uneven_planes(const TouchedContacts& touched, const CorrectedRobot& robot) {
  std::vector<Finding> found;
  for (const auto& [group, members] : touched.groups()) {
    if (group.set != PoseSet::calibration || touched.kind_of(group) != ContactKind::plane) continue;
    const std::vector<double> own = distances_m(touched, group);
    const std::optional<double> others_m = scatter_elsewhere_m(touched, group);
    if (own.size() < kFewestOnPlane || !others_m) continue;
    double squares = 0.0;
    for (const double distance_m : own) squares += distance_m * distance_m;
    const double own_m = std::sqrt(squares / static_cast<double>(own.size()));
    if (own_m <= std::max(kNotFlat_m, kMuchMore * *others_m)) continue;
    std::vector<std::string> names;
    for (const std::size_t pose : members) names.push_back(touched.data().poses[pose].pose_id);
    found.push_back(
        of_uneven_plane(group.contact, std::move(names), own_m, *others_m, height_m(touched, group, robot)));
  }
  return found;
}

}  // namespace demecal::inline data_check
