#include "residuals/noise_estimation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "parameters/observation.hpp"
#include "residuals/noise.hpp"
#include "residuals/smooth_corrections.hpp"

namespace demecal::inline residuals {
namespace {

/// Rows of the poses that take part, without weights and as they were measured.
class RowsTaken {
 public:
  explicit RowsTaken(const ResidualField& field) : field_(field) {
    constexpr double kTakesPart = 0.3;  ///< root of a pose's weight
    for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
      if (field.root_weight[pose] < kTakesPart) continue;
      poses.push_back(pose);
      for (Eigen::Index row = field.first_row[pose]; row < field.first_row[pose + 1]; ++row) {
        rows_.push_back(row);
        over_weight_.push_back(1.0 / field.root_weight[pose]);
      }
    }
  }
  Eigen::Index size() const { return std::ssize(rows_); }
  RowMatrix select(const RowMatrix& whitened) const {
    RowMatrix taken = unwhitened(field_, whitened)(rows_, Eigen::all);
    for (Eigen::Index i = 0; i < taken.rows(); ++i) taken.row(i) *= over_weight_[static_cast<std::size_t>(i)];
    return taken;
  }

  std::vector<std::size_t> poses;

 private:
  const ResidualField& field_;
  std::vector<Eigen::Index> rows_;
  std::vector<double> over_weight_;
};

/// The terms in the order of how fast they change; waves before polynomials that do alike.
std::vector<Eigen::Index> slow_first(const SmoothCorrections& smooth) {
  const auto changes = [&](Eigen::Index term) {
    const SmoothTerm& at = smooth.terms[static_cast<std::size_t>(term)];
    return at.harmonic > 0 ? static_cast<double>(at.harmonic) : 0.7 + 0.5 * at.family;
  };
  std::vector<Eigen::Index> order(smooth.terms.size());
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::stable_sort(order, {}, changes);
  return order;
}

/// The columns that the model may move in, among the declared ones and the smooth terms behind them.
std::vector<Eigen::Index> movable_columns(const Linearization& linearization, const SmoothCorrections& smooth) {
  constexpr double kMostOfRows = 0.6;  ///< of the rows of distinct poses
  const auto declared = static_cast<Eigen::Index>(linearization.ids.size());
  std::vector<Eigen::Index> columns(linearization.ids.size());
  std::iota(columns.begin(), columns.end(), Eigen::Index{0});
  const double share = static_cast<double>(distinct_poses(linearization.fitted)) /
                       static_cast<double>(linearization.fitted.poses.size());
  const double most = kMostOfRows * share * static_cast<double>(linearization.fitted.rows());
  for (const Eigen::Index term : slow_first(smooth))
    if (static_cast<double>(columns.size()) < most) columns.push_back(declared + term);
  return columns;
}

/// What the terms do whose columns are not among `moving`: with too few poses to tell, it counts as noise.
Eigen::VectorXd at_rest(const RowMatrix& columns, const std::vector<Eigen::Index>& moving,
                        const SmoothCorrections& smooth) {
  Eigen::VectorXd numbers = Eigen::VectorXd::Zero(columns.cols());
  numbers.tail(smooth.coefficients.size()) = smooth.coefficients;
  for (const Eigen::Index column : moving) numbers[column] = 0.0;
  return columns * numbers;
}

/// Whether anything could be told of heat: then drift explains as much where it warms while it is measured.
bool heat_varies(const ResidualField& field) {
  const auto celsius = [](const ArmState& state) { return state.stop.temperature_celsius; };
  return std::ranges::any_of(field.states, [&](const ArmState& state) {
    return celsius(state).has_value() && celsius(state) != celsius(field.states.front());
  });
}

/// What a base does that creeps evenly in time, where times vary: rows x numbers. It is a cause that can be named, and
/// counts as fitted whether it was chosen or not: a straight line lent to poses as noise would never be one.
RowMatrix even_drift(const DiagnosisProblem& problem, const ResidualField& field) {
  const auto time_s = [](const ArmState& state) { return state.stop.time_s; };
  const bool timed =
      std::ranges::all_of(field.states, [&](const ArmState& state) { return time_s(state).has_value(); });
  const bool varies = timed && std::ranges::any_of(field.states, [&](const ArmState& state) {
                        return time_s(state) != time_s(field.states.front());
                      });
  if (!varies) return RowMatrix(field.rows(), 0);
  double sum_s = 0.0;
  for (const ArmState& state : field.states) sum_s += *time_s(state);
  Evidence evidence;
  evidence.time = true;
  evidence.mean_time_s = sum_s / static_cast<double>(field.states.size());
  std::vector<Effect> effects;
  for (const EffectLaw* const law : catalogue())
    if (law->prerequisite() == Circumstance::time)
      std::ranges::copy(law->proposals(problem.data.robot, evidence), std::back_inserter(effects));
  EffectColumns columns;
  columns.append(effects, problem.data.robot, field.states);
  columns.pack();
  return columns.dense(field);
}

/// Among the columns of the model's numbers, those of effects that the model holds and that go with time.
std::vector<Eigen::Index> held_drift(const Linearization& linearization, const CorrectedRobot& robot) {
  std::vector<Eigen::Index> held;
  for (std::size_t i = 0; i < linearization.ids.size(); ++i) {
    const ParameterId& id = linearization.ids[i];
    if (id.kind != ParameterId::Kind::effect) continue;
    if (law_of(robot.effects[static_cast<std::size_t>(id.index)]).prerequisite() == Circumstance::time)
      held.push_back(static_cast<Eigen::Index>(i));
  }
  return held;
}

/// Whether an arm and an instrument may be as noisy: else what the model lacks is taken for noise.
bool is_noise(const NoiseEstimate& noise, const RowScales& scales) {
  constexpr double kWorstJoint_rad = 1e-3, kWorstShared_m = 5e-3;
  const double unit_m = noise.scale * std::max(scales[kPosition], scales[kDistance]);
  return noise.model.joint_rad <= kWorstJoint_rad &&
         unit_m * std::max(noise.model.repeats, noise.model.order) <= kWorstShared_m;
}

}  // namespace

std::optional<NoiseEstimate> noise_shown(const DiagnosisProblem& problem, const Linearization& linearization,
                                         const DiagnosedModel& model) {
  const SmoothCorrections& smooth = model.smooth;
  const RowsTaken taken(linearization.fitted);
  if (taken.size() == 0) return std::nullopt;
  const RowMatrix columns = beside(linearization.fitted.declared, smooth.columns(linearization.fitted));
  std::vector<Eigen::Index> moving = movable_columns(linearization, smooth);
  Eigen::VectorXd residual = linearization.fitted.residual + at_rest(columns, moving, smooth);
  // Drift that the model holds is judged beside slow noise as if it had not been found yet.
  const std::vector<Eigen::Index> held = held_drift(linearization, model.robot);
  for (const Eigen::Index column : held) {
    std::erase(moving, column);
    residual += columns.col(column) * parameter_value(model.robot, linearization.ids[static_cast<std::size_t>(column)]);
  }
  const RowMatrix drift = beside(even_drift(problem, linearization.fitted), columns(Eigen::all, held));
  NoiseRows rows{
      .columns = taken.select(columns(Eigen::all, moving)),
      .residual = taken.select(residual),
      .joint_motions = taken.select(linearization.fitted.motions(Eigen::all, linearization.fitted.scattering)),
      .first_row = {0},
      .group = {},
      .order = {},
      .drift_is_rival = heat_varies(linearization.fitted),
      .even_drift = taken.select(drift)};
  for (const std::size_t pose : taken.poses) {
    rows.first_row.push_back(rows.first_row.back() + linearization.fitted.rows_of_pose(pose));
    rows.group.push_back(linearization.fitted.group[pose]);
    rows.order.push_back(static_cast<double>(linearization.fitted.poses[pose]));
  }
  return estimate_noise(rows);
}

DiagnosedModel with_noise(DiagnosedModel model, const Linearization& linearization, const NoiseEstimate& noise) {
  if (!is_noise(noise, model.scales)) return model;
  model.noise = noise.model;
  model.noise.fast = unfollowed_variance(model.noise, linearization.fitted.poses);
  model.noise_estimated = true;
  for (double& scale : model.scales) scale *= noise.scale;
  return model;
}

DiagnosedModel with_noise_estimated(const DiagnosisProblem& problem, DiagnosedModel model) {
  const Linearization linearization = linearize(problem, model);
  const std::optional<NoiseEstimate> noise = noise_shown(problem, linearization, model);
  return noise ? with_noise(std::move(model), linearization, *noise) : model;
}

}  // namespace demecal::inline residuals
