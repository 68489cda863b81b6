// A transport whose messages arrive twice, late or not at all, to try what its user does then.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <utility>

#include "random/random_stream.hpp"
#include "transport/transport.hpp"

namespace demecal {

struct Faults {
  double drop = 0.0;       ///< probability that a message that may be dropped is
  double duplicate = 0.0;  ///< probability that a message comes again later
  double delay = 0.0;      ///< probability that a message lets others pass
  /// Which messages may be dropped; none of those that the network itself would deliver at last, by default.
  std::function<bool(const Message&)> may_drop = [](const Message& message) {
    return std::holds_alternative<Progress>(message) || std::holds_alternative<Checkpoint>(message);
  };
  /// Which messages may come again or late: all by default.
  std::function<bool(const Message&)> may_stray = [](const Message&) { return true; };
};

/// Spoils what is received; what is published goes out as it is. The same seed spoils the same sequence alike.
class FaultyTransport final : public Transport {
 public:
  FaultyTransport(std::unique_ptr<Transport> sound, Faults faults, std::uint64_t seed)
      : sound_(std::move(sound)), faults_(std::move(faults)), random_{seed} {}

  void publish(const Message& message) override { sound_->publish(message); }
  void wake() override { sound_->wake(); }
  void follow_migrants(std::uint32_t joint) override { sound_->follow_migrants(joint); }
  void assert_alive() override { sound_->assert_alive(); }
  bool flush(std::chrono::milliseconds patience) override { return sound_->flush(patience); }
  RunId new_run() override { return sound_->new_run(); }
  void reject(const std::string& source, const std::string& why) override { sound_->reject(source, why); }
  std::uint64_t rejected() const override { return sound_->rejected(); }

  /// A held message goes first now and then, and surely where nothing new has come.
  std::optional<Message> receive(std::chrono::milliseconds patience) override {
    if (!held_.empty() && random_.chance(0.5)) return release();
    auto message = sound_->receive(held_.empty() ? patience : std::chrono::milliseconds{0});
    if (!message) return held_.empty() ? std::nullopt : release();
    if (faults_.may_drop(*message) && random_.chance(faults_.drop)) return receive(patience);
    if (!faults_.may_stray(*message)) return message;
    if (random_.chance(faults_.duplicate)) held_.push_back(*message);
    if (!random_.chance(faults_.delay)) return message;
    held_.push_back(std::move(*message));
    return receive(patience);
  }

 private:
  std::optional<Message> release() {
    const auto place = held_.begin() + static_cast<std::ptrdiff_t>(random_.index(held_.size()));
    std::optional<Message> message = std::move(*place);
    held_.erase(place);
    return message;
  }

  std::unique_ptr<Transport> sound_;
  Faults faults_;
  RandomStream random_;
  std::deque<Message> held_;
};

}  // namespace demecal
