#include "updating/belief_sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

#include "decompositions/decompositions.hpp"
#include "parameters/parameter_space.hpp"

namespace demecal::inline updating {
namespace {

/// Whole poses' rows, spread evenly.
std::vector<Eigen::Index> evenly_kept(const NewRows& rows, Eigen::Index most_rows) {
  const Eigen::Index all = rows.columns.rows();
  const double share = static_cast<double>(std::min(all, most_rows)) / static_cast<double>(all);
  std::vector<Eigen::Index> kept;
  double due = 0.0;
  for (std::size_t i = 0; i < rows.field.poses.size(); ++i) {
    due += share;
    if (due < 1.0 - 1e-9) continue;
    due -= 1.0;
    for (Eigen::Index row = rows.field.first_row[i]; row < rows.field.first_row[i + 1]; ++row) kept.push_back(row);
  }
  return kept;
}

/// Variance components of the rows, as far as factors multiply them.
class RowCovariance {
 public:
  RowCovariance(const PriorModel& prior, const NewRows& rows, Eigen::Index most_rows) {
    const std::vector<Eigen::Index> kept = evenly_kept(rows, most_rows);
    const Eigen::MatrixXd columns = rows.columns(kept, Eigen::all);
    values_ = rows.values(kept);
    fixed_ = columns * prior.fixed_covariance() * columns.transpose();
    for (const BeliefPart part : kAllBeliefParts)
      for (int joint = 0; joint < (of_waves(part) ? prior.joints() : 1); ++joint)
        components_.push_back({part, joint, columns * prior.covariance_of(part, joint) * columns.transpose()});
  }

  double minus_twice_log(const BeliefSizes& sizes) const {
    Eigen::MatrixXd sum = fixed_;
    for (const Component& one : components_) {
      const double of_joint = of_waves(one.part) ? sizes.of_joint[one.joint] : 1.0;
      sum += sizes.factors[static_cast<std::size_t>(one.part)] * of_joint * one.covariance;
    }
    sum.diagonal().array() += sizes.noise;
    const Cholesky root(sum);
    if (!root.succeeded()) return 1e300;
    return root.whitened(values_).squaredNorm() + root.log_determinant();
  }

 private:
  struct Component {
    BeliefPart part;
    int joint;
    Eigen::MatrixXd covariance;
  };

  Eigen::MatrixXd fixed_;
  std::vector<Component> components_;
  Eigen::VectorXd values_;
};

double minus_twice_log_belief(const BeliefSizes& sizes) {
  constexpr double kBelief = 2.0, kNoiseBelief = 0.7;  ///< of the logarithm of a variance's factor
  double sum = std::pow(std::log(sizes.noise) / kNoiseBelief, 2.0);
  for (const double factor : sizes.factors) sum += std::pow(std::log(factor) / kBelief, 2.0);
  return sum + (sizes.of_joint.array().log() / kBelief).square().sum();
}

double& factor_at(BeliefSizes& sizes, std::size_t which) {
  if (which < kBeliefParts) return sizes.factors[which];
  if (which == kBeliefParts) return sizes.noise;
  return sizes.of_joint[static_cast<Eigen::Index>(which - kBeliefParts - 1)];
}

}  // namespace

std::string_view to_string(BeliefPart part) {
  constexpr std::array<std::string_view, kBeliefParts> kWords{"links", "effects", "joints outside the known range",
                                                              "joints within it"};
  return kWords[static_cast<std::size_t>(part)];
}

NewRows rows_about(const PriorModel& prior, const DataSet& data, const std::vector<std::size_t>& poses,
                   const RowScales& scales, const Eigen::VectorXd& change, bool robust) {
  const ParameterSpace space(prior.changed(change), prior.ids());
  NewRows rows{residual_field(data, poses, space, scales, robust), {}, {}};
  rows.columns = prior.columns(rows.field);
  rows.values = rows.field.residual + rows.columns * change;
  return rows;
}

BeliefSizes likeliest_sizes(const PriorModel& prior, const NewRows& new_rows, JointSizes joints) {
  constexpr int kSweeps = 4, kSteps = 6;
  constexpr Eigen::Index kMostRows = 480;
  const RowCovariance rows(prior, new_rows, kMostRows);
  const auto cost = [&](const BeliefSizes& sizes) {
    return rows.minus_twice_log(sizes) + minus_twice_log_belief(sizes);
  };
  BeliefSizes best;
  best.of_joint.setOnes(prior.joints());
  double least = cost(best);
  double ratio = 4.0;
  const std::size_t count =
      kBeliefParts + 1 + (joints == JointSizes::each ? static_cast<std::size_t>(prior.joints()) : 0);
  for (int sweep = 0; sweep < kSweeps; ++sweep, ratio = std::max(1.3, std::sqrt(ratio))) {
    for (std::size_t which = 0; which < count; ++which) {
      for (const double by : {ratio, 1.0 / ratio}) {
        for (int step = 0; step < kSteps; ++step) {
          BeliefSizes trial = best;
          factor_at(trial, which) *= by;
          const double there = cost(trial);
          if (there >= least - 1e-6) break;
          least = there;
          best = trial;
        }
      }
    }
  }
  return best;
}

}  // namespace demecal::inline updating
