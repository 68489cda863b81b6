#include "updating/fleet_model.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "calibration/calibration.hpp"
#include "calibration/job.hpp"
#include "calibration/joint_targets.hpp"
#include "data/data_set.hpp"
#include "decompositions/decompositions.hpp"
#include "effects/effect.hpp"
#include "errors/input_error.hpp"
#include "expression/bound.hpp"
#include "fitting/fit.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/parameter_space.hpp"
#include "parameters/posterior.hpp"
#include "prediction/corrected_robot.hpp"
#include "updating/fleet_curves.hpp"
#include "updating/fleet_numbers.hpp"

namespace demecal::inline updating {
namespace {

using Models = std::vector<const CalibratedModel*>;

constexpr double kSameMasses = 1e-9;  ///< m, rad, kg

bool same_masses(const Robot& one, const Robot& other) {
  return std::ranges::equal(one.masses, other.masses, [](const LinkMass& here, const LinkMass& there) {
    return std::abs(here.mass_kg - there.mass_kg) < kSameMasses &&
           (here.centre_m - there.centre_m).norm() < kSameMasses;
  });
}

/// The first difference between two arms as their makers describe them, masses included; empty where there is none.
std::string difference_of_types(const Robot& one, const Robot& other) {
  std::string difference = first_difference(one.chain, other.chain);
  if (difference.empty() && !same_masses(one, other)) difference = "its links' masses are others";
  return difference;
}

void require_one_type(const std::vector<NamedModel>& models) {
  if (models.size() < 2)
    throw InputError({models.empty() ? "" : models[0].file, 0}, "",
                     "is the only model: a fleet takes those of at least 2 robots of one type, better 5");
  const NamedModel& first = models.front();
  for (const NamedModel& one : models) {
    if (one.model.fleet)
      throw InputError({one.file, 0}, "", "is a fleet's mean: give the models that it was made from, and the new ones");
    if (!one.model.posterior)
      throw InputError({one.file, 0}, "",
                       "states no covariance of its numbers (it is of an older version): calibrate again");
    const std::string difference = difference_of_types(first.model.nominal, one.model.nominal);
    if (!difference.empty())
      throw InputError(
          {one.file, 0}, one.model.nominal.name,
          fmt::format("is another arm than that of {}: {}; a fleet is of one type of arm", first.file, difference));
    const auto same = std::ranges::find_if(models, [&](const NamedModel& other) {
      return &other < &one && !one.model.data_sha256.empty() && other.model.data_sha256 == one.model.data_sha256;
    });
    if (same != models.end())
      throw InputError({one.file, 0}, one.model.data_name,
                       fmt::format("is what {} was calibrated from as well: a robot counts once", same->file));
  }
}

/// Where every joint stood in the poses of all; none where a model does not say.
std::vector<Interval> common_ranges(const std::vector<NamedModel>& models) {
  std::vector<Interval> common = models[0].model.measured;
  for (const auto& [file, model] : models) {
    if (model.measured.size() != common.size()) return {};
    for (std::size_t joint = 0; joint < common.size(); ++joint) {
      const Interval &known = common[joint], &own = model.measured[joint];
      const Interval both{std::max(known.lower, own.lower), std::min(known.upper, own.upper)};
      if (both.lower > both.upper)
        throw InputError(
            {file, 0}, "",
            fmt::format("was measured with joint {} where the other models were not: a fleet's models need "
                        "a range that all know",
                        joint + 1));
      common[joint] = both;
    }
  }
  return common;
}

/// How the models err beside their numbers, on average.
std::optional<PredictionInterval> common_interval(const Models& models) {
  PredictionInterval all;
  std::vector<double> quantiles;
  for (const CalibratedModel* model : models) {
    if (!model->interval) return std::nullopt;
    const PredictionInterval& own = *model->interval;
    const auto share = 1.0 / static_cast<double>(models.size());
    all.noise_m += share * own.noise_m * own.noise_m;
    all.distance_noise_m += share * own.distance_noise_m * own.distance_noise_m;
    all.model_error_m += share * own.model_error_m * own.model_error_m;
    all.poses = quantiles.empty() ? own.poses : std::min(all.poses, own.poses);
    all.fitted = all.fitted || own.fitted;
    all.along_path = all.along_path || own.along_path;
    quantiles.push_back(own.quantile);
  }
  std::ranges::sort(quantiles);
  all.quantile = quantiles[quantiles.size() / 2];
  all.noise_m = std::sqrt(all.noise_m);
  all.distance_noise_m = std::sqrt(all.distance_noise_m);
  all.model_error_m = std::sqrt(all.model_error_m);
  return all;
}

DeclaredModel declared_by_any(const Models& models) {
  DeclaredModel all;
  for (const std::string& word : declared_words()) {
    bool DeclaredModel::*const flag = declared_flag(word);
    for (const CalibratedModel* model : models) all.*flag = all.*flag || model->declared.*flag;
  }
  return all;
}

/// The arm with the means in place, and what is stated of every number.
class Mean {
 public:
  Mean(const FleetNumbers& numbers, CorrectedRobot nominal) : nominal_(std::move(nominal)), numbers_(numbers) {}

  void put(CalibratedModel& fleet) const {
    const std::vector<ParameterId>& ids = numbers_.ids();
    const TypeSpread& type = numbers_.type();
    const Eigen::MatrixXd covariance = numbers_.covariance();
    fleet.robot = ParameterSpace(nominal_, ids).at(type.mean).robot;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      const ParameterId& id = ids[i];
      const double of_mean = std::sqrt(type.mean_covariance(at, at)), whole = std::sqrt(covariance(at, at));
      const double value = parameter_value(fleet.robot, id);
      fleet.fleet->numbers.push_back({id.name(), border(id, value), border(id, of_mean), border(id, type.spread[at])});
      if (id.kind != ParameterId::Kind::effect) {
        fleet.estimates.push_back({id, parameter_value(nominal_, id), value, whole});
        continue;
      }
      Effect& effect = fleet.robot.effects[static_cast<std::size_t>(id.index)];
      effect.standard_errors.resize(effect.values.size(), 0.0);
      effect.standard_errors[static_cast<std::size_t>(id.coefficient)] = whole;
    }
    fleet.posterior = Posterior{ids, {}, Cholesky(covariance).lower()};
  }

 private:
  static double border(const ParameterId& id, double value) {
    if (id.kind == ParameterId::Kind::effect) return value;
    return id.is_angle() ? degrees(value) : millimetres(value);
  }

  CorrectedRobot nominal_;
  const FleetNumbers& numbers_;
};

/// Joints whose robots have corrections and their mean none say why.
void summarise_joints(const Models& models, CalibratedModel& fleet) {
  fleet.joints = joint_summaries({}, {}, fleet.robot);
  for (JointSummary& summary : fleet.joints) {
    const auto at = static_cast<std::size_t>(summary.joint);
    const bool lost =
        fleet.robot.corrections[at].is_neutral() && std::ranges::any_of(models, [&](const CalibratedModel* model) {
          return !model->robot.corrections[at].is_neutral();
        });
    if (lost) summary.note = "the robots' corrections have no range in common";
  }
}

}  // namespace

CalibratedModel fleet_model(const std::vector<NamedModel>& models) {
  require_one_type(models);
  Models all;
  CalibratedModel fleet;
  fleet.fleet.emplace();
  for (const auto& [file, model] : models) {
    all.push_back(&model);
    fleet.fleet->robots.push_back({file, model.job, model.data_name, model.data_sha256});
    fleet.approach_recorded = fleet.approach_recorded && model.approach_recorded;
  }
  fleet.job = fmt::format("fleet of {} robots", models.size());
  fleet.data_name = fleet.job;
  fleet.nominal = all[0]->nominal;
  fleet.method = Method::diagnose;
  fleet.declared = declared_by_any(all);
  fleet.measured = common_ranges(models);
  fleet.interval = common_interval(all);
  DataSet none;
  none.robot = fleet.nominal;
  CorrectedRobot robot = nominal_robot(none);
  robot.effects = united_effects(all);
  FleetCurves curves = fleet_curves(all);
  robot.corrections = std::move(curves.mean);
  fleet.fleet->curves = std::move(curves.curves);
  Mean(FleetNumbers(all, robot, curves.average), robot).put(fleet);
  summarise_joints(all, fleet);
  return fleet;
}

void require_one_robot(const CalibratedModel& model, const std::string& file, const std::string& what) {
  if (!model.fleet) return;
  throw InputError({file, 0}, model.job,
                   fmt::format("is the mean of several robots, and {} needs the model of one: make it with `demecal "
                               "calibrate --prior {}`",
                               what, file));
}

}  // namespace demecal::inline updating
