// What a model found before says of its arm today, before anything new is measured: how its numbers may have drifted,
// what its joints may do outside the range it knows, and how that moves what new poses measure.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "expression/bound.hpp"
#include "kinematics/chain.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/observation.hpp"
#include "parameters/parameter_space.hpp"
#include "prediction/corrected_robot.hpp"
#include "products/tall_products.hpp"
#include "residuals/residual_field.hpp"
#include "residuals/smooth_corrections.hpp"

namespace demecal::inline updating {

/// How far numbers of each kind drift between two measurements, standard deviations.
struct AssumedDrift {
  double offset_rad = 1e-4;        ///< zeros of joints
  double angle_rad = 5e-5;         ///< other angles of links
  double length_m = 3e-5;          ///< lengths of links
  double transmission_rad = 3e-5;  ///< what gears and encoders do over their turns
  double effect_motion = 1e-4;     ///< of other effects' motions, rad or m
  double ripple_rad = 3e-5;        ///< of a joint over its turn
};

/// What is believed to have moved since the model was found, by any amount. A base or tool that has not is where the
/// model has it, as surely as it knows that, and drifts as links do.
struct Moved {
  bool base = true, tool = true;
  std::vector<int> zeros{};  ///< joints, from 0
};

/// The number that says where a joint is zero.
ParameterId zero_of(const Chain& chain, int joint);

/// Parts of the belief whose sizes new poses may change: each is multiplied by a factor that they make likeliest.
enum class BeliefPart { links, effects, outside, ripple };
inline constexpr std::array kAllBeliefParts{BeliefPart::links, BeliefPart::effects, BeliefPart::outside,
                                            BeliefPart::ripple};
inline constexpr std::size_t kBeliefParts = kAllBeliefParts.size();
/// Each joint has its own.
constexpr bool of_waves(BeliefPart part) {
  return part == BeliefPart::outside || part == BeliefPart::ripple;
}
/// Of the variance of each part; 1 as stated.
using PartFactors = std::array<double, kBeliefParts>;

/// The numbers of a model that may change, and what is believed of their changes: normal, with zero mean about `robot`.
/// A fleet's mean does not change: what is believed is how far a robot of the type is from it, as its posterior states.
class PriorModel {
 public:
  /// `placed`: the model's robot with what moved of base and tool where `data` have it. Numbers declared that the model
  /// does not know are believed as the maker states them.
  PriorModel(const CalibratedModel& model, const CorrectedRobot& placed, const DataSet& data,
             std::span<const std::size_t> poses, const DeclaredModel& declared, const AssumedDrift& drift = {},
             const Moved& moved = {});

  const CorrectedRobot& robot() const { return robot_; }
  const std::vector<ParameterId>& ids() const { return ids_; }
  const SmoothCorrections& ripples() const { return ripples_; }  ///< waves of every joint about the model
  Eigen::Index numbers() const { return static_cast<Eigen::Index>(ids_.size() + ripples_.terms.size()); }

  int joints() const { return static_cast<int>(outside_.size()); }

  /// Covariance of the changes: ids, then waves. `of_joint` multiplies the variance of a joint's waves besides.
  Eigen::MatrixXd covariance(const PartFactors& factors, const Eigen::VectorXd& of_joint) const;
  /// The same of base and tool, and of what the model states of its own numbers: what no factor multiplies.
  Eigen::MatrixXd fixed_covariance() const;
  /// The part alone, for a factor of 1; of waves those of one joint.
  Eigen::MatrixXd covariance_of(BeliefPart part, int joint = 0) const;

  /// rows x numbers: how the field's rows change with each.
  RowMatrix columns(const ResidualField& field) const;
  /// The robot after `change`.
  CorrectedRobot changed(const Eigen::VectorXd& change) const;

 private:
  void believe_numbers(const CalibratedModel& model, const DataSet& data, const AssumedDrift& drift,
                       std::span<const std::size_t> poses, const Moved& moved);
  void believe_ripples(const CalibratedModel& model, const DataSet& data, const AssumedDrift& drift);

  CorrectedRobot robot_;
  std::vector<ParameterId> ids_;
  SmoothCorrections ripples_;
  Eigen::MatrixXd stated_;                     ///< ids x ids
  Eigen::VectorXd link_drift_, effect_drift_;  ///< variances, ids; about a fleet's mean those of its robots
  std::vector<Eigen::MatrixXd> outside_;       ///< by joint: of its waves
  Eigen::VectorXd ripple_;                     ///< variances of the waves
};

}  // namespace demecal::inline updating
