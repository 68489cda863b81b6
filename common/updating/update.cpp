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
#include "fitting/tall_products.hpp"
#include "parameters/observation.hpp"
#include "parameters/parameter_space.hpp"
#include "parameters/posterior.hpp"
#include "random/distributions.hpp"
#include "residuals/residual_field.hpp"
#include "residuals/smooth_corrections.hpp"
#include "updating/belief_sizes.hpp"
#include "updating/gross_poses.hpp"

namespace demecal::inline updating {
namespace {

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

void say_changes(const BeliefSizes& sizes, const DataSet& data, bool of_fleet, Update& update) {
  constexpr double kMuch = 3.0;
  for (std::size_t part = 0; part < kBeliefParts; ++part) {
    const double times = std::sqrt(sizes.factors[part]);
    if (times <= kMuch) continue;
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
  constexpr int kSteps = 3;
  constexpr std::size_t kMostLeftOut = 150;  ///< poses
  constexpr double kNothing = 1e-8;
  const PriorModel prior(model, placed, data, poses, declared, drift);
  const JointSizes joints = model.fleet ? JointSizes::alike : JointSizes::each;
  RowScales scales = scales_of_new_poses(data, placed, poses, model.interval);
  Update update;
  Solution solution{Eigen::VectorXd::Zero(prior.numbers()), {}};
  BeliefSizes sizes;
  Eigen::MatrixXd covariance;
  std::vector<std::size_t> used = poses;
  for (int step = 0; step < kSteps; ++step) {
    const bool many = used.size() > kMostLeftOut;
    const NewRows rows = rows_about(prior, data, used, scales, solution.change, many && step > 0);
    sizes = likeliest_sizes(prior, rows, joints);
    covariance = prior.covariance(sizes.factors, sizes.of_joint);
    if (!many) {
      const LeftOut all = left_out(covariance, rows, sizes.noise);
      if (step == 0) {
        update.gross = gross_poses(prior, rows, sizes, joints);
        std::erase_if(used, [&](std::size_t pose) { return std::ranges::binary_search(update.gross, pose); });
      }
      // A robot may be as it was; none is its fleet's mean.
      const Eigen::MatrixXd little = prior.covariance({kNothing, kNothing, kNothing, kNothing}, sizes.of_joint);
      update.base_and_tool_only = !model.fleet && left_out(little, rows, sizes.noise).squares < all.squares;
      if (update.base_and_tool_only) covariance = little;
    }
    solution = solve(covariance, rows, sizes.noise);
    // By the rows' medians; told anew in every step, since what the old model errs by hides how instruments differ.
    if (step + 1 == kSteps) break;
    const CorrectedRobot present = prior.changed(solution.change);
    scales.stations = scales_of_stations(data, present, observe(data, used, present), scales).stations;
  }
  for (double& scale : scales) scale *= std::sqrt(sizes.noise);
  update.robot = prior.changed(solution.change);
  set_errors_of_effects(prior, solution.root, update.robot);
  update.fitted = {posterior_of_update(prior, solution.root), scales};
  update.estimates = updated_estimates(prior, update.robot, data, solution.root);
  update.factors = sizes.factors;
  update.noise_factor = sizes.noise;
  say_changes(sizes, data, model.fleet.has_value(), update);
  return update;
}

}  // namespace demecal::inline updating
