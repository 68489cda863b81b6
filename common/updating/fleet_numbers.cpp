#include "updating/fleet_numbers.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "expression/bound.hpp"
#include "fitting/fit.hpp"
#include "kinematics/chain.hpp"
#include "parameters/parameter_space.hpp"
#include "parameters/posterior.hpp"

namespace demecal::inline updating {
namespace {

bool is_reference(const std::string& setting) {
  return setting.starts_with("reference_");
}

/// What both ranges hold; the first where they have nothing in common.
void narrow_ranges(MeasuredRanges& ranges, const MeasuredRanges& other) {
  for (auto& [joint, range] : ranges) {
    const auto found = other.find(joint);
    if (found == other.end()) continue;
    const Interval both{std::max(range.lower, found->second.lower), std::min(range.upper, found->second.upper)};
    if (both.lower < both.upper) range = both;
  }
}

/// The inverse of a covariance in sizes of about 1, what it is certain of bounded.
Eigen::MatrixXd information_of(const Eigen::MatrixXd& covariance) {
  constexpr double kCertain = 1e-8;
  const auto eigen = eigen_system(covariance);
  const Eigen::VectorXd inverse = eigen.values.cwiseMax(kCertain).cwiseInverse();
  return eigen.vectors * inverse.asDiagonal() * eigen.vectors.transpose();
}

}  // namespace

bool same_effect(const Effect& one, const Effect& other) {
  Effect aligned = other;
  for (auto& [name, value] : aligned.settings) {
    const auto own = one.settings.find(name);
    if (is_reference(name) && own != one.settings.end()) value = own->second;
  }
  return one.same_law_as(aligned);
}

std::vector<Effect> united_effects(std::span<const CalibratedModel* const> models) {
  std::vector<Effect> all;
  std::vector<double> robots;
  for (const CalibratedModel* model : models) {
    for (const Effect& own : model->robot.effects) {
      const auto known = std::ranges::find_if(all, [&](const Effect& effect) { return same_effect(effect, own); });
      if (known == all.end()) {
        all.push_back(own);
        all.back().values.assign(law_of(own).coefficients(own, model->nominal).size(), 0.0);
        all.back().standard_errors.clear();
        robots.push_back(1.0);
        continue;
      }
      double& count = robots[static_cast<std::size_t>(known - all.begin())];
      count += 1.0;
      narrow_ranges(known->ranges, own.ranges);
      for (auto& [name, value] : known->settings)
        if (is_reference(name)) value += (own.setting(name) - value) / count;
    }
  }
  return all;
}

FleetNumbers::FleetNumbers(std::span<const CalibratedModel* const> models, const CorrectedRobot& robot,
                           const std::vector<std::vector<double>>& averages)
    : models_(models), robot_(robot) {
  find_ids(averages);
  find_sizes(averages);
  for (std::size_t i = 0; i < models_.size(); ++i) known_.push_back(known_of(*models_[i], averages[i]));
  type_ = type_spread(known_, groups(), maker_precision());
  type_.mean = sizes_.asDiagonal() * type_.mean;
  type_.spread = sizes_.asDiagonal() * type_.spread;
  type_.mean_covariance = sizes_.asDiagonal() * type_.mean_covariance * sizes_.asDiagonal();
}

Eigen::MatrixXd FleetNumbers::covariance() const {
  Eigen::MatrixXd all = type_.mean_covariance;
  all.diagonal() += type_.widening * type_.spread.cwiseAbs2();
  return all;
}

void FleetNumbers::find_ids(const std::vector<std::vector<double>>& averages) {
  for (int joint = 0; joint < robot_.chain.size(); ++joint) {
    for (int link = 0; link < kLinkParameters; ++link) {
      const ParameterId id{ParameterId::Kind::link, joint, static_cast<LinkParameter>(link)};
      const bool known =
          std::ranges::any_of(models_, [&](const CalibratedModel* model) { return place(*model, id) >= 0; });
      const bool corrected = is_zero_of(id) && std::ranges::any_of(averages, [&](const std::vector<double>& one) {
                               return one[static_cast<std::size_t>(joint)] != 0.0;
                             });
      if (known || corrected) ids_.push_back(id);
    }
  }
  for (ParameterId& id : effect_parameters(robot_)) ids_.push_back(std::move(id));
}

Eigen::Index FleetNumbers::place(const CalibratedModel& model, const ParameterId& id) const {
  const std::vector<ParameterId>& own = model.posterior->ids;
  const auto found = std::ranges::find_if(own, [&](const ParameterId& one) {
    if (one.kind != id.kind) return false;
    if (id.kind == ParameterId::Kind::link) return one.index == id.index && one.link == id.link;
    return one.coefficient == id.coefficient && same_effect(model.robot.effects[static_cast<std::size_t>(one.index)],
                                                            robot_.effects[static_cast<std::size_t>(id.index)]);
  });
  return found == own.end() ? -1 : found - own.begin();
}

double FleetNumbers::value(const CalibratedModel& model, const ParameterId& id) const {
  if (id.kind == ParameterId::Kind::link) return parameter_value(model.robot, id) - parameter_value(robot_, id);
  for (const Effect& own : model.robot.effects)
    if (same_effect(own, robot_.effects[static_cast<std::size_t>(id.index)]))
      return own.value(static_cast<std::size_t>(id.coefficient));
  return 0.0;
}

bool FleetNumbers::is_zero_of(const ParameterId& id) const {
  return id.kind == ParameterId::Kind::link &&
         id.link == moving_parameter(robot_.chain.joints[static_cast<std::size_t>(id.index)]);
}

void FleetNumbers::find_sizes(const std::vector<std::vector<double>>& averages) {
  constexpr double kLeast = 1e-9;  ///< SI
  const std::vector<int> group = groups();
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(std::ssize(ids_)), count = squares;
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    for (std::size_t robot = 0; robot < models_.size(); ++robot) {
      double own = value(*models_[robot], ids_[i]);
      if (is_zero_of(ids_[i])) own += averages[robot][static_cast<std::size_t>(ids_[i].index)];
      squares[group[i]] += own * own;
      count[group[i]] += 1.0;
    }
  }
  sizes_.resize(std::ssize(ids_));
  for (std::size_t i = 0; i < ids_.size(); ++i)
    sizes_[static_cast<Eigen::Index>(i)] = std::max(kLeast, std::sqrt(squares[group[i]] / count[group[i]]));
}

KnownNumbers FleetNumbers::known_of(const CalibratedModel& model, const std::vector<double>& averages) const {
  // Of an effect that the model lacks, in sizes; of a zero that a correction takes the place of.
  constexpr double kLacking = 0.02, kCorrected_rad = 1e-5;
  KnownNumbers result{Eigen::MatrixXd::Zero(std::ssize(ids_), std::ssize(ids_)), {}};
  Eigen::VectorXd values(std::ssize(ids_)), added = values;
  std::vector<Eigen::Index> here, there;
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const ParameterId& id = ids_[i];
    const double correction = is_zero_of(id) ? averages[static_cast<std::size_t>(id.index)] : 0.0;
    added[at] = correction / sizes_[at];
    values[at] = value(model, id) / sizes_[at] + added[at];
    const Eigen::Index row = place(model, id);
    if (row >= 0) {
      here.push_back(at);
      there.push_back(row);
    } else if (id.kind == ParameterId::Kind::effect) {
      result.information(at, at) = 1.0 / (kLacking * kLacking);
    } else if (correction != 0.0) {
      result.information(at, at) = std::pow(sizes_[at] / kCorrected_rad, 2.0);
    }
  }
  result.weighted = result.information * values;
  if (here.empty()) return result;
  const Eigen::MatrixXd factor = sizes_(here).cwiseInverse().asDiagonal() * model.posterior->factor(there, Eigen::all);
  const Eigen::MatrixXd whole = information_of(factor * factor.transpose());
  // Without what the fit believed of a maker's figures before it saw poses, which every robot's would count anew.
  Eigen::MatrixXd seen = whole;
  seen.diagonal() -= maker_precision()(here);
  const auto eigen = eigen_system(seen);
  const Eigen::VectorXd positive = eigen.values.cwiseMax(0.0);
  const Eigen::VectorXd shown = (positive.array() > 0.0).cast<double>();
  const auto only = [&](const Eigen::VectorXd& kept) -> Eigen::MatrixXd {
    return eigen.vectors * kept.asDiagonal() * eigen.vectors.transpose();
  };
  result.information(here, here) = only(positive);
  result.weighted(here) = only(shown) * (whole * (values - added)(here)) + only(positive) * added(here);
  return result;
}

std::vector<int> FleetNumbers::groups() const {
  std::map<std::string, int> numbered;
  std::vector<int> result;
  for (const ParameterId& id : ids_) {
    std::string name = id.is_angle() ? "angle" : "length";
    if (is_zero_of(id)) name = "zero " + name;
    if (id.kind == ParameterId::Kind::effect) {
      const Effect& effect = robot_.effects[static_cast<std::size_t>(id.index)];
      name = effect.kind + ' ' +
             law_of(effect).coefficients(effect, robot_.described)[static_cast<std::size_t>(id.coefficient)].unit;
    }
    result.push_back(numbered.try_emplace(name, static_cast<int>(numbered.size())).first->second);
  }
  return result;
}

Eigen::VectorXd FleetNumbers::maker_precision() const {
  constexpr double kNothing = 1e-6;  ///< is believed of effects
  const FitOptions options;
  Eigen::VectorXd result(std::ssize(ids_));
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double deviation = ids_[i].is_angle() ? options.prior_rad : options.prior_m;
    result[at] = ids_[i].kind == ParameterId::Kind::link ? std::pow(sizes_[at] / deviation, 2.0) : kNothing;
  }
  return result;
}

}  // namespace demecal::inline updating
