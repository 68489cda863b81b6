#include "residuals/smooth_corrections.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "expression/evaluate.hpp"
#include "kinematics/chain.hpp"
#include "primitives/primitive.hpp"
#include "residuals/projection.hpp"

namespace demecal::inline residuals {
namespace {

constexpr double kLeastMotion_rad = 0.052;  ///< 3 deg: less shows no shape
constexpr int kHighestDegree = 8;
constexpr int kHighestHarmonic = 5;
constexpr double kGone = 1e8;  ///< belief in zero, in scaled units, of a term that is out for good

Tree scaled_tree(double factor, const Tree& tree) {
  return apply(Primitive::multiply, constant_tree(factor), tree);
}

/// (theta - middle) * (1 / half): from -1 to 1 over the range.
Tree unit_variable(const Interval& range) {
  const double middle = 0.5 * (range.lower + range.upper), half = 0.5 * (range.upper - range.lower);
  return scaled_tree(1.0 / half, apply(Primitive::subtract, variable_tree(0), constant_tree(middle)));
}

/// Legendre polynomial of `degree` in `t` by Bonnet's recurrence on its coefficients, as a Horner scheme.
Tree legendre(int degree, const Tree& t) {
  if (degree == 0) return constant_tree(1.0);
  std::vector<double> before{1.0}, now{0.0, 1.0};
  for (int n = 1; n < degree; ++n) {
    std::vector<double> next(static_cast<std::size_t>(n) + 2, 0.0);
    for (std::size_t i = 0; i < now.size(); ++i) next[i + 1] += (2.0 * n + 1.0) / (n + 1.0) * now[i];
    for (std::size_t i = 0; i < before.size(); ++i) next[i] -= n / (n + 1.0) * before[i];
    before = std::exchange(now, std::move(next));
  }
  Tree tree = constant_tree(now.back());
  for (std::size_t i = now.size() - 1; i-- > 0;) {
    tree = apply(Primitive::multiply, tree, t);
    if (now[i] != 0.0) tree = apply(Primitive::add, tree, constant_tree(now[i]));
  }
  return tree;
}

/// At most `most` terms: polynomials and waves in turn, the slower ones first.
void add_terms(SmoothCorrections& smooth, int joint, const Interval& range, bool offset_declared, std::size_t most) {
  const Tree t = unit_variable(range);
  std::vector<SmoothTerm> terms;
  const auto add_degree = [&](int degree) {
    if (degree <= kHighestDegree) terms.push_back({joint, legendre(degree, t), 0, degree});
  };
  if (!offset_declared) add_degree(0);
  add_degree(1);
  for (int n = 1; n <= kHighestHarmonic; ++n) {
    const Tree angle = n == 1 ? variable_tree(0) : scaled_tree(n, variable_tree(0));
    terms.push_back({joint, apply(Primitive::cosine, angle), n, kHighestDegree + n});
    terms.push_back({joint, apply(Primitive::sine, angle), n, kHighestDegree + n});
    add_degree(2 * n);
    add_degree(2 * n + 1);
  }
  if (terms.size() > most) terms.resize(most);
  std::ranges::stable_sort(terms, {}, &SmoothTerm::family);
  std::ranges::move(terms, std::back_inserter(smooth.terms));
}

/// Values more than a tenth of a degree apart.
std::size_t distinct_values(std::vector<double> angles) {
  constexpr double kSame_rad = 1.7e-3;
  std::ranges::sort(angles);
  std::size_t count = 0;
  double last = -1e9;
  for (const double angle : angles) {
    if (angle - last < kSame_rad) continue;
    ++count;
    last = angle;
  }
  return count;
}

/// Terms that so many values of a joint can hold: one for every third, and a wave with its slope wherever they show
/// one.
std::size_t most_terms(const std::vector<double>& angles) {
  constexpr std::size_t kValuesPerTerm = 3, kWaveAndSlope = 4;
  const std::size_t values = distinct_values(angles);
  return std::max(values / kValuesPerTerm, std::min(kWaveAndSlope, values - 1));
}

/// How far most of the values spread: from their 5 % to their 95 % quantile.
double usual_range(std::vector<double> angles) {
  std::ranges::sort(angles);
  const std::size_t beyond = angles.size() / 20;
  return angles[angles.size() - 1 - beyond] - angles[beyond];
}

double smooth_term_value(const SmoothCorrections& smooth, const SmoothTerm& term, double theta) {
  const auto joint = static_cast<std::size_t>(term.joint);
  const double inside =
      std::clamp(smooth.branches[joint](theta), smooth.ranges[joint].lower, smooth.ranges[joint].upper);
  return evaluate(term.formula, {&inside, 1});
}

/// Sums over the terms of each family.
std::vector<double> family_sums(std::span<const int> families, const Eigen::VectorXd& of_terms) {
  std::vector<double> sums(families.empty() ? 0 : static_cast<std::size_t>(std::ranges::max(families)) + 1, 0.0);
  for (std::size_t i = 0; i < families.size(); ++i) {
    sums[static_cast<std::size_t>(families[i])] += of_terms[static_cast<Eigen::Index>(i)];
  }
  return sums;
}

/// Takes away the least sure quarter of the terms that are less than three standard errors from zero, and of a family
/// whose mean square is hardly more than chance makes it: relevance alone keeps one in three of those that are not
/// there.
void prune(Eigen::Ref<Eigen::VectorXd> belief, std::span<const int> families, const Eigen::VectorXd& errors) {
  constexpr double kSureAlone = 3.0;
  const Eigen::VectorXd present = (belief.array() < kGone).cast<double>();
  const std::vector<double> squares = family_sums(families, errors.cwiseAbs2().cwiseProduct(present));
  const std::vector<double> sizes = family_sums(families, present);
  std::vector<std::pair<double, Eigen::Index>> unsure;
  for (Eigen::Index i = 0; i < belief.size(); ++i) {
    if (present[i] == 0.0) continue;
    const auto family = static_cast<std::size_t>(families[static_cast<std::size_t>(i)]);
    const double by_chance = sizes[family] + std::sqrt(sizes[family]);  // chi squared's mean and 0.7 of its deviation
    const double sure = std::max(errors[i] / kSureAlone, std::sqrt(squares[family] / by_chance));
    if (sure < 1.0) unsure.emplace_back(sure, i);
  }
  std::sort(unsure.begin(), unsure.end());
  const std::size_t taken = (unsure.size() + 3) / 4;
  for (std::size_t i = 0; i < taken; ++i) belief[unsure[i].second] = kGone;
}

/// Where rounding leaves it singular, by pivots.
Eigen::MatrixXd inverse_of_positive(const Eigen::MatrixXd& a) {
  const Cholesky solver(a);
  if (solver.succeeded()) return solver.inverse();
  return PivotedCholesky(a).solve(Eigen::MatrixXd::Identity(a.rows(), a.cols()));
}

struct Coefficients {
  Eigen::VectorXd mean, spread;  ///< what is certain counts as zero
  double explained = 0.0;        ///< of the sum of squares
};

/// Of rows with these products, where so much is added to the diagonal; those with `certain` take no part, for most
/// terms soon are out for good.
Coefficients most_probable(const Eigen::MatrixXd& gram, const Eigen::VectorXd& moment, const Eigen::VectorXd& added,
                           double certain) {
  std::vector<Eigen::Index> in;
  for (Eigen::Index i = 0; i < added.size(); ++i) {
    if (added[i] < certain) in.push_back(i);
  }
  const Eigen::MatrixXd own = gram(in, in);
  const Eigen::VectorXd own_moment = moment(in);
  Eigen::MatrixXd precision = own;
  precision.diagonal() += added(in);
  const Eigen::MatrixXd inverse = inverse_of_positive(precision);
  const Eigen::VectorXd mean = inverse * own_moment;
  Coefficients all{Eigen::VectorXd::Zero(added.size()), added.cwiseInverse(),
                   2.0 * mean.dot(own_moment) - mean.dot(own * mean)};
  all.mean(in) = mean;
  all.spread(in) = inverse.diagonal();
  return all;
}

/// MacKay's update of the terms' beliefs, each as if kShared more terms of its family's mean square had been seen.
void update(Eigen::Ref<Eigen::VectorXd> belief, std::span<const int> families, const Eigen::VectorXd& known,
            const Eigen::VectorXd& mean, const Eigen::VectorXd& scale) {
  constexpr double kShared = 3.0;
  const Eigen::VectorXd present = (belief.array() < kGone).cast<double>();
  const std::vector<double> determined = family_sums(families, known.cwiseProduct(present));
  const std::vector<double> squares = family_sums(families, mean.cwiseProduct(scale).cwiseAbs2().cwiseProduct(present));
  for (Eigen::Index i = 0; i < belief.size(); ++i) {
    if (present[i] == 0.0) continue;
    const auto family = static_cast<std::size_t>(families[static_cast<std::size_t>(i)]);
    const double usual = squares[family] / std::max(determined[family], 1e-12) / (scale[i] * scale[i]);
    const double square = std::max(mean[i] * mean[i] + kShared * usual, 1e-30);
    belief[i] = std::clamp((known[i] + kShared) / square, 1e-10, kGone);
  }
}

}  // namespace

std::vector<JointCorrection> SmoothCorrections::corrections() const {
  std::vector<JointCorrection> result = base;
  for (std::size_t joint = 0; joint < base.size(); ++joint) {
    Tree sum;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const double coefficient = coefficients[static_cast<Eigen::Index>(i)];
      if (terms[i].joint != static_cast<int>(joint) || coefficient == 0.0) continue;
      const Tree part = scaled_tree(coefficient, terms[i].formula);
      sum = sum.empty() ? part : apply(Primitive::add, sum, part);
    }
    if (sum.empty()) continue;
    if (!base[joint].is_neutral()) sum = apply(Primitive::add, base[joint].formula(), sum);
    result[joint] = JointCorrection(std::move(sum), branches[joint], ranges[joint]);
  }
  return result;
}

std::vector<int> SmoothCorrections::families() const {
  std::vector<int> all;
  for (const SmoothTerm& term : terms) all.push_back(term.family);
  return all;
}

RowMatrix SmoothCorrections::columns(const ResidualField& field) const {
  RowMatrix columns(field.rows(), static_cast<Eigen::Index>(terms.size()));
  for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
    const Eigen::Index first = field.first_row[pose], count = field.rows_of_pose(pose);
    const JointVector& joints = field.states[pose].joints();
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const double value = smooth_term_value(*this, terms[i], joints[terms[i].joint]);
      columns.block(first, static_cast<Eigen::Index>(i), count, 1) =
          value * field.motions.block(first, motion_column(terms[i].joint, kTurnAboutZ), count, 1);
    }
  }
  return columns;
}

SmoothCorrections smooth_corrections(const DataSet& data, std::span<const std::size_t> poses,
                                     const CorrectedRobot& robot, bool declared, bool offset_declared) {
  SmoothCorrections smooth;
  smooth.base = robot.corrections;
  smooth.branches.resize(smooth.base.size());
  smooth.ranges.resize(smooth.base.size());
  for (int joint = 0; joint < robot.chain.size(); ++joint) {
    const auto at = static_cast<std::size_t>(joint);
    const Joint& link = robot.chain.joints[at];
    std::vector<double> angles;
    for (const std::size_t pose : poses) angles.push_back(data.poses[pose].joints[joint]);
    if (is_revolute(link)) smooth.branches[at] = choose_branch(angles, link.lower, link.upper);
    if (!smooth.base[at].is_neutral()) smooth.branches[at] = smooth.base[at].branch();
    for (double& angle : angles) angle = smooth.branches[at](angle);
    const auto [lower, upper] = std::minmax_element(angles.begin(), angles.end());
    if (lower == angles.end()) continue;
    smooth.ranges[at] = {*lower, *upper};
    const bool moves = is_revolute(link) && usual_range(angles) > kLeastMotion_rad;
    if (declared && moves) add_terms(smooth, joint, smooth.ranges[at], offset_declared, most_terms(angles));
  }
  smooth.coefficients.setZero(static_cast<Eigen::Index>(smooth.terms.size()));
  return smooth;
}

Eigen::VectorXd relevance(const Eigen::MatrixXd& products, std::span<const int> families, double rows) {
  constexpr int kRounds = 80, kPruneEvery = 8;
  constexpr double kLargest = 300.0;         ///< times what the poses say of a coefficient: one so believed is zero
  constexpr double kLeastPrecision = 100.0;  ///< 1/rad: no joint errs by whole hundredths
  const auto terms = static_cast<Eigen::Index>(families.size());
  const Eigen::Index n = products.cols() - 1, fixed = n - terms;
  const auto gram = products.topLeftCorner(n, n);
  const Eigen::VectorXd moment = products.topRightCorner(n, 1);
  const double whole = products(n, n);
  Eigen::VectorXd scale = gram.diagonal().cwiseSqrt();
  for (double& value : scale) value = 1 / std::max(value, kNoColumn);
  const Eigen::MatrixXd scaled = scale.asDiagonal() * gram * scale.asDiagonal();
  const Eigen::VectorXd scaled_moment = scale.cwiseProduct(moment);
  Eigen::VectorXd belief = Eigen::VectorXd::Constant(n, 1e-9);  // in scaled units, over the variance of rows
  belief.tail(terms).setConstant(1e-2);
  for (Eigen::Index i = fixed; i < n; ++i) {
    if (gram(i, i) < kNoColumn * kNoColumn) belief[i] = kGone;  // a joint that moves nothing of what was measured
  }
  double variance = 1.0;
  for (int round = 0; round < kRounds; ++round) {
    const Coefficients now = most_probable(scaled, scaled_moment, variance * belief, variance * kGone);
    const Eigen::VectorXd means = now.mean.tail(terms), spread = now.spread.tail(terms);
    const Eigen::VectorXd known =
        (1.0 - variance * belief.tail(terms).cwiseProduct(spread).array()).max(1e-12).min(1.0);
    const double determined = static_cast<double>(fixed) + known.sum();
    update(belief.tail(terms), families, known, means, scale.tail(terms));
    if (round % kPruneEvery == kPruneEvery - 1) {
      prune(belief.tail(terms), families, means.cwiseAbs().cwiseQuotient((variance * spread).cwiseSqrt()));
    }
    variance = std::max(whole - now.explained, 1e-12 * whole) / std::max(rows - determined, 1.0);
  }
  Eigen::VectorXd precision(terms);
  for (Eigen::Index i = 0; i < terms; ++i) {
    // back to rows of unit variance: precision of the unscaled coefficient
    const double seen = std::min(kLargest, std::sqrt(belief[fixed + i])) / scale[fixed + i];
    precision[i] = std::max(kLeastPrecision, seen);
  }
  return precision;
}

}  // namespace demecal::inline residuals
