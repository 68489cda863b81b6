// Evolved formulas in the form that people write: constants at their least-squares values, and round where data allow.
#include "calibration/polish.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "waves.hpp"

namespace demecal {
namespace {

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
