#include "updating/learned_drift.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "closed_calibration/calibrated_model.hpp"
#include "effects/effect.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"
#include "updating/fleet_curves.hpp"
#include "updating/fleet_numbers.hpp"
#include "updating/motion_sizes.hpp"

namespace demecal::inline updating {
namespace {

struct DriftKind {
  double AssumedDrift::*size;
  std::string_view words;
  std::string_view unit;
};

constexpr std::array<DriftKind, 5> kDriftKinds{{{&AssumedDrift::offset_rad, "zeros of joints", "mrad"},
                                                {&AssumedDrift::angle_rad, "other angles of links", "mrad"},
                                                {&AssumedDrift::length_m, "lengths", "mm"},
                                                {&AssumedDrift::transmission_rad, "gears and encoders", "mrad"},
                                                {&AssumedDrift::effect_motion, "other effects", "mrad or mm"}}};

/// The place in kDriftKinds.
int drift_kind(const ParameterId& id, const CorrectedRobot& robot) {
  double AssumedDrift::*size = &AssumedDrift::angle_rad;
  if (id.kind == ParameterId::Kind::effect) {
    const bool of_transmission = is_of_transmission(robot.effects[static_cast<std::size_t>(id.index)]);
    size = of_transmission ? &AssumedDrift::transmission_rad : &AssumedDrift::effect_motion;
  } else if (!id.is_angle()) {
    size = &AssumedDrift::length_m;
  } else if (id.link == LinkParameter::theta) {
    size = &AssumedDrift::offset_rad;
  }
  return static_cast<int>(std::ranges::find(kDriftKinds, size, &DriftKind::size) - kDriftKinds.begin());
}

using Models = std::vector<const CalibratedModel*>;

/// Effects of all models that move the arm at the poses; what one model lacks another may have found by more poses.
std::vector<Effect> common_effects(const Models& models, const DataSet& data, std::span<const std::size_t> poses) {
  CorrectedRobot robot = nominal_robot(data);
  robot.effects = united_effects(models);
  const auto motions = unit_motion_sizes(robot, data, poses);
  std::vector<Effect> common;
  for (std::size_t i = 0; i < robot.effects.size(); ++i) {
    const bool everywhere = std::ranges::all_of(models, [&](const CalibratedModel* model) {
      return std::ranges::any_of(model->robot.effects,
                                 [&](const Effect& own) { return same_effect(own, robot.effects[i]); });
    });
    if (everywhere && std::ranges::min(motions[i]) > 0.0) common.push_back(robot.effects[i]);
  }
  return common;
}

/// The models' numbers in units of how far drift is stated to take them from their mean.
struct InUnitsOfDrift {
  std::vector<KnownNumbers> models;
  std::vector<int> kinds;  ///< by number, places in kDriftKinds
  Eigen::VectorXd maker_precision;
};

InUnitsOfDrift in_units_of_drift(const FleetNumbers& numbers, const CorrectedRobot& robot,
                                 const std::vector<std::vector<double>>& motions) {
  InUnitsOfDrift result;
  Eigen::VectorXd units = numbers.sizes().cwiseInverse();
  for (std::size_t i = 0; i < numbers.ids().size(); ++i) {
    const ParameterId& id = numbers.ids()[i];
    result.kinds.push_back(drift_kind(id, robot));
    // Two measurements are apart by the root of 2 times what each is from the mean.
    double stated = AssumedDrift{}.*kDriftKinds[static_cast<std::size_t>(result.kinds.back())].size / std::sqrt(2.0);
    if (id.kind == ParameterId::Kind::effect)
      stated /= motions[static_cast<std::size_t>(id.index)][static_cast<std::size_t>(id.coefficient)];
    units[static_cast<Eigen::Index>(i)] *= stated;
  }
  result.maker_precision = units.cwiseAbs2().cwiseProduct(numbers.maker_precision());
  for (const KnownNumbers& known : numbers.known())
    result.models.push_back(
        {units.asDiagonal() * known.information * units.asDiagonal(), units.cwiseProduct(known.weighted)});
  return result;
}

[[noreturn]] void refuse_to_learn(const NamedModel& model, const std::string& what) {
  throw InputError({model.file, 0}, model.model.data_name, what);
}

}  // namespace

void require_models_of_one_robot(const std::vector<NamedModel>& models) {
  if (models.size() < 2) return;
  const NamedModel& first = models.front();
  for (const NamedModel& one : models) {
    if (one.model.fleet)
      refuse_to_learn(one, "is a fleet's mean: how a robot drifts is told by models of that robot alone");
    if (!one.model.posterior)
      refuse_to_learn(one, "states no covariance of its numbers (it is of an older version): calibrate again");
    const std::string difference = first_difference(first.model.nominal.chain, one.model.nominal.chain);
    if (!difference.empty())
      refuse_to_learn(
          one, fmt::format("is another arm than that of {}: {}; how a robot drifts is told by models of that robot "
                           "alone",
                           first.file, difference));
    const auto same = std::ranges::find_if(models, [&](const NamedModel& other) {
      return &other < &one && !one.model.data_sha256.empty() && other.model.data_sha256 == one.model.data_sha256;
    });
    if (same != models.end())
      refuse_to_learn(
          one, fmt::format("is what {} was calibrated from as well: models of the same poses do not tell how the "
                           "robot drifts between two measurements",
                           same->file));
    const std::string latest = first.model.certificate.text("date"), date = one.model.certificate.text("date");
    if (!latest.empty() && date > latest)
      refuse_to_learn(one, fmt::format("was measured on {}, later than {} of {}: the latest model is to be named first",
                                       date, latest, first.file));
  }
}

LearnedDrift learned_drift(const std::vector<NamedModel>& models, const DataSet& data,
                           std::span<const std::size_t> poses) {
  require_models_of_one_robot(models);
  Models all;
  for (const auto& [file, model] : models) all.push_back(&model);
  CorrectedRobot robot = nominal_robot(data);
  robot.effects = common_effects(all, data, poses);
  const FleetNumbers numbers(all, robot, fleet_curves(all).average);
  const InUnitsOfDrift known = in_units_of_drift(numbers, robot, unit_motion_sizes(robot, data, poses));
  const Eigen::VectorXd times = group_spread(known.models, known.kinds, known.maker_precision);
  LearnedDrift learned;
  std::vector<std::string> sizes;
  for (std::size_t kind = 0; kind < kDriftKinds.size(); ++kind) {
    if (std::ranges::find(known.kinds, static_cast<int>(kind)) == known.kinds.end()) continue;
    double& size = learned.drift.*kDriftKinds[kind].size;
    const double stated = size;
    size *= times[static_cast<Eigen::Index>(kind)];
    sizes.push_back(fmt::format("{} {:.2g} {} ({:g} is usual)", kDriftKinds[kind].words, 1e3 * size,
                                kDriftKinds[kind].unit, 1e3 * stated));
  }
  learned.sentence = fmt::format("How far this robot drifts between two measurements, by its {} models: {}.",
                                 models.size(), fmt::join(sizes, ", "));
  return learned;
}

}  // namespace demecal::inline updating
