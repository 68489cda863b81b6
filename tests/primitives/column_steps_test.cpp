// The vector kernels against the primitives one value at a time.
#include "primitives/columns.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "random/random_stream.hpp"

namespace demecal {
namespace {

constexpr std::size_t kStepRows = 24;
constexpr std::size_t kBegin = 8;

std::uint64_t bits(double value) {
  return std::bit_cast<std::uint64_t>(value);
}

class ColumnSteps : public testing::Test {
 protected:
  ColumnSteps() : a(kStepRows), b(kStepRows) {
    for (std::size_t i = 0; i < kStepRows; ++i) a[i] = random.real(-3.0, 3.0), b[i] = random.real(-3.0, 3.0);
    a[9] = b[10] = 0.0;
    a[11] = 1e9;
  }
  /// What a step made of the rows from kBegin on; `expected` gives each row's value.
  template <class Expected>
  void expect(const ColumnStep& made, Expected expected, const std::string& what) {
    run({&made, 1}, kBegin, kStepRows - kBegin);
    for (std::size_t row = kBegin; row < kStepRows; ++row) {
      const double value = made.out[made.out_whole ? row : row - kBegin];
      ASSERT_EQ(bits(value), bits(expected(row))) << what << " in row " << row;
    }
  }

  RandomStream random{9, 1};
  AlignedColumn a, b, out = AlignedColumn(kStepRows);
};

TEST_F(ColumnSteps, GiveTheBitsOfEveryPrimitiveForColumnsAndConstants) {
  for (const PrimitiveTraits& function : kPrimitives) {
    const Primitive f = function.primitive;
    const std::string name(function.symbol);
    const Operand left{a.data(), 0.0, true}, right{b.data(), 0.0, true};
    if (function.arity == 1)
      expect(
          make_step(f, left, out.data(), true), [&](std::size_t i) { return value_of(f, a[i]); }, name);
    if (function.arity != 2) continue;
    expect(
        make_step(f, left, right, out.data(), true), [&](std::size_t i) { return value_of(f, a[i], b[i]); }, name);
    for (const double c : {0.75, 0.0}) {
      const Operand constant{nullptr, c, false};
      expect(
          make_step(f, left, constant, out.data(), true), [&](std::size_t i) { return value_of(f, a[i], c); }, name);
      expect(
          make_step(f, constant, right, out.data(), true), [&](std::size_t i) { return value_of(f, c, b[i]); }, name);
    }
  }
}

TEST_F(ColumnSteps, ReadAndWriteStripsAsWellAsWholeColumns) {
  const Operand strip{a.data(), 0.0, false}, whole{b.data(), 0.0, true};
  expect(
      make_step(Primitive::subtract, strip, whole, out.data(), false),
      [&](std::size_t row) { return a[row - kBegin] - b[row]; }, "strip");
}

TEST_F(ColumnSteps, MayWriteToWhatTheyRead) {
  const AlignedColumn before = a;
  expect(
      make_step(Primitive::divide, {b.data(), 0.0, true}, {a.data(), 0.0, true}, a.data(), true),
      [&](std::size_t row) { return protected_divide(b[row], before[row]); }, "in place");
}

// The sum is a literal, so that every machine on which the tests run is held to the same bits.
TEST(Kernels, GiveTheSameBitsOnEveryMachine) {
  RandomStream random{2, 4};
  std::uint64_t sum = 0;
  const auto add = [&](double value) { sum = (sum ^ bits(value)) * 0x9e3779b97f4a7c15; };
  for (const double largest : {1.0, 100.0, 1e6, 1e15}) {
    AlignedColumn in(4096), out(4096);
    for (double& x : in) x = random.real(-largest, largest);
    for (const Primitive function : {Primitive::sine, Primitive::cosine, Primitive::square_root, Primitive::logarithm,
                                     Primitive::exponential, Primitive::hyperbolic_tangent, Primitive::arc_tangent}) {
      const ColumnStep step = make_step(function, {in.data(), 0.0, true}, out.data(), true);
      run({&step, 1}, 0, in.size());
      for (const double value : out) add(value);
      for (const double x : in) add(value_of(function, x));
    }
  }
  EXPECT_EQ(sum, 0x794828b62e71a040U);
}

}  // namespace
}  // namespace demecal
