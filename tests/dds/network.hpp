// What transport tests run over: a network that participants join, in memory or DDS on this machine alone.
#pragma once

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "dds/dds_transport.hpp"
#include "transport/transport.hpp"

namespace demecal {

/// Longer than anything takes on a busy machine: tests wait for messages, and fail after this.
inline constexpr std::chrono::seconds kDeadline{30};

/// A DDS domain of this test process alone: the first from its process id on in which the port of a first participant
/// is free. DDS gives a domain's ports to whoever asks, so a domain that others are in shows by that port being taken.
inline std::uint32_t free_domain() {
  // Their ports lie above those that Linux gives away (to 60999), and people rarely choose domains this high.
  constexpr std::uint32_t kFirstDomain = 215, kDomains = 17;
  for (std::uint32_t i = 0; i < kDomains; ++i) {
    const std::uint32_t domain = kFirstDomain + (static_cast<std::uint32_t>(getpid()) + i) % kDomains;
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_ANY);
    address.sin_port = htons(static_cast<std::uint16_t>(7410 + 250 * domain));
    const int socket_of_domain = socket(AF_INET, SOCK_DGRAM, 0);
    const bool is_free = bind(socket_of_domain, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    close(socket_of_domain);
    if (is_free) return domain;
  }
  ADD_FAILURE() << "no DDS domain is free";
  return 0;
}

/// On this machine alone, in one domain for all of this test process.
inline DdsOptions local_options() {
  static const std::uint32_t domain = free_domain();
  DdsOptions options;
  options.domain = domain;
  return options;
}

class Network {
 public:
  virtual ~Network() = default;
  virtual std::unique_ptr<Transport> join(Role role, const std::string& name) = 0;
};

class InMemoryNetwork final : public Network {
 public:
  std::unique_ptr<Transport> join(Role role, const std::string& name) override {
    return demecal::join(exchange_, role, name);
  }

 private:
  std::shared_ptr<Exchange> exchange_ = make_exchange();
};

class DdsNetwork final : public Network {
 public:
  explicit DdsNetwork(DdsOptions options = local_options()) : options_(std::move(options)) {}
  std::unique_ptr<Transport> join(Role role, const std::string& name) override {
    return join_dds(options_, role, name);
  }

 private:
  DdsOptions options_;
};

/// Receives until `enough(messages so far)`; fails the test where that does not come about.
template <class Enough>
std::vector<Message> receive_until(Transport& transport, Enough enough) {
  const auto deadline = std::chrono::steady_clock::now() + kDeadline;
  std::vector<Message> messages;
  while (!enough(messages) && std::chrono::steady_clock::now() < deadline)
    if (auto message = transport.receive(std::chrono::seconds{1})) messages.push_back(std::move(*message));
  EXPECT_TRUE(enough(messages)) << "after " << messages.size() << " messages";
  return messages;
}

/// Receives up to and with the first message equal to `awaited`.
inline std::vector<Message> receive_up_to(Transport& transport, const Message& awaited) {
  return receive_until(transport,
                       [&](const auto& messages) { return !messages.empty() && messages.back() == awaited; });
}

/// Receives until all of `expected` have come, in whatever order; nothing else may have come by then.
inline void expect_exactly(Transport& transport, const std::vector<Message>& expected) {
  const auto messages = receive_until(transport, [&](const std::vector<Message>& arrived) {
    return arrived.size() >= expected.size() && std::all_of(expected.begin(), expected.end(), [&](const Message& one) {
             return std::find(arrived.begin(), arrived.end(), one) != arrived.end();
           });
  });
  EXPECT_EQ(messages.size(), expected.size());
}

/// Those of one kind, in order of arrival.
template <class Plain>
std::vector<Plain> only(const std::vector<Message>& messages) {
  std::vector<Plain> chosen;
  for (const Message& message : messages)
    if (const auto* plain = std::get_if<Plain>(&message)) chosen.push_back(*plain);
  return chosen;
}

inline WorkerStatus status_of(const std::string& worker, bool leaving = false) {
  WorkerStatus status;
  status.worker = worker;
  status.leaving = leaving;
  return status;
}

}  // namespace demecal
