#include "residuals/diagnosed_model.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "fitting/least_squares.hpp"
#include "parameters/observation.hpp"
#include "parameters/parameter_space.hpp"
#include "pieces/pieces.hpp"
#include "products/tall_products.hpp"
#include "random/distributions.hpp"
#include "residuals/noise.hpp"

namespace demecal::inline residuals {
namespace {

std::vector<ParameterId> free_ids(const DiagnosisProblem& problem, const CorrectedRobot& robot) {
  std::vector<ParameterId> ids = free_parameters(problem.data, problem.declared);
  for (ParameterId& id : effect_parameters(robot)) ids.push_back(std::move(id));
  for (ParameterId& id : contact_parameters(problem.data, problem.fitted)) ids.push_back(std::move(id));
  return ids;
}

void believe_effects_small(const std::vector<ParameterId>& ids, const CorrectedRobot& robot, const Robot& described,
                           const std::vector<ArmState>& states, Prior& prior) {
  const std::vector<std::vector<double>> precisions = precisions_of(robot.effects, described, states);
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (ids[k].kind != ParameterId::Kind::effect) continue;
    const auto effect = static_cast<std::size_t>(ids[k].index),
               coefficient = static_cast<std::size_t>(ids[k].coefficient);
    const auto at = static_cast<Eigen::Index>(k);
    prior.precision[at] = precisions[effect][coefficient];
    prior.offset[at] = robot.effects[effect].value(coefficient);
  }
}

/// `shared`: of unit variance, taken out beforehand.
Eigen::VectorXd smooth_precision(const ModelColumns& columns, const RowMatrix& shared, const Eigen::VectorXd& residual,
                                 const SmoothCorrections& smooth) {
  const Eigen::VectorXd& present = smooth.coefficients;
  const Eigen::Index terms = present.size(), n = columns.fitted.cols(), others = n - terms;
  if (terms == 0) return {};
  const RowMatrix rows = beside(columns.fitted, residual + columns.fitted.rightCols(terms) * present);
  const RowMatrix known = beside(columns.known, columns.known_residual);
  Eigen::MatrixXd products = square_product(rows) + known.transpose() * known;
  const Eigen::ArrayXd beliefs = columns.precision.head(others).array().square();
  const Eigen::ArrayXd believed = -beliefs * columns.offset.head(others).array();
  products.diagonal().head(others).array() += beliefs;
  products.col(n).head(others).array() += believed;
  products.row(n).head(others).array() += believed.transpose();
  products(n, n) -= (believed * columns.offset.head(others).array()).sum();
  if (shared.cols() > 0) {
    Eigen::MatrixXd own = shared.transpose() * shared;
    own.diagonal().array() += 1.0;
    const Eigen::MatrixXd across = transposed_product(shared, rows);
    products -= across.transpose() * Cholesky(own).solve(across);
  }
  return relevance(products, smooth.families(), static_cast<double>(residual.size()));
}

/// What is known between contacts, over the model's columns: `terms` smooth ones come after those of `space`.
void add_known(const DataSet& data, const ParameterSpace& space, Eigen::Index terms, ModelColumns& columns) {
  const RelationRows known = relation_rows(data, space, space.at(Eigen::VectorXd::Zero(space.size())));
  columns.known = RowMatrix::Zero(known.residual.size(), space.size() + terms);
  columns.known.leftCols(space.size()) = -known.jacobian;
  columns.known_residual = known.residual;
}

ModelColumns model_columns(const DataSet& data, const ParameterSpace& space, const Prior& prior,
                           const SmoothCorrections& smooth, const Eigen::VectorXd& kept_precision,
                           const ResidualField& fitted, const ResidualField& validation, const RowMatrix& shared) {
  RowMatrix unseen = smooth.columns(validation);
  leave_out_places(validation, unseen);
  ModelColumns columns{beside(fitted.declared, smooth.columns(fitted)), beside(validation.declared, unseen), {}, {}};
  const Eigen::Index n = space.size(), terms = smooth.coefficients.size();
  add_known(data, space, terms, columns);
  columns.precision.setZero(n + terms);
  columns.precision.head(n) = prior.precision;
  columns.offset.setZero(n + terms);
  columns.offset.head(n) = prior.offset;
  columns.offset.tail(terms) = smooth.coefficients;
  columns.precision.tail(terms) =
      kept_precision.size() == terms ? kept_precision : smooth_precision(columns, shared, fitted.residual, smooth);
  return columns;
}

/// Takes effects that are left out from the numbers of the model, and gives the residual what they explain of it. The
/// columns that stay: of those numbers, and of the `terms` smooth terms after them.
std::vector<Eigen::Index> without_effects(const std::vector<bool>& left_out, const CorrectedRobot& robot,
                                          Eigen::Index terms, std::vector<ParameterId>& ids, ResidualField& fitted,
                                          ResidualField& validation) {
  std::vector<Eigen::Index> kept;
  std::vector<ParameterId> kept_ids;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    if (ids[i].kind == ParameterId::Kind::effect && left_out[static_cast<std::size_t>(ids[i].index)]) {
      const double value = parameter_value(robot, ids[i]);
      fitted.residual += fitted.declared.col(column) * value;
      validation.residual += validation.declared.col(column) * value;
    } else {
      kept.push_back(column);
      kept_ids.push_back(ids[i]);
    }
  }
  for (Eigen::Index i = 0; i < terms; ++i) kept.push_back(static_cast<Eigen::Index>(ids.size()) + i);
  ids = std::move(kept_ids);
  return kept;
}

ModelColumns those_of(const ModelColumns& columns, const std::vector<Eigen::Index>& kept) {
  return {columns.fitted(Eigen::all, kept),
          columns.validation(Eigen::all, kept),
          columns.precision(kept),
          columns.offset(kept),
          0,
          columns.known(Eigen::all, kept),
          columns.known_residual};
}

void append_shared_errors(ModelColumns& columns, const SharedErrors& shared) {
  const Eigen::Index known = columns.precision.size(), more = shared.fitted.cols();
  if (more == 0) return;
  columns.fitted = beside(columns.fitted, shared.fitted);
  columns.validation = beside(columns.validation, shared.validation);
  columns.precision.conservativeResize(known + more);
  columns.precision.tail(more).setOnes();
  columns.offset.conservativeResize(known + more);
  columns.offset.tail(more).setZero();
  columns.known = beside(columns.known, RowMatrix::Zero(columns.known.rows(), more));
  columns.shared = more;
}

/// What the least-squares residuals of every station and kind show, given the freedom they have left. Data that name no
/// stations are of one.
StationSums sums_of_residuals(const DiagnosisProblem& problem, const Linearization& linearization,
                              const RowScales& present) {
  StationSums sums;
  for (std::size_t i = 0; i < linearization.fitted.poses.size(); ++i) {
    const MeasuredPose& pose = problem.data.poses[linearization.fitted.poses[i]];
    const RowCounts count = count_rows(pose);
    auto& [squares, freedom] = sums[problem.data.stations.empty() ? std::string() : pose.station];
    Eigen::Index row = linearization.fitted.first_row[i];
    for (std::size_t kind = 0; kind < kRowKinds; ++kind) {
      if (present[kind] <= 0) continue;
      for (int k = 0; k < count[kind]; ++k, ++row) {
        squares[kind] += std::pow(linearization.projection.residual()[row], 2);
        freedom[kind] +=
            std::pow(linearization.fitted.root_weight[i], 2) - linearization.projection.basis().row(row).squaredNorm();
      }
    }
  }
  return sums;
}

/// Scales that were estimated together with the noise stay, but for how stations differ from one another.
RowScales rescaled_by_residuals(const DiagnosisProblem& problem, const Linearization& linearization,
                                const DiagnosedModel& model) {
  if (model.noise_estimated && problem.data.stations.empty()) return model.scales;
  RowScales scales = rescaled(sums_of_residuals(problem, linearization, model.scales), model.scales);
  if (model.noise_estimated) std::ranges::copy(model.scales, scales.begin());
  return scales;
}

void set_effect_errors(CorrectedRobot& robot, const Linearization& linearization) {
  for (std::size_t i = 0; i < linearization.ids.size(); ++i) {
    const ParameterId& id = linearization.ids[i];
    if (id.kind != ParameterId::Kind::effect) continue;
    Effect& effect = robot.effects[static_cast<std::size_t>(id.index)];
    effect.standard_errors.resize(effect.values.size());
    const auto row = static_cast<Eigen::Index>(i);
    effect.standard_errors[static_cast<std::size_t>(id.coefficient)] = std::sqrt(linearization.covariance(row, row));
  }
}

/// A start's scales, which its few gross errors cannot have driven up.
RowScales starting_scales(const DiagnosisProblem& problem, const Fit& start) {
  const std::vector<Observation> observations = observe(problem.data, problem.fitted, start.robot);
  const RowScales median = median_deviations(problem.data, start.robot, observations);
  RowScales scales{start.sigma_position_m, start.sigma_orientation_rad, start.sigma_distance_m};
  for (std::size_t kind = 0; kind < kRowKinds; ++kind)
    if (scales[kind] > 0.0) scales[kind] = std::max(kSmallestScale, std::min(scales[kind], median[kind]));
  return scales_of_stations(problem.data, start.robot, observations, scales);
}

}  // namespace

RowMatrix unwhitened(const ResidualField& field, RowMatrix rows) {
  for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
    if (field.within[pose].size() == 0) continue;
    auto own = rows.middleRows(field.first_row[pose], field.rows_of_pose(pose));
    own = (field.within[pose] * own).eval();
  }
  return rows;
}

DiagnosedModel diagnosed_model(const DiagnosisProblem& problem, const Fit& start) {
  DiagnosedModel model;
  model.robot = start.robot;
  model.smooth = smooth_corrections(problem.data, problem.fitted, start.robot, problem.declared.joint_corrections,
                                    problem.declared.joint_offset);
  model.scales = starting_scales(problem, start);
  return model;
}

std::vector<std::vector<double>> precisions_of(const std::vector<Effect>& effects, const Robot& described,
                                               const std::vector<ArmState>& states) {
  constexpr double kUsualMotion = 2e-3;  ///< rad or m
  constexpr double kLeastShare = 1e-6;   ///< of the most that another coefficient of the effect does
  constexpr std::size_t kEnough = 1000;  ///< states that tell how large a motion is
  const std::size_t step = std::max<std::size_t>(states.size() / kEnough, 1);
  std::vector<std::vector<double>> precisions(effects.size());
  in_pieces(effects.size(), [&](std::size_t i) {
    std::vector<double> squares(law_of(effects[i]).coefficients(effects[i], described).size(), 0.0);
    std::vector<UnitMotion> motions;
    double count = 0.0;
    for (std::size_t state = 0; state < states.size(); state += step, ++count) {
      motions.clear();
      append_unit_motions(effects[i], described, states[state], motions);
      for (const UnitMotion& motion : motions)
        squares[static_cast<std::size_t>(motion.coefficient)] += motion.size * motion.size;
    }
    const double least = std::pow(kLeastShare, 2) * (squares.empty() ? 0.0 : std::ranges::max(squares));
    for (const double square : squares)
      precisions[i].push_back(std::sqrt(std::max(square, least) / count) / kUsualMotion);
  });
  return precisions;
}

Linearization linearize(const DiagnosisProblem& problem, const DiagnosedModel& model) {
  return linearize_without(problem, model, std::vector<bool>(model.robot.effects.size(), false));
}

Linearization linearize_without(const DiagnosisProblem& problem, const DiagnosedModel& model,
                                const std::vector<bool>& left_out) {
  const FitOptions options;
  std::vector<ParameterId> ids = free_ids(problem, model.robot);
  const ParameterSpace space(with_contacts_of(model.robot, ids, problem.data), ids);
  Prior prior = link_prior(space, nominal_robot(problem.data), options);
  ResidualField fitted = residual_field(problem.data, problem.fitted, space, model.scales, true, model.noise);
  ResidualField validation =
      unseen_field(problem.data, problem.validation, space.reference(), ids, model.scales, model.noise);
  believe_effects_small(ids, model.robot, problem.data.robot, fitted.states, prior);
  SharedErrors shared = shared_errors(model.noise, fitted, validation);
  leave_out_places(validation, shared.validation);
  ModelColumns columns =
      model_columns(problem.data, space, prior, model.smooth, model.precision, fitted, validation, shared.fitted);
  const std::vector<Eigen::Index> kept =
      without_effects(left_out, model.robot, model.smooth.coefficients.size(), ids, fitted, validation);
  if (std::ssize(kept) < columns.precision.size()) columns = those_of(columns, kept);
  const Eigen::Index own = columns.precision.size();
  append_shared_errors(columns, shared);
  Projection projection(columns, fitted.residual, validation.residual);
  Eigen::VectorXd changes = projection.changes().head(own);
  Eigen::MatrixXd covariance = projection.covariance().topLeftCorner(own, own);
  Eigen::VectorXd errors = fitted.residual - columns.fitted.leftCols(own) * changes;
  return {std::move(ids),     std::move(fitted),     std::move(validation),       std::move(projection),
          std::move(changes), std::move(covariance), columns.precision.head(own), std::move(errors)};
}

DiagnosedModel refined(const DiagnosisProblem& problem, DiagnosedModel model, int steps) {
  constexpr double kSettled = 0.02;  ///< of a scale
  const DiagnosisProblem fitted_alone{problem.data, problem.declared, problem.fitted, {}};
  for (int step = 0; step < steps; ++step) {
    const Linearization linearization = linearize(fitted_alone, model);
    const ParameterSpace space(with_contacts_of(model.robot, linearization.ids, problem.data), linearization.ids);
    model.robot = space.at(linearization.changes.head(space.size())).robot;
    model.smooth.coefficients += linearization.changes.tail(model.smooth.coefficients.size());
    model.robot.corrections = model.smooth.corrections();
    set_effect_errors(model.robot, linearization);
    const RowScales before = model.scales;
    model.scales = rescaled_by_residuals(problem, linearization, model);
    const double gained = (linearization.fitted.residual - linearization.errors).squaredNorm();
    if (scales_settled(before, model.scales, kSettled) &&
        gained < 1e-4 * static_cast<double>(linearization.fitted.rows()))
      break;
  }
  return model;
}

}  // namespace demecal::inline residuals
