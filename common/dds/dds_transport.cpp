#include "dds/dds_transport.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <type_traits>
#include <utility>
#include <variant>

#include "dds/participant.hpp"
#include "dds/receiver.hpp"
#include "dds/writers.hpp"
#include "protocol/messages.hpp"
#include "transport/mailbox.hpp"
#include "transport/participants.hpp"
#include "transport/run_owners.hpp"

namespace demecal::inline dds {
namespace {

namespace fastdds = eprosima::fastdds::dds;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// Another for every run of this process, and most likely of an earlier one that had its number.
std::uint16_t new_serial() {
  static std::atomic<std::uint64_t> count{0};
  const auto now_s = std::chrono::system_clock::now().time_since_epoch() / std::chrono::seconds(1);
  return static_cast<std::uint16_t>(static_cast<std::uint64_t>(now_s) + count++);
}

class DdsTransport final : public Transport {
 public:
  DdsTransport(const DdsOptions& options, Role role, const std::string& name)
      : role_(role), name_(name), inbox_(role), participant_(options, role, name), writers_(name) {
    // A coordinator knows what its own reporter repeats of a run that goes on.
    inbox_.is_own = [this](const auto& publication) {
      return participant_.is_own(publication) ||
             (role_ == Role::coordinator && participant_.is_of_this_process(publication));
    };
    inbox_.id = participant_.id();
    inbox_.secured = !options.security.empty();
    inbox_.name_of = [this](const ParticipantId& participant) { return participant_.name_of(participant); };
    for (const Topic topic : kTopics) {
      if (topic == Topic::migrants) continue;
      if (reads(role, topic)) add_reader({topic, 0});
      if (writes(role, topic)) writers_.add({topic, 0}, participant_.make_writer(topic, 0));
    }
  }

  void publish(const Message& message) override;
  std::optional<Message> receive(milliseconds patience) override;
  void wake() override { inbox_.mailbox.wake(); }
  void follow_migrants(std::uint32_t joint) override;
  void offer_migrants(std::uint32_t joint) override;
  void assert_alive() override;
  bool flush(milliseconds patience) override;
  RunId new_run() override { return run_of(participant_.id(), new_serial()); }
  void reject(const std::string& source, const std::string& why) override { inbox_.rejections.add(source, why); }
  std::uint64_t rejected() const override { return inbox_.rejections.count(); }

 private:
  void add_reader(DdsWriters::Channel channel);
  void note_status(const WorkerStatus& status);
  std::optional<WorkerStatus> status_due();

  const Role role_;
  const std::string name_;
  Inbox inbox_;
  std::vector<std::unique_ptr<fastdds::DataReaderListener>> receivers_;
  DdsParticipant participant_;
  DdsWriters writers_;
  std::mutex mutex_;  ///< guards what follows
  std::map<DdsWriters::Channel, Owned<fastdds::DataReader>> readers_;
  std::set<std::uint32_t> offered_;     ///< joints
  std::optional<WorkerStatus> status_;  ///< the last one published
  steady_clock::time_point status_published_;
};

void DdsTransport::add_reader(DdsWriters::Channel channel) {
  const auto [topic, joint] = channel;
  receivers_.push_back(make_receiver(topic, inbox_));
  readers_.emplace(channel,
                   participant_.make_reader(topic, joint, receivers_.back().get(), reads_reliably(role_, topic)));
}

void DdsTransport::follow_migrants(std::uint32_t joint) {
  const std::lock_guard lock(mutex_);
  const DdsWriters::Channel channel{Topic::migrants, joint};
  if (reads(role_, Topic::migrants) && !readers_.contains(channel)) add_reader(channel);
}

void DdsTransport::offer_migrants(std::uint32_t joint) {
  const std::lock_guard lock(mutex_);
  const DdsWriters::Channel channel{Topic::migrants, joint};
  if (writes(role_, Topic::migrants) && offered_.insert(joint).second)
    writers_.add(channel, participant_.make_writer(Topic::migrants, joint));
}

void DdsTransport::publish(const Message& message) {
  check_may_publish(role_, name_, key_of(message));
  if (const auto* status = std::get_if<WorkerStatus>(&message)) note_status(*status);
  writers_.vacate_ended();
  writers_.send(message);
  if (const RunId ended = ended_run(message)) writers_.withdraw(ended);
}

void DdsTransport::note_status(const WorkerStatus& status) {
  const std::lock_guard lock(mutex_);
  status_ = status;
  status_published_ = steady_clock::now();
}

std::optional<Message> DdsTransport::receive(milliseconds patience) {
  participant_.log_unauthenticated();
  writers_.vacate_ended();
  inbox_.owners.release(steady_clock::now());
  auto message = inbox_.mailbox.take(patience);
  if (message)
    if (const RunId ended = ended_run(*message)) writers_.withdraw(ended);
  return message;
}

void DdsTransport::assert_alive() {
  if (role_ != Role::worker) return;
  writers_.vacate_ended();
  writers_.at({Topic::worker, 0})->assert_liveliness();
  // An assertion that meets the end of the lease revives the worker in Fast DDS without notice to its readers, who go
  // on taking it for lost: the status corrects that.
  if (const auto due = status_due()) publish(*due);
}

std::optional<WorkerStatus> DdsTransport::status_due() {
  const std::lock_guard lock(mutex_);
  return steady_clock::now() - status_published_ >= kLease ? status_ : std::nullopt;
}

/// A reporter has nothing but news to wait for.
bool DdsTransport::flush(milliseconds patience) {
  const auto deadline = steady_clock::now() + patience;
  bool arrived = true;
  for (const auto& [topic, writer] : writers_.all()) {
    if (!is_awaited(topic) && role_ != Role::reporter) continue;
    const auto left = std::chrono::duration_cast<milliseconds>(deadline - steady_clock::now());
    arrived &=
        writer->wait_for_acknowledgments(dds_duration(std::max(left, milliseconds{0}))) == ReturnCode_t::RETCODE_OK;
  }
  return arrived;
}

/// Leaves the domain within a bounded time: Fast DDS can wait for itself for ever where another participant goes at the
/// same moment as its timer asks whether it is still there (eProsima/Fast-DDS, issue 6502).
class LeavingTransport final : public Transport {
 public:
  explicit LeavingTransport(std::unique_ptr<Transport> transport) : transport_(std::move(transport)) {}
  ~LeavingTransport() override {
    constexpr milliseconds kPatience{10000};
    leave_within(kPatience, [transport = std::shared_ptr(std::move(transport_))]() mutable { transport.reset(); });
  }

  void publish(const Message& message) override { transport_->publish(message); }
  std::optional<Message> receive(milliseconds patience) override { return transport_->receive(patience); }
  void wake() override { transport_->wake(); }
  void follow_migrants(std::uint32_t joint) override { transport_->follow_migrants(joint); }
  void offer_migrants(std::uint32_t joint) override { transport_->offer_migrants(joint); }
  void assert_alive() override { transport_->assert_alive(); }
  bool flush(milliseconds patience) override { return transport_->flush(patience); }
  RunId new_run() override { return transport_->new_run(); }
  void reject(const std::string& source, const std::string& why) override { transport_->reject(source, why); }
  std::uint64_t rejected() const override { return transport_->rejected(); }

 private:
  std::unique_ptr<Transport> transport_;
};

}  // namespace

bool leave_within(milliseconds patience, std::function<void()> leave) {
  std::promise<void> left;
  const std::future<void> end = left.get_future();
  std::thread([leave = std::move(leave), left = std::move(left)]() mutable {
    leave();
    leave = nullptr;
    left.set_value();
  }).detach();
  if (end.wait_for(patience) == std::future_status::ready) return true;
  // What the thread is stuck in would be waited for again by the library's static objects.
  static const int once = ::on_exit(
      [](int status, void*) {
        std::fflush(nullptr);
        std::_Exit(status);
      },
      nullptr);
  static_cast<void>(once);
  return false;
}

std::shared_ptr<DdsOptions> add_dds_arguments(CLI::App& command) {
  const auto dds = std::make_shared<DdsOptions>();
  const auto reach_out = [dds](std::int64_t) { dds->reach = DdsOptions::Reach::network; };
  command.add_option("--domain", dds->domain, "DDS domain")
      ->envname("DEMECAL_DOMAIN")
      ->check(CLI::Range(0, 230))
      ->capture_default_str();
  command.add_flag("--network", reach_out, "meet other machines too, found by multicast");
  command.add_option("--interface", dds->interfaces, "addresses of the network interfaces to use");
  command.add_option("--peer", dds->peers, "addresses of other hosts, where there is no multicast");
  command.add_option("--discovery-server", dds->discovery_server, "ADDRESS:PORT of a discovery server");
  command
      .add_option("--security", dds->security,
                  "folder of certificates, from scripts/security; not with a discovery server")
      ->excludes("--discovery-server");
  command.parse_complete_callback([dds] {
    if (!dds->peers.empty() || !dds->discovery_server.empty()) dds->reach = DdsOptions::Reach::network;
  });
  return dds;
}

std::vector<std::string> dds_arguments(const DdsOptions& options) {
  std::vector<std::string> arguments{"--domain", std::to_string(options.domain)};
  const auto add = [&](const char* option, const std::string& value) {
    arguments.emplace_back(option);
    arguments.push_back(value);
  };
  if (options.reach == DdsOptions::Reach::network) arguments.emplace_back("--network");
  for (const std::string& address : options.interfaces) add("--interface", address);
  for (const std::string& peer : options.peers) add("--peer", peer);
  if (!options.discovery_server.empty()) add("--discovery-server", options.discovery_server);
  if (!options.security.empty()) add("--security", options.security);
  return arguments;
}

std::unique_ptr<Transport> join_dds(const DdsOptions& options, Role role, const std::string& name) {
  return std::make_unique<LeavingTransport>(std::make_unique<DdsTransport>(options, role, name));
}

}  // namespace demecal::inline dds
