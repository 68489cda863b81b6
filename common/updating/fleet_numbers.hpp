// The numbers that models of several robots of one type have, and what each model knows of its own: by these, what the
// robots have in common and how far one of them is from it, a normal law with mean and spread of each number.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "effects/effect.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline updating {

/// What measurements of one robot say of its numbers, and nothing that was believed before them.
struct KnownNumbers {
  Eigen::MatrixXd information;  ///< inverse covariance; none of numbers that they do not speak of
  Eigen::VectorXd weighted;     ///< information * numbers
};

struct TypeSpread {
  Eigen::VectorXd mean;
  Eigen::MatrixXd mean_covariance;
  Eigen::VectorXd spread;  ///< standard deviations of robots about the mean
  double widening = 1.0;   ///< of a further robot's variance: few robots tell the spread, and it might be larger
};

/// Expectation maximisation of restricted likelihood (the mean counts as unknown). So few robots tell a variance badly:
/// those of one group (numbers from 0, one each) are believed to be alike, as much as four further robots would tell.
/// `mean_precision`: how precisely each mean is believed to be zero before. Numbers should be of size about 1, those of
/// a group in one unit.
TypeSpread type_spread(std::span<const KnownNumbers> robots, std::span<const int> groups,
                       const Eigen::VectorXd& mean_precision);

/// By group, the standard deviation of numbers about the mean of several models, where all of a group deviate alike: 1
/// is believed before, as much as four further numbers would tell. Numbers should be in units of what is believed.
Eigen::VectorXd group_spread(std::span<const KnownNumbers> models, std::span<const int> groups,
                             const Eigen::VectorXd& mean_precision);

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

  /// What each model says of the numbers divided by sizes(), and how precisely the maker's figures say them.
  const std::vector<KnownNumbers>& known() const { return known_; }
  const Eigen::VectorXd& sizes() const { return sizes_; }
  Eigen::VectorXd maker_precision() const;

 private:
  void find_ids(const std::vector<std::vector<double>>& averages);
  KnownNumbers known_of(const CalibratedModel& model, const std::vector<double>& averages) const;
  /// Where a model's posterior has the number; -1 where it has not.
  Eigen::Index place(const CalibratedModel& model, const ParameterId& id) const;
  double value(const CalibratedModel& model, const ParameterId& id) const;
  bool is_zero_of(const ParameterId& id) const;
  std::vector<int> groups() const;
  void find_sizes(const std::vector<std::vector<double>>& averages);

  std::span<const CalibratedModel* const> models_;
  CorrectedRobot robot_;
  std::vector<ParameterId> ids_;
  Eigen::VectorXd sizes_;  ///< of each number, SI; those of a group alike
  std::vector<KnownNumbers> known_;
  TypeSpread type_;
};

}  // namespace demecal::inline updating
