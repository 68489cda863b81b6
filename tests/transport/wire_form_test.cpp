// The wire form loses nothing, and what was never encoded is not decoded.
#include <gtest/gtest.h>

#include <cmath>

#include "random_messages.hpp"
#include "transport/wire_form.hpp"

namespace demecal {
namespace {

constexpr int kRounds = 100;

/// Messages made by `make` come back equal.
template <class Plain>
void expect_round_trips(Plain (RandomMessages::*make)()) {
  RandomMessages random(17);
  for (int i = 0; i < kRounds; ++i) {
    const Plain message = (random.*make)();
    const auto decoded = decode(encode(message));
    ASSERT_TRUE(decoded.has_value());
    EXPECT_EQ(*decoded, message);
  }
}

TEST(WireForm, EveryMessageRoundTrips) {
  expect_round_trips(&RandomMessages::data);
  expect_round_trips(&RandomMessages::task);
  expect_round_trips(&RandomMessages::migrants);
  expect_round_trips(&RandomMessages::progress);
  expect_round_trips(&RandomMessages::checkpoint);
  expect_round_trips(&RandomMessages::outcome);
  expect_round_trips(&RandomMessages::status);
  expect_round_trips(&RandomMessages::news);
  expect_round_trips(&RandomMessages::tree);
}

TEST(WireForm, EveryStateOfARunRoundTrips) {
  for (const auto state : {Control::State::running, Control::State::finished, Control::State::cancelled}) {
    const Control control{3, state, "note"};
    EXPECT_EQ(decode(encode(control)), control);
  }
}

TEST(WireForm, JointsAndDemesCountFromOneOnTheWire) {
  const wire::Migrants encoded = encode(Migrants{1, {0, 4}, 1, {}});
  EXPECT_EQ(encoded.joint(), 1u);
  EXPECT_EQ(encoded.deme(), 5u);
}

TEST(WireForm, TextIsCutOffAtItsBound) {
  WorkerStatus status;
  status.worker = std::string(300, 'w');
  EXPECT_EQ(decode(encode(status))->worker, std::string(255, 'w'));
}

TEST(WireForm, FormulasWithUnknownCodesOrWrongCountsAreRefused) {
  const wire::Formula sound = encode(apply(Primitive::add, variable_tree(0), constant_tree(0.5)));
  ASSERT_TRUE(decode(sound).has_value());
  wire::Formula unknown = sound;
  unknown.primitives()[1] = static_cast<std::uint8_t>(kPrimitives.size());
  EXPECT_FALSE(decode(unknown).has_value());
  wire::Formula variable_missing = sound, variable_left = sound, constant_missing = sound, constant_left = sound;
  variable_missing.variables().clear();
  EXPECT_FALSE(decode(variable_missing).has_value());
  variable_left.variables().push_back(0);
  EXPECT_FALSE(decode(variable_left).has_value());
  constant_missing.constants().clear();
  EXPECT_FALSE(decode(constant_missing).has_value());
  constant_left.constants().push_back(1.0);
  EXPECT_FALSE(decode(constant_left).has_value());
  wire::Formula endless;
  endless.primitives().assign(65536, static_cast<std::uint8_t>(Primitive::sine));
  EXPECT_FALSE(decode(endless).has_value());
}

TEST(WireForm, OneBadFormulaRefusesTheMessageThatHoldsIt) {
  wire::Individual bad;
  bad.formula().primitives({200});
  wire::Migrants migrants = encode(Migrants{1, {0, 0}, 1, {}});
  migrants.individuals({bad});
  EXPECT_FALSE(decode(migrants).has_value());
  wire::Checkpoint of_state = encode(RandomMessages(3).checkpoint());
  of_state.state().front({bad});
  EXPECT_FALSE(decode(of_state).has_value());
  wire::Checkpoint of_recent = encode(RandomMessages(3).checkpoint());
  of_recent.recent({migrants});
  EXPECT_FALSE(decode(of_recent).has_value());
  wire::IslandTask task = encode(RandomMessages(3).task());
  task.start().population({bad});
  EXPECT_FALSE(decode(task).has_value());
  wire::Outcome outcome = encode(RandomMessages(3).outcome());
  outcome.front({bad});
  EXPECT_FALSE(decode(outcome).has_value());
}

TEST(WireForm, JointOrDemeZeroIsRefused) {
  wire::Progress progress = encode(RandomMessages(3).progress());
  ASSERT_TRUE(decode(progress).has_value());
  progress.joint(0);
  EXPECT_FALSE(decode(progress).has_value());
  progress.joint(1);
  progress.deme(0);
  EXPECT_FALSE(decode(progress).has_value());
}

TEST(WireForm, UnknownCodesInARunsDataAreRefused) {
  const wire::CalibrationData sound = encode(RandomMessages(3).data());
  ASSERT_TRUE(decode(sound).has_value());
  wire::CalibrationData topology = sound, function = sound, joint = sound;
  topology.archipelago().topology(static_cast<wire::Topology>(3));
  EXPECT_FALSE(decode(topology).has_value());
  function.parameters().functions().push_back(static_cast<std::uint8_t>(kPrimitives.size()));
  EXPECT_FALSE(decode(function).has_value());
  joint.archipelago().joints().push_back(0);
  EXPECT_FALSE(decode(joint).has_value());
}

TEST(WireForm, AnUnknownStageOrVerdictIsRefused) {
  const wire::LoopNews sound = encode(RandomMessages(3).news());
  ASSERT_TRUE(decode(sound).has_value());
  wire::LoopNews stage = sound, verdict = sound;
  stage.stage(static_cast<wire::Stage>(6));
  EXPECT_FALSE(decode(stage).has_value());
  verdict.verdict(static_cast<wire::RoundVerdict>(3));
  EXPECT_FALSE(decode(verdict).has_value());
}

TEST(WireForm, AnUnknownStateOfARunIsRefused) {
  wire::Control control;
  control.run(1);
  control.state(static_cast<wire::RunState>(3));
  EXPECT_FALSE(decode(control).has_value());
}

TEST(WireForm, AConstantThatIsNotFiniteIsRefused) {
  for (const double value : {HUGE_VAL, -HUGE_VAL, std::nan("")})
    EXPECT_FALSE(decode(encode(constant_tree(value))).has_value());
}

TEST(WireForm, ARunWorkerOrCalibrationThatIsNoneIsRefused) {
  const auto of_run_0 = [](auto message) {
    message.run = 0;
    return decode(encode(message)).has_value();
  };
  RandomMessages random(23);
  EXPECT_FALSE(of_run_0(random.data()) || of_run_0(random.task()) || of_run_0(random.migrants()) ||
               of_run_0(random.progress()) || of_run_0(random.checkpoint()) || of_run_0(random.outcome()) ||
               of_run_0(random.control()));
  EXPECT_FALSE(decode(encode(WorkerStatus{})).has_value());
  EXPECT_FALSE(decode(encode(LoopNews{})).has_value());
}

TEST(WireForm, TextThatWouldMoveACursorIsMadePrintable) {
  WorkerStatus status = RandomMessages(3).status();
  status.worker = "a\nb";
  status.host = "\033[2J";
  EXPECT_EQ(decode(encode(status))->worker, "a?b");
  EXPECT_EQ(decode(encode(status))->host, "?[2J");
}

}  // namespace
}  // namespace demecal
