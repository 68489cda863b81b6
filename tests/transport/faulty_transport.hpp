// A transport whose messages arrive twice, late or not at all, to try what its user does then.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <utility>

#include "forwarding_transport.hpp"
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
class FaultyTransport final : public ForwardingTransport {
 public:
  FaultyTransport(std::unique_ptr<Transport> sound, Faults faults, std::uint64_t seed)
      : ForwardingTransport(std::move(sound)), faults_(std::move(faults)), random_{seed} {}

  /// A held message goes first now and then, and surely where nothing new has come.
  std::optional<Message> receive(std::chrono::milliseconds patience) override {
    if (!held_.empty() && random_.chance(0.5)) return release();
    auto message = ForwardingTransport::receive(held_.empty() ? patience : std::chrono::milliseconds{0});
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

  Faults faults_;
  RandomStream random_;
  std::deque<Message> held_;
};

}  // namespace demecal
