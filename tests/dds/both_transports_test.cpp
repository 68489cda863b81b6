// What every transport promises, tried on both.
#include "transport/transport.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "network.hpp"
#include "random_messages.hpp"

namespace demecal {
namespace {

class Transports : public ::testing::TestWithParam<const char*> {
 protected:
  std::unique_ptr<Network> network = std::string(GetParam()) == "dds"
                                         ? std::unique_ptr<Network>(std::make_unique<DdsNetwork>())
                                         : std::make_unique<InMemoryNetwork>();
};

INSTANTIATE_TEST_SUITE_P(Both, Transports, ::testing::Values("in_memory", "dds"),
                         [](const auto& parameter) { return std::string(parameter.param); });

constexpr std::uint32_t kJoint = 2;

Migrants emigration(std::uint32_t joint, std::uint32_t deme, std::uint32_t epoch, const char* sender = "worker") {
  return {1, {joint, deme}, epoch, {{variable_tree(0), 1.0 / epoch}}, sender};
}

TEST_P(Transports, DeliverEveryMessageEqualToAllWhoseRoleReadsIt) {
  const auto coordinator = network->join(Role::coordinator, "coordinator");
  const auto worker = network->join(Role::worker, "worker");
  const auto neighbour = network->join(Role::worker, "neighbour");
  worker->offer_migrants(kJoint);
  neighbour->follow_migrants(kJoint);
  RandomMessages random(41);
  std::vector<Message> from_coordinator, from_worker, migrants;
  for (int i = 0; i < 10; ++i) {
    const IslandTask task = random.task();
    const CalibrationData data = random.data_of(task);
    Control control = random.control();
    control.run = task.run;
    from_coordinator.insert(from_coordinator.end(), {data, task, control});
    from_worker.insert(from_worker.end(), {random.progress(), random.checkpoint(), random.outcome()});
    Migrants some = random.migrants();
    some.island.joint = kJoint;
    migrants.emplace_back(some);
  }
  from_worker.emplace_back(status_of("worker"));
  for (const Message& message : from_coordinator) coordinator->publish(message);
  for (const auto* messages : {&from_worker, &migrants})
    for (const Message& message : *messages) worker->publish(message);

  auto to_neighbour = from_coordinator;
  to_neighbour.insert(to_neighbour.end(), migrants.begin(), migrants.end());
  expect_exactly(*coordinator, from_worker);
  expect_exactly(*worker, from_coordinator);
  expect_exactly(*neighbour, to_neighbour);
}

TEST_P(Transports, GiveWatchersWhoComeLateDataProgressAndNews) {
  const auto coordinator = network->join(Role::coordinator, "coordinator");
  const auto worker = network->join(Role::worker, "worker");
  const auto reporter = network->join(Role::reporter, "reporter");
  RandomMessages random(47);
  std::vector<Message> told;
  for (int i = 0; i < 5; ++i) {
    told.insert(told.end(), {random.data(), random.progress(), random.news()});
    coordinator->publish(told[told.size() - 3]);
    worker->publish(told[told.size() - 2]);
    reporter->publish(told[told.size() - 1]);
    worker->publish(random.checkpoint());
    coordinator->publish(random.task());
  }
  const auto watcher = network->join(Role::watcher, "watcher");
  expect_exactly(*watcher, told);
}

TEST_P(Transports, GiveWatchersWhoComeLateEveryCauseAndTheFinalFigures) {
  const auto reporter = network->join(Role::reporter, "reporter");
  RandomMessages random(53);
  LoopNews news = random.news();
  std::vector<Message> told;
  for (std::uint32_t number = 1; number <= 30; ++number) {
    CauseFound cause = random.cause();
    cause.calibration = news.calibration;
    cause.number = number;
    told.push_back(cause);
  }
  FinalFigures figures = random.figures();
  figures.calibration = news.calibration;
  told.insert(told.end(), {figures, news});
  for (const Message& message : told) reporter->publish(message);
  const auto watcher = network->join(Role::watcher, "watcher");
  expect_exactly(*watcher, told);
}

TEST_P(Transports, GiveWatchersWhatWorkersRepeat) {
  const auto worker = network->join(Role::worker, "worker");
  const auto watcher = network->join(Role::watcher, "watcher");
  WorkerStatus status = status_of("worker");
  receive_until(*watcher, [&](const auto& messages) {
    if (messages.empty()) {
      status.waited_share += 1e-3;
      worker->publish(status);
    }
    return !messages.empty();
  });
}

TEST_P(Transports, ReportACalibrationLostWhenItsReporterGoes) {
  const auto watcher = network->join(Role::watcher, "watcher");
  auto reporter = network->join(Role::reporter, "reporter");
  const LoopNews news = RandomMessages(5).news();
  reporter->publish(news);
  receive_up_to(*watcher, news);
  reporter.reset();
  expect_exactly(*watcher, {CalibrationLost{news.calibration}});
}

TEST_P(Transports, ReportNoCalibrationLostThatCameToItsEnd) {
  const auto watcher = network->join(Role::watcher, "watcher");
  auto ended = network->join(Role::reporter, "ended"), broken_off = network->join(Role::reporter, "broken off");
  LoopNews over, evolving;
  over.calibration = 1;
  over.stage = LoopNews::Stage::finished;
  evolving.calibration = 2;
  evolving.stage = LoopNews::Stage::evolving;
  ended->publish(over);
  receive_up_to(*watcher, over);
  broken_off->publish(evolving);
  receive_up_to(*watcher, evolving);
  ended.reset();
  broken_off.reset();
  expect_exactly(*watcher, {CalibrationLost{2}});
}

TEST_P(Transports, KeepTheOrderOfEachKeyAndTheLastValue) {
  const auto coordinator = network->join(Role::coordinator, "coordinator");
  const auto worker = network->join(Role::worker, "worker");
  Progress last;
  last.worker = "worker";
  for (std::uint32_t epoch = 1; epoch <= 200; ++epoch) {
    last.run = 1;
    last.epoch = epoch;
    worker->publish(last);
  }
  const auto progress = only<Progress>(receive_up_to(*coordinator, last));
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end(),
                             [](const Progress& a, const Progress& b) { return a.epoch < b.epoch; }));
}

TEST_P(Transports, GiveLatecomersTheLastValueOfEachKey) {
  const auto coordinator = network->join(Role::coordinator, "coordinator");
  RandomMessages random(43);
  std::vector<Message> last;
  for (int key = 0; key < 12; ++key) {
    IslandTask task = random.task();
    last.emplace_back(random.data_of(task));
    coordinator->publish(last.back());
    coordinator->publish(task);
    ++task.attempt;
    coordinator->publish(task);
    last.emplace_back(task);
  }
  const auto latecomer = network->join(Role::worker, "latecomer");
  expect_exactly(*latecomer, last);
}

TEST_P(Transports, GiveLatecomersTheMigrantsOfTheLastEpochs) {
  const auto worker = network->join(Role::worker, "worker");
  worker->offer_migrants(kJoint);
  constexpr std::uint32_t kBefore = 5, kLast = kBefore + kMigrantEpochs;
  for (std::uint32_t epoch = 1; epoch <= kLast; ++epoch)
    for (std::uint32_t deme = 0; deme < 3; ++deme) worker->publish(emigration(kJoint, deme, epoch));
  const auto latecomer = network->join(Role::worker, "latecomer");
  latecomer->follow_migrants(kJoint);
  std::vector<Message> last;
  for (std::uint32_t epoch = kBefore + 1; epoch <= kLast; ++epoch)
    for (std::uint32_t deme = 0; deme < 3; ++deme) last.emplace_back(emigration(kJoint, deme, epoch));
  expect_exactly(*latecomer, last);
}

TEST_P(Transports, DeliverMigrantsOfFollowedJointsOnly) {
  const auto worker = network->join(Role::worker, "worker");
  const auto neighbour = network->join(Role::worker, "neighbour");
  for (const std::uint32_t joint : {0u, 1u, 2u}) worker->offer_migrants(joint);
  neighbour->follow_migrants(0);
  neighbour->follow_migrants(2);
  neighbour->follow_migrants(2);
  for (const std::uint32_t joint : {0u, 1u, 2u}) worker->publish(emigration(joint, 0, 1));
  expect_exactly(*neighbour, {emigration(0, 0, 1), emigration(2, 0, 1)});
}

TEST_P(Transports, DeliverNothingToWhoOnlyOffersMigrants) {
  const auto worker = network->join(Role::worker, "worker");
  const auto neighbour = network->join(Role::worker, "neighbour");
  const auto consumer = network->join(Role::worker, "consumer");
  worker->offer_migrants(kJoint);
  neighbour->offer_migrants(kJoint);
  consumer->follow_migrants(kJoint);
  worker->publish(emigration(kJoint, 0, 1));
  receive_up_to(*consumer, emigration(kJoint, 0, 1));
  neighbour->follow_migrants(kJoint + 1);
  worker->offer_migrants(kJoint + 1);
  worker->publish(emigration(kJoint + 1, 0, 1));
  expect_exactly(*neighbour, {emigration(kJoint + 1, 0, 1)});
}

TEST_P(Transports, NeverDeliverToTheSender) {
  const auto worker = network->join(Role::worker, "worker");
  const auto neighbour = network->join(Role::worker, "neighbour");
  for (const auto& both : {&worker, &neighbour}) {
    (*both)->follow_migrants(kJoint);
    (*both)->offer_migrants(kJoint);
  }
  worker->publish(emigration(kJoint, 0, 1));
  receive_up_to(*neighbour, emigration(kJoint, 0, 1));
  neighbour->publish(emigration(kJoint, 1, 1, "neighbour"));
  expect_exactly(*worker, {emigration(kJoint, 1, 1, "neighbour")});
}

TEST_P(Transports, CarryLongNames) {
  const std::string name(200, 'w');
  const auto coordinator = network->join(Role::coordinator, "coordinator");
  const auto worker = network->join(Role::worker, name);
  WorkerStatus status = status_of(name);
  status.host = status.version = name;
  Progress progress;
  progress.run = 1;
  progress.worker = name;
  worker->publish(status);
  worker->publish(progress);
  expect_exactly(*coordinator, {status, progress});
}

TEST_P(Transports, CarryMessagesOfAMegabyte) {
  const auto coordinator = network->join(Role::coordinator, "coordinator");
  const auto worker = network->join(Role::worker, "worker");
  Checkpoint checkpoint;
  checkpoint.run = 1;
  checkpoint.worker = "worker";
  Tree tree = variable_tree(0);
  for (int i = 0; i < 9; ++i) tree = apply(Primitive::add, tree, tree);
  checkpoint.state.population.assign(1000, {tree, 0.25});
  worker->publish(checkpoint);
  receive_up_to(*coordinator, checkpoint);
}

TEST_P(Transports, ReportAWorkerLostThatGoesWithoutNotice) {
  const auto coordinator = network->join(Role::coordinator, "coordinator");
  auto worker = network->join(Role::worker, "worker");
  worker->publish(status_of("worker"));
  receive_up_to(*coordinator, status_of("worker"));
  worker.reset();
  expect_exactly(*coordinator, {WorkerLost{"worker"}});
}

TEST_P(Transports, DoNotReportAWorkerLostThatAnnouncesItLeaves) {
  const auto coordinator = network->join(Role::coordinator, "coordinator");
  auto leaver = network->join(Role::worker, "leaver");
  auto loser = network->join(Role::worker, "loser");
  leaver->publish(status_of("leaver"));
  loser->publish(status_of("loser"));
  expect_exactly(*coordinator, {status_of("leaver"), status_of("loser")});
  leaver->publish(status_of("leaver", true));
  EXPECT_TRUE(leaver->flush(kDeadline));
  leaver.reset();
  loser.reset();
  expect_exactly(*coordinator, {status_of("leaver", true), WorkerLost{"loser"}});
}

TEST_P(Transports, FlushWhenNobodyListens) {
  const auto worker = network->join(Role::worker, "worker");
  worker->publish(status_of("worker"));
  EXPECT_TRUE(worker->flush(kDeadline));
}

TEST_P(Transports, ReceiveNothingWhenNothingComes) {
  const auto worker = network->join(Role::worker, "worker");
  EXPECT_EQ(worker->receive(std::chrono::milliseconds{0}), std::nullopt);
}

TEST_P(Transports, WakeWhoWaits) {
  const auto worker = network->join(Role::worker, "worker");
  std::thread other([&] { worker->wake(); });
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(worker->receive(kDeadline), std::nullopt);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, kDeadline);
  other.join();
}

}  // namespace
}  // namespace demecal
