#include "updating/fleet_curves.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <type_traits>
#include <utility>

#include "data/data_set.hpp"
#include "decompositions/decompositions.hpp"
#include "expression/bound.hpp"
#include "expression/tree.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline updating {

double wave_share(int n) {
  constexpr double kWaveDecay = 25.0;  ///< cycles a turn beyond which they get rarer
  static const double whole = [] {
    double sum = 0.0;
    for (int k = 1; k <= kHighestWave; ++k) sum += 1.0 / (1.0 + std::pow(k / kWaveDecay, 2.0));
    return sum;
  }();
  return 1.0 / (1.0 + std::pow(n / kWaveDecay, 2.0)) / whole;
}

namespace {

constexpr int kGrid = 721;  ///< places of a range

/// Whole turns, rad, that bring the middle of `range` nearest to that of `other`.
double turns_between(const Interval& range, const Interval& other, bool revolute) {
  if (!revolute) return 0.0;
  return kTurn_rad * std::round((other.lower + other.upper - range.lower - range.upper) / 2.0 / kTurn_rad);
}

/// The formula of theta at theta + shift.
Tree shifted_formula(const Tree& formula, double shift) {
  if (shift == 0.0) return formula;
  const Tree argument = apply(Primitive::add, variable_tree(0), constant_tree(shift));
  Tree result;
  for (const Node& node : formula) {
    if (node.primitive == Primitive::variable)
      result.insert(result.end(), argument.begin(), argument.end());
    else
      result.push_back(node);
  }
  return result;
}

/// One joint's corrections of all robots, over what all know of it.
class JointCurves {
 public:
  JointCurves(std::span<const CalibratedModel* const> models, int joint)
      : models_(models), at_(static_cast<std::size_t>(joint)), revolute_(is_revolute(models[0]->nominal.chain, joint)) {
    for (const CalibratedModel* model : models) {
      const JointCorrection& one = correction(*model);
      if (one.is_neutral()) continue;
      if (!known_) {
        known_ = first_ = one.range_rad();
        branch_ = one.branch();
      }
      narrow(one.range_rad());
    }
    for (const CalibratedModel* model : models)
      if (known_ && correction(*model).is_neutral() && at_ < model->measured.size()) narrow(model->measured[at_]);
    constexpr double kNarrow = 0.05;  // rad or m
    if (known_ && known_->upper - known_->lower < kNarrow) known_.reset();
  }

  bool known() const { return known_.has_value(); }

  /// Of a robot's correction, at places of the range.
  Eigen::VectorXd values(const CalibratedModel& model) const {
    Eigen::VectorXd result(kGrid);
    for (int i = 0; i < kGrid; ++i) result[i] = correction(model)(place(i));
    return result;
  }

  JointCorrection mean(double average) const {
    const double share = 1.0 / static_cast<double>(models_.size());
    Tree sum = constant_tree(-average);
    for (const CalibratedModel* model : models_) {
      const JointCorrection& one = correction(*model);
      if (one.is_neutral()) continue;
      const double shift = -turns_between(one.range_rad(), first_, revolute_);
      sum = apply(Primitive::add,
                  apply(Primitive::multiply, constant_tree(share), shifted_formula(one.formula(), shift)), sum);
    }
    return {std::move(sum), branch_, *known_};
  }

  /// Deviations of waves of 1, 2, ... cycles a turn: told by the robots' own (columns), as far as those are enough to
  /// tell, and alike otherwise.
  std::vector<double> wave_deviations(const Eigen::MatrixXd& values) const {
    constexpr double kAlike = 2.0, kRounding_rad = 1e-6;
    const Eigen::MatrixXd about = values.colwise() - values.rowwise().mean();
    const double freedom = static_cast<double>(values.cols()) - 1.0;
    const double whole = std::max(about.squaredNorm() / kGrid / freedom, kRounding_rad * kRounding_rad);
    Eigen::MatrixXd waves(kGrid, 2 * kHighestWave);
    Eigen::VectorXd belief(2 * kHighestWave);
    for (int n = 1; n <= kHighestWave; ++n) {
      for (int i = 0; i < kGrid; ++i) {
        waves(i, 2 * n - 2) = std::cos(n * place(i));
        waves(i, 2 * n - 1) = std::sin(n * place(i));
      }
      belief.segment(2 * n - 2, 2).setConstant(kRounding_rad * kRounding_rad / (whole * wave_share(n)));
    }
    Eigen::MatrixXd normal = waves.transpose() * waves;
    normal.diagonal() += belief;
    const Eigen::MatrixXd found = Cholesky(normal).solve(waves.transpose() * about);
    std::vector<double> power;
    double sum = 0.0;
    for (int n = 1; n <= kHighestWave; ++n) {
      power.push_back(found.middleRows(2 * n - 2, 2).squaredNorm() / 2.0 / freedom);
      sum += power.back();
    }
    for (int n = 1; n <= kHighestWave; ++n) {
      double& one = power[static_cast<std::size_t>(n - 1)];
      one = std::sqrt((kAlike * sum * wave_share(n) + 2.0 * freedom * one) / (kAlike + 2.0 * freedom));
    }
    return power;
  }

  bool revolute() const { return revolute_; }

 private:
  const JointCorrection& correction(const CalibratedModel& model) const { return model.robot.corrections[at_]; }
  double place(int i) const { return known_->lower + (known_->upper - known_->lower) * i / (kGrid - 1.0); }

  void narrow(const Interval& range) {
    const double turns = turns_between(range, first_, revolute_);
    known_ = Interval{std::max(known_->lower, range.lower + turns), std::min(known_->upper, range.upper + turns)};
  }

  std::span<const CalibratedModel* const> models_;
  std::size_t at_;
  bool revolute_;
  std::optional<Interval> known_;
  Interval first_;  ///< whose turns the others are brought to
  AngleBranch branch_;
};

}  // namespace

FleetCurves fleet_curves(std::span<const CalibratedModel* const> models) {
  const int joints = models[0]->nominal.chain.size();
  FleetCurves result;
  result.mean.resize(static_cast<std::size_t>(joints));
  result.average.assign(models.size(), std::vector<double>(static_cast<std::size_t>(joints), 0.0));
  for (int joint = 0; joint < joints; ++joint) {
    const auto at = static_cast<std::size_t>(joint);
    const JointCurves curves(models, joint);
    if (!curves.known()) continue;
    Eigen::MatrixXd values(kGrid, std::ssize(models));
    double average = 0.0;
    for (std::size_t i = 0; i < models.size(); ++i) {
      const Eigen::VectorXd own = curves.values(*models[i]);
      result.average[i][at] = own.mean();
      average += own.mean() / static_cast<double>(models.size());
      values.col(static_cast<Eigen::Index>(i)) = own.array() - own.mean();
    }
    result.mean[at] = curves.mean(average);
    if (curves.revolute()) result.curves.push_back({joint, curves.wave_deviations(values)});
  }
  return result;
}

}  // namespace demecal::inline updating
