// Work is the same to the bit wherever its numbers are, and received numbers that are of no work are refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "random/random_stream.hpp"
#include "random_works.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal {
namespace {

void expect_same_elsewhere(const SharedWork& work) {
  const WorkInputs inputs = work.inputs();
  ASSERT_EQ(find_fault(inputs), std::nullopt);
  const std::unique_ptr<SharedWork> elsewhere = received_work(inputs);
  EXPECT_EQ(elsewhere->inputs(), inputs);
  ASSERT_EQ(elsewhere->pieces(), work.pieces());
  ASSERT_EQ(inputs.numbers_of_pieces.size(), work.pieces());
  EXPECT_EQ(do_work(*elsewhere), do_work(work));
  for (std::size_t piece = work.pieces(); piece-- > 0;) {
    EXPECT_EQ(elsewhere->piece(piece), work.piece(piece)) << piece;
    EXPECT_EQ(work.piece(piece).size(), inputs.numbers_of_pieces[piece]);
  }
}

TEST(SharedWork, IsTheSameWhereverItsNumbersAre) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    RandomWorks works(seed);
    expect_same_elsewhere(works.agreements(false));
    expect_same_elsewhere(works.agreements(true));
    expect_same_elsewhere(*works.gains()->work);
    expect_same_elsewhere(works.resamplings());
    expect_same_elsewhere(*works.products()->work);
  }
}

TEST(SharedWork, OfAPieceDependsOnNoOther) {
  RandomWorks few(7), many(7);
  const AgreementDraws one = few.agreements(true, 32), three = many.agreements(true, 96);
  ASSERT_EQ(one.pieces(), 1U);
  ASSERT_EQ(three.pieces(), 3U);
  EXPECT_EQ(one.piece(0), three.piece(0));
  EXPECT_NE(three.piece(0), three.piece(1));
}

TEST(SharedWork, ThatLacksAListOrATableIsRefused) {
  for (const WorkInputs& whole : inputs_of_all_kinds(1)) {
    for (std::size_t missing = 0; missing < whole.lists.size(); ++missing) {
      WorkInputs inputs = whole;
      inputs.lists.erase(inputs.lists.begin() + static_cast<std::ptrdiff_t>(missing));
      EXPECT_NE(find_fault(inputs), std::nullopt) << missing;
    }
    for (std::size_t missing = 0; missing < whole.tables.size(); ++missing) {
      WorkInputs inputs = whole;
      inputs.tables.erase(inputs.tables.begin() + static_cast<std::ptrdiff_t>(missing));
      EXPECT_NE(find_fault(inputs), std::nullopt) << missing;
    }
  }
}

TEST(SharedWork, OfNumbersThatAreNotFiniteIsRefused) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (const WorkInputs& whole : inputs_of_all_kinds(2)) {
      for (std::size_t table = 0; table < whole.tables.size(); ++table) {
        WorkInputs inputs = whole;
        if (inputs.tables[table].numbers.empty()) continue;
        inputs.tables[table].numbers.back() = bad;
        EXPECT_NE(find_fault(inputs), std::nullopt) << table;
      }
    }
  }
}

TEST(SharedWork, ThatWouldClaimMoreMemoryThanItsNumbersIsRefused) {
  constexpr std::size_t kBasis = 2, kPriorBasis = 3, kFifth = 4;
  WorkInputs agreements = RandomWorks(5).agreements(false).inputs();
  agreements.tables[kFifth] = {5, {}};  // a root without columns, and so of no size
  EXPECT_NE(find_fault(agreements), std::nullopt);
  agreements = RandomWorks(5).agreements(false).inputs();
  ++agreements.numbers_of_pieces.back();
  EXPECT_NE(find_fault(agreements), std::nullopt);
  agreements = RandomWorks(5).agreements(false).inputs();
  agreements.lists[1] = {0, 2'000'000};
  EXPECT_NE(find_fault(agreements), std::nullopt);
  WorkInputs gains = RandomWorks(6).gains()->work->inputs();
  gains.tables[kBasis].numbers.clear();
  gains.tables[kPriorBasis].numbers.clear();
  gains.tables[kFifth] = {4'000'000'000, {}};  // columns along a basis that there is not
  EXPECT_NE(find_fault(gains), std::nullopt);
  gains = RandomWorks(6).gains()->work->inputs();
  gains.lists.resize(gains.lists.size() + 1'000'000);  // blocks without their tables
  EXPECT_NE(find_fault(gains), std::nullopt);
  WorkInputs resamplings = RandomWorks(7).resamplings(1'000).inputs();
  resamplings.lists.front() = {1'000, 1'000};  // in one piece
  resamplings.numbers_of_pieces = {6'000};
  EXPECT_NE(find_fault(resamplings), std::nullopt);
}

/// Whatever was changed on the way, it is refused or can be done.
TEST(SharedWork, OfAnyNumbersIsRefusedOrDone) {
  RandomStream random{98};
  int refused = 0, made = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    for (WorkInputs inputs : inputs_of_all_kinds(seed)) {
      const std::size_t list = random.index(inputs.lists.size()), table = random.index(inputs.tables.size());
      switch (random.index(6)) {
        case 0:
          inputs.lists[list].push_back(static_cast<std::uint32_t>(random.index(100)));
          break;
        case 1:
          if (!inputs.lists[list].empty())
            inputs.lists[list][random.index(inputs.lists[list].size())] = static_cast<std::uint32_t>(random.index(100));
          break;
        case 2:
          inputs.tables[table].rows = static_cast<std::uint32_t>(random.index(50));
          break;
        case 3:
          inputs.tables[table].numbers.resize(random.index(50), 1.0);
          break;
        case 4:
          inputs.numbers_of_pieces[random.index(inputs.numbers_of_pieces.size())] =
              static_cast<std::uint32_t>(random.index(2000));
          break;
        default:
          for (double& number : inputs.tables[table].numbers) number = random.real(-2.0, 2.0);
      }
      if (find_fault(inputs)) {
        ++refused;
        continue;
      }
      const std::unique_ptr<SharedWork> work = received_work(inputs);
      for (std::size_t piece = 0; piece < work->pieces(); ++piece)
        EXPECT_EQ(work->piece(piece).size(), inputs.numbers_of_pieces[piece]);
      ++made;
    }
  }
  EXPECT_GT(refused, 40);
  EXPECT_GT(made, 40);
}

}  // namespace
}  // namespace demecal
