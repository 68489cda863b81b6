#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data_check/searches.hpp"
#include "decompositions/decompositions.hpp"
#include "kinematics/units.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"
#include "trials/finding.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kLengthOff_m = 8e-3;  ///< what an arm that is as far off as makers' figures may have a length wrong by
constexpr double kLengthOffShare = 0.05;  ///< the same of a long one
constexpr double kSameFactor = 0.15;      ///< relative: how near a factor is to that of a unit

struct LengthUnit {
  double factor;  ///< of the number, over that in mm
  const char* name;
};
constexpr std::array<LengthUnit, 5> kLengthUnits{
    {{1e-3, "metres"}, {0.1, "centimetres"}, {1 / 25.4, "inches"}, {1 / 304.8, "feet"}, {1e3, "micrometres"}}};

/// A known length, and what the arm makes of it in one set that touches both its ends.
struct ComparedLength {
  const KnownDistance* known = nullptr;
  PoseSet set = PoseSet::calibration;
  double by_arm_m = 0.0;
  double open_m = 0.0;  ///< what few touches leave open of where planes and spheres are

  bool is_wrong(double apart_m) const {
    return std::abs(by_arm_m - known->length_m) >
           std::max(kLengthOff_m, 2.0 * apart_m) + kLengthOffShare * std::max(by_arm_m, known->length_m) + open_m;
  }
  const LengthUnit* unit() const {
    const auto fits = [this](const LengthUnit& one) {
      return std::abs(known->length_m / one.factor - by_arm_m) < kLengthOff_m + kSameFactor * by_arm_m;
    };
    const auto* const found = std::ranges::find_if(kLengthUnits, fits);
    return found == kLengthUnits.end() ? nullptr : found;
  }
};

struct TouchedPlace {
  ContactPlace place;
  std::vector<Touch> touches;
};
using MedianPlaces = std::map<ContactGroup, TouchedPlace>;

/// Where the poses of every contact and set have it; of points the median along each axis, which a few poses at another
/// contact cannot move.
MedianPlaces median_places(const DataSet& data, const CorrectedRobot& robot) {
  MedianPlaces places;
  for (const auto& [group, members] : contact_groups(data)) {
    std::vector<Touch> touches;
    for (const std::size_t pose : members) touches.push_back(touch_of(robot, data.poses[pose]));
    const ContactForm form = data.contacts.form_of(group.contact);
    ContactPlace place = contact_place(form, touches);
    for (int axis = 0; form.kind == ContactKind::point && axis < 3; ++axis) {
      std::vector<double> along;
      for (const Touch& touch : touches) along.push_back(touch.point_m[axis]);
      place.frame.translation()[axis] = median(along);
    }
    places[group] = {place, std::move(touches)};
  }
  return places;
}

/// Those of one length in every set.
std::vector<ComparedLength> compared(const KnownDistance& known, const MedianPlaces& places, double apart_m) {
  constexpr double kDeviations = 3.0;
  const auto open_m2 = [&](const TouchedPlace& own, const TouchedPlace& other) {
    return own.place.kind == ContactKind::point ? 0.0 : placed_m2(own.place, own.touches, other.place, apart_m);
  };
  std::vector<ComparedLength> all;
  for (const PoseSet set : {PoseSet::calibration, PoseSet::validation, PoseSet::accept}) {
    const auto first = places.find({known.first, set}), second = places.find({known.second, set});
    if (first == places.end() || second == places.end()) continue;
    const TouchedPlace &one = first->second, &other = second->second;
    all.push_back({&known, set, place_distance(one.place, other.place).length_m,
                   kDeviations * std::sqrt(open_m2(one, other) + open_m2(other, one))});
  }
  return all;
}

double apart_m(const TouchedPlace& one, const TouchedPlace& other) {
  return (one.place.frame.translation() - other.place.frame.translation()).norm();
}

/// Two contacts of a set of which each stands where the other does in another set, one of them `contact`.
struct ExchangedNames {
  std::string first, second;
};
std::optional<ExchangedNames> exchange_about(const std::string& contact, PoseSet set, const MedianPlaces& places) {
  constexpr double kNearShare = 0.3;  ///< of the distance between the two
  for (const PoseSet other : {PoseSet::calibration, PoseSet::validation, PoseSet::accept}) {
    const auto own = places.find({contact, set}), elsewhere = places.find({contact, other});
    if (other == set || own == places.end() || elsewhere == places.end()) continue;
    for (const auto& [group, place] : places) {
      if (group.set != set || group.contact == contact) continue;
      const auto there = places.find({group.contact, other});
      if (there == places.end()) continue;
      const double near_m = kNearShare * apart_m(there->second, elsewhere->second);
      if (apart_m(own->second, there->second) < near_m && apart_m(place, elsewhere->second) < near_m)
        return ExchangedNames{std::min(contact, group.contact), std::max(contact, group.contact)};
    }
  }
  return std::nullopt;
}

std::string in_words(const ComparedLength& one) {
  return fmt::format("'{}' and '{}' are {:.4g} mm apart as given, and {:.4g} mm by the joints", one.known->first,
                     one.known->second, millimetres(one.known->length_m), millimetres(one.by_arm_m));
}

/// A length that no set of poses has as it is given: `one` is one of them.
Finding wrong_everywhere(const ComparedLength& one) {
  const LengthUnit* const unit = one.unit();
  return {.kind = unit == nullptr ? FindingKind::wrong_length : FindingKind::unit,
          .as_given_mm = millimetres(std::abs(one.by_arm_m - one.known->length_m)),
          .sentence =
              in_words(one) +
              (unit == nullptr
                   ? fmt::format(" ({:.3g} times as far), which no error of this arm explains: correct the length or "
                                 "the names under contacts.distances, or the robot's lengths.",
                                 one.by_arm_m / one.known->length_m)
                   : fmt::format(": the length fits if it is in {} where millimetres are stated. Give "
                                 "contacts.distances in mm.",
                                 unit->name))};
}

/// A length that other sets have as it is given.
Finding wrong_in_one_set(const ComparedLength& one, const DataSet& data, const MedianPlaces& places) {
  std::optional<ExchangedNames> found = exchange_about(one.known->first, one.set, places);
  if (!found) found = exchange_about(one.known->second, one.set, places);
  Finding finding{.kind = FindingKind::wrong_length,
                  .as_given_mm = millimetres(std::abs(one.by_arm_m - one.known->length_m)),
                  .sentence = fmt::format("{} of the {} poses, while other sets have it as given: ", in_words(one),
                                          to_string(one.set))};
  finding.sentence += found ? fmt::format("there '{}' and '{}' are exchanged. Correct the names of that set.",
                                          found->first, found->second)
                            : fmt::format("there '{}' or '{}' names another contact. Correct the names of that set.",
                                          one.known->first, one.known->second);
  const ExchangedNames names = found.value_or(ExchangedNames{one.known->first, one.known->second});
  for (const MeasuredPose& pose : data.poses)
    if (pose.set == one.set && (pose.contact == names.first || pose.contact == names.second))
      finding.poses.push_back(pose.pose_id);
  return finding;
}

/// A place moved by one of its motions.
ContactPlace nudged(ContactPlace place, int motion, double step) {
  const Eigen::Matrix3d axes = place.frame.linear();
  if (motion == kRadiusMotion) {
    place.radius_m += step;
  } else if (motion < 3) {
    place.frame.translation() += step * axes.col(motion);
  } else {
    const Eigen::Vector3d axis = axes.col(motion - 3);
    place.frame.linear() = Eigen::AngleAxisd(step, axis) * axes;
  }
  return place;
}

}  // namespace

double placed_m2(const ContactPlace& own, const std::vector<Touch>& touches, const ContactPlace& other,
                 double noise_m) {
  constexpr double kStep = 1e-6, kUnseen = 1e-9;
  const std::vector<int> motions = motions_of(own);
  const Eigen::Index each = rows_of(own.kind);
  Eigen::MatrixXd rows(each * std::ssize(touches), std::ssize(motions));
  Eigen::VectorXd slopes(std::ssize(motions));
  for (Eigen::Index k = 0; k < slopes.size(); ++k) {
    const ContactPlace moved = nudged(own, motions[static_cast<std::size_t>(k)], kStep);
    slopes[k] = (place_distance(moved, other).length_m - place_distance(own, other).length_m) / kStep;
    for (Eigen::Index i = 0; i < std::ssize(touches); ++i) {
      const Touch& touch = touches[static_cast<std::size_t>(i)];
      rows.block(each * i, k, each, 1) = (contact_residual(moved, touch) - contact_residual(own, touch)) / kStep;
    }
  }
  const auto information = eigen_system(rows.transpose() * rows);
  const double least = kUnseen * information.values.maxCoeff();
  double open_m2 = 0.0;
  for (Eigen::Index i = 0; i < slopes.size(); ++i) {
    const double slope = information.vectors.col(i).dot(slopes);
    if (information.values[i] > least)
      open_m2 += slope * slope / information.values[i];
    else if (std::abs(slope) > kUnseen)
      return std::numeric_limits<double>::infinity();
  }
  return noise_m * noise_m * open_m2;
}

std::vector<Finding> find_wrong_lengths(const DataSet& data, const CorrectedRobot& robot, double apart_m) {
  const MedianPlaces places = median_places(data, robot);
  std::vector<Finding> found;
  for (const KnownDistance& known : data.contacts.distances) {
    const std::vector<ComparedLength> all = compared(known, places, apart_m);
    const auto is_wrong = [apart_m](const ComparedLength& one) { return one.is_wrong(apart_m); };
    const auto first = std::ranges::find_if(all, is_wrong);
    if (first == all.end()) continue;
    const bool everywhere = std::ranges::all_of(all, is_wrong);
    found.push_back(everywhere ? wrong_everywhere(*first) : wrong_in_one_set(*first, data, places));
  }
  return worst_lengths(std::move(found));
}

std::vector<Finding> worst_lengths(std::vector<Finding> found) {
  constexpr std::size_t kMost = 3;
  if (found.size() <= kMost) return found;
  std::ranges::stable_sort(found, std::greater{}, &Finding::as_given_mm);
  const std::size_t more = found.size() - kMost;
  found.resize(kMost);
  found.back().sentence += fmt::format(" {} more known length{} wrong, too.", more, more == 1 ? " is" : "s are");
  return found;
}

}  // namespace demecal::inline data_check
