#include "updating/update.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>

#include "decompositions/decompositions.hpp"
#include "effects/effect.hpp"
#include "fitting/fit.hpp"
#include "fitting/least_squares.hpp"
#include "fitting/station_scales.hpp"
#include "parameters/observation.hpp"
#include "parameters/parameter_space.hpp"
#include "parameters/posterior.hpp"
#include "products/tall_products.hpp"
#include "random/distributions.hpp"
#include "residuals/residual_field.hpp"
#include "residuals/smooth_corrections.hpp"
#include "updating/belief_sizes.hpp"
#include "updating/gross_poses.hpp"
#include "updating/single_change.hpp"

namespace demecal::inline updating {
namespace {

constexpr std::size_t kMostLeftOut = 150;  ///< poses

/// The most probable change, and a root of its covariance.
struct Solution {
  Eigen::VectorXd change;
  Eigen::MatrixXd root;
};

Solution solve(const Eigen::MatrixXd& covariance, const NewRows& rows, double noise) {
  Eigen::MatrixXd believed = covariance;
  believed.diagonal().array() += 1e-20;  // numbers that cannot change
  const Eigen::MatrixXd root = PivotedCholesky(believed).root();
  const Eigen::MatrixXd seen = rows.columns * root;
  Eigen::MatrixXd information = seen.transpose() * seen / noise;
  information.diagonal().array() += 1.0;
  const Cholesky known(information);
  Solution solution;
  solution.change = root * known.solve(seen.transpose() * rows.values / noise);
  solution.root = known.whitened(root.transpose()).transpose();
  return solution;
}

RowScales scales_of_new_poses(const DataSet& data, const CorrectedRobot& placed, const std::vector<std::size_t>& poses,
                              const std::optional<PredictionInterval>& interval) {
  constexpr double kSmallest = 1e-8;
  const auto observations = observe(data, poses, placed);
  RowScales scales = scales_of_stations(data, placed, observations, median_deviations(data, placed, observations));
  if (mounted_otherwise(data, placed, observations)) scales[kOrientation] = 0.0;
  if (interval && scales[kPosition] > 0.0) {
    const double stated = std::max(kSmallest, std::hypot(interval->noise_m, interval->model_error_m));
    const double share = std::min(1.0, stated / scales[kPosition]);
    for (double& scale : scales) scale *= share;
  }
  return scales;
}

std::vector<ParameterEstimate> updated_estimates(const PriorModel& prior, const CorrectedRobot& robot,
                                                 const DataSet& data, const Eigen::MatrixXd& root) {
  const CorrectedRobot nominal = nominal_robot(data);
  std::vector<ParameterEstimate> estimates;
  for (std::size_t i = 0; i < prior.ids().size(); ++i) {
    const ParameterId& id = prior.ids()[i];
    if (id.kind == ParameterId::Kind::effect) continue;
    estimates.push_back(
        {id, parameter_value(nominal, id), parameter_value(robot, id), root.row(static_cast<Eigen::Index>(i)).norm()});
  }
  return estimates;
}

void set_errors_of_effects(const PriorModel& prior, const Eigen::MatrixXd& root, CorrectedRobot& robot) {
  for (std::size_t i = 0; i < prior.ids().size(); ++i) {
    const ParameterId& id = prior.ids()[i];
    if (id.kind != ParameterId::Kind::effect) continue;
    Effect& effect = robot.effects[static_cast<std::size_t>(id.index)];
    effect.standard_errors.resize(effect.values.size(), 0.0);
    effect.standard_errors[static_cast<std::size_t>(id.coefficient)] = root.row(static_cast<Eigen::Index>(i)).norm();
  }
}

/// The posterior in the model file's form: waves that are as good as known are left out of it.
Posterior posterior_of_update(const PriorModel& prior, const Eigen::MatrixXd& root) {
  constexpr double kKnown_rad = 4e-6;
  Posterior posterior{prior.ids(), {}, {}};
  std::vector<Eigen::Index> kept(prior.ids().size());
  std::iota(kept.begin(), kept.end(), Eigen::Index{0});
  const SmoothCorrections& waves = prior.ripples();
  for (std::size_t i = 0; i < waves.terms.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(prior.ids().size() + i);
    if (root.row(row).norm() < kKnown_rad) continue;
    const auto joint = static_cast<std::size_t>(waves.terms[i].joint);
    posterior.terms.push_back(
        {waves.terms[i].joint, {waves.terms[i].formula, waves.branches[joint], waves.ranges[joint]}});
    kept.push_back(row);
  }
  const Eigen::MatrixXd rows = root(kept, Eigen::all);
  posterior.factor = upper_factor(rows.transpose()).topRows(rows.rows()).transpose();
  return posterior;
}

/// A way of updating, and what came of it.
struct UpdateTrial {
  PriorModel prior;
  RowScales scales;
  Solution solution{};
  BeliefSizes sizes{};
  std::vector<std::size_t> used{}, gross{};
  bool as_known = false;  ///< nothing drifted: what did not move is changed by as much as the model does not know it
  LeftOut others{};       ///< of the poses used
};

UpdateTrial tried(PriorModel believed, const CalibratedModel& model, const DataSet& data,
                  const std::vector<std::size_t>& poses, const RowScales& scales) {
  constexpr int kSteps = 3;
  constexpr double kNothing = 1e-8;
  UpdateTrial trial{std::move(believed), scales};
  trial.used = poses;
  const PriorModel& prior = trial.prior;
  const JointSizes joints = model.fleet ? JointSizes::alike : JointSizes::each;
  trial.solution.change = Eigen::VectorXd::Zero(prior.numbers());
  for (int step = 0; step < kSteps; ++step) {
    const bool many = trial.used.size() > kMostLeftOut;
    const NewRows rows = rows_about(prior, data, trial.used, trial.scales, trial.solution.change, many && step > 0);
    trial.sizes = likeliest_sizes(prior, rows, joints);
    Eigen::MatrixXd covariance = prior.covariance(trial.sizes.factors, trial.sizes.of_joint);
    if (!many) {
      trial.others = left_out(covariance, rows, trial.sizes.noise);
      if (step == 0) {
        trial.gross = gross_poses(prior, rows, trial.sizes, joints);
        std::erase_if(trial.used, [&](std::size_t pose) { return std::ranges::binary_search(trial.gross, pose); });
      }
      // A robot may be as it was; none is its fleet's mean.
      const Eigen::MatrixXd little = prior.covariance({kNothing, kNothing, kNothing, kNothing}, trial.sizes.of_joint);
      LeftOut by_little = left_out(little, rows, trial.sizes.noise);
      trial.as_known = !model.fleet && by_little.squares < trial.others.squares;
      if (trial.as_known) {
        covariance = little;
        trial.others = std::move(by_little);
      }
    }
    trial.solution = solve(covariance, rows, trial.sizes.noise);
    // By the rows' medians; told anew in every step, since what the old model errs by hides how instruments differ.
    if (step + 1 == kSteps) break;
    const CorrectedRobot present = prior.changed(trial.solution.change);
    trial.scales.stations =
        scales_of_stations(data, present, observe(data, trial.used, present), trial.scales).stations;
  }
  return trial;
}

/// Whether all others predict each pose better by `one` way, of those that both use; leaving more of them out is no
/// better way.
bool predicts_better(const UpdateTrial& one, const UpdateTrial& other) {
  if (one.gross.size() > other.gross.size()) return false;
  const auto squares = [](const UpdateTrial& of, const UpdateTrial& beside) {
    double sum = 0.0;
    for (std::size_t i = 0; i < of.used.size(); ++i)
      if (std::ranges::count(beside.used, of.used[i]) > 0) sum += of.others.by_pose[i];
    return sum;
  };
  return squares(one, other) < squares(other, one);
}

void say_changes(const UpdateTrial& trial, const DataSet& data, bool of_fleet, Update& update) {
  constexpr double kMuch = 3.0;
  for (std::size_t part = 0; part < kBeliefParts; ++part) {
    const double times = std::sqrt(trial.sizes.factors[part]);
    if (trial.as_known || times <= kMuch) continue;
    const std::string_view what = to_string(static_cast<BeliefPart>(part));
    update.sentences.push_back(
        of_fleet ? fmt::format("The new poses show {} to be {:.1f} times as far from the fleet's mean as is usual for "
                               "its robots: is this one of the type?",
                               what, times)
                 : fmt::format("The new poses show {} to have changed {:.1f} times as much as is usual between two "
                               "measurements: are they of the same robot, and has nothing been exchanged?",
                               what, times));
  }
  if (!update.gross.empty())
    update.sentences.push_back(
        fmt::format("Left out as gross errors by what the model and the other poses predict of them: {}.",
                    names_with_lines(data, update.gross)));
  if (update.base_and_tool_only)
    update.sentences.emplace_back(
        "Base and tool alone explain the new poses best: nothing else of the old model was changed.");
}

}  // namespace

Update updated(const CalibratedModel& model, const CorrectedRobot& placed, const DataSet& data,
               const std::vector<std::size_t>& poses, const DeclaredModel& declared, const AssumedDrift& drift) {
  const RowScales scales = scales_of_new_poses(data, placed, poses, model.interval);
  UpdateTrial best = tried({model, placed, data, poses, declared, drift}, model, data, poses, scales);
  Update update;
  if (poses.size() <= kMostLeftOut) {
    if (const auto change = single_change(model, data, poses)) {
      UpdateTrial other =
          tried({model, change->placed, data, poses, declared, drift, change->moved}, model, data, poses, scales);
      if (predicts_better(other, best)) {
        best = std::move(other);
        update.moved = change->moved;
      }
    }
  }
  const PriorModel& prior = best.prior;
  for (double& scale : best.scales) scale *= std::sqrt(best.sizes.noise);
  update.robot = prior.changed(best.solution.change);
  set_errors_of_effects(prior, best.solution.root, update.robot);
  update.fitted = {posterior_of_update(prior, best.solution.root), best.scales};
  update.estimates = updated_estimates(prior, update.robot, data, best.solution.root);
  update.factors = best.sizes.factors;
  update.noise_factor = best.sizes.noise;
  update.gross = best.gross;
  update.base_and_tool_only = best.as_known && !update.moved;
  say_changes(best, data, model.fleet.has_value(), update);
  if (update.moved) update.sentences.push_back(sentence_of(*update.moved, model.robot, update.robot, best.as_known));
  return update;
}

}  // namespace demecal::inline updating
