// What only DDS has: leases, malformed samples, discovery servers, addresses.
#include "dds/dds_transport.hpp"

#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <csignal>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "dds/participant.hpp"
#include "dds/parts.hpp"
#include "errors/input_error.hpp"
#include "network.hpp"
#include "protocol/message_bytes.hpp"
#include "random_messages.hpp"

namespace demecal {
namespace {

constexpr std::uint32_t kFollowedJoint = 0;

DdsOptions read_arguments(const std::vector<std::string>& arguments) {
  CLI::App app;
  const std::shared_ptr<DdsOptions> options = add_dds_arguments(app);
  app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  return *options;
}

TEST(DdsArguments, AreReadBackAsTheOptionsTheyWereMadeOf) {
  for (const bool network : {false, true}) {
    for (const int addresses : {0, 1, 3}) {
      for (const bool by_server : {false, true}) {
        DdsOptions options;
        options.domain = static_cast<std::uint32_t>(7 + addresses);
        for (int i = 0; i < addresses; ++i) {
          options.interfaces.push_back("10.0.0." + std::to_string(i));
          options.peers.push_back("10.0.1." + std::to_string(i));
        }
        (by_server ? options.discovery_server : options.security) = by_server ? "10.0.2.1:11811" : "/folder of keys";
        if (network || addresses > 0 || by_server) options.reach = DdsOptions::Reach::network;
        const DdsOptions read = read_arguments(dds_arguments(options));
        EXPECT_EQ(read.domain, options.domain);
        EXPECT_EQ(read.reach, options.reach);
        EXPECT_EQ(read.interfaces, options.interfaces);
        EXPECT_EQ(read.peers, options.peers);
        EXPECT_EQ(read.discovery_server, options.discovery_server);
        EXPECT_EQ(read.security, options.security);
      }
    }
  }
}

TEST(Dds, AWorkerWhoseLoopIsStuckIsLostAndComesBackWhenItGoesOn) {
  DdsNetwork network;
  const auto coordinator = network.join(Role::coordinator, "coordinator");
  const auto stuck = network.join(Role::worker, "stuck");
  stuck->publish(status_of("stuck"));
  receive_up_to(*coordinator, status_of("stuck"));
  // One sign of life, then silence for longer than the lease; again, should the sign have come before the two had met.
  const Message lost = WorkerLost{"stuck"};
  std::optional<Message> received;
  for (int i = 0; i < 5 && received != lost; ++i) {
    stuck->assert_alive();
    received = coordinator->receive(2 * kLease);
  }
  ASSERT_EQ(received, lost);
  // Signs of life as work loops give them: where the first one meets the end of the lease, the status follows.
  receive_until(*coordinator, [&](const auto& messages) {
    stuck->assert_alive();
    return !messages.empty() && messages.back() == Message(status_of("stuck"));
  });
}

TEST(Dds, MalformedSamplesAreCountedAndRejected) {
  DdsNetwork network;
  const auto worker = network.join(Role::worker, "worker");
  worker->follow_migrants(kFollowedJoint);
  DdsParticipant stranger(local_options(), Role::worker, "stranger");
  const auto writer = stranger.make_writer(Topic::migrants, kFollowedJoint);
  const std::string sound = to_bytes(Migrants{1, {kFollowedJoint, 0}, 1, {{variable_tree(0), 0.5}}, "stranger"});
  std::string no_run = sound;
  no_run.replace(0, sizeof(RunId), sizeof(RunId), '\0');
  std::uint32_t place = 0;
  for (const std::string& bytes : {no_run, sound.substr(1), sound})
    for (Sample<MessagePart> part : split_into_parts(bytes, place++, 1)) ASSERT_TRUE(writer->write(&part));
  Sample<MessagePart> beyond = split_into_parts(sound, place, 1).front();
  beyond->index = 7;
  ASSERT_TRUE(writer->write(&beyond));
  receive_until(*worker, [](const auto& messages) { return !messages.empty(); });
  receive_until(*worker, [&](const auto&) { return worker->rejected() == 3; });
}

/// Receives checkpoints, but keeps Fast DDS's thread, and with it the acknowledgment, until it is let go.
class SlowReader final : public eprosima::fastdds::dds::DataReaderListener {
 public:
  void on_data_available(eprosima::fastdds::dds::DataReader* reader) override {
    Sample<MessagePart> sample;
    eprosima::fastdds::dds::SampleInfo info;
    while (reader->take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK) {
      const std::lock_guard lock(mutex_);
      if (!info.valid_data) continue;
      const auto result = assembly_.take({}, std::move(*sample));
      if (result.verdict == MessageAssembler::Verdict::whole)
        epochs_.push_back(from_bytes<Checkpoint>(result.bytes)->state.epoch);
    }
    arrived_ = true;
    arrived_.notify_all();
    let_go_.wait(false);
  }
  void wait_for_first() { arrived_.wait(false); }
  void let_go() {
    let_go_ = true;
    let_go_.notify_all();
  }
  std::vector<std::uint32_t> epochs() {
    const std::lock_guard lock(mutex_);
    return epochs_;
  }

 private:
  std::atomic<bool> arrived_{false}, let_go_{false};
  std::mutex mutex_;
  MessageAssembler assembly_;
  std::vector<std::uint32_t> epochs_;
};

/// One that does not fit into a datagram.
Checkpoint checkpoint_of(std::uint32_t epoch) {
  constexpr int kIndividuals = 5000;
  Checkpoint checkpoint;
  checkpoint.state.population.assign(kIndividuals, {variable_tree(0), 0.5});
  checkpoint.run = 1;
  checkpoint.worker = "worker";
  checkpoint.state.epoch = epoch;
  return checkpoint;
}

TEST(Dds, OfLargeCheckpointsThatReplaceEachOtherOnTheirWayTheLastOneGetsThere) {
  SlowReader slow_reader;
  DdsParticipant slow(local_options(), Role::coordinator, "slow");
  const auto reader = slow.make_reader(Topic::checkpoint, 0, &slow_reader);
  DdsNetwork network;
  const auto worker = network.join(Role::worker, "worker");
  worker->publish(checkpoint_of(1));
  slow_reader.wait_for_first();
  for (const std::uint32_t epoch : {2, 3, 4}) worker->publish(checkpoint_of(epoch));
  slow_reader.let_go();
  const auto deadline = std::chrono::steady_clock::now() + kDeadline;
  const auto last_has_come = [&] { return !slow_reader.epochs().empty() && slow_reader.epochs().back() == 4; };
  while (!last_has_come() && std::chrono::steady_clock::now() < deadline)
    worker->receive(std::chrono::milliseconds{10});
  EXPECT_TRUE(last_has_come());
  EXPECT_TRUE(std::ranges::is_sorted(slow_reader.epochs()));
}

/// Asks two threads at once for the keys of different samples of the topic.
template <class Plain>
void expect_own_keys(Topic topic, Sample<Plain> one, Sample<Plain> two) {
  eprosima::fastdds::dds::TypeSupport type = topic_type(topic);
  const auto key_of_sample = [&](Sample<Plain>& sample) {
    eprosima::fastrtps::rtps::InstanceHandle_t handle;
    EXPECT_TRUE(type->getKey(&sample, &handle, false));
    return handle;
  };
  constexpr std::uint32_t kAsked = 1'000'000;  // long enough for the two to ask at once
  const auto mine = key_of_sample(one), others = key_of_sample(two);
  ASSERT_NE(mine, others);
  std::atomic<int> wrong{0};
  const auto ask = [&](Sample<Plain>& sample, const auto& expected) {
    for (std::uint32_t i = 0; i < kAsked; ++i) wrong += key_of_sample(sample) == expected ? 0 : 1;
  };
  std::thread other(ask, std::ref(two), others);
  ask(one, mine);
  other.join();
  EXPECT_EQ(wrong, 0);
}

TEST(Dds, KeysAreTheSamplesOwnWhateverOtherThreadsDo) {
  RandomMessages random(5);
  expect_own_keys<MessagePart>(Topic::migrants, vacant_part(1, 0, 1), vacant_part(2, 0, 1));
  expect_own_keys<PlacedProgress>(Topic::progress, PlacedProgress{"one", 1, false, {}},
                                  PlacedProgress{"one", 2, false, {}});
  expect_own_keys<Control>(Topic::control, random.control(), random.control());
  expect_own_keys<LoopNews>(Topic::loop, random.news(), random.news());
  expect_own_keys<CauseFound>(Topic::cause, random.cause(), random.cause());
  expect_own_keys<FinalFigures>(Topic::final_figures, random.figures(), random.figures());
  expect_own_keys<WorkerStatus>(Topic::worker, status_of("one"), status_of("two"));
}

TEST(Dds, AddressesThatAreNoneAreTheUsersError) {
  DdsOptions no_port = local_options(), no_host = local_options(), no_peer = local_options();
  no_port.discovery_server = "127.0.0.1";
  EXPECT_THROW(join_dds(no_port, Role::worker, "worker"), InputError);
  no_host.discovery_server = ":11811";
  EXPECT_THROW(join_dds(no_host, Role::worker, "worker"), InputError);
  no_peer.reach = DdsOptions::Reach::network;
  no_peer.peers = {"no.such.host.invalid"};
  EXPECT_THROW(join_dds(no_peer, Role::worker, "worker"), InputError);
}

TEST(Dds, ParticipantsOnANetworkMeetByNamedPeers) {
  DdsOptions options = local_options();
  options.reach = DdsOptions::Reach::network;
  options.interfaces = {"127.0.0.1"};
  options.peers = {"127.0.0.1"};
  DdsNetwork network(options);
  const auto coordinator = network.join(Role::coordinator, "coordinator");
  const auto worker = network.join(Role::worker, "worker");
  worker->publish(status_of("worker"));
  receive_up_to(*coordinator, status_of("worker"));
}

/// Fast DDS's own server, for as long as the test runs.
class DiscoveryServer {
 public:
  static constexpr const char* kProgram = "/usr/bin/fast-discovery-server";

  explicit DiscoveryServer(const std::string& port) {
    std::vector<std::string> words{kProgram, "-i", "0", "-l", "127.0.0.1", "-p", port};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t silent;
    posix_spawn_file_actions_init(&silent);
    posix_spawn_file_actions_addopen(&silent, STDOUT_FILENO, "/dev/null", 01, 0);
    EXPECT_EQ(posix_spawn(&process_, kProgram, &silent, nullptr, arguments.data(), environ), 0);
    posix_spawn_file_actions_destroy(&silent);
  }
  ~DiscoveryServer() {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  DiscoveryServer(const DiscoveryServer&) = delete;
  DiscoveryServer& operator=(const DiscoveryServer&) = delete;

 private:
  pid_t process_ = 0;
};

TEST(Dds, ParticipantsMeetThroughADiscoveryServer) {
  if (!std::filesystem::exists(DiscoveryServer::kProgram)) GTEST_SKIP() << "no " << DiscoveryServer::kProgram;
  const std::string port = std::to_string(20000 + getpid() % 10000);
  const DiscoveryServer server(port);
  DdsOptions options = local_options();
  options.discovery_server = "127.0.0.1:" + port;
  DdsNetwork network(options);
  const auto coordinator = network.join(Role::coordinator, "coordinator");
  auto worker = network.join(Role::worker, "worker");
  worker->publish(status_of("worker"));
  receive_up_to(*coordinator, status_of("worker"));
  const Message data = RandomMessages(7).data();
  coordinator->publish(data);
  receive_up_to(*worker, data);
  worker.reset();
  receive_up_to(*coordinator, WorkerLost{"worker"});
}

}  // namespace
}  // namespace demecal
