// The misfit and the length of formulas, in nats.
#include "formula_search/misfit.hpp"

#include <gtest/gtest.h>

#include "waves.hpp"

namespace demecal {
namespace {

TEST(FormulaMisfit, IsLeastForTheTruthAndKnowsItsGain) {
  const TrainingTable table = table_of(1.0, 0.1, 7);
  FormulaMisfit misfit(table);
  const Tree truth = parse("SIN(q1 + 2 * q2)", kNames), other = parse("SIN(q1) * q2", kNames);
  EXPECT_LT(misfit.nats(truth), misfit.nats(other));
  EXPECT_NEAR(misfit.gain_nats(truth) - misfit.gain_nats(other), misfit.nats(other) - misfit.nats(truth), 1e-9);
  EXPECT_EQ(misfit.nats(parse("q1 % (q1 - q1) * SQRTp(q1)", kNames)), misfit.nats(parse("SQRTp(q1)", kNames)));
}

TEST(FormulaMisfit, IsThatOfItsResidual) {
  const TrainingTable table = table_of(1.0, 0.1, 11);
  FormulaMisfit misfit(table);
  for (const char* text : {"SIN(q1 + 2 * q2)", "q1 * q2", "SQRTp(q1) - 0.3"}) {
    const Eigen::VectorXd left = misfit.residual(parse(text, kNames));
    EXPECT_NEAR(misfit.nats(parse(text, kNames)), 100.0 * std::log(left.squaredNorm()), 1e-9) << text;
  }
}

TEST(DescriptionNats, ChargeForEveryNodeAndForConstantsThatAreNotRound) {
  const double plain = description_nats(parse("SIN(q1)", kNames), 2, 100);
  const double round = description_nats(parse("SIN(2 * q1)", kNames), 2, 100);
  const double odd = description_nats(parse("SIN(2.13 * q1)", kNames), 2, 100);
  EXPECT_GT(plain, 0.0);
  EXPECT_GT(round, plain);
  EXPECT_NEAR(odd - round, 0.5 * std::log(100.0), 1e-12);
}

}  // namespace
}  // namespace demecal
