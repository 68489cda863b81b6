#include "transport/transport.hpp"

#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "errors/check.hpp"
#include "evolution/archipelago.hpp"
#include "protocol/messages.hpp"
#include "protocol/stages.hpp"
#include "transport/mailbox.hpp"
#include "transport/participants.hpp"
#include "transport/run_owners.hpp"

namespace demecal::inline transport {

/// What the exchange knows of a participant.
struct InMemoryMember {
  InMemoryMember(Role r, std::string n)
      : role(r), name(std::move(n)), owners(mailbox, rejections, role == Role::worker) {}

  bool follows(const TopicKey& key) const {
    return reads(role, key.topic) && (key.topic != Topic::migrants || joints.contains(key.island.joint));
  }

  /// What another member published.
  void receive(const InMemoryMember& sender, const Message& message) {
    std::visit(
        [&](const auto& plain) {
          const auto now = std::chrono::steady_clock::now();
          if constexpr (requires { owners.receive(sender.id, "", plain, now); }) {
            owners.receive(sender.id, sender.name, plain, now);
          } else if (!mailbox.put(sender.id, plain)) {
            rejections.add(sender.name, "more than can be kept");
          }
        },
        message);
  }

  const Role role;
  const std::string name;
  ParticipantId id{};
  Mailbox mailbox;
  RejectionLog rejections;
  RunOwners owners;
  std::set<std::uint32_t> joints;   ///< those whose migrants it follows
  std::set<std::uint32_t> offered;  ///< those whose migrants it may publish
};

/// A value that waits for those who come late, with its place in the order of all that was published.
struct KeptMessage {
  std::uint64_t number;
  Message message;
};

/// One mutex guards all: it takes the place of the network.
class Exchange {
 public:
  void enter(InMemoryMember* member) {
    const std::lock_guard lock(mutex_);
    members_.push_back(member);
    member->id = id_of(++entered_);
    catch_up(*member, [member](const TopicKey& key) { return member->follows(key); });
  }

  void leave(InMemoryMember* member) {
    const std::lock_guard lock(mutex_);
    std::erase(members_, member);
    const bool is_lost = has_announced_itself(*member);
    const std::set<std::uint64_t> calibrations = unended_calibrations_of(*member);
    kept_.erase(member);
    for (const std::uint64_t calibration : calibrations) announce(*member, Topic::loop, CalibrationLost{calibration});
    if (is_lost) announce(*member, Topic::worker, WorkerLost{member->name});
    for (InMemoryMember* other : members_) other->owners.departed(member->id, std::chrono::steady_clock::now());
  }

  void follow(InMemoryMember* member, std::uint32_t joint) {
    const std::lock_guard lock(mutex_);
    if (!member->joints.insert(joint).second) return;
    catch_up(*member, [member, joint](const TopicKey& key) {
      return key.topic == Topic::migrants && key.island.joint == joint && member->follows(key);
    });
  }

  void offer(InMemoryMember* member, std::uint32_t joint) {
    const std::lock_guard lock(mutex_);
    member->offered.insert(joint);
  }

  void publish(InMemoryMember* sender, const Message& message) {
    const std::lock_guard lock(mutex_);
    const TopicKey key = key_of(message);
    check_may_publish(sender->role, sender->name, key);
    DEMECAL_CHECK(key.topic != Topic::migrants || sender->offered.contains(key.island.joint),
                  "joint=" << key.island.joint << " is not offered");
    if (const RunId ended = ended_run(message)) forget(ended);
    auto& values = kept_[sender][key];
    values.push_back({++published_, message});
    if (values.size() > static_cast<std::size_t>(values_kept(key.topic))) values.pop_front();
    for (InMemoryMember* member : members_)
      if (member != sender && member->follows(key)) member->receive(*sender, message);
  }

 private:
  using Values = std::map<TopicKey, std::deque<KeptMessage>>;

  /// No two members have the same, whatever their names.
  static ParticipantId id_of(std::uint64_t number) {
    ParticipantId id{};
    for (std::size_t i = 0; i < sizeof number; ++i) id[i] = static_cast<std::uint8_t>(number >> (8 * i));
    return id;
  }

  /// Announces what a member does not publish itself.
  void announce(const InMemoryMember& source, Topic topic, const Message& message) {
    for (InMemoryMember* member : members_)
      if (reads(member->role, topic)) member->mailbox.put(source.id, message);
  }

  /// Those whose news it has published, less those whose last stage says that they are over.
  std::set<std::uint64_t> unended_calibrations_of(const InMemoryMember& member) {
    std::set<std::uint64_t> calibrations, ended;
    for (const auto& [key, values] : kept_[&member]) {
      if (key.topic != Topic::loop) continue;
      const auto& news = std::get<LoopNews>(values.back().message);
      (news.round == 0 && is_over(news.stage) ? ended : calibrations).insert(news.calibration);
    }
    for (const std::uint64_t calibration : ended) calibrations.erase(calibration);
    return calibrations;
  }

  template <class Predicate>
  void catch_up(InMemoryMember& newcomer, Predicate wanted) {
    std::map<std::uint64_t, std::pair<const InMemoryMember*, const Message*>> in_order;
    for (const auto& [sender, values] : kept_)
      for (const auto& [key, waiting] : values)
        if (sender != &newcomer && wanted(key))
          for (const KeptMessage& kept : waiting) in_order.emplace(kept.number, std::pair(sender, &kept.message));
    for (const auto& [number, kept] : in_order) newcomer.receive(*kept.first, *kept.second);
  }

  /// Whether it has published a status, and none that says it leaves.
  bool has_announced_itself(const InMemoryMember& member) {
    const auto& values = kept_[&member];
    const auto status = values.find({Topic::worker, 0, {}, member.name});
    return status != values.end() && !std::get<WorkerStatus>(status->second.back().message).leaving;
  }

  void forget(RunId run) {
    for (auto& [sender, values] : kept_)
      std::erase_if(values, [run](const auto& kept) { return kept.first.run == run; });
  }

  std::mutex mutex_;
  std::vector<InMemoryMember*> members_;
  std::map<const InMemoryMember*, Values> kept_;
  std::uint64_t published_ = 0, entered_ = 0;
};

namespace {

class InMemoryTransport final : public Transport {
 public:
  InMemoryTransport(std::shared_ptr<Exchange> exchange, Role role, const std::string& name)
      : exchange_(std::move(exchange)), member_(role, name) {
    exchange_->enter(&member_);
  }
  ~InMemoryTransport() override { exchange_->leave(&member_); }
  InMemoryTransport(const InMemoryTransport&) = delete;
  InMemoryTransport& operator=(const InMemoryTransport&) = delete;

  void publish(const Message& message) override { exchange_->publish(&member_, message); }
  std::optional<Message> receive(std::chrono::milliseconds patience) override {
    member_.owners.release(std::chrono::steady_clock::now());
    return member_.mailbox.take(patience);
  }
  void wake() override { member_.mailbox.wake(); }
  void follow_migrants(std::uint32_t joint) override { exchange_->follow(&member_, joint); }
  void offer_migrants(std::uint32_t joint) override { exchange_->offer(&member_, joint); }
  void assert_alive() override {}
  bool flush(std::chrono::milliseconds) override { return true; }
  RunId new_run() override {
    const auto moment = std::chrono::system_clock::now().time_since_epoch().count();
    return ((static_cast<RunId>(moment) << 16) ^ static_cast<RunId>(::getpid()) ^ 1U) & ~(RunId{1} << 63);
  }
  void reject(const std::string& source, const std::string& why) override { member_.rejections.add(source, why); }
  std::uint64_t rejected() const override { return member_.rejections.count(); }

 private:
  std::shared_ptr<Exchange> exchange_;
  InMemoryMember member_;
};

}  // namespace

std::shared_ptr<Exchange> make_exchange() {
  return std::make_shared<Exchange>();
}

std::unique_ptr<Transport> join(std::shared_ptr<Exchange> exchange, Role role, const std::string& name) {
  return std::make_unique<InMemoryTransport>(std::move(exchange), role, name);
}

}  // namespace demecal::inline transport
