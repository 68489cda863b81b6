// Messages are to the byte what idl/calibration.idl says, and what it does not allow is not read.
#include <gtest/gtest.h>

#include <cmath>

#include "generated_types.hpp"
#include "random_messages.hpp"

namespace demecal {
namespace {

constexpr int kRounds = 100;

/// Messages made by `make` are read and written by `Wire` as the programs do it.
template <class Wire, class Plain>
void expect_the_same_form(Plain (RandomMessages::*make)()) {
  RandomMessages random(17);
  for (int i = 0; i < kRounds; ++i) {
    const Plain message = (random.*make)();
    const Wire read = encode<Wire>(message);
    ASSERT_EQ(written(read), to_bytes(message));
    ASSERT_EQ(decode<Plain>(read), message);
  }
}

TEST(WireForm, IsThatOfTheDocumentForEveryMessage) {
  expect_the_same_form<wire::CalibrationData>(&RandomMessages::data);
  expect_the_same_form<wire::IslandTask>(&RandomMessages::task);
  expect_the_same_form<wire::Migrants>(&RandomMessages::migrants);
  expect_the_same_form<wire::PlacedProgress>(&RandomMessages::placed_progress);
  expect_the_same_form<wire::Checkpoint>(&RandomMessages::checkpoint);
  expect_the_same_form<wire::Outcome>(&RandomMessages::outcome);
  expect_the_same_form<wire::WorkerStatus>(&RandomMessages::status);
  expect_the_same_form<wire::Control>(&RandomMessages::control);
  expect_the_same_form<wire::LoopNews>(&RandomMessages::news);
  expect_the_same_form<wire::CauseFound>(&RandomMessages::cause);
  expect_the_same_form<wire::FinalFigures>(&RandomMessages::figures);
  const MessagePart part{3, 1, 4, 99, std::vector<std::uint8_t>(1000, 7)};
  EXPECT_EQ(written(encode<wire::MessagePart>(part)), to_bytes(part));
  EXPECT_EQ(decode<MessagePart>(encode<wire::MessagePart>(part)), part);
}

TEST(WireForm, HasTheWordsThatEventsHave) {
  using enum LoopNews::Stage;
  using enum LoopNews::Verdict;
  LoopNews news = RandomMessages(3).news();
  for (const auto& [stage, text] : {std::pair(preparing, "preparing"), std::pair(finished, "finished"),
                                    std::pair(interrupted, "interrupted"), std::pair(failed, "failed")}) {
    news.stage = stage;
    EXPECT_EQ(encode<wire::LoopNews>(news).stage(), text);
  }
  for (const auto& [verdict, text] : {std::pair(added, "added"), std::pair(LoopNews::Verdict::none, "none")}) {
    news.verdict = verdict;
    EXPECT_EQ(encode<wire::LoopNews>(news).verdict(), text);
  }
  for (const auto& [state, text] :
       {std::pair(Control::State::running, "running"), std::pair(Control::State::cancelled, "cancelled")}) {
    const Control control{3, state, "note"};
    EXPECT_EQ(encode<wire::Control>(control).state(), text);
    EXPECT_EQ(decode<Control>(encode<wire::Control>(control)), control);
  }
}

TEST(WireForm, HasTheDocumentsCodesInARunsData) {
  CalibrationData data = RandomMessages(3).data();
  data.tables.resize(1);
  const auto coded = [&] { return encode<wire::CalibrationData>(data); };
  const std::vector<std::pair<Topology, wire::Topology>> topologies{
      {Topology::none, wire::NONE}, {Topology::ring, wire::RING}, {Topology::full, wire::FULL}};
  for (const auto& [topology, code] : topologies) {
    data.archipelago.topology = topology;
    EXPECT_EQ(coded().archipelago().topology(), code);
  }
  const std::vector<std::pair<ConstantPolicy, wire::ConstantPolicy>> policies{
      {ConstantPolicy::none, wire::UNFITTED},
      {ConstantPolicy::lamarckian, wire::LAMARCKIAN},
      {ConstantPolicy::baldwin, wire::BALDWIN}};
  for (const auto& [policy, code] : policies) {
    data.parameters.constants = policy;
    EXPECT_EQ(coded().parameters().constants(), code);
  }
  for (const auto& [replacement, code] :
       {std::pair(Replacement::worst, wire::WORST_LEAVE), std::pair(Replacement::random, wire::ANY_LEAVE)}) {
    data.archipelago.replacement = replacement;
    EXPECT_EQ(coded().archipelago().replacement(), code);
  }
  for (const auto& [loss, code] :
       {std::pair(Loss::absolute, wire::ABSOLUTE_ERROR), std::pair(Loss::squared, wire::SQUARED_ERROR)}) {
    data.tables[0].loss = loss;
    EXPECT_EQ(coded().tables()[0].loss(), code);
  }
}

TEST(WireForm, JointsAndDemesCountFromOneOnTheWire) {
  const auto encoded = encode<wire::Migrants>(Migrants{1, {0, 4}, 1, {}});
  EXPECT_EQ(encoded.joint(), 1u);
  EXPECT_EQ(encoded.deme(), 5u);
}

TEST(WireForm, TextIsCutOffAtItsBound) {
  WorkerStatus status;
  status.worker = std::string(300, 'w');
  EXPECT_EQ(decode<WorkerStatus>(encode<wire::WorkerStatus>(status))->worker, std::string(255, 'w'));
}

/// Migrants of which one is this formula.
wire::Migrants with_formula(const wire::Formula& formula) {
  auto migrants = encode<wire::Migrants>(Migrants{1, {0, 0}, 1, {}});
  wire::Individual individual;
  individual.formula(formula);
  migrants.individuals({individual});
  return migrants;
}

bool is_read(const wire::Formula& formula) {
  return decode<Migrants>(with_formula(formula)).has_value();
}

wire::Formula formula_of(const Tree& tree) {
  return encode<wire::Migrants>(Migrants{1, {0, 0}, 1, {{tree, 0.5}}}).individuals()[0].formula();
}

TEST(WireForm, FormulasWithUnknownCodesOrWrongCountsAreRefused) {
  const wire::Formula sound = formula_of(apply(Primitive::add, variable_tree(0), constant_tree(0.5)));
  ASSERT_TRUE(is_read(sound));
  wire::Formula unknown = sound;
  unknown.primitives()[1] = static_cast<std::uint8_t>(kPrimitives.size());
  EXPECT_FALSE(is_read(unknown));
  wire::Formula variable_missing = sound, variable_left = sound, constant_missing = sound, constant_left = sound;
  variable_missing.variables().clear();
  EXPECT_FALSE(is_read(variable_missing));
  variable_left.variables().push_back(0);
  EXPECT_FALSE(is_read(variable_left));
  constant_missing.constants().clear();
  EXPECT_FALSE(is_read(constant_missing));
  constant_left.constants().push_back(1.0);
  EXPECT_FALSE(is_read(constant_left));
  wire::Formula endless;
  endless.primitives().assign(65536, static_cast<std::uint8_t>(Primitive::sine));
  EXPECT_FALSE(is_read(endless));
}

TEST(WireForm, AConstantThatIsNotFiniteIsRefused) {
  for (const double value : {HUGE_VAL, -HUGE_VAL, std::nan("")})
    EXPECT_FALSE(is_read(formula_of(constant_tree(value))));
}

TEST(WireForm, OneBadFormulaRefusesTheMessageThatHoldsIt) {
  wire::Formula unknown;
  unknown.primitives({200});
  const wire::Migrants migrants = with_formula(unknown);
  const std::vector<wire::Individual> bad = migrants.individuals();
  auto of_state = encode<wire::Checkpoint>(RandomMessages(3).checkpoint());
  of_state.state().front(bad);
  EXPECT_FALSE(decode<Checkpoint>(of_state).has_value());
  auto of_recent = encode<wire::Checkpoint>(RandomMessages(3).checkpoint());
  of_recent.recent({migrants});
  EXPECT_FALSE(decode<Checkpoint>(of_recent).has_value());
  auto task = encode<wire::IslandTask>(RandomMessages(3).task());
  task.start().population(bad);
  EXPECT_FALSE(decode<IslandTask>(task).has_value());
  auto outcome = encode<wire::Outcome>(RandomMessages(3).outcome());
  outcome.front(bad);
  EXPECT_FALSE(decode<Outcome>(outcome).has_value());
}

TEST(WireForm, JointOrDemeZeroIsRefused) {
  auto progress = encode<wire::PlacedProgress>(RandomMessages(3).placed_progress());
  ASSERT_TRUE(decode<PlacedProgress>(progress).has_value());
  progress.joint(0);
  EXPECT_FALSE(decode<PlacedProgress>(progress).has_value());
  progress.joint(1);
  progress.deme(0);
  EXPECT_FALSE(decode<PlacedProgress>(progress).has_value());
}

TEST(WireForm, UnknownCodesInARunsDataAreRefused) {
  const auto sound = encode<wire::CalibrationData>(RandomMessages(3).data());
  ASSERT_TRUE(decode<CalibrationData>(sound).has_value());
  wire::CalibrationData topology = sound, function = sound, joint = sound;
  topology.archipelago().topology(static_cast<wire::Topology>(3));
  EXPECT_FALSE(decode<CalibrationData>(topology).has_value());
  function.parameters().functions().push_back(static_cast<std::uint8_t>(kPrimitives.size()));
  EXPECT_FALSE(decode<CalibrationData>(function).has_value());
  joint.archipelago().joints().push_back(0);
  EXPECT_FALSE(decode<CalibrationData>(joint).has_value());
}

TEST(WireForm, AnUnknownStageVerdictOrStateIsRefused) {
  const auto sound = encode<wire::LoopNews>(RandomMessages(3).news());
  ASSERT_TRUE(decode<LoopNews>(sound).has_value());
  wire::LoopNews stage = sound, verdict = sound;
  stage.stage("done");
  EXPECT_FALSE(decode<LoopNews>(stage).has_value());
  verdict.verdict("");
  EXPECT_FALSE(decode<LoopNews>(verdict).has_value());
  wire::Control control;
  control.run(1);
  control.state("running on");
  EXPECT_FALSE(decode<Control>(control).has_value());
}

/// So many epochs before the present one.
wire::PlacedProgress with_epochs(std::size_t count) {
  auto progress = encode<wire::PlacedProgress>(RandomMessages(3).placed_progress());
  for (auto* column : {&progress.before_epoch(), &progress.before_generation(), &progress.before_best_length()})
    column->resize(count);
  for (auto* column : {&progress.before_best(), &progress.before_median(), &progress.before_diversity()})
    column->resize(count);
  for (auto* column : {&progress.before_evaluations(), &progress.before_migrants_taken()}) column->resize(count);
  return progress;
}

TEST(WireForm, MoreEpochsAtOnceThanAreAllowedAreRefused) {
  EXPECT_TRUE(decode<PlacedProgress>(with_epochs(255)).has_value());
  EXPECT_FALSE(decode<PlacedProgress>(with_epochs(256)).has_value());
}

TEST(WireForm, FiguresOfMoreOrFewerEpochsThanThereAreAreRefused) {
  for (const std::size_t other : {0u, 2u, 4u}) {
    auto progress = with_epochs(3);
    ASSERT_TRUE(decode<PlacedProgress>(progress).has_value());
    progress.before_median().resize(other);
    EXPECT_FALSE(decode<PlacedProgress>(progress).has_value());
    progress = with_epochs(3);
    progress.before_epoch().resize(other);
    EXPECT_FALSE(decode<PlacedProgress>(progress).has_value());
  }
}

}  // namespace
}  // namespace demecal
