#include "decompositions/decompositions.hpp"
#include "next_measurement/next_measurement.hpp"
#include "products/tall_products.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "kinematics/chain.hpp"
#include "next_measurement/experiments.hpp"
#include "next_measurement/posterior_model.hpp"
#include "random/random_stream.hpp"
#include "residuals/diagnosed_model.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline next_measurement {
namespace {

constexpr int kPool = 2000;
constexpr Eigen::Index kMostColumns = 150;
/// How large a coefficient may be beforehand: so that its rows are of this size, in units of their scatter.
constexpr double kBelievedRows = 10.0;

bool has_same_law(const std::vector<Effect>& effects, const Effect& one) {
  return std::ranges::any_of(effects, [&](const Effect& effect) { return effect.same_law_as(one); });
}

/// The effects in doubt, and their rivals, the nearest of each before the next nearest of any.
std::vector<Effect> effects_asked(const std::vector<AmbiguousEffect>& ambiguous, const Robot& robot) {
  std::vector<Effect> asked;
  Eigen::Index columns = 0;
  const auto ask = [&](const Effect& effect) {
    const auto count = static_cast<Eigen::Index>(law_of(effect).coefficients(effect, robot).size());
    if (has_same_law(asked, effect) || columns + count > kMostColumns) return;
    asked.push_back(effect);
    columns += count;
  };
  std::size_t most = 0;
  for (const AmbiguousEffect& each : ambiguous) {
    ask(each.effect);
    most = std::max(most, each.rivals.size());
  }
  for (std::size_t place = 0; place < most; ++place) {
    for (const AmbiguousEffect& each : ambiguous) {
      if (place < each.rivals.size()) ask(each.rivals[place].effect);
    }
  }
  return asked;
}

/// Stops at feasible joints, in recorded circumstances; what they measure is what the poses at hand measured.
std::vector<MeasuredPose> random_stops(const DiagnosisProblem& problem, int count, RandomStream random) {
  const FeasiblePoses feasible(problem.data, problem.fitted);
  std::set<double> payloads;
  bool sides = false;
  for (const std::size_t i : problem.fitted) {
    if (problem.data.poses[i].payload_kg) payloads.insert(*problem.data.poses[i].payload_kg);
    sides = sides || problem.data.poses[i].approach;
  }
  const std::vector<double> levels(payloads.begin(), payloads.end());
  std::vector<MeasuredPose> stops;
  for (int i = 0; i < count; ++i) {
    MeasuredPose& pose = stops.emplace_back(problem.data.poses[problem.fitted[random.index(problem.fitted.size())]]);
    pose.joints = feasible.draw(feasible.allowed(), random);
    pose.torque = std::nullopt;
    pose.payload_kg = std::nullopt;
    if (!levels.empty()) pose.payload_kg = levels[random.index(levels.size())];
    pose.approach = std::nullopt;
    if (sides) {
      pose.approach = ApproachSigns(pose.joints.size());
      for (double& sign : *pose.approach) sign = random.chance(0.5) ? 1.0 : -1.0;
    }
    pose.temperature_celsius = std::nullopt;
    pose.time_s = std::nullopt;
  }
  return stops;
}

/// The determinant of what is known, as rows are added, in coordinates that start out known to one unit each.
class InformationMatrix {
 public:
  explicit InformationMatrix(RowMatrix rows) : rows_(std::move(rows)), carried_(rows_) {}

  /// By how much its logarithm grows with rows first .. first + count - 1.
  double gain(Eigen::Index first, Eigen::Index count) const {
    if (rows_.cols() == 0) return 0.0;
    return std::log(added(first, count).determinant());
  }
  void take(Eigen::Index first, Eigen::Index count) {
    const RowMatrix taken = carried_.middleRows(first, count);
    const Eigen::MatrixXd share = added(first, count).inverse();
    const RowMatrix along = rows_ * taken.transpose();
    carried_.noalias() -= along * (share * taken);
  }

 private:
  Eigen::MatrixXd added(Eigen::Index first, Eigen::Index count) const {
    return Eigen::MatrixXd::Identity(count, count) +
           carried_.middleRows(first, count) * rows_.middleRows(first, count).transpose();
  }

  RowMatrix rows_;
  RowMatrix carried_;  ///< rows times the covariance of what is known
};

/// The columns asked about, less what of them the poses at hand lay to the model's, in coordinates known to one unit.
RowMatrix asked_rows(const PosteriorModel& posterior, const std::vector<Effect>& asked, const ResidualField& field,
                     const RowMatrix& model_rows) {
  const AskedProducts at_hand =
      asked_products(posterior.model_columns(posterior.present()), posterior.effect_columns(asked, posterior.present()),
                     posterior.weight());
  RowMatrix rows = posterior.effect_columns(asked, field);
  Eigen::MatrixXd known = at_hand.asked - at_hand.cross.transpose() * at_hand.cross;
  for (Eigen::Index i = 0; i < known.cols(); ++i) {
    const double square = rows.col(i).squaredNorm() / static_cast<double>(rows.rows());
    known(i, i) += square > 0 ? square / (kBelievedRows * kBelievedRows) : 1.0;
  }
  rows -= model_rows * at_hand.cross;
  const Eigen::MatrixXd root = Cholesky(known).lower().transpose();
  return root.triangularView<Eigen::Upper>().solve<Eigen::OnTheRight>(rows);
}

}  // namespace

std::vector<Stop> propose_poses(const DiagnosisProblem& problem, const DiagnosedModel& model,
                                const std::vector<AmbiguousEffect>& ambiguous, int count, RandomStream random) {
  std::vector<Stop> picked;
  if (problem.fitted.empty() || count <= 0) return picked;
  const std::vector<Effect> asked = effects_asked(ambiguous, problem.data.robot);
  const PosteriorModel posterior(problem, model, asked, random);
  const DataSet pool = posterior.predicted(random_stops(problem, std::max(kPool, 4 * count), random));
  const ResidualField field = posterior.field(pool);
  const RowMatrix model_rows = posterior.model_columns(field);
  InformationMatrix whole(asked.empty() ? model_rows
                                        : beside(model_rows, asked_rows(posterior, asked, field, model_rows)));
  InformationMatrix nuisance(asked.empty() ? RowMatrix(field.rows(), 0) : model_rows);
  std::vector<bool> taken(field.poses.size(), false);
  while (std::ssize(picked) < count && picked.size() < taken.size()) {
    std::size_t best = taken.size();
    double most = 0.0;
    for (std::size_t i = 0; i < taken.size(); ++i) {
      if (taken[i]) continue;
      const Eigen::Index first = field.first_row[i], rows = field.rows_of_pose(i);
      const double gain = whole.gain(first, rows) - nuisance.gain(first, rows);
      if (best < taken.size() && gain <= most) continue;
      best = i;
      most = gain;
    }
    taken[best] = true;
    const Eigen::Index first = field.first_row[best], rows = field.rows_of_pose(best);
    whole.take(first, rows);
    if (!asked.empty()) nuisance.take(first, rows);
    picked.emplace_back(pool.poses[field.poses[best]]);
  }
  return picked;
}

}  // namespace demecal::inline next_measurement
