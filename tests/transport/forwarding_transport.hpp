// A participant's end of a network that passes everything on: those in tests change what they are about.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "transport/transport.hpp"

namespace demecal {

class ForwardingTransport : public Transport {
 public:
  explicit ForwardingTransport(std::unique_ptr<Transport> sound) : sound_(std::move(sound)) {}

  void publish(const Message& message) override { sound_->publish(message); }
  std::optional<Message> receive(std::chrono::milliseconds patience) override { return sound_->receive(patience); }
  void wake() override { sound_->wake(); }
  void follow_migrants(std::uint32_t joint) override { sound_->follow_migrants(joint); }
  void offer_migrants(std::uint32_t joint) override { sound_->offer_migrants(joint); }
  void assert_alive() override { sound_->assert_alive(); }
  bool flush(std::chrono::milliseconds patience) override { return sound_->flush(patience); }
  RunId new_run() override { return sound_->new_run(); }
  void reject(const std::string& source, const std::string& why) override { sound_->reject(source, why); }
  std::uint64_t rejected() const override { return sound_->rejected(); }

 private:
  std::unique_ptr<Transport> sound_;
};

}  // namespace demecal
