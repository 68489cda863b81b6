#include "diagnosis/noise_estimation.hpp"

#include <algorithm>
#include <numeric>

#include "diagnosis/noise_model.hpp"
#include "diagnosis/shared_errors.hpp"

namespace demecal {
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
  RowMatrix of(const RowMatrix& whitened) const {
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
std::vector<Eigen::Index> columns_of(const Linearised& at, const SmoothCorrections& smooth) {
  constexpr double kMostOfRows = 0.6;  ///< of the rows of distinct poses
  const auto declared = static_cast<Eigen::Index>(at.ids.size());
  std::vector<Eigen::Index> columns(at.ids.size());
  std::iota(columns.begin(), columns.end(), Eigen::Index{0});
  const double share = static_cast<double>(distinct_poses(at.fitted)) / static_cast<double>(at.fitted.poses.size());
  const double most = kMostOfRows * share * static_cast<double>(at.fitted.rows());
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

/// Whether an arm and an instrument may be as noisy: else what the model lacks is taken for noise.
bool is_noise(const NoiseEstimate& noise, const RowScales& scales) {
  constexpr double kWorstJoint_rad = 1e-3, kWorstShared_m = 5e-3;
  const double unit_m = noise.scale * std::max(scales[kPosition], scales[kDistance]);
  return noise.model.joint_rad <= kWorstJoint_rad &&
         unit_m * std::max(noise.model.repeats, noise.model.order) <= kWorstShared_m;
}

}  // namespace

DiagnosedModel with_noise_estimated(const DiagnosisData& of, DiagnosedModel model) {
  const Linearised at = linearise(of, model);
  const RowsTaken taken(at.fitted);
  if (taken.size() == 0) return model;
  const RowMatrix columns = beside(at.fitted.declared, model.smooth.columns(at.fitted));
  const std::vector<Eigen::Index> moving = columns_of(at, model.smooth);
  NoiseRows rows{.columns = taken.of(columns(Eigen::all, moving)),
                 .residual = taken.of(at.fitted.residual + at_rest(columns, moving, model.smooth)),
                 .joint_motions = taken.of(at.fitted.motions(Eigen::all, at.fitted.scattering)),
                 .first_row = {0},
                 .group = {},
                 .order = {},
                 .drift_is_rival = heat_varies(at.fitted)};
  for (const std::size_t pose : taken.poses) {
    rows.first_row.push_back(rows.first_row.back() + at.fitted.rows_of_pose(pose));
    rows.group.push_back(at.fitted.group[pose]);
    rows.order.push_back(static_cast<double>(at.fitted.poses[pose]));
  }
  const NoiseEstimate noise = estimate_noise(rows);
  if (!is_noise(noise, model.scales)) return model;
  model.noise = noise.model;
  model.noise.fast = unfollowed_variance(model.noise, at.fitted.poses);
  model.noise_estimated = true;
  for (double& scale : model.scales) scale *= noise.scale;
  return model;
}

}  // namespace demecal
