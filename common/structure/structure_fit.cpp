#include "structure/structure_fit.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "fitting/levenberg_marquardt.hpp"
#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/observation.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline structure {
namespace {

constexpr double kSingular = 1e-6;  // of columns of unit length
constexpr double kDeficientDamping = 1e-6, kHighestDamping = 1e3;
constexpr int kMostSuccessfulSteps = 20;
constexpr double kSettledCost = 1e-8;  // of the cost

double row_weight(const StructureProblem& problem, const MeasurementRows& rows, int row) {
  const bool turn = row >= rows.position && row < rows.position + rows.orientation;
  if (!turn) return 1.0 / problem.position_scale_m;
  return problem.orientation_scale_rad > 0.0 ? 1.0 / problem.orientation_scale_rad : 0.0;
}

Eigen::VectorXd row_weights(const StructureProblem& problem, const MeasuredPose& pose) {
  const MeasurementRows rows = rows_of(pose);
  Eigen::VectorXd weights(rows.total());
  for (int row = 0; row < rows.total(); ++row) weights[row] = row_weight(problem, rows, row);
  return weights;
}

double structure_cost(const StructureProblem& problem, const StructuredArm& arm, std::span<const std::size_t> poses) {
  double sum = 0.0;
  for (const std::size_t index : poses) {
    const MeasuredPose& pose = problem.data.poses[index];
    const Eigen::VectorXd rows = residual(arm.robot, arm.predict(pose.joints, pose.target), problem.data, pose);
    sum += rows.cwiseProduct(row_weights(problem, pose)).squaredNorm();
  }
  return sum;
}

struct StructureRows {
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd residual;
};

/// Per gene: one over its prior standard deviation, in the units of scaled rows that scatter as they do now.
Eigen::VectorXd prior_weights(const StructureProblem& problem, const StructureFit& fit) {
  const int freedom = std::max(1, rows_in_use(problem, problem.fitted) - fit.numbers);
  const double level = std::sqrt(fit.cost / freedom);
  std::vector<double> weights;
  for (const GeneSection& section : fit.arm.genome) {
    for (const Gene& gene : section)
      weights.push_back(level / (gene.rotates ? kMakersDeviation_rad : kMakersDeviation_m));
  }
  return Eigen::Map<const Eigen::VectorXd>(weights.data(), static_cast<Eigen::Index>(weights.size()));
}

double prior_cost(const StructuredArm& arm, const Eigen::VectorXd& weights) {
  const Eigen::Map<const Eigen::VectorXd> values(arm.values.data(), weights.size());
  return weights.cwiseProduct(values).squaredNorm();
}

/// The poses' rows, and below them the genes' priors.
StructureRows structure_rows(const StructureProblem& problem, const StructuredArm& arm, int numbers,
                             const Eigen::VectorXd& prior) {
  Eigen::Index total = 0;
  for (const std::size_t index : problem.fitted) total += rows_of(problem.data.poses[index]).total();
  const Eigen::Index genes = prior.size();
  StructureRows rows{Eigen::MatrixXd::Zero(total + genes, numbers), Eigen::VectorXd(total + genes)};
  Eigen::Index next = 0;
  for (const std::size_t index : problem.fitted) {
    const MeasuredPose& pose = problem.data.poses[index];
    const StructureMotion motion = motion_of(arm, problem.freedom, pose.joints, pose.target);
    const Eigen::VectorXd weights = row_weights(problem, pose);
    const Eigen::Index count = weights.size();
    rows.jacobian.middleRows(next, count) =
        weights.asDiagonal() * (measurement_jacobian(arm.robot, motion.predicted, problem.data, pose) * motion.twists);
    rows.residual.segment(next, count) =
        residual(arm.robot, motion.predicted, problem.data, pose).cwiseProduct(weights);
    next += count;
  }
  rows.jacobian.bottomRightCorner(genes, genes) = prior.asDiagonal();
  for (Eigen::Index i = 0; i < genes; ++i)
    rows.residual[total + i] = -prior[i] * arm.values[static_cast<std::size_t>(i)];
  return rows;
}

/// Columns of unit length, and what they were divided by; columns without effect stay, divided by 1.
Eigen::VectorXd scale_columns(Eigen::MatrixXd& jacobian) {
  Eigen::VectorXd lengths = jacobian.colwise().norm();
  for (Eigen::Index i = 0; i < lengths.size(); ++i) {
    if (lengths[i] == 0.0) lengths[i] = 1.0;
    jacobian.col(i) /= lengths[i];
  }
  return lengths;
}

/// (J^T J + damping I)^-1 J^T r, by the decomposition of J with damped rows below it.
Eigen::VectorXd damped_qr_step(const StructureRows& rows, double damping) {
  const Eigen::Index n = rows.jacobian.cols(), m = rows.jacobian.rows();
  Eigen::MatrixXd tall(m + n, n);
  tall << rows.jacobian, std::sqrt(damping) * Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(m + n);
  right.head(m) = rows.residual;
  return least_squares_solution(tall, right);
}

/// The numbers of an arm of given structure; genes have priors that go by the scatter of the rows.
class StructureSteps {
 public:
  StructureSteps(const StructureProblem& problem, StructureFit& fit) : problem_(problem), fit_(fit) {}

  std::optional<double> linearize(double& damping) {
    prior_ = prior_weights(problem_, fit_);
    rows_ = structure_rows(problem_, fit_.arm, fit_.numbers, prior_);
    lengths_ = scale_columns(rows_.jacobian);
    qr_ = PivotedQr(rows_.jacobian, kSingular);
    fit_.rank = static_cast<int>(qr_.rank());
    damping = fit_.rank < fit_.numbers ? kDeficientDamping : 0.0;
    return fit_.cost + prior_cost(fit_.arm, prior_);
  }

  std::optional<double> try_step(double damping) {
    const Eigen::VectorXd step = damping > 0.0 ? damped_qr_step(rows_, damping) : qr_.solve(rows_.residual);
    tried_ = changed(fit_.arm, problem_.freedom, step.cwiseQuotient(lengths_));
    tried_cost_ = structure_cost(problem_, tried_, problem_.fitted);
    return tried_cost_ + prior_cost(tried_, prior_);
  }

  void accept() {
    fit_.arm = std::move(tried_);
    fit_.cost = tried_cost_;
  }

 private:
  const StructureProblem& problem_;
  StructureFit& fit_;
  Eigen::VectorXd prior_, lengths_;
  StructureRows rows_;
  PivotedQr qr_;
  StructuredArm tried_;
  double tried_cost_ = 0.0;
};

constexpr const char kGeneAxes[] = {'x', 'y', 'z'};

char axis_of(const Gene& gene) {
  return kGeneAxes[static_cast<std::size_t>(gene.axis)];
}

}  // namespace

StructureProblem structure_problem(const DataSet& data, const StructureFreedom& freedom, const CorrectedRobot& start,
                                   std::vector<std::size_t> fitted, std::vector<std::size_t> selection_poses) {
  double shifts = 0.0, turns = 0.0;
  int shift_rows = 0, turn_rows = 0;
  for (const std::size_t index : fitted) {
    const MeasurementRows rows = rows_of(data.poses[index]);
    const Eigen::VectorXd left = residual(start, data, data.poses[index]);
    const double turned = left.segment(rows.position, rows.orientation).squaredNorm();
    turns += turned;
    shifts += left.squaredNorm() - turned;
    turn_rows += rows.orientation;
    shift_rows += rows.position + rows.distances;
  }
  StructureProblem problem{data, freedom, start, std::move(fitted), std::move(selection_poses)};
  if (shifts > 0.0) problem.position_scale_m = std::sqrt(shifts / shift_rows);
  if (turns > 0.0) problem.orientation_scale_rad = std::sqrt(turns / turn_rows);
  if (!freedom.tool_turns && problem.orientation_scale_rad > kMountedOtherwise_rad) problem.orientation_scale_rad = 0.0;
  return problem;
}

int rows_in_use(const StructureProblem& problem, std::span<const std::size_t> poses) {
  int count = 0;
  for (const std::size_t index : poses) {
    const MeasurementRows rows = rows_of(problem.data.poses[index]);
    count += rows.total() - (problem.orientation_scale_rad > 0.0 ? 0 : rows.orientation);
  }
  return count;
}

StructureFit fit_structure(const StructureProblem& problem, const Genome& genome) {
  StructureFit fit;
  fit.arm = {problem.start, genome, std::vector<double>(gene_count(genome), 0.0)};
  fit.numbers = problem.freedom.before_genes() + static_cast<int>(gene_count(genome));
  fit.selection_cost = std::numeric_limits<double>::infinity();
  fit.cost = structure_cost(problem, fit.arm, problem.fitted);
  if (fit.numbers >= rows_in_use(problem, problem.fitted)) return fit;
  if (fit.numbers > 0) {
    StructureSteps steps(problem, fit);
    levenberg_marquardt(steps, {.max_successful_steps = kMostSuccessfulSteps,
                                .increase_factor = 100.0,
                                .min_increased_damping = kDeficientDamping,
                                .max_damping = kHighestDamping,
                                .function_tolerance = kSettledCost});
  }
  const double selection_cost = structure_cost(problem, fit.arm, problem.selection_poses);
  fit.solved = std::isfinite(selection_cost) && std::isfinite(fit.cost);
  if (fit.solved) fit.selection_cost = selection_cost;
  return fit;
}

Eigen::MatrixXd covariance(const StructureProblem& problem, const StructureFit& fit) {
  StructureRows rows = structure_rows(problem, fit.arm, fit.numbers, prior_weights(problem, fit));
  const Eigen::VectorXd lengths = scale_columns(rows.jacobian);
  const MoorePenroseInverse decomposed = moore_penrose_inverse(rows.jacobian, kSingular);
  const Eigen::MatrixXd inverse = lengths.cwiseInverse().asDiagonal() * decomposed.inverse;
  const int freedom = std::max(1, rows_in_use(problem, problem.fitted) - static_cast<int>(decomposed.rank));
  return fit.cost / freedom * inverse * inverse.transpose();
}

std::string FoundTransform::name() const {
  return "after link " + std::to_string(link + 1) + (gene.rotates ? " R" : " T") + axis_of(gene) +
         (gene.rotates ? "_deg" : "_mm");
}

double FoundTransform::at_border(double amount) const {
  return gene.rotates ? degrees(amount) : millimetres(amount);
}

std::vector<FoundTransform> found_transforms(const StructureProblem& problem, const StructureFit& fit) {
  const Eigen::MatrixXd all_covariances = covariance(problem, fit);
  std::vector<FoundTransform> found;
  Eigen::Index column = problem.freedom.before_genes();
  for (std::size_t section = 0; section < fit.arm.genome.size(); ++section) {
    for (const Gene& gene : fit.arm.genome[section]) {
      const double variance = all_covariances(column, column);
      ++column;
      found.push_back({static_cast<int>(section), gene, fit.arm.values[found.size()], std::sqrt(variance)});
    }
  }
  return found;
}

}  // namespace demecal::inline structure
