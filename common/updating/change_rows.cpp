#include "updating/change_rows.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "data/written_steps.hpp"
#include "decompositions/decompositions.hpp"
#include "effects/effect.hpp"
#include "kinematics/chain.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/observation.hpp"
#include "parameters/posterior.hpp"
#include "prediction/corrected_robot.hpp"
#include "products/tall_products.hpp"
#include "updating/unstated.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/candidates.hpp"
#include "parameters/parameter_space.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline updating {
namespace {

Eigen::MatrixXd uncertain_rows(const Posterior& posterior, const ResidualField& field) {
  Eigen::MatrixXd columns(field.rows(), static_cast<Eigen::Index>(posterior.ids.size() + posterior.terms.size()));
  columns.leftCols(field.declared.cols()) = field.declared;
  for (std::size_t t = 0; t < posterior.terms.size(); ++t) {
    const CorrectionTerm& term = posterior.terms[t];
    for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
      const Eigen::Index first = field.first_row[pose], count = field.rows_of_pose(pose);
      columns.block(first, field.declared.cols() + static_cast<Eigen::Index>(t), count, 1) =
          term.shape(field.states[pose].joints()[term.joint]) *
          field.motions.block(first, motion_column(term.joint, kTurnAboutZ), count, 1);
    }
  }
  return columns * posterior.factor;
}

/// A base that was found again is anywhere.
void add_base(const ResidualField& field, Eigen::MatrixXd& covariance) {
  constexpr double kAnywhere = 1e-2;  // m and rad about where it was found
  for (int axis = 0; axis < 6; ++axis) {
    const Eigen::VectorXd column = kAnywhere * field.motions.col(motion_column(0, axis));
    covariance += column * column.transpose();
  }
}

/// Every joint stands up to half a step from where it is written.
void add_rounding(const ResidualField& field, const Chain& chain, const JointSteps& steps,
                  Eigen::MatrixXd& covariance) {
  constexpr int kShiftAlongZ = 2;
  for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
    const Eigen::Index first = field.first_row[pose], count = field.rows_of_pose(pose);
    for (int joint = 0; joint < chain.size(); ++joint) {
      const int axis = is_revolute(chain, joint) ? kTurnAboutZ : kShiftAlongZ;
      const Eigen::VectorXd column =
          steps.of(chain, joint) * field.motions.block(first, motion_column(joint, axis), count, 1);
      covariance.block(first, first, count, count) += column * column.transpose() / 12.0;
    }
  }
}

}  // namespace

std::vector<Effect> possible_changes(const DataSet& data, std::span<const std::size_t> poses, bool orientations) {
  Evidence evidence = evidence_of(data, poses);
  evidence.orientation = orientations;
  std::vector<Effect> effects;
  for (const EffectLaw* law : catalogue()) {
    const bool circumstance =
        law->prerequisite() == Circumstance::approach || law->prerequisite() == Circumstance::temperature;
    if (declared_flag(law->kind()) == nullptr && !circumstance) continue;
    const std::vector<std::string> forms = law->forms();
    for (Effect& effect : law->proposals(data.robot, evidence)) {
      const bool plain =
          law->subject() == Subject::tool || effect.form.empty() || forms.empty() || effect.form == forms.front();
      const bool single = law->coefficients(effect, data.robot).size() == 1;
      if (plain && (single || law->subject() != Subject::joint)) effects.push_back(std::move(effect));
    }
  }
  return effects;
}

ScaledChangeRows scaled_change_rows(const CalibratedModel& model, const DataSet& data, const ComparedPoses& compared,
                                    const std::vector<Effect>& effects) {
  std::vector<ParameterId> ids;
  if (model.posterior) ids = model.posterior->ids;
  const ParameterSpace space(compared.robot, ids);
  const double distance_m =
      model.interval ? std::hypot(model.interval->distance_noise_m, model.interval->model_error_m) : 0.0;
  const RowScales scales{compared.noise_m, compared.orientation_rad, distance_m > 0.0 ? distance_m : compared.noise_m};
  const ResidualField field = residual_field(data, compared.poses, space, scales, false);
  ScaledChangeRows rows{field.residual, {}, Eigen::MatrixXd::Zero(field.rows(), field.rows()), field.first_row, {}};
  if (model.posterior) {
    const Eigen::MatrixXd known = uncertain_rows(*model.posterior, field);
    rows.covariance += known * known.transpose();
  }
  add_rounding(field, data.robot.chain, compared.rounding, rows.covariance);
  rows.unstated_m = compared.noise_m * add_unstated(compared.robot, data, field, rows.covariance);
  rows.expected_m = compared.noise_m * std::sqrt((static_cast<double>(field.rows()) + rows.covariance.trace()) /
                                                 static_cast<double>(compared.poses.size()));
  if (compared.set_up_anew) add_base(field, rows.covariance);
  EffectColumns columns;
  columns.append(effects, data.robot, field.states);
  columns.pack();
  for (std::size_t i = 0; i < effects.size(); ++i) rows.columns.emplace_back(columns.dense(field, i));
  for (std::size_t pose = 0; compared.orientation_rad > 0.0 && pose < field.poses.size(); ++pose) {
    const RowCounts count = count_rows(data.poses[field.poses[pose]]);
    for (int i = 0; i < count[kOrientation]; ++i) rows.turned.push_back(field.first_row[pose] + count[kPosition] + i);
  }
  return rows;
}

ChangeRows whitened(const ScaledChangeRows& scaled) {
  const Eigen::Index n = scaled.values.size();
  const Cholesky root(Eigen::MatrixXd::Identity(n, n) + scaled.covariance);
  ChangeRows rows{root.whitened(scaled.values), {}, scaled.first_row, scaled.unstated_m, scaled.expected_m};
  for (const Eigen::MatrixXd& columns : scaled.columns) rows.columns.push_back(root.whitened(columns));
  return rows;
}

namespace {

constexpr double kLeastNoise_rad = 1e-7;

/// Enough poses to know a noise by.
std::vector<std::size_t> some_with_orientation(const DataSet& data, const std::vector<std::size_t>& poses) {
  constexpr std::size_t kMost = 60;
  std::vector<std::size_t> measured, some;
  for (const std::size_t pose : poses)
    if (data.poses[pose].orientation) measured.push_back(pose);
  const std::size_t step = 1 + measured.size() / (kMost + 1);
  for (std::size_t i = 0; i < measured.size(); i += step) some.push_back(measured[i]);
  return some;
}

Eigen::MatrixXd all_columns(const ScaledChangeRows& rows) {
  Eigen::MatrixXd all(rows.values.size(), 0);
  for (const Eigen::MatrixXd& columns : rows.columns) {
    all.conservativeResize(Eigen::NoChange, all.cols() + columns.cols());
    all.rightCols(columns.cols()) = columns;
  }
  return all;
}

}  // namespace

DataSet without_unknown_orientations(const CalibratedModel& model, DataSet data) {
  std::set<std::string> known;
  if (model.posterior)
    for (const ParameterId& id : model.posterior->ids)
      if (id.kind == ParameterId::Kind::tool_rotation) known.insert(id.target);
  for (MeasuredPose& pose : data.poses)
    if (!known.contains(pose.target)) pose.orientation.reset();
  return data;
}

OrientationNoise orientation_noise(const CalibratedModel& model, const DataSet& data, const ComparedPoses& compared,
                                   const std::vector<Effect>& effects) {
  constexpr int kRounds = 8;
  const std::vector<std::size_t> poses = some_with_orientation(data, compared.poses);
  if (poses.empty()) return {};
  ComparedPoses some{compared.robot, poses, compared.noise_m, 1.0, compared.set_up_anew, compared.rounding};
  const ScaledChangeRows rows = scaled_change_rows(model, data, some, effects);
  const Eigen::MatrixXd columns = all_columns(rows);
  const Eigen::Index n = rows.values.size();
  OrientationNoise noise{
      std::max(kLeastNoise_rad, rows.values(rows.turned).norm() / std::sqrt(static_cast<double>(rows.turned.size()))),
      0.0};
  for (int round = 0; round < kRounds; ++round) {
    Eigen::VectorXd scale = Eigen::VectorXd::Ones(n);
    scale(rows.turned).setConstant(1.0 / noise.noise_rad);
    const Eigen::MatrixXd covariance = scale.asDiagonal() * rows.covariance * scale.asDiagonal();
    const Cholesky root(Eigen::MatrixXd::Identity(n, n) + covariance);
    const Eigen::MatrixXd explained = PivotedQr(root.whitened(Eigen::MatrixXd(scale.asDiagonal() * columns))).basis();
    Eigen::MatrixXd left = root.whitened(Eigen::MatrixXd::Identity(n, n));
    left -= explained * (explained.transpose() * left).eval();
    const Eigen::VectorXd errors = left.transpose() * (left * (scale.asDiagonal() * rows.values)).eval();
    noise.freedom = left(Eigen::all, rows.turned).squaredNorm();
    if (!(noise.freedom > 0.0)) return {};
    noise.noise_rad =
        std::max(kLeastNoise_rad, noise.noise_rad * std::sqrt(errors(rows.turned).squaredNorm() / noise.freedom));
  }
  return noise;
}

}  // namespace demecal::inline updating
