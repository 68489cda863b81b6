#include "explanations/error_budget.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "fitting/parameter_space.hpp"
#include "kinematics/units.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline explanations {
namespace {

using SquaredErrors_mm2 = std::vector<double>;  ///< of the judging poses

/// The effects of some of the causes.
std::vector<std::size_t> effects_of(const std::vector<ErrorCause>& causes, const std::vector<std::size_t>& some) {
  std::vector<std::size_t> effects;
  for (const std::size_t cause : some) std::ranges::copy(causes[cause].effects, std::back_inserter(effects));
  std::ranges::sort(effects);
  return effects;
}

SquaredErrors_mm2 squared_errors(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot) {
  SquaredErrors_mm2 errors;
  for (const std::size_t pose : poses)
    errors.push_back(std::pow(millimetres(tool_error_m(robot, data, data.poses[pose])), 2));
  return errors;
}

double mean_of(const SquaredErrors_mm2& errors) {
  return std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
}

/// The poses on which models are judged: those with a tool error that is not gross.
std::vector<std::size_t> judging_poses(const DiagnosisProblem& problem, const CorrectedRobot& robot) {
  std::vector<std::size_t> poses = problem.validation.empty() ? problem.fitted : problem.validation;
  const auto error_m = [&](std::size_t pose) { return tool_error_m(robot, problem.data, problem.data.poses[pose]); };
  std::vector<double> errors_m;
  for (const std::size_t pose : poses) errors_m.push_back(error_m(pose));
  const double limit_m = gross_error_limit(std::move(errors_m));
  std::erase_if(poses, [&](std::size_t pose) { return !(error_m(pose) <= limit_m); });
  return poses;
}

double root_of_fall(double without_mm2, double with_mm2) {
  return std::sqrt(std::max(without_mm2 - with_mm2, 0.0));
}

/// 95 % of the root of the fall of the mean square when poses are drawn anew.
std::array<double, 2> fall_interval(const SquaredErrors_mm2& without, const SquaredErrors_mm2& with,
                                    RandomStream& random) {
  constexpr std::size_t kDraws = 400;
  std::vector<double> falls_mm;
  for (std::size_t draw = 0; draw < kDraws; ++draw) {
    double fall_mm2 = 0.0;
    for (std::size_t i = 0; i < with.size(); ++i) {
      const std::size_t pose = random.index(with.size());
      fall_mm2 += (without[pose] - with[pose]) / static_cast<double>(with.size());
    }
    falls_mm.push_back(root_of_fall(fall_mm2, 0.0));
  }
  std::ranges::sort(falls_mm);
  return {falls_mm[kDraws / 40], falls_mm[kDraws - 1 - kDraws / 40]};
}

/// For every number of causes, from all of them down to none, those that are left out.
std::vector<std::vector<std::size_t>> left_out_by_number(const ReducedModels& models,
                                                         const std::vector<ErrorCause>& causes) {
  const auto rise = [&](const std::vector<std::size_t>& out) { return models.rise(effects_of(causes, out)); };
  std::vector<bool> is_out(causes.size(), false);
  std::vector<std::size_t> out;
  const auto lower_by_exchange = [&] {
    double least = rise(out);
    for (std::size_t place = 0; place < out.size(); ++place) {
      for (std::size_t other = 0; other < causes.size(); ++other) {
        if (is_out[other]) continue;
        const std::size_t present = std::exchange(out[place], other);
        if (const double tried = rise(out); tried < least) {
          is_out[present] = false;
          is_out[other] = true;
          least = tried;
          return true;
        }
        out[place] = present;
      }
    }
    return false;
  };
  std::vector<std::vector<std::size_t>> all{out};
  while (out.size() < causes.size()) {
    std::size_t next = causes.size();
    double least = std::numeric_limits<double>::infinity();
    out.push_back(0);
    for (std::size_t cause = 0; cause < causes.size(); ++cause) {
      if (is_out[cause]) continue;
      out.back() = cause;
      if (const double tried = rise(out); tried < least) {
        least = tried;
        next = cause;
      }
    }
    out.back() = next;
    is_out[next] = true;
    while (lower_by_exchange()) {
    }
    all.push_back(out);
  }
  return all;
}

}  // namespace

ReducedModels::ReducedModels(const DiagnosisProblem& problem, const DiagnosedModel& model)
    : model_(model), linearization_(linearize(problem, model)) {}

std::vector<Eigen::Index> ReducedModels::columns_of(std::span<const std::size_t> effects) const {
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < linearization_.ids.size(); ++i) {
    const ParameterId& id = linearization_.ids[i];
    if (id.kind == ParameterId::Kind::effect && std::ranges::binary_search(effects, static_cast<std::size_t>(id.index)))
      columns.push_back(static_cast<Eigen::Index>(i));
  }
  return columns;
}

ReducedModels::WaldTerms ReducedModels::wald_terms(const std::vector<Eigen::Index>& columns) const {
  const auto size = static_cast<Eigen::Index>(columns.size());
  WaldTerms terms{Eigen::VectorXd(size), Eigen::VectorXd(size)};
  if (columns.empty()) return terms;
  for (Eigen::Index i = 0; i < size; ++i) {
    const Eigen::Index column = columns[static_cast<std::size_t>(i)];
    const ParameterId& id = linearization_.ids[static_cast<std::size_t>(column)];
    terms.values[i] = parameter_value(model_.robot, id) + linearization_.changes[column];
  }
  const Eigen::MatrixXd covariance = linearization_.covariance(columns, columns);
  const Eigen::VectorXd scale = covariance.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Eigen::MatrixXd> solver(scale.asDiagonal() * covariance * scale.asDiagonal());
  terms.weighted = scale.cwiseProduct(solver.solve(scale.cwiseProduct(terms.values)));
  return terms;
}

double ReducedModels::rise(std::span<const std::size_t> effects) const {
  const WaldTerms terms = wald_terms(columns_of(effects));
  return terms.values.dot(terms.weighted);
}

CorrectedRobot ReducedModels::without(std::span<const std::size_t> effects) const {
  const std::vector<Eigen::Index> columns = columns_of(effects);
  const WaldTerms terms = wald_terms(columns);
  Eigen::VectorXd changes = linearization_.changes;
  for (Eigen::Index i = 0; i < terms.weighted.size(); ++i)
    changes -= linearization_.covariance.col(columns[static_cast<std::size_t>(i)]) * terms.weighted[i];
  const ParameterSpace space(model_.robot, linearization_.ids);
  CorrectedRobot robot = space.at(changes.head(space.size())).robot;
  SmoothCorrections smooth = model_.smooth;
  smooth.coefficients += changes.tail(smooth.coefficients.size());
  robot.corrections = smooth.corrections();
  for (std::size_t i = effects.size(); i-- > 0;)
    robot.effects.erase(robot.effects.begin() + static_cast<std::ptrdiff_t>(effects[i]));
  return robot;
}

ErrorBudget error_budget(const DiagnosisProblem& problem, const DiagnosedModel& model,
                         std::span<const std::size_t> last_fitted, const DiagnosedModel& last, RandomStream random) {
  ErrorBudget budget;
  const std::vector<ErrorCause> causes = causes_of(model.robot);
  const std::vector<std::size_t> judging = judging_poses(problem, model.robot);
  if (causes.empty() || judging.empty()) return budget;
  const ReducedModels models(problem, model);
  const DiagnosisProblem last_problem{problem.data, problem.declared, {last_fitted.begin(), last_fitted.end()}, {}};
  const ReducedModels last_models(last_problem, last);
  const std::vector<std::size_t> accept = poses_of(problem.data, PoseSet::accept);

  for (const std::vector<std::size_t>& out : left_out_by_number(models, causes)) {
    const std::vector<std::size_t> effects = effects_of(causes, out);
    FrontPoint point{.causes = {}, .chosen = out.empty()};
    for (std::size_t cause = 0; cause < causes.size(); ++cause)
      if (!std::ranges::count(out, cause)) point.causes.push_back(cause);
    point.validation_rms_mm = std::sqrt(mean_of(squared_errors(problem.data, judging, models.without(effects))));
    if (!accept.empty()) point.accept_rms_mm = error_figures(last_models.without(effects), problem.data, accept).rms_mm;
    budget.front.push_back(std::move(point));
  }
  std::ranges::reverse(budget.front);

  const SquaredErrors_mm2 with = squared_errors(problem.data, judging, models.without({}));
  const double bare_mm2 = std::pow(budget.front.front().validation_rms_mm, 2);
  for (const ErrorCause& cause : causes) {
    const SquaredErrors_mm2 without = squared_errors(problem.data, judging, models.without(cause.effects));
    const double without_mm2 = mean_of(without), with_mm2 = mean_of(with);
    budget.causes.push_back({.cause = cause,
                             .without_mm = std::sqrt(without_mm2),
                             .with_mm = std::sqrt(with_mm2),
                             .share = (without_mm2 - with_mm2) / bare_mm2,
                             .interval_mm = fall_interval(without, with, random)});
  }
  std::ranges::stable_sort(budget.causes, std::greater{}, &CauseCost::without_mm);
  return budget;
}

}  // namespace demecal::inline explanations
