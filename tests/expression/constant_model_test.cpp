// Formulas as functions of their constants: values to the bit, folding that changes none, slopes against differences.
#include "expression/constant_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "expression/text.hpp"
#include "random_formulas.hpp"

namespace demecal {
namespace {

using Scaling = ConstantModel::Scaling;

std::vector<double> row_of(const std::vector<std::vector<double>>& columns, std::size_t row) {
  return {columns[0][row], columns[1][row]};
}

std::vector<double> values_at(ConstantModel& model, std::span<const double> constants, std::size_t rows) {
  std::vector<double> values;
  model.set(constants);
  for (std::size_t begin = 0; begin < model.padded_rows(); begin += model.rows_at(begin)) {
    const double* const strip = model.values(begin);
    values.insert(values.end(), strip, strip + model.rows_at(begin));
  }
  values.resize(rows);
  return values;
}

std::vector<double> slopes_of(ConstantModel& model, std::size_t constant, std::size_t rows) {
  std::vector<double> slopes;
  for (std::size_t begin = 0; begin < model.padded_rows(); begin += model.rows_at(begin)) {
    model.values(begin);
    model.find_slopes();
    slopes.insert(slopes.end(), model.slope(constant), model.slope(constant) + model.rows_at(begin));
  }
  slopes.resize(rows);
  return slopes;
}

std::vector<double> own_constants(const ConstantModel& model) {
  return {model.constants().begin(), model.constants().end()};
}

class ConstantModels : public testing::Test {
 protected:
  Tree tree() { return random_tree(random, 6, 2); }
  RandomStream random{41};
  NodeStore store;
};

TEST_F(ConstantModels, HaveTheBitsOfEvaluate) {
  for (const std::size_t rows : {1, 30, 300}) {
    const auto columns = random_columns(random, 2, rows);
    ConstantModel model(columns);
    for (int i = 0; i < 100; ++i) {
      const Tree formula = tree();
      model.bind(store, store.enter(formula));
      const std::vector<double> values = values_at(model, own_constants(model), rows);
      for (std::size_t row = 0; row < rows; ++row)
        ASSERT_TRUE(same_bits(values[row], evaluate(formula, row_of(columns, row)))) << "row " << row;
    }
  }
}

TEST_F(ConstantModels, FoldWithoutChangingAValue) {
  const auto columns = random_columns(random, 2, 12);
  ConstantModel model(columns);
  int shorter = 0;
  for (int i = 0; i < 300; ++i) {
    const Tree formula = tree();
    model.bind(store, store.enter(formula));
    const Tree folded = store.tree(model.rebuilt(store, own_constants(model)));
    shorter += folded.size() < formula.size();
    ASSERT_LE(folded.size(), formula.size());
    ASSERT_TRUE(is_valid(folded, 2));
    for (std::size_t row = 0; row < 12; ++row)
      ASSERT_TRUE(same_bits(evaluate(folded, row_of(columns, row)), evaluate(formula, row_of(columns, row))));
  }
  EXPECT_GT(shorter, 50);
}

TEST_F(ConstantModels, AreRebuiltWithTheConstantsTheyAreGiven) {
  const auto columns = random_columns(random, 2, 12);
  ConstantModel model(columns);
  for (const Scaling scaling : {Scaling::none, Scaling::linear}) {
    for (int i = 0; i < 200; ++i) {
      const NodeId root = store.enter(apply(Primitive::add, tree(), variable_tree(0)));
      model.bind(store, root, scaling);
      std::vector<double> constants = own_constants(model);
      for (double& constant : constants) constant = random.real(-2.0, 2.0);
      const std::vector<double> values = values_at(model, constants, 12);
      const NodeId rebuilt = model.rebuilt(store, constants);
      const TreeExtent extent = ConstantModel::extent(store, root, scaling);
      ASSERT_GE(extent.nodes, store[rebuilt].whole.nodes);
      ASSERT_GE(extent.depth, store[rebuilt].whole.depth);
      for (std::size_t row = 0; row < 12; ++row)
        ASSERT_TRUE(same_bits(values[row], evaluate(store.tree(rebuilt), row_of(columns, row))));
    }
  }
}

// Where two widths of differences agree, and those to either side, the formula is smooth there.
TEST_F(ConstantModels, HaveTheSlopesThatDifferencesShow) {
  constexpr std::size_t kRows = 20;
  const auto columns = random_columns(random, 2, kRows);
  ConstantModel model(columns);
  int compared = 0, varying = 0;
  for (int i = 0; i < 400; ++i) {
    model.bind(store, store.enter(tree()), i % 2 == 0 ? Scaling::none : Scaling::linear);
    const std::vector<double> constants = own_constants(model);
    for (std::size_t k = 0; k < constants.size(); ++k) {
      const auto difference = [&](double width) {
        std::vector<double> above = constants, below = constants;
        above[k] += width;
        below[k] -= width;
        std::vector<double> result = values_at(model, above, kRows);
        const std::vector<double> lower = values_at(model, below, kRows);
        for (std::size_t row = 0; row < kRows; ++row) result[row] = (result[row] - lower[row]) / (2.0 * width);
        return result;
      };
      const std::vector<double> wide = difference(2e-5), narrow = difference(1e-5);
      model.set(constants);
      const std::vector<double> slopes = slopes_of(model, k, kRows);
      const std::vector<double> values = values_at(model, constants, kRows);
      std::vector<double> above = constants;
      above[k] += 1e-5;
      const std::vector<double> ahead = values_at(model, above, kRows);
      for (std::size_t row = 0; row < kRows; ++row) {
        if (!(std::abs((ahead[row] - values[row]) / 1e-5 - narrow[row]) < 0.01 * (1.0 + std::abs(narrow[row]))))
          continue;
        const double tolerance = 1e-5 * (1.0 + std::abs(wide[row])) + 1e-9 * std::abs(values[row]);
        if (!(std::abs(wide[row] - narrow[row]) < 0.1 * tolerance) || !std::isfinite(slopes[row])) continue;
        ASSERT_NEAR(slopes[row], narrow[row], tolerance) << "formula " << i << " constant " << k << " row " << row;
        ++compared;
        varying += slopes[row] != 0.0;
      }
    }
  }
  EXPECT_GT(compared, 10000);
  EXPECT_GT(varying, 5000);
}

TEST_F(ConstantModels, ShareTheConstantsOfEqualSubtrees) {
  const auto columns = random_columns(random, 2, 5);
  ConstantModel model(columns);
  const Tree half = constant_tree(0.5);
  const Tree wave = apply(Primitive::sine, apply(Primitive::multiply, half, variable_tree(0)));
  model.bind(store, store.enter(apply(Primitive::add, wave, apply(Primitive::multiply, wave, constant_tree(2.0)))));
  EXPECT_EQ(own_constants(model), (std::vector<double>{0.5, 2.0}));
}

TEST_F(ConstantModels, LeaveOutConstantsThatAreNotFinite) {
  const auto columns = random_columns(random, 2, 5);
  ConstantModel model(columns);
  const Tree huge = apply(Primitive::multiply, constant_tree(1e200), constant_tree(1e200));
  const Tree formula = apply(Primitive::divide, variable_tree(0), huge);
  model.bind(store, store.enter(formula));
  EXPECT_TRUE(model.constants().empty());
  EXPECT_EQ(store.tree(model.rebuilt(store, {})), formula);
}

TEST_F(ConstantModels, KnowWhetherAConstantMovesAJump) {
  const auto columns = random_columns(random, 2, 5);
  ConstantModel model(columns);
  const auto jumps = [&](const Tree& formula) {
    model.bind(store, store.enter(formula));
    return model.jumps();
  };
  const Tree moved = apply(Primitive::sign, apply(Primitive::add, variable_tree(0), constant_tree(0.3)));
  EXPECT_TRUE(jumps(apply(Primitive::multiply, constant_tree(2.0), moved)));
  EXPECT_FALSE(jumps(apply(Primitive::multiply, constant_tree(2.0), apply(Primitive::sign, variable_tree(0)))));
}

TEST_F(ConstantModels, TakeOffWhatScalingMakesRedundant) {
  const auto columns = random_columns(random, 2, 5);
  ConstantModel model(columns);
  const Tree wave = apply(Primitive::sine, variable_tree(0));
  const Tree scaled =
      apply(Primitive::subtract, constant_tree(3.0),
            apply(Primitive::divide, apply(Primitive::multiply, constant_tree(0.5), wave), constant_tree(4.0)));
  const NodeId root = store.enter(scaled);
  model.bind(store, root, Scaling::linear);
  EXPECT_EQ(own_constants(model), (std::vector<double>{0.0, 1.0}));
  const Tree expected = apply(Primitive::add, constant_tree(1.0), apply(Primitive::multiply, constant_tree(2.0), wave));
  EXPECT_EQ(store.tree(model.rebuilt(store, std::vector<double>{1.0, 2.0})), expected);
  EXPECT_EQ(ConstantModel::extent(store, root, Scaling::linear).nodes, expected.size());
}

}  // namespace
}  // namespace demecal
