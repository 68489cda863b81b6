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
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data/stated_radius.hpp"
#include "data_check/searches.hpp"
#include "kinematics/units.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "prediction/place_uncertainty.hpp"
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

using NamePair = std::pair<std::string, std::string>;

/// Known lengths, some of them wrong in all sets, against the places that poses touch.
class ExchangedPlaces {
 public:
  ExchangedPlaces(const std::vector<KnownDistance>& lengths, const MedianPlaces& places, double apart_m)
      : lengths_(lengths), places_(places), apart_m_(apart_m) {}

  /// The pairs of names of which one exchange alone makes all lengths right: the symmetry of a grid has several alike.
  std::vector<NamePair> all() const {
    constexpr std::size_t kFewestWrong = 2;  // one length alone is as wrong as its ends may be
    constexpr double kAlike = 4.0;           // times the least squares
    std::set<std::string> suspects, names;
    std::size_t wrong = 0;
    for (const KnownDistance& known : lengths_) {
      if (is_radius(known)) continue;
      names.insert({known.first, known.second});
      if (squares_m2(known)) continue;
      ++wrong;
      suspects.insert({known.first, known.second});
    }
    if (wrong < kFewestWrong) return {};
    std::map<NamePair, double> left_m2;
    for (const std::string& first : suspects)
      for (const std::string& second : names)
        if (first != second)
          if (const auto left = squares_m2(NamePair{std::min(first, second), std::max(first, second)}))
            left_m2[{std::min(first, second), std::max(first, second)}] = *left;
    double least_m2 = std::numeric_limits<double>::infinity();
    for (const auto& [pair, left] : left_m2) least_m2 = std::min(least_m2, left);
    std::vector<NamePair> alike;
    for (const auto& [pair, left] : left_m2)
      if (left <= kAlike * least_m2) alike.push_back(pair);
    return alike;
  }

 private:
  /// Of one length in all sets; nothing where it is wrong in any.
  std::optional<double> squares_m2(const KnownDistance& known) const {
    double squares = 0.0;
    for (const ComparedLength& one : compared(known, places_, apart_m_)) {
      if (one.is_wrong(apart_m_)) return std::nullopt;
      squares += std::pow(one.by_arm_m - known.length_m, 2);
    }
    return squares;
  }

  /// Of all lengths with these names exchanged.
  std::optional<double> squares_m2(const NamePair& pair) const {
    double squares = 0.0;
    for (KnownDistance known : lengths_) {
      if (is_radius(known)) continue;
      for (std::string* name : {&known.first, &known.second})
        if (*name == pair.first || *name == pair.second) *name = *name == pair.first ? pair.second : pair.first;
      const std::optional<double> own = squares_m2(known);
      if (!own) return std::nullopt;
      squares += *own;
    }
    return squares;
  }

  const std::vector<KnownDistance>& lengths_;
  const MedianPlaces& places_;
  double apart_m_;
};

/// Lengths that are all right once two names are exchanged: `one` is the first that is wrong.
Finding of_exchanged_places(const ComparedLength& one, const std::vector<NamePair>& pairs, const DataSet& data) {
  constexpr std::size_t kMost = 4;
  std::vector<std::string> words;
  for (const auto& [first, second] : pairs) words.push_back(fmt::format("'{}' and '{}'", first, second));
  if (words.size() > kMost) {
    const std::size_t more = words.size() - kMost;
    words.resize(kMost);
    words.back() += fmt::format(" (or one of {} other pairs)", more);
  }
  Finding finding{.kind = FindingKind::targets_exchanged,
                  .as_given_mm = millimetres(std::abs(one.by_arm_m - one.known->length_m))};
  finding.sentence =
      in_words(one) +
      fmt::format(
          ": all known lengths agree once the names of {} are exchanged{}. Correct the names of the poses, or {}.",
          fmt::join(words, ", or of "),
          pairs.size() > 1 ? ", which the lengths between the places cannot tell apart" : "", one.known->key());
  if (pairs.size() > 1) return finding;
  for (const MeasuredPose& pose : data.poses)
    if (pose.contact == pairs.front().first || pose.contact == pairs.front().second)
      finding.poses.push_back(pose.pose_id);
  return finding;
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
                                 "the names under {}, or the robot's lengths.",
                                 one.by_arm_m / one.known->length_m, one.known->key())
                   : fmt::format(": the length fits if it is in {} where millimetres are stated. Give {} in mm.",
                                 unit->name, one.known->key()))};
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

}  // namespace

std::vector<Finding> find_wrong_lengths(const DataSet& data, const CorrectedRobot& robot, double apart_m) {
  const MedianPlaces places = median_places(data, robot);
  std::vector<Finding> found;
  std::optional<std::vector<NamePair>> exchanged;  // looked for where a length is wrong in all sets
  for (const KnownDistance& known : data.contacts.distances) {
    const std::vector<ComparedLength> all = compared(known, places, apart_m);
    const auto is_wrong = [apart_m](const ComparedLength& one) { return one.is_wrong(apart_m); };
    const auto first = std::ranges::find_if(all, is_wrong);
    if (first == all.end()) continue;
    const bool everywhere = std::ranges::all_of(all, is_wrong);
    if (everywhere && !exchanged) exchanged = ExchangedPlaces(data.contacts.distances, places, apart_m).all();
    if (everywhere && !exchanged->empty()) return {of_exchanged_places(*first, *exchanged, data)};
    found.push_back(everywhere ? wrong_everywhere(*first) : wrong_in_one_set(*first, data, places));
  }
  return worst_lengths(std::move(found));
}

std::vector<std::string_view> length_keys(const Contacts& contacts) {
  std::vector<std::string_view> keys;
  for (const KnownDistance& known : contacts.distances)
    if (!is_radius(known) && std::ranges::find(keys, known.key()) == keys.end()) keys.push_back(known.key());
  return keys;
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
