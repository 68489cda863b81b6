// Messages of work in pieces that could not be acted on are refused.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "../shared_work/random_works.hpp"
#include "protocol/faults.hpp"
#include "protocol/messages.hpp"

namespace demecal {
namespace {

CalibrationData data_of_some_work() {
  CalibrationData data = data_of_work(RandomWorks(4).agreements(true));
  data.run = 1;
  return data;
}

TEST(WorkFaults, OfDataAsTheyAreMadeThereAreNone) {
  EXPECT_EQ(find_fault(data_of_some_work()), std::nullopt);
}

TEST(WorkFaults, OfDataAreFound) {
  const std::vector<std::function<void(CalibrationData&)>> spoil{
      [](CalibrationData& data) { data.archipelago.demes_per_joint = 2; },
      [](CalibrationData& data) { data.archipelago.topology = Topology::ring; },
      [](CalibrationData& data) { data.archipelago.migrants = 1; },
      [](CalibrationData& data) { data.parameters.number_generations = 2; },
      [](CalibrationData& data) { data.tables.emplace_back(); },
      [](CalibrationData& data) { data.breeds = Breeds::formulas; },
      [](CalibrationData& data) { data.breeds = Breeds::sets; },
      [](CalibrationData& data) { data.work = {}; },
      [](CalibrationData& data) { data.work.kind = static_cast<WorkKind>(4); },
      [](CalibrationData& data) { data.work.numbers_of_pieces.front() = 8'000'001; },
      [](CalibrationData& data) { data.work.tables[2].numbers.resize(kMostWorkNumbers); }};
  for (std::size_t i = 0; i < spoil.size(); ++i) {
    CalibrationData data = data_of_some_work();
    spoil[i](data);
    EXPECT_NE(find_fault(data), std::nullopt) << i;
  }
}

TEST(WorkFaults, OfNumbersThatAPieceDoesNotGiveAreFound) {
  const CalibrationData data = data_of_some_work();
  const IslandKey last{0, data.archipelago.demes_per_joint - 1};
  Outcome outcome{.run = 1, .attempt = 1, .island = last, .worker = "w", .generations = 1, .front = {}};
  outcome.numbers.assign(data.work.numbers_of_pieces[last.deme], 0.5);
  EXPECT_EQ(find_fault(outcome, data), std::nullopt);
  const Outcome whole = outcome;
  outcome.numbers.pop_back();
  EXPECT_NE(find_fault(outcome, data), std::nullopt);
  outcome = whole;
  outcome.numbers.front() = std::nan("");
  EXPECT_NE(find_fault(outcome, data), std::nullopt);
  outcome = whole;
  outcome.island.deme = 0;  // a piece of more draws
  EXPECT_NE(find_fault(outcome, data), std::nullopt);
  outcome = whole;
  outcome.front.emplace_back();
  EXPECT_NE(find_fault(outcome, data), std::nullopt);
}

}  // namespace
}  // namespace demecal
