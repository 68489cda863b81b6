#include "diagnosis/backward.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace demecal {
namespace {

constexpr int kStepsAgain = 3;

/// The columns of each effect among the free parameters.
std::vector<std::vector<Eigen::Index>> columns_of_effects(const Linearised& at, std::size_t effects) {
  std::vector<std::vector<Eigen::Index>> columns(effects);
  for (std::size_t i = 0; i < at.ids.size(); ++i) {
    if (at.ids[i].kind == ParameterId::Kind::effect) {
      columns[static_cast<std::size_t>(at.ids[i].index)].push_back(static_cast<Eigen::Index>(i));
    }
  }
  return columns;
}

/// Rise of the sum of squares if these coefficients were zero (Wald).
double rise_without(const Linearised& at, const Effect& effect, const std::vector<Eigen::Index>& columns) {
  const auto m = static_cast<Eigen::Index>(columns.size());
  Eigen::VectorXd values(m);
  Eigen::MatrixXd covariance(m, m);
  for (Eigen::Index i = 0; i < m; ++i) {
    values[i] = effect.value(static_cast<std::size_t>(i)) + at.changes[columns[static_cast<std::size_t>(i)]];
    for (Eigen::Index k = 0; k < m; ++k) {
      covariance(i, k) = at.covariance(columns[static_cast<std::size_t>(i)], columns[static_cast<std::size_t>(k)]);
    }
  }
  return values.dot(covariance.completeOrthogonalDecomposition().solve(values));
}

/// The effect whose loss would shorten the description most, if any would.
std::optional<std::size_t> needless(const Linearised& at, const CorrectedRobot& robot,
                                    const std::vector<Candidate>& candidates) {
  const auto columns = columns_of_effects(at, robot.effects.size());
  const double variance = at.projection.squares() / at.projection.freedom();
  const double price_of_one = 0.5 * std::log(static_cast<double>(at.fitted.poses.size()));
  std::optional<std::size_t> worst;
  double least = 0.0;
  for (std::size_t i = 0; i < robot.effects.size(); ++i) {
    const double rise = rise_without(at, robot.effects[i], columns[i]) / variance;
    const double fall =
        0.5 * rise - price_of_one * static_cast<double>(columns[i].size()) - price_nats(robot.effects[i], candidates);
    if (fall < least) {
      least = fall;
      worst = i;
    }
  }
  return worst;
}

}  // namespace

Linearised take_back_needless(const DiagnosisData& of, DiagnosedModel& model, const std::vector<Candidate>& candidates,
                              LoopOutcome& outcome) {
  for (;;) {
    Linearised at = linearise(of, model);
    const auto index = needless(at, model.robot, candidates);
    if (!index) return at;
    const auto dropped = model.robot.effects.begin() + static_cast<std::ptrdiff_t>(*index);
    for (Round& round : outcome.rounds) {
      if (round.verdict != Verdict::added || !round.effect.same_law_as(*dropped)) continue;
      round.verdict = Verdict::rejected;
      round.reason = "taken back by the backward step: no longer needed beside the others";
    }
    outcome.dropped.push_back(*dropped);
    model.robot.effects.erase(dropped);
    model = refined(of, std::move(model), kStepsAgain);
  }
}

}  // namespace demecal
