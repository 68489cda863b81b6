// Evolved formulas in the form that people write: constants at their least-squares values, and round where data allow.
#include "calibration/polish.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "expression/text.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

const VariableNames kNames{"q1", "q2"};

/// Rows of sin(factor q1 + 2 q2) with noise, of weight 1.
TrainingTable table_of(double factor, double noise, std::uint64_t seed) {
  RandomStream random{71, seed};
  TrainingTable table;
  table.variables.resize(2);
  for (int row = 0; row < 200; ++row) {
    const double q1 = random.real(-2.0, 2.0), q2 = random.real(-2.0, 2.0);
    table.variables[0].push_back(q1);
    table.variables[1].push_back(q2);
    table.target.push_back(std::sin(factor * q1 + 2.0 * q2) + noise * random.normal());
    table.weight.push_back(1.0);
  }
  return table;
}

TEST(Polished, BringsConstantsToRoundNumbersThatTheDataAllow) {
  const TrainingTable table = table_of(1.0, 0.1, 1);
  const Tree evolved = parse("SIN(0.93 * q1 + 2.08 * q2)", kNames);
  EXPECT_EQ(to_text(polished(evolved, table), kNames), to_text(parse("SIN(1 * q1 + 2 * q2)", kNames), kNames));
}

TEST(Polished, LeavesConstantsThatTheDataKnowNotToBeRound) {
  const TrainingTable table = table_of(1.1, 0.02, 2);
  const Tree tree = polished(parse("SIN(1.02 * q1 + 1.95 * q2)", kNames), table);
  double nearest = 1.0;
  for (const Node& node : tree) {
    if (node.primitive == Primitive::constant) nearest = std::min(nearest, std::abs(node.value - 1.1));
  }
  EXPECT_LT(nearest, 0.01) << to_text(tree, kNames);
}

TEST(Polished, KeepsAFormulaWithoutConstants) {
  const Tree tree = parse("SIN(q1) * q2", kNames);
  EXPECT_EQ(polished(tree, table_of(1.0, 0.1, 3)), tree);
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
