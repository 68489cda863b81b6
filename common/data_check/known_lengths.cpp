#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data_check/finding.hpp"
#include "data_check/searches.hpp"
#include "kinematics/units.hpp"
#include "prediction/measurement.hpp"

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

/// A known length, and what the arm makes of it: the mean over the sets that touch both ends.
struct ComparedLength {
  const KnownDistance* known = nullptr;
  double by_arm_m = 0.0;

  bool is_wrong(double apart_m) const {
    return std::abs(by_arm_m - known->length_m) >
           std::max(kLengthOff_m, 2.0 * apart_m) + kLengthOffShare * std::max(by_arm_m, known->length_m);
  }
  const LengthUnit* unit() const {
    const auto fits = [this](const LengthUnit& one) {
      return std::abs(known->length_m / one.factor - by_arm_m) < kLengthOff_m + kSameFactor * by_arm_m;
    };
    const auto* const found = std::ranges::find_if(kLengthUnits, fits);
    return found == kLengthUnits.end() ? nullptr : found;
  }
};

std::vector<ComparedLength> compared_lengths(const DataSet& data, const CorrectedRobot& robot) {
  std::vector<ComparedLength> all;
  std::map<const KnownDistance*, std::vector<double>> lengths;
  for (const LengthError& one : length_errors(robot, data))
    lengths[one.known].push_back(one.known->length_m + one.error_m);
  for (const KnownDistance& known : data.contacts.distances) {
    const auto found = lengths.find(&known);
    if (found == lengths.end()) continue;
    double sum_m = 0.0;
    for (const double length_m : found->second) sum_m += length_m;
    all.push_back({&known, sum_m / static_cast<double>(found->second.size())});
  }
  return all;
}

std::string in_words(const ComparedLength& one) {
  return fmt::format("'{}' and '{}' are {:.4g} mm apart as given, and {:.4g} mm by the joints", one.known->first,
                     one.known->second, millimetres(one.known->length_m), millimetres(one.by_arm_m));
}

}  // namespace

std::vector<Finding> find_wrong_lengths(const DataSet& data, const CorrectedRobot& robot, double apart_m) {
  std::vector<Finding> found;
  for (const ComparedLength& one : compared_lengths(data, robot)) {
    if (!one.is_wrong(apart_m)) continue;
    const LengthUnit* const unit = one.unit();
    found.push_back({.kind = unit == nullptr ? FindingKind::wrong_length : FindingKind::unit,
                     .as_given_mm = millimetres(std::abs(one.by_arm_m - one.known->length_m)),
                     .sentence = in_words(one)});
    found.back().sentence +=
        unit == nullptr
            ? fmt::format(
                  " ({:.3g} times as far), which no error of this arm explains: correct the length or the names "
                  "under contacts.distances, or the robot's lengths.",
                  one.by_arm_m / one.known->length_m)
            : fmt::format(
                  ": the length fits if it is in {} where millimetres are stated. Give contacts.distances in "
                  "mm.",
                  unit->name);
  }
  return found;
}

}  // namespace demecal::inline data_check
