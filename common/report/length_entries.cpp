#include "report/length_entries.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "data/contacts.hpp"
#include "data/stated_radius.hpp"
#include "kinematics/units.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/measurement.hpp"
#include "prediction/only_places.hpp"
#include "prediction/place_uncertainty.hpp"
#include "report/report.hpp"

namespace demecal::inline report {
namespace {

/// Where the poses of every contact and set have it, and what they scatter about these places by.
class ScatteredTouches {
 public:
  ScatteredTouches(const DataSet& data, const CorrectedRobot& robot) : placed_(with_own_contacts(robot, data)) {
    std::map<PoseSet, TouchScatter> by_set;
    for (const auto& [group, poses] : contact_groups(data)) {
      for (const std::size_t pose : poses) touches_[group].push_back(touch_of(placed_, data.poses[pose]));
      if (only_places(data.contacts.form_of(group.contact), poses.size())) continue;
      const ContactPlace& place = placed_.contacts.at(group);
      TouchScatter own{.free = static_cast<double>(poses.size()) * rows_of(place.kind) -
                               static_cast<double>(motions_of(place).size())};
      for (const Touch& touch : touches_[group]) own.squares_m2 += contact_residual(place, touch).squaredNorm();
      for (TouchScatter* const sum : {&by_set[group.set], &all_}) {
        sum->squares_m2 += own.squares_m2;
        sum->free += own.free;
      }
    }
    by_set_ = std::move(by_set);
  }

  /// What the touches leave open of how far the two are apart in that set, m^2; nothing where they do not tell.
  std::optional<double> open_m2(const KnownDistance& known, PoseSet set) const {
    const auto own = by_set_.find(set);
    const TouchScatter& scatter = own == by_set_.end() || own->second.free <= 0.0 ? all_ : own->second;
    if (scatter.free <= 0.0) return std::nullopt;
    const double noise_m = std::sqrt(scatter.squares_m2 / scatter.free);
    const ContactGroup first{known.first, set}, second{known.second, set};
    const ContactPlace &one = placed_.contacts.at(first), &other = placed_.contacts.at(second);
    const double open =
        placed_m2(one, touches_.at(first), other, noise_m) + placed_m2(other, touches_.at(second), one, noise_m);
    return std::isfinite(open) ? std::optional(open) : std::nullopt;
  }

 private:
  struct TouchScatter {
    double squares_m2 = 0.0, free = 0.0;
  };

  CorrectedRobot placed_;
  std::map<ContactGroup, std::vector<Touch>> touches_;
  std::map<PoseSet, TouchScatter> by_set_;
  TouchScatter all_;
};

std::size_t touches_of(const DataSet& data, const std::string& contact, const std::string& set) {
  return static_cast<std::size_t>(std::ranges::count_if(
      data.poses, [&](const MeasuredPose& pose) { return pose.contact == contact && to_string(pose.set) == set; }));
}

/// "calibration and accept poses touch 'a'".
std::string touched_words(const std::string& contact, const std::set<PoseSet>& sets) {
  std::vector<std::string> names;
  for (const PoseSet set : sets) names.emplace_back(to_string(set));
  if (names.empty()) return fmt::format("no pose that is not excluded touches '{}'", contact);
  return fmt::format("{} poses touch '{}'", fmt::join(names, " and "), contact);
}

/// The known lengths between contacts that calibration poses touch at both ends.
std::size_t fitted_lengths(const DataSet& data) {
  std::set<std::string> touched;
  for (const MeasuredPose& pose : data.poses)
    if (pose.set == PoseSet::calibration) touched.insert(pose.contact);
  return static_cast<std::size_t>(std::ranges::count_if(data.contacts.distances, [&](const KnownDistance& known) {
    return !is_radius(known) && touched.contains(known.first) && touched.contains(known.second);
  }));
}

/// Whether poses hold the tool at a length from something: a wire's, or a sphere's stated radius.
bool shows_lengths(const DataSet& data) {
  if (std::ranges::any_of(data.contacts.distances, is_radius)) return true;
  return std::ranges::any_of(data.poses, [&](const MeasuredPose& pose) {
    return pose.contact_length_m > 0.0 || data.contacts.form_of(pose.contact).radius_m.value_or(0.0) > 0.0;
  });
}

}  // namespace

std::vector<LengthErrorEntry> length_error_entries(const DataSet& data, const CorrectedRobot& robot,
                                                   const CorrectedRobot* before) {
  const std::vector<LengthError> after = length_errors(robot, data);
  if (after.empty()) return {};
  const std::vector<LengthError> first = before == nullptr ? std::vector<LengthError>{} : length_errors(*before, data);
  const ScatteredTouches touches(data, robot);
  std::vector<LengthErrorEntry> entries;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const LengthError& one = after[i];
    LengthErrorEntry entry{{one.known->first, one.known->second},
                           std::string(to_string(one.set)),
                           millimetres(one.known->length_m),
                           millimetres(one.known->sigma_m),
                           {},
                           if_finite(millimetres(one.error_m))};
    if (before != nullptr) entry.before_mm = if_finite(millimetres(first[i].error_m));
    if (const std::optional<double> open_m2 = touches.open_m2(*one.known, one.set))
      entry.uncertainty_mm = millimetres(std::sqrt(*open_m2 + one.known->sigma_m * one.known->sigma_m));
    entries.push_back(std::move(entry));
  }
  return entries;
}

std::string unfitted_lengths_sentence(const DataSet& data, const std::vector<LengthErrorEntry>& lengths,
                                      const std::vector<std::string>& fitted_sets) {
  const auto is_of_fitted_set = [&](const LengthErrorEntry& one) {
    return std::ranges::find(fitted_sets, one.set) != fitted_sets.end();
  };
  const auto was_fitted = [&](const LengthErrorEntry& one) {
    return std::ranges::any_of(lengths, [&](const LengthErrorEntry& other) {
      return is_of_fitted_set(other) && std::ranges::is_permutation(other.between, one.between);
    });
  };
  double squares_mm2 = 0.0, uncertainty_mm2 = 0.0, sigma_mm = 0.0;
  bool is_sure = true;
  std::size_t count = 0;
  std::map<std::pair<std::string, std::string>, std::size_t> ends;  // with their set, and how often each is touched
  for (const LengthErrorEntry& one : lengths) {
    if (!one.error_mm || was_fitted(one)) continue;
    squares_mm2 += *one.error_mm * *one.error_mm;
    is_sure = is_sure && one.uncertainty_mm;
    uncertainty_mm2 += std::pow(one.uncertainty_mm.value_or(0.0), 2);
    sigma_mm = std::max(sigma_mm, one.sigma_mm.value_or(0.0));
    for (const std::string& end : one.between) ends[{one.set, end}] = touches_of(data, end, one.set);
    ++count;
  }
  if (count == 0) return {};
  std::size_t touches = 0;
  for (const auto& [end, times] : ends) touches += times;
  const auto share = static_cast<double>(count);
  std::string text = fmt::format(
      "Accuracy against lengths that nothing was fitted to: off by {:.3f} mm (rms of {}, each known to {:.2g} mm; {} "
      "touches at {} ends)",
      std::sqrt(squares_mm2 / share), count, sigma_mm, touches, ends.size());
  if (is_sure)
    text += fmt::format(", with a standard uncertainty of {:.3f} mm from the lengths and the touches' scatter",
                        std::sqrt(uncertainty_mm2 / share));
  else
    text += ": too few touches to tell how far these scatter";
  return text + (count == 1 ? ". One length judges one place and direction." : ".");
}

std::string untold_lengths_sentence(const DataSet& data) {
  constexpr std::size_t kMost = 3;
  std::map<std::string, std::set<PoseSet>> sets;
  for (const MeasuredPose& pose : data.poses)
    if (!pose.contact.empty()) sets[pose.contact].insert(pose.set);
  std::vector<std::string> untold;
  std::set<std::string> told, of_grids;
  for (const KnownDistance& known : data.contacts.distances) {
    if (is_radius(known)) continue;
    const std::set<PoseSet>&first = sets[known.first], &second = sets[known.second];
    if (std::ranges::any_of(first, [&](PoseSet set) { return second.contains(set); })) {
      told.insert({known.first, known.second});
    } else if (known.of_grid) {
      of_grids.insert({known.first, known.second});
    } else {
      untold.push_back(fmt::format("'{}' to '{}' ({}, {})", known.first, known.second,
                                   touched_words(known.first, first), touched_words(known.second, second)));
    }
  }
  std::string text;
  if (!untold.empty()) {
    const std::size_t more = untold.size() - std::min(kMost, untold.size());
    untold.resize(std::min(kMost, untold.size()));
    text = fmt::format(
        "Known lengths that count nowhere, since no set of poses touches both ends (contacts.distances): {}{}. Touch "
        "both in calibration poses, and the length gives the scale; in accept poses alone, and it judges the model.",
        fmt::join(untold, "; "), more == 0 ? "" : fmt::format("; and {} more", more));
  }
  std::vector<std::string> lone;
  for (const std::string& place : of_grids)
    if (!told.contains(place)) lone.push_back(touched_words(place, sets[place]));
  if (!lone.empty())
    text += fmt::format(
        "{}Places of contacts.grids that are in no length, since no set of poses touches them and another place of "
        "their grid: {}.",
        text.empty() ? "" : " ", fmt::join(lone, "; "));
  return text;
}

std::string unknown_scale_sentence(const DataSet& data) {
  if (has_instrument(data) || fitted_lengths(data) > 0 || shows_lengths(data)) return {};
  return "No length between contacts is known: the scale of the arm is not measured and stays the description's. Two "
         "contacts at a known distance (contacts.distances) would give it.";
}

}  // namespace demecal::inline report
