#include "updating/prior_model.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <ranges>
#include <set>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "effects/arm_state.hpp"
#include "effects/catalogue.hpp"
#include "effects/effect.hpp"
#include "expression/bound.hpp"
#include "expression/tree.hpp"
#include "fitting/fit.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "parameters/parameter_space.hpp"
#include "parameters/posterior.hpp"
#include "primitives/primitive.hpp"
#include "random/random_stream.hpp"
#include "updating/fleet_curves.hpp"
#include "updating/known_places.hpp"
#include "updating/motion_sizes.hpp"

namespace demecal::inline updating {
namespace {

constexpr double kBase = 5e-3, kTool = 5e-3;  ///< m and rad about where base and tool were found

bool is_place(const ParameterId& id) {
  return id.is_of_base() || id.is_of_tool() || id.kind == ParameterId::Kind::station;
}

bool has_moved(const ParameterId& id, const Moved& moved, const Chain& chain) {
  return std::ranges::any_of(moved.zeros, [&](int joint) { return id == zero_of(chain, joint); });
}

bool knows(const CalibratedModel& model, const ParameterId& id) {
  return model.posterior && std::ranges::find(model.posterior->ids, id) != model.posterior->ids.end();
}

/// Whether a base's, tool's or station's number may be anything.
bool is_anywhere(const ParameterId& id, const CalibratedModel& model, const Moved& moved) {
  return is_place(id) && ((id.is_of_tool() ? moved.tool : moved.base) || !knows(model, id));
}

std::vector<ParameterId> numbers_of(const CalibratedModel& model, const CorrectedRobot& robot, const DataSet& data,
                                    const DeclaredModel& declared, const Moved& moved) {
  DeclaredModel placed = declared;
  placed.registration = placed.tool = true;
  std::vector<ParameterId> ids = free_parameters(data, placed);
  for (const int joint : moved.zeros) {
    const ParameterId id = zero_of(robot.chain, joint);
    if (std::ranges::find(ids, id) == ids.end()) ids.push_back(id);
  }
  if (model.posterior) {
    for (const ParameterId& id : model.posterior->ids) {
      const bool new_link = id.kind == ParameterId::Kind::link && std::ranges::find(ids, id) == ids.end();
      if (new_link) ids.push_back(id);
    }
  }
  for (ParameterId& id : effect_parameters(robot)) ids.push_back(std::move(id));
  return ids;
}

/// Waves of every revolute joint that the model does not correct already, over what was measured then or now. About a
/// fleet's mean curve each robot has its own: waves over the range of the mean.
SmoothCorrections waves_about(const CalibratedModel& model, const CorrectedRobot& robot, const DataSet& data,
                              std::span<const std::size_t> poses) {
  SmoothCorrections waves = smooth_corrections(data, poses, robot, false);
  for (int joint = 0; joint < robot.chain.size(); ++joint) {
    const auto at = static_cast<std::size_t>(joint);
    const bool corrected = !waves.base[at].is_neutral();
    if (!is_revolute(robot.chain, joint) || (corrected && !model.fleet)) continue;
    if (corrected) {
      waves.ranges[at] = waves.base[at].range_rad();
    } else if (at < model.measured.size()) {
      Interval& range = waves.ranges[at];
      range = {std::min(range.lower, waves.branches[at](model.measured[at].lower)),
               std::max(range.upper, waves.branches[at](model.measured[at].upper))};
    }
    for (int n = 1; n <= kHighestWave; ++n) {
      const Tree angle = apply(Primitive::multiply, constant_tree(n), variable_tree(0));
      waves.terms.push_back({joint, apply(Primitive::cosine, angle), n, n});
      waves.terms.push_back({joint, apply(Primitive::sine, angle), n, n});
    }
  }
  waves.coefficients.setZero(static_cast<Eigen::Index>(waves.terms.size()));
  return waves;
}

/// How far robots of the type are from the mean in a number of the posterior, SI.
double spread_of(const FleetOrigin& fleet, const ParameterId& id, Eigen::Index place) {
  const double stated = fleet.numbers[static_cast<std::size_t>(place)].spread;
  if (id.kind == ParameterId::Kind::effect) return stated;
  return id.is_angle() ? radians(stated) : metres(stated);
}

/// Variances of a joint's waves of 1, 2, ... cycles a turn within the range that the model knows, rad^2.
std::vector<double> variances_within(const CalibratedModel& model, const AssumedDrift& drift, int joint) {
  constexpr double kOfFleet_rad = 5e-6;  ///< where its models have no corrections; the new poses may show more
  const double ripple_rad = model.fleet ? kOfFleet_rad : drift.ripple_rad;
  std::vector<double> result;
  for (int n = 1; n <= kHighestWave; ++n) result.push_back(ripple_rad * ripple_rad * wave_share(n));
  if (!model.fleet) return result;
  for (const FleetCurve& curve : model.fleet->curves) {
    if (curve.joint != joint) continue;
    for (std::size_t i = 0; i < std::min(result.size(), curve.wave_deviations_rad.size()); ++i)
      result[i] = std::pow(curve.wave_deviations_rad[i], 2.0);
  }
  return result;
}

/// The variance of what the model's effects do to a joint within the range it knows, rad^2.
double ripple_variance(const CalibratedModel& model, const CorrectedRobot& robot, const Robot& described, int joint) {
  constexpr int kDraws = 200;
  RandomStream random{2, static_cast<std::uint64_t>(joint)};
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    JointVector joints(robot.chain.size());
    for (int k = 0; k < robot.chain.size(); ++k) {
      const auto at = static_cast<std::size_t>(k);
      joints[k] = at < model.measured.size() ? random.real(model.measured[at].lower, model.measured[at].upper) : 0.0;
    }
    const Displacement moved = displacement(robot.chain, robot.effects,
                                            effect_motions(robot.effects, described, arm_state(described, joints)));
    sum += moved.joints[joint];
    squares += moved.joints[joint] * moved.joints[joint];
  }
  return std::max(0.0, (squares - sum * sum / kDraws) / (kDraws - 1));
}

}  // namespace

ParameterId zero_of(const Chain& chain, int joint) {
  return {.kind = ParameterId::Kind::link,
          .index = joint,
          .link = moving_parameter(chain.joints[static_cast<std::size_t>(joint)])};
}

PriorModel::PriorModel(const CalibratedModel& model, const CorrectedRobot& placed, const DataSet& data,
                       std::span<const std::size_t> poses, const DeclaredModel& declared, const AssumedDrift& drift,
                       const Moved& moved)
    : robot_(placed),
      ids_(numbers_of(model, placed, data, declared, moved)),
      ripples_(waves_about(model, placed, data, poses)) {
  for (Effect& effect : robot_.effects)
    effect.values.resize(law_of(effect).coefficients(effect, data.robot).size(), 0.0);
  believe_numbers(model, data, drift, poses, moved);
  believe_ripples(model, data, drift);
}

void PriorModel::believe_numbers(const CalibratedModel& model, const DataSet& data, const AssumedDrift& drift,
                                 std::span<const std::size_t> poses, const Moved& moved) {
  constexpr double kJump = 0.1;  ///< rad or m
  const FitOptions options;
  const auto n = static_cast<Eigen::Index>(ids_.size());
  stated_ = Eigen::MatrixXd::Zero(n, n);
  link_drift_ = effect_drift_ = Eigen::VectorXd::Zero(n);
  const auto motions = unit_motion_sizes(robot_, data, poses);
  std::vector<Eigen::Index> here, there;
  for (Eigen::Index i = 0; i < n; ++i) {
    const ParameterId& id = ids_[static_cast<std::size_t>(i)];
    if (is_anywhere(id, model, moved)) {
      const double usual = id.is_of_tool() ? kTool : kBase;
      stated_(i, i) = usual * usual;
      continue;
    }
    if (has_moved(id, moved, robot_.chain)) stated_(i, i) = kJump * kJump;
    if (id.kind != ParameterId::Kind::effect) {
      const bool offset = id.kind == ParameterId::Kind::link && id.link == LinkParameter::theta;
      const double size = !id.is_angle() ? drift.length_m : offset ? drift.offset_rad : drift.angle_rad;
      link_drift_[i] = size * size;
    } else {
      const double motion = motions[static_cast<std::size_t>(id.index)][static_cast<std::size_t>(id.coefficient)];
      // Teeth and encoders stay as they were made; lost motion, and what springs and weights do, need not.
      const double drifts = is_of_transmission(robot_.effects[static_cast<std::size_t>(id.index)])
                                ? drift.transmission_rad
                                : drift.effect_motion;
      effect_drift_[i] = motion > 0.0 ? std::pow(drifts / motion, 2.0) : 0.0;
    }
    if (knows(model, id)) {
      here.push_back(i);
      there.push_back(std::ranges::find(model.posterior->ids, id) - model.posterior->ids.begin());
    } else if (id.kind == ParameterId::Kind::link) {
      stated_(i, i) += std::pow(id.is_angle() ? options.prior_rad : options.prior_m, 2.0);
    }
  }
  if (here.empty()) return;
  const Eigen::MatrixXd rows = model.posterior->factor(there, Eigen::all);
  const Eigen::MatrixXd known = rows * rows.transpose();
  stated_(here, here) += known;
  if (!model.fleet) return;
  // Nothing has drifted, but robots of a type are spread: the new poses tell whether this one differs from the mean
  // more or less than the others do. How well the mean is known is another matter.
  for (std::size_t i = 0; i < here.size(); ++i) {
    const Eigen::Index at = here[i];
    const double variance =
        std::pow(spread_of(*model.fleet, model.posterior->ids[static_cast<std::size_t>(there[i])], there[i]), 2.0);
    stated_(at, at) -= variance;
    (ids_[static_cast<std::size_t>(at)].kind == ParameterId::Kind::link ? link_drift_ : effect_drift_)[at] = variance;
  }
}

void PriorModel::believe_ripples(const CalibratedModel& model, const DataSet& data, const AssumedDrift& drift) {
  const auto terms = static_cast<Eigen::Index>(ripples_.terms.size());
  ripple_.setZero(terms);
  outside_.resize(ripples_.base.size());
  std::vector<std::vector<double>> within;
  for (std::size_t joint = 0; joint < ripples_.base.size(); ++joint)
    within.push_back(variances_within(model, drift, static_cast<int>(joint)));
  std::vector<std::vector<Eigen::Index>> of_joint(ripples_.base.size());
  for (Eigen::Index i = 0; i < terms; ++i) {
    const SmoothTerm& term = ripples_.terms[static_cast<std::size_t>(i)];
    ripple_[i] = within[static_cast<std::size_t>(term.joint)][static_cast<std::size_t>(term.harmonic - 1)];
    of_joint[static_cast<std::size_t>(term.joint)].push_back(i);
  }
  for (std::size_t joint = 0; joint < of_joint.size(); ++joint) {
    const auto count = static_cast<Eigen::Index>(of_joint[joint].size());
    if (count == 0) continue;
    const double variance = ripple_variance(model, robot_, data.robot, static_cast<int>(joint));
    Eigen::VectorXd shares(count);
    for (Eigen::Index i = 0; i < count; ++i)
      shares[i] =
          std::max(variance, 1e-14) *
          wave_share(ripples_.terms[static_cast<std::size_t>(of_joint[joint][static_cast<std::size_t>(i)])].harmonic);
    Eigen::MatrixXd information = shares.cwiseInverse().asDiagonal();
    for (const KnownPlace& place : known_places(model, static_cast<int>(joint))) {
      Eigen::VectorXd wave(count);
      for (Eigen::Index i = 0; i < count; ++i) {
        const int n = ripples_.terms[static_cast<std::size_t>(of_joint[joint][static_cast<std::size_t>(i)])].harmonic;
        wave[i] = i % 2 == 0 ? std::cos(n * place.theta_rad) : std::sin(n * place.theta_rad);
      }
      information += wave * wave.transpose() / place.variance;
    }
    outside_[joint] = Cholesky(information).inverse();
  }
}

Eigen::MatrixXd PriorModel::fixed_covariance() const {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(numbers(), numbers());
  covariance.topLeftCorner(stated_.rows(), stated_.cols()) = stated_;
  return covariance;
}

Eigen::MatrixXd PriorModel::covariance_of(BeliefPart part, int joint) const {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(numbers(), numbers());
  Eigen::Index first = std::ssize(ids_);
  if (part == BeliefPart::links) covariance.diagonal().head(first) = link_drift_;
  if (part == BeliefPart::effects) covariance.diagonal().head(first) = effect_drift_;
  if (!of_waves(part)) return covariance;
  for (int before = 0; before < joint; ++before) first += outside_[static_cast<std::size_t>(before)].rows();
  const Eigen::MatrixXd& outside = outside_[static_cast<std::size_t>(joint)];
  auto block = covariance.block(first, first, outside.rows(), outside.cols());
  if (part == BeliefPart::outside) block = outside;
  if (part == BeliefPart::ripple) block.diagonal() = ripple_.segment(first - std::ssize(ids_), outside.rows());
  return covariance;
}

Eigen::MatrixXd PriorModel::covariance(const PartFactors& factors, const Eigen::VectorXd& of_joint) const {
  Eigen::MatrixXd covariance = fixed_covariance();
  for (const BeliefPart part : kAllBeliefParts) {
    const double factor = factors[static_cast<std::size_t>(part)];
    if (!of_waves(part)) covariance += factor * covariance_of(part);
    for (int joint = 0; of_waves(part) && joint < joints(); ++joint)
      covariance += factor * of_joint[joint] * covariance_of(part, joint);
  }
  return covariance;
}

RowMatrix PriorModel::columns(const ResidualField& field) const {
  return beside(field.declared, ripples_.columns(field));
}

CorrectedRobot PriorModel::changed(const Eigen::VectorXd& change) const {
  const auto n = static_cast<Eigen::Index>(ids_.size());
  CorrectedRobot robot = ParameterSpace(robot_, ids_).at(change.head(n)).robot;
  SmoothCorrections waves = ripples_;
  waves.coefficients = change.tail(ripple_.size());
  robot.corrections = waves.corrections();
  return robot;
}

}  // namespace demecal::inline updating
