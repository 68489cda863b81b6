// Messages come back whole from their parts, whatever is lost, replaced or invented between.
#include "dds/parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "protocol/message_bytes.hpp"
#include "random/random_stream.hpp"

namespace demecal {
namespace {

using enum MessageAssembler::Verdict;

constexpr std::uint32_t kPlace = 4;

WriterId writer(std::uint8_t number) {
  WriterId id{};
  id[0] = number;
  return id;
}

std::string random_bytes(std::size_t size, RandomStream& random) {
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random.index(256));
  return bytes;
}

/// The messages that came of handing over these parts.
std::vector<std::string> messages_of(MessageAssembler& assembly, const std::vector<MessagePart>& parts,
                                     const WriterId& from = {}) {
  std::vector<std::string> messages;
  for (const MessagePart& part : parts) {
    auto result = assembly.take(from, part);
    EXPECT_TRUE(result.verdict == waits || result.verdict == whole);
    if (result.verdict == whole) messages.push_back(std::move(result.bytes));
  }
  return messages;
}

TEST(Parts, ComeBackAsTheMessageAndFitIntoADatagram) {
  RandomStream random{1};
  MessageAssembler assembly;
  std::uint64_t number = 0;
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, kPart_bytes - 1, kPart_bytes, kPart_bytes + 1,
                                 2 * kPart_bytes, 7 * kPart_bytes + 123}) {
    const std::string message = random_bytes(size, random);
    const auto parts = split_into_parts(message, kPlace, ++number);
    constexpr std::size_t kDatagram_bytes = 65'000;
    for (const MessagePart& part : parts) EXPECT_LT(to_sample(part).size(), kDatagram_bytes);
    EXPECT_EQ(messages_of(assembly, parts), std::vector{message});
  }
}

TEST(Parts, OfAMessageThatWasReplacedOnItsWayAreGivenUpForTheNewer) {
  RandomStream random{2};
  for (int i = 0; i < 50; ++i) {
    MessageAssembler assembly;
    // What a slow reader sees: of each message those parts that were not replaced before it looked, of the last all.
    std::vector<MessagePart> seen;
    std::string last;
    for (std::uint64_t number = 1; number <= 5; ++number) {
      last = random_bytes(kPart_bytes * (2 + random.index(2)) + 10, random);
      std::vector<MessagePart> parts = split_into_parts(last, kPlace, number);
      if (number < 5) parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(random.index(parts.size())));
      seen.insert(seen.end(), parts.begin(), parts.end());
    }
    EXPECT_EQ(messages_of(assembly, seen), std::vector{last});
    EXPECT_TRUE(messages_of(assembly, {split_into_parts(last, kPlace, 1).front()}).empty());
  }
}

TEST(Parts, OfDifferentPlacesAndWritersDoNotMix) {
  RandomStream random{3};
  MessageAssembler assembly;
  const std::string one = random_bytes(2 * kPart_bytes, random), other = random_bytes(2 * kPart_bytes, random);
  const auto of_one = split_into_parts(one, kPlace, 1), of_other = split_into_parts(other, kPlace + 1, 2);
  for (const std::uint8_t from : {1, 2}) EXPECT_EQ(assembly.take(writer(from), of_one[0]).verdict, waits);
  EXPECT_EQ(assembly.take(writer(1), of_other[0]).verdict, waits);
  EXPECT_EQ(assembly.take(writer(1), of_one[1]).bytes, one);
  EXPECT_EQ(assembly.take(writer(1), of_other[1]).bytes, other);
}

TEST(Parts, OfOneWhoIsGoneAreKeptForAWhileSinceTheyAreNotSentAgain) {
  MessageAssembler assembly;
  const MessageAssembler::Time now{};
  const std::string message(2 * kPart_bytes, 'x');
  const auto parts = split_into_parts(message, kPlace, 1);
  for (const std::uint8_t from : {1, 2}) EXPECT_EQ(assembly.take(writer(from), parts[0]).verdict, waits);
  assembly.departed(writer(1), now);
  assembly.departed(writer(2), now + kLongestAbsence / 2);
  EXPECT_EQ(assembly.take(writer(2), parts[1]).bytes, message) << "back in time";
  assembly.departed(writer(3), now + kLongestAbsence);
  EXPECT_EQ(assembly.take(writer(1), parts[1]).verdict, waits) << "too late";
}

TEST(Parts, OfAVacatedPlaceAreForgotten) {
  MessageAssembler assembly;
  const auto parts = split_into_parts(std::string(2 * kPart_bytes, 'x'), kPlace, 1);
  EXPECT_EQ(assembly.take({}, parts[0]).verdict, waits);
  EXPECT_EQ(assembly.take({}, vacant_part(kPlace, 0, 2)).verdict, waits);
  EXPECT_EQ(assembly.take({}, parts[1]).verdict, waits);
  EXPECT_EQ(assembly.take({}, parts[0]).verdict, whole) << "its second part has come after the place was vacated";
}

TEST(Parts, ThatCannotBeAreRefused) {
  MessageAssembler assembly;
  const MessagePart sound = split_into_parts(std::string(2 * kPart_bytes, 'x'), kPlace, 1)[0];
  MessagePart nothing, beyond = sound, countless = sound, small = sound, large = sound, other_count = sound;
  beyond.index = 2;
  countless.count = 0xFFFFFFFF;
  small.bytes.resize(1);
  large.bytes.resize(kPart_bytes + 1);
  other_count.count = 3;
  EXPECT_EQ(assembly.take({}, sound).verdict, waits);
  for (const MessagePart& part : {nothing, beyond, countless, small, large, other_count})
    EXPECT_EQ(assembly.take({}, part).verdict, MessageAssembler::Verdict::malformed);
  EXPECT_EQ(assembly.take({}, sound).verdict, waits) << "doubled";
}

TEST(Parts, OfOneParticipantAreKeptUpToABoundAndOthersGoOn) {
  MessageAssembler assembly(4 * kPart_bytes);
  const std::string message(2 * kPart_bytes, 'x');
  int refused = 0;
  for (std::uint32_t place = 0; place < 100; ++place)
    refused += assembly.take(writer(1), split_into_parts(message, place, 1)[0]).verdict == too_much;
  EXPECT_GT(refused, 90);
  EXPECT_EQ(messages_of(assembly, split_into_parts(message, 0, 2), writer(2)), std::vector{message});
  assembly.departed(writer(1), {});
  assembly.departed(writer(2), MessageAssembler::Time{} + kLongestAbsence);
  EXPECT_EQ(messages_of(assembly, split_into_parts(message, 0, 2), writer(1)), std::vector{message});
}

Checkpoint checkpoint(RunId run, std::uint32_t deme, std::uint32_t epoch) {
  Checkpoint made;
  made.run = run;
  made.island = {0, deme};
  made.state.epoch = epoch;
  return made;
}

Migrants migrants(RunId run, std::uint32_t epoch) {
  return {run, {0, 0}, epoch, {}, "worker"};
}

TEST(Places, AreKeptByWhatReplacesAValueAndSharedByNothingElse) {
  PlaceAllocator places;
  std::set<std::uint32_t> seen;
  for (const RunId run : {5, 9})
    for (std::uint32_t deme = 0; deme < 4; ++deme) {
      const std::uint32_t place = places.place_of(checkpoint(run, deme, 1));
      EXPECT_TRUE(seen.insert(place).second);
      EXPECT_EQ(places.place_of(checkpoint(run, deme, 2)), place);
    }
}

TEST(Places, OfMigrantsAreKeptForAsManyEpochsAsWaitForThoseWhoComeLate) {
  PlaceAllocator places;
  std::set<std::uint32_t> seen;
  for (std::uint32_t epoch = 1; epoch <= kMigrantEpochs; ++epoch) seen.insert(places.place_of(migrants(1, epoch)));
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(kMigrantEpochs));
  for (std::uint32_t epoch = 1; epoch <= kMigrantEpochs; ++epoch)
    EXPECT_EQ(places.place_of(migrants(1, epoch + kMigrantEpochs)), places.place_of(migrants(1, epoch)));
}

TEST(Places, AreNoMoreThanThereAreValuesAtOnceHoweverManyRunsThereWere) {
  PlaceAllocator places;
  std::uint32_t largest = 0;
  for (RunId run = 1; run <= 50; ++run) {
    std::set<std::uint32_t> taken;
    for (std::uint32_t deme = 0; deme < 6; ++deme) taken.insert(places.place_of(checkpoint(run, deme, 1)));
    largest = std::max(largest, *taken.rbegin());
    const auto vacated = places.vacate(run - 1);
    EXPECT_EQ(vacated.size(), run == 1 ? 0u : 6u);
    for (const std::uint32_t place : vacated) EXPECT_FALSE(taken.contains(place));
  }
  EXPECT_EQ(largest, 11u);
}

}  // namespace
}  // namespace demecal
