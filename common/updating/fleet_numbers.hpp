// The numbers that models of several robots of one type have, and what each model knows of its own.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "effects/effect.hpp"
#include "fitting/declared_model.hpp"
#include "prediction/corrected_robot.hpp"
#include "updating/type_spread.hpp"

namespace demecal::inline updating {

/// The effects that any of the models has, their coefficients zero; of references (of temperature, of time) the mean,
/// of ranges what all know that have it.
std::vector<Effect> united_effects(std::span<const CalibratedModel* const> models);

/// Whether they are the same effect at the same place, whatever coefficients, ranges and references.
bool same_effect(const Effect& one, const Effect& other);

class FleetNumbers {
 public:
  /// `robot`: the nominal arm with the united effects. `averages`: by model and joint, what its corrections add to the
  /// joint's zero.
  FleetNumbers(std::span<const CalibratedModel* const> models, const CorrectedRobot& robot,
               const std::vector<std::vector<double>>& averages);

  const std::vector<ParameterId>& ids() const { return ids_; }
  /// Mean, its covariance and the spread, in SI units; links about the nominal arm.
  const TypeSpread& type() const { return type_; }
  /// Of a further robot of the type.
  Eigen::MatrixXd covariance() const;

 private:
  void find_ids(const std::vector<std::vector<double>>& averages);
  KnownNumbers known(const CalibratedModel& model, const std::vector<double>& averages) const;
  /// Where a model's posterior has the number; -1 where it has not.
  Eigen::Index place(const CalibratedModel& model, const ParameterId& id) const;
  double value(const CalibratedModel& model, const ParameterId& id) const;
  bool is_zero_of(const ParameterId& id) const;
  std::vector<int> groups() const;
  Eigen::VectorXd maker_precision() const;
  void find_sizes(const std::vector<std::vector<double>>& averages);

  std::span<const CalibratedModel* const> models_;
  CorrectedRobot robot_;
  std::vector<ParameterId> ids_;
  Eigen::VectorXd sizes_;  ///< of each number, SI; those of a group alike
  TypeSpread type_;
};

}  // namespace demecal::inline updating
