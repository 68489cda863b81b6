// The scan over candidates: its scores against refits, and its null distribution against pure noise.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "diagnosis/scan.hpp"
#include "residuals/measured_arm.hpp"

namespace demecal {
namespace {

using ::testing::Each;
using ::testing::FloatNear;

/// An arm, its field, and what is tried on it.
struct ScannedArm {
  KnownArm arm;
  ResidualField field;
  EffectColumns columns;
  std::vector<double> naming_cost_nats;
};

ScannedArm scanned_arm(RandomStream& stream, int poses) {
  ScannedArm made{arm_of(stream, laden_arm(stream, Arm::standard)), {}, {}, {}};
  measure_anyhow(made.arm, stream, {.noise_m = 5e-5}, poses);
  made.field = field_of(made.arm, kPlacedAndZeroed);
  Evidence evidence = full_evidence(made.arm.data.robot);
  evidence.highest_ratio = 6;
  std::vector<Effect> effects;
  for (const char* kind : {"joint_offset", "compliance", "backlash", "gear_harmonic", "axis_wobble", "drift"}) {
    for (Effect& effect : find_law(kind)->proposals(made.arm.data.robot, evidence))
      effects.push_back(std::move(effect));
  }
  made.columns = columns_of(effects, made.arm.data.robot, made.field);
  for (std::size_t i = 0; i < effects.size(); ++i) made.naming_cost_nats.push_back(stream.real(0.0, 5.0));
  return made;
}

double best_fall(const Scan& scan) {
  double best = 0.0;
  for (const Score& score : scan.scores()) best = std::max(best, score.gain_nats);
  return best;
}

double p_value(const std::vector<double>& maxima, double fall) {
  const auto beyond = std::ranges::count_if(maxima, [&](double each) { return each >= fall; });
  return (1.0 + static_cast<double>(beyond)) / (1.0 + static_cast<double>(maxima.size()));
}

TEST(Scan, ScoresAreThoseOfRefittingWithEveryCandidate) {
  RandomStream stream{84, 1};
  const ScannedArm tested = scanned_arm(stream, 40);
  const Projection model = projection_of(tested.field);
  const std::vector<Score> scores = Scan(tested.columns, tested.naming_cost_nats, tested.field, model).scores();
  ASSERT_EQ(scores.size(), tested.naming_cost_nats.size());
  int new_ones = 0;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const RowMatrix dense = tested.columns.dense(tested.field, i);
    const Projection::Trial trial = model.trial(dense, dense);
    EXPECT_EQ(scores[i].rank, trial.rank);
    EXPECT_NEAR(scores[i].drop, trial.drop, 1e-6 * (1 + trial.drop));
    const double left = model.residual().squaredNorm();
    const double nats = trial.rank == 0
                            ? 0.0
                            : 0.5 * 120 * std::log(left / (left - trial.drop)) -
                                  0.5 * static_cast<double>(trial.rank) * std::log(40.0) - tested.naming_cost_nats[i];
    EXPECT_NEAR(scores[i].gain_nats, nats, 1e-6 * (1 + std::abs(nats)));
    new_ones += trial.rank > 0;
  }
  EXPECT_GT(new_ones, 30);
  EXPECT_LT(new_ones, static_cast<int>(scores.size()));  // joint offsets are declared
}

TEST(Scan, VisibleIsTheSquaredLengthOfEachColumnBeyondTheModel) {
  RandomStream stream{84, 2};
  const ScannedArm tested = scanned_arm(stream, 40);
  const Projection model = projection_of(tested.field);
  const std::vector<Score> scores = Scan(tested.columns, tested.naming_cost_nats, tested.field, model).scores();
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const RowMatrix dense = tested.columns.dense(tested.field, i);
    if (scores[i].rank == 0) continue;
    const Eigen::VectorXd squares = model.trial(dense, dense).fitted.colwise().squaredNorm().transpose();
    EXPECT_LT((scores[i].visible - squares).norm(), 1e-6 * dense.squaredNorm());
  }
}

TEST(Scan, FollowingTheModelIsTheSameAsBeginningAnew) {
  RandomStream stream{84, 3};
  const ScannedArm tested = scanned_arm(stream, 40);
  Projection model = projection_of(tested.field);
  Scan scan(tested.columns, tested.naming_cost_nats, tested.field, model);
  for (const std::size_t added : {8, 20, 31}) {
    const RowMatrix dense = tested.columns.dense(tested.field, added);
    const Projection::Trial trial = model.trial(dense, dense);
    model.add(trial);
    scan.follow(tested.columns.transposed_times(tested.field, trial.columns()), trial, model);
    const std::vector<Score> followed = scan.scores();
    const std::vector<Score> anew = Scan(tested.columns, tested.naming_cost_nats, tested.field, model).scores();
    for (std::size_t i = 0; i < anew.size(); ++i) {
      EXPECT_EQ(followed[i].rank, anew[i].rank);
      EXPECT_NEAR(followed[i].drop, anew[i].drop, 1e-8 * (1 + anew[i].drop));
      EXPECT_NEAR(followed[i].gain_nats, anew[i].gain_nats, 1e-8 * (1 + std::abs(anew[i].gain_nats)));
    }
    EXPECT_EQ(followed[added].rank, 0);
  }
}

TEST(Scan, CosinesAreThoseBetweenADirectionAndWhatEachCandidateMakesOfIt) {
  RandomStream stream{84, 4};
  const ScannedArm tested = scanned_arm(stream, 40);
  const Projection model = projection_of(tested.field);
  const Scan scan(tested.columns, tested.naming_cost_nats, tested.field, model);
  const RowMatrix named = tested.columns.dense(tested.field, 12);
  const RowMatrix direction = model.trial(named, named).fitted.leftCols(1);
  const std::vector<double> cosines =
      scan.cosines(tested.columns.transposed_times(tested.field, direction), direction.squaredNorm());
  EXPECT_NEAR(cosines[12], 1.0, 1e-6);
  for (std::size_t i = 0; i < cosines.size(); ++i) {
    const RowMatrix dense = tested.columns.dense(tested.field, i);
    const Projection::Trial trial = model.trial(dense, dense);
    if (trial.rank == 0) continue;
    const RowMatrix left = trial.fitted * trial.to_basis;
    EXPECT_NEAR(cosines[i], (left.transpose() * direction).norm() / direction.norm(), 1e-5);
  }
}

TEST(Scan, InPlaceOfAPartIsTheSameAsBesideTheModelWithoutIt) {
  RandomStream stream{84, 10};
  const ScannedArm tested = scanned_arm(stream, 40);
  const Projection whole = projection_of(tested.field);
  const auto without = [&](Eigen::Index taken) {
    std::vector<Eigen::Index> others;
    for (Eigen::Index i = 0; i < tested.field.declared.cols(); ++i)
      if (i != taken) others.push_back(i);
    const RowMatrix left = tested.field.declared(Eigen::all, others);
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(left.cols());
    return Projection({left, left, none, none}, tested.field.residual, tested.field.residual);
  };
  Eigen::Index taken = 0;  // the first number that no others explain
  for (;; ++taken) {
    ASSERT_LT(taken, tested.field.declared.cols());
    const RowMatrix own = tested.field.declared.col(taken);
    if (without(taken).trial(own, own).rank == 1) break;
  }
  const Projection rest = without(taken);
  const ModelPart part = part_of_model(whole.to_basis().row(taken), whole.changes().segment(taken, 1));
  ASSERT_EQ(part.explained.size(), 1);
  const Scan scan(tested.columns, tested.naming_cost_nats, tested.field, whole),
      beside(tested.columns, tested.naming_cost_nats, tested.field, rest);
  const Scan::InPlace found = scan.in_place_of(part);
  const std::vector<Score> scores = beside.scores();
  const RowMatrix column = tested.field.declared.col(taken);
  const Projection::Trial trial = rest.trial(column, column);
  const RowMatrix direction = trial.fitted * trial.coefficients;
  const std::vector<double> cosines =
      beside.cosines(tested.columns.transposed_times(tested.field, direction), direction.squaredNorm());
  EXPECT_NEAR(part.explained.squaredNorm(), trial.drop, 1e-6 * trial.drop);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    EXPECT_NEAR(found.gains_nats[i], scores[i].gain_nats, 1e-5 * (1 + std::abs(scores[i].gain_nats))) << i;
    EXPECT_NEAR(found.cosines[i], cosines[i], 1e-5) << i;
  }
}

TEST(Scan, RivalsAreNoMoreAlikeForErrorsThatPosesShare) {
  RandomStream stream{84, 11};
  const ScannedArm tested = scanned_arm(stream, 40);
  const Eigen::Index declared = tested.field.declared.cols(), rows = tested.field.rows();
  ModelColumns columns{beside(tested.field.declared, RowMatrix::Identity(rows, rows)), {}, {}, {}};
  columns.validation = columns.fitted;
  columns.offset = Eigen::VectorXd::Zero(declared + rows);
  columns.precision = Eigen::VectorXd::Zero(declared + rows);
  columns.precision.tail(rows).setConstant(0.5);  // the larger part of the scatter
  const Projection model(columns, tested.field.residual, tested.field.residual);
  const Scan scan(tested.columns, tested.naming_cost_nats, tested.field, model);
  std::vector<Candidate> candidates(tested.naming_cost_nats.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    candidates[i].effect = {.kind = "gain", .joint = static_cast<int>(i)};  // each of its own law
    candidates[i].naming_cost_nats = tested.naming_cost_nats[i];
  }
  constexpr std::size_t kNamed = 12;
  const RowMatrix named = tested.columns.dense(tested.field, kNamed);
  const Projection::Trial trial = model.trial(named, named);
  const auto products = tested.columns.transposed_times(tested.field, trial.columns());
  RowMatrix direction(rows + model.prior_basis().rows(), 1);
  direction << trial.fitted * trial.coefficients, trial.prior * trial.coefficients;
  const std::vector<Rival> rivals = rivals_of(kNamed, trial, products, candidates, scan.scores(), scan);
  EXPECT_FALSE(rivals.empty());
  for (const Rival& rival : rivals) {
    const RowMatrix dense = tested.columns.dense(tested.field, static_cast<std::size_t>(rival.effect.joint));
    const Projection::Trial other = model.trial(dense, dense);
    RowMatrix left(direction.rows(), other.rank);
    left << other.fitted * other.to_basis, other.prior * other.to_basis;
    EXPECT_NEAR(rival.cosine, (left.transpose() * direction).norm() / direction.norm(), 1e-5);
    EXPECT_LT(rival.cosine, 0.999999);
  }
}

/// Of 200 draws of noise in place of the residual, each fitted by a model: how many of the best candidates' p-values
/// are 0.05 or less, and their mean.
struct PValues {
  int rare = 0;
  double mean = 0.0;
};
PValues p_values_of_noise(ScannedArm& tested, RandomStream& stream, const std::function<Projection()>& fitted,
                          std::uint64_t purpose) {
  constexpr int kDraws = 200;
  PValues found;
  for (int draw = 0; draw < kDraws; ++draw) {
    renew_noise(tested.field, stream);
    const Projection model = fitted();
    const Scan scan(tested.columns, tested.naming_cost_nats, tested.field, model);
    const std::vector<double> maxima = scan.null_maxima(tested.columns, tested.field, model, 99,
                                                        RandomStream{84, purpose, static_cast<std::uint64_t>(draw)});
    const double p = p_value(maxima, best_fall(scan));
    found.rare += p <= 0.05;
    found.mean += p / kDraws;
  }
  return found;
}

TEST(Scan, ExplainsNoiseAsOftenAsItsPValuesSay) {
  RandomStream stream{84, 5};
  ScannedArm tested = scanned_arm(stream, 40);
  const PValues found = p_values_of_noise(
      tested, stream, [&] { return projection_of(tested.field); }, 6);
  EXPECT_GE(found.rare, 2);
  EXPECT_LE(found.rare, 22);
  EXPECT_NEAR(found.mean, 0.5, 0.1);
}

TEST(Scan, NumbersBelievedToBeLargerThanTheyAreMakeNothingRare) {
  RandomStream stream{84, 8};
  ScannedArm tested = scanned_arm(stream, 40);
  const Eigen::Index declared = tested.field.declared.cols(), rows = tested.field.rows(), more = rows;
  RowMatrix random_columns(rows, more);
  for (double& value : random_columns.reshaped()) value = stream.normal() / std::sqrt(static_cast<double>(rows));
  ModelColumns columns{beside(tested.field.declared, random_columns), {}, {}, {}};
  columns.validation = columns.fitted;
  columns.offset = Eigen::VectorXd::Zero(declared + more);
  columns.precision = Eigen::VectorXd::Zero(declared + more);
  columns.precision.tail(more).setConstant(0.7);  // the rows tell about as much
  const PValues found = p_values_of_noise(
      tested, stream, [&] { return Projection(columns, tested.field.residual, tested.field.residual); }, 9);
  EXPECT_LE(found.rare, 22);
  EXPECT_NEAR(found.mean, 0.5, 0.1);
}

TEST(Scan, NullIsAFunctionOfItsSeedAndAscends) {
  RandomStream stream{84, 7};
  const ScannedArm tested = scanned_arm(stream, 20);
  const Projection model = projection_of(tested.field);
  const Scan scan(tested.columns, tested.naming_cost_nats, tested.field, model);
  const std::vector<double> maxima = scan.null_maxima(tested.columns, tested.field, model, 70, RandomStream{1});
  EXPECT_EQ(maxima.size(), 70u);
  EXPECT_TRUE(std::ranges::is_sorted(maxima));
  EXPECT_EQ(maxima, scan.null_maxima(tested.columns, tested.field, model, 70, RandomStream{1}));
  EXPECT_NE(maxima, scan.null_maxima(tested.columns, tested.field, model, 70, RandomStream{2}));
}

}  // namespace
}  // namespace demecal
