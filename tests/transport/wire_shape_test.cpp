// Bytes are compared with a message's shape before anything is read from them.
#include "transport/wire_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "random_messages.hpp"
#include "transport/message_bytes.hpp"
#include "transport/wire_form.hpp"

namespace demecal {
namespace {

/// Calls `check(bytes, has shape)` for random messages of every kind.
template <class Check>
void with_every_kind(Check check) {
  RandomMessages random(71);
  const auto one = [&](const auto& message) {
    using Wire = decltype(encode(message));
    check(to_bytes(message), [](std::string_view bytes) { return has_shape<Wire>(bytes, Endian::little); });
  };
  for (int i = 0; i < 20; ++i) {
    one(random.data());
    one(random.task());
    one(random.migrants());
    one(random.progress());
    one(random.checkpoint());
    one(random.outcome());
    one(random.status());
    one(random.control());
    one(random.news());
  }
}

TEST(WireShape, EveryMessageHasItsOwn) {
  with_every_kind([](const std::string& bytes, auto has) { EXPECT_TRUE(has(bytes)); });
}

TEST(WireShape, NothingShorterHasIt) {
  with_every_kind([](const std::string& bytes, auto has) {
    const std::size_t step = 1 + bytes.size() / 50;
    for (std::size_t size = 0; size < bytes.size(); size += step)
      EXPECT_FALSE(has(std::string_view(bytes).substr(0, size))) << size << " of " << bytes.size();
    EXPECT_FALSE(has(std::string_view(bytes).substr(0, bytes.size() - 1)));
  });
}

TEST(WireShape, OnlyWhatFillsAWordMayFollow) {
  with_every_kind([](const std::string& bytes, auto has) {
    EXPECT_TRUE(has(bytes + std::string(3, '\0')));
    EXPECT_FALSE(has(bytes + std::string(4, '\0')));
  });
}

TEST(WireShape, ACountThatPromisesMoreThanFollowsIsRefused) {
  Migrants migrants = RandomMessages(73).migrants();
  std::string bytes = to_bytes(migrants);
  constexpr std::size_t kCount = 20;  // behind run, joint, deme and epoch
  for (const unsigned char byte : {0x7F, 0xFF}) {
    bytes[kCount + 3] = static_cast<char>(byte);
    EXPECT_FALSE(has_shape<wire::Migrants>(bytes, Endian::little));
    EXPECT_FALSE(message_of<Migrants>(bytes).has_value());
  }
}

TEST(WireShape, AFlagIsTrueOrFalse) {
  WorkerStatus status = RandomMessages(79).status();
  status.leaving = true;
  const std::string sound = to_bytes(status);
  status.leaving = false;
  const std::string other = to_bytes(status);
  const std::size_t flag = static_cast<std::size_t>(std::ranges::mismatch(sound, other).in1 - sound.begin());
  for (int value = 0; value < 256; ++value) {
    std::string bytes = sound;
    bytes[flag] = static_cast<char>(value);
    EXPECT_EQ(has_shape<wire::WorkerStatus>(bytes, Endian::little), value <= 1);
  }
}

TEST(WireShape, TheOtherOrderOfBytesIsAnother) {
  const std::string bytes = to_bytes(RandomMessages(83).control());
  EXPECT_FALSE(has_shape<wire::Control>(bytes, Endian::big));
}

TEST(WireShape, ASampleIsNoLargerThanIsBelieved) {
  EXPECT_FALSE(has_shape<wire::Control>(std::string(kMostSample_bytes + 1, '\0'), Endian::little));
}

}  // namespace
}  // namespace demecal
