// What belongs to a run that is over is withdrawn, and its writers go on with the next.
#include <gtest/gtest.h>

#include <algorithm>

#include "network.hpp"
#include "random_messages.hpp"
#include "transport/transport.hpp"

namespace demecal {
namespace {

class Withdrawal : public ::testing::TestWithParam<const char*> {
 protected:
  std::unique_ptr<Network> network = std::string(GetParam()) == "dds"
                                         ? std::unique_ptr<Network>(std::make_unique<DdsNetwork>())
                                         : std::make_unique<InMemoryNetwork>();
};

INSTANTIATE_TEST_SUITE_P(Both, Withdrawal, ::testing::Values("in_memory", "dds"),
                         [](const auto& parameter) { return std::string(parameter.param); });

constexpr std::uint32_t kWithdrawnJoint = 2;  ///< the joint whose migrants are

/// Has both receive until one who comes late as `role` and looks for `last` is not told `over`, which goes when it has
/// arrived.
void expect_withdrawn(Network& network, Transport& one, Transport& other, Role role, const Message& over,
                      const Message& last) {
  const auto deadline = std::chrono::steady_clock::now() + kDeadline;
  for (int i = 0; std::chrono::steady_clock::now() < deadline; ++i) {
    one.receive(std::chrono::milliseconds(10));
    other.receive(std::chrono::milliseconds(10));
    const auto probe = network.join(role, "probe " + std::to_string(i));
    const auto told = receive_up_to(*probe, last);
    if (std::find(told.begin(), told.end(), over) == told.end()) return;
  }
  ADD_FAILURE() << "what is over is still told";
}

TEST_P(Withdrawal, ForgetWhatBelongsToARunThatIsOverAndGoOnWithOthers) {
  const auto coordinator = network->join(Role::coordinator, "coordinator");
  const auto worker = network->join(Role::worker, "worker");
  const Control over{1, Control::State::finished, ""};
  Progress of_over, of_next;
  of_over.run = 1;
  of_next.run = 2;
  IslandTask task_of_over, task_of_next;
  of_over.worker = of_next.worker = "worker";
  task_of_over.run = 1;
  task_of_next.run = 2;
  RandomMessages random(59);
  const CalibrationData data_of_next = random.data_of(task_of_next);
  coordinator->publish(random.data_of(task_of_over));
  coordinator->publish(data_of_next);
  coordinator->publish(task_of_over);
  coordinator->publish(task_of_next);
  worker->publish(of_over);
  worker->publish(of_next);
  receive_up_to(*coordinator, of_next);
  coordinator->publish(over);
  receive_up_to(*worker, over);
  expect_withdrawn(*network, *coordinator, *worker, Role::coordinator, of_over, of_next);
  expect_withdrawn(*network, *coordinator, *worker, Role::worker, task_of_over, task_of_next);
  const auto late_worker = network->join(Role::worker, "late worker");
  const auto late_coordinator = network->join(Role::coordinator, "late coordinator");
  const auto watcher = network->join(Role::watcher, "watcher");
  expect_exactly(*late_worker, {over, data_of_next, task_of_next});
  expect_exactly(*late_coordinator, {of_next});
  receive_up_to(*watcher, of_next);
  ++of_next.epoch;
  ++task_of_next.attempt;
  worker->publish(of_next);
  coordinator->publish(task_of_next);
  expect_exactly(*late_worker, {task_of_next});
  expect_exactly(*late_coordinator, {of_next});
  const auto watched = only<Progress>(receive_up_to(*watcher, of_next));
  EXPECT_EQ(watched, std::vector<Progress>{of_next});
}

TEST_P(Withdrawal, GoOnWithTheNextRunWhileTheLastIsTakenBack) {
  const auto coordinator = network->join(Role::coordinator, "coordinator");
  const auto worker = network->join(Role::worker, "worker");
  const auto neighbour = network->join(Role::worker, "neighbour");
  worker->offer_migrants(kWithdrawnJoint);
  neighbour->follow_migrants(kWithdrawnJoint);
  worker->publish(status_of("worker"));
  receive_up_to(*coordinator, status_of("worker"));
  RandomMessages random(61);
  for (RunId run = 1; run <= 40; ++run) {
    worker->assert_alive();
    IslandTask task;
    task.run = run;
    coordinator->publish(random.data_of(task));
    Migrants migrants;
    for (std::uint32_t deme = 0; deme < 6; ++deme) {
      migrants = {run, {kWithdrawnJoint, deme}, 1, {{variable_tree(0), 1.0}}, "worker"};
      worker->publish(migrants);
    }
    receive_up_to(*neighbour, migrants);
    const Control over{run, Control::State::finished, ""};
    coordinator->publish(over);
    receive_up_to(*worker, over);
    receive_up_to(*neighbour, over);
    if (HasFailure()) return;
  }
  // Who hangs on the way falls silent.
  while (const auto message = coordinator->receive(std::chrono::milliseconds(0)))
    EXPECT_FALSE(std::holds_alternative<WorkerLost>(*message));
}

}  // namespace
}  // namespace demecal
