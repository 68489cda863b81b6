// A participant that means harm: it floods every topic of a domain with bytes that are no samples and with samples that
// are not its own to send, until it is killed. One argument: the domain.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "dds/parts.hpp"
#include "forger.hpp"
#include "protocol/message_bytes.hpp"
#include "raw_writers.hpp"

namespace {

using namespace demecal;

/// Other instances are not invented beyond this, lest this program fill its own memory.
constexpr std::uint32_t kKeys = 2000;
constexpr std::uint32_t kJoints = 6;
constexpr int kAtOnce = 40;

std::string little_endian(const std::string& content) {
  return std::string("\0\1\0\0", 4) + content;
}

/// The message as a sample, or the first of its parts, whichever travels.
std::string bytes_of(const Message& message, std::uint32_t place) {
  return std::visit(
      [&](const auto& plain) {
        using Plain = std::decay_t<decltype(plain)>;
        if constexpr (std::is_same_v<Plain, Progress>) {
          return to_sample(PlacedProgress{"intruder", place, false, plain});
        } else if constexpr (kTravels<Plain>) {
          if (!is_large(topic_of(message))) return to_sample(plain);
          static std::uint64_t number = 0;
          return to_sample(split_into_parts(to_bytes(plain), place, ++number).front());
        }
        return std::string();
      },
      message);
}

std::string garbage(RandomStream& random) {
  std::string bytes(random.index(300), '\0');
  for (char& byte : bytes) byte = static_cast<char>(random.index(256));
  return random.chance(0.5) ? little_endian(bytes) : bytes;
}

/// Flags that are neither true nor false, counts beyond any memory, ends amid a number.
std::string spoilt(RandomStream& random, std::string bytes) {
  for (std::size_t changes = random.index(5); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = random.index(bytes.size());
    if (random.chance(0.2)) bytes.resize(at);
    if (at < bytes.size()) bytes[at] = static_cast<char>(random.chance(0.5) ? 0xFF : random.index(256));
  }
  return bytes;
}

}  // namespace

int main(int, char** arguments) {
  DdsOptions options;
  options.domain = static_cast<std::uint32_t>(std::atoi(arguments[1]));
  RawWriters writers(options, "intruder");
  const auto listener = join_dds(options, Role::worker, "a listener that says nothing");
  Forger forger(1);
  RandomStream random{2};
  std::puts("flooding");
  std::fflush(stdout);
  while (true) {
    while (const auto message = listener->receive(std::chrono::milliseconds{0})) forger.hear(*message);
    for (int i = 0; i < kAtOnce; ++i) {
      const Message forged = forger.forge();
      const auto key = static_cast<std::uint32_t>(random.index(kKeys));
      const Topic topic = random.chance(0.3) ? kTopics[random.index(kTopics.size())] : topic_of(forged);
      const auto joint = static_cast<std::uint32_t>(random.index(kJoints));
      const auto* migrants = std::get_if<Migrants>(&forged);
      const std::string bytes = bytes_of(forged, key);
      writers.write(topic, migrants != nullptr ? migrants->island.joint : joint,
                    random.chance(0.2)   ? garbage(random)
                    : random.chance(0.3) ? spoilt(random, bytes)
                                         : bytes,
                    key);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds{5});
  }
}
