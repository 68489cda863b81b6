// Rewriting and polishing bring formulas into the form that people write, and never make their description longer.
#include "formula_search/rewrite.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "waves.hpp"

namespace demecal {
namespace {

std::string rewrite(const char* text, const TrainingTable& table) {
  FormulaMisfit misfit(table);
  return to_string(rewritten(parse(text, kNames), misfit), kNames);
}

TEST(Rewritten, LeavesOutWhatEarnsNothing) {
  const TrainingTable table = table_of(1.0, 0.1, 4);
  EXPECT_EQ(rewrite("0.7 * SIN(1 * q1 + 1.9 * q2 + 0.02 * COS(q1)) - 0.01 * q2 * SIGN(q1)", table), "SIN(q1 + 2 * q2)");
}

TEST(Rewritten, KeepsAPartThatEarnsItsWords) {
  TrainingTable table = table_of(1.0, 0.05, 5);
  for (std::size_t row = 0; row < table.target.size(); ++row) table.target[row] += 0.8 * table.variables[1][row];
  const std::string text = rewrite("SIN(q1 + 2 * q2) + 0.6 * q2 + 0.001 * q1", table);
  EXPECT_NE(text.find("SIN(q1 + 2 * q2)"), std::string::npos) << text;
  EXPECT_NE(text.find("* q2)"), std::string::npos) << text;
  EXPECT_LT(parse(text, kNames).size(), parse("SIN(q1 + 2 * q2) + 0.6 * q2 + 0.001 * q1", kNames).size()) << text;
}

TEST(Rewritten, GivesTheAmplitudeToItsCoefficient) {
  const TrainingTable table = table_of(1.0, 0.1, 8);
  EXPECT_EQ(rewrite("3.1 * (SIN(q1 + 2 * q2) % 0.4)", table), "SIN(q1 + 2 * q2)");
  EXPECT_EQ(rewrite("3.1 % (0.4 % SIN(q1 + 2 * q2))", table), "SIN(q1 + 2 * q2)");
}

TEST(Rewritten, GrowsByFactorsAndSumsThatEarnTheirWords) {
  const TrainingTable table = table_of(1.0, 0.1, 9);
  EXPECT_EQ(parse(rewrite("SIN(q1 + q2)", table), kNames).size(), parse("SIN(q1 + 2 * q2)", kNames).size());
  TrainingTable product = table;
  for (std::size_t row = 0; row < table.target.size(); ++row) {
    product.target[row] = table.variables[0][row] * std::cos(table.variables[1][row]) + 0.01 * table.target[row];
  }
  EXPECT_EQ(parse(rewrite("SIN(SIN(q1))", product), kNames).size(), parse("q1 * COS(q2)", kNames).size());
}

TEST(BestProduct, IsTheTruthWhereThatIsOne) {
  TrainingTable table = table_of(1.0, 0.1, 12);
  for (std::size_t row = 0; row < table.target.size(); ++row) {
    table.target[row] *= 0.1;
    table.target[row] +=
        table.variables[0][row] * std::sin(table.variables[1][row]) * std::cos(table.variables[1][row]);
  }
  FormulaMisfit misfit(table);
  EXPECT_NEAR(misfit.nats(best_product(misfit)), misfit.nats(parse("q1 * SIN(q2) * COS(q2)", kNames)), 1e-9);
}

TEST(Rewritten, EndsWhereNoSingleStepHelps) {
  const TrainingTable table = table_of(1.0, 0.1, 10);
  const std::string once = rewrite("q1 * q2 + SIN(q2)", table);
  EXPECT_EQ(rewrite(once.c_str(), table), once);
}

Tree polish(const Tree& tree, const TrainingTable& table) {
  FormulaMisfit misfit(table);
  return polished(tree, misfit);
}

TEST(Polished, BringsConstantsToRoundNumbersThatTheDataAllow) {
  const TrainingTable table = table_of(1.0, 0.1, 1);
  const Tree evolved = parse("SIN(0.93 * q1 + 2.08 * q2)", kNames);
  EXPECT_EQ(to_string(polish(evolved, table), kNames), to_string(parse("SIN(1 * q1 + 2 * q2)", kNames), kNames));
}

TEST(Polished, LeavesConstantsThatTheDataKnowNotToBeRound) {
  const TrainingTable table = table_of(1.1, 0.02, 2);
  const Tree tree = polish(parse("SIN(1.02 * q1 + 1.95 * q2)", kNames), table);
  double nearest = 1.0;
  for (const Node& node : tree) {
    if (node.primitive == Primitive::constant) nearest = std::min(nearest, std::abs(node.value - 1.1));
  }
  EXPECT_LT(nearest, 0.01) << to_string(tree, kNames);
}

TEST(Polished, KeepsAFormulaWithoutConstants) {
  const Tree tree = parse("SIN(q1) * q2", kNames);
  EXPECT_EQ(polish(tree, table_of(1.0, 0.1, 3)), tree);
}

}  // namespace
}  // namespace demecal
