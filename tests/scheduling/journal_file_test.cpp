// A journal gives back what was written to it, and of a damaged one what stands before the damage.
#include "scheduling/journal_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "random/random_stream.hpp"

namespace demecal {
namespace {

std::vector<std::string> random_contents(RandomStream& random, std::size_t count) {
  std::vector<std::string> contents(count);
  for (std::string& content : contents) {
    content.resize(random.index(200));
    for (char& byte : content) byte = static_cast<char>(random.index(256));
  }
  return contents;
}

std::string journal_of(const std::vector<std::string>& contents) {
  std::string journal(kJournalHead);
  for (const std::string& content : contents) journal += record_of(content);
  return journal;
}

/// Whether the records are the first ones of `contents`.
bool begins(const std::vector<std::string>& contents, const JournalRecords& records) {
  return records.contents.size() <= contents.size() &&
         std::equal(records.contents.begin(), records.contents.end(), contents.begin());
}

TEST(Checksum, IsTheStandardsOne) {
  EXPECT_EQ(crc32c("123456789"), 0xE3069283U);
  EXPECT_EQ(crc32c(std::string(32, '\0')), 0x8A9136AAU);
  EXPECT_EQ(crc32c(""), 0U);
}

TEST(Records, AreReadAsTheyWereWritten) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random{seed};
    const auto contents = random_contents(random, random.index(12));
    const std::string journal = journal_of(contents);
    const JournalRecords records = read_records(journal);
    EXPECT_EQ(records.end, JournalEnd::clean);
    EXPECT_EQ(records.contents.size(), contents.size());
    EXPECT_TRUE(begins(contents, records));
    EXPECT_EQ(records.sound_bytes, journal.size());
  }
}

TEST(Records, OfAJournalCutOffAnywhereAreTheWholeOnes) {
  RandomStream random{3};
  const auto contents = random_contents(random, 6);
  const std::string journal = journal_of(contents);
  std::size_t most = 0;
  for (std::size_t size = 0; size < journal.size(); ++size) {
    const JournalRecords records = read_records(std::string_view(journal).substr(0, size));
    ASSERT_TRUE(begins(contents, records)) << size;
    ASSERT_LE(records.sound_bytes, size);
    ASSERT_EQ(records.end == JournalEnd::clean, size > 0 && records.sound_bytes == size) << size;
    ASSERT_NE(records.end, JournalEnd::corrupt) << size;
    ASSERT_GE(records.contents.size(), most);
    most = records.contents.size();
  }
  EXPECT_EQ(most, contents.size() - 1);
}

TEST(Records, AfterAChangedByteAreNotBelieved) {
  RandomStream random{4};
  const auto contents = random_contents(random, 6);
  const std::string sound = journal_of(contents);
  for (std::size_t place = 0; place < sound.size(); ++place) {
    std::string journal = sound;
    journal[place] = static_cast<char>(journal[place] ^ (1 << random.index(8)));
    const JournalRecords records = read_records(journal);
    ASSERT_NE(records.end, JournalEnd::clean) << place;
    ASSERT_TRUE(begins(contents, records)) << place;
    ASSERT_LE(records.sound_bytes, place);
  }
}

TEST(Records, OfAnotherFileAreNone) {
  const JournalRecords records = read_records("demecal_model: 1\nrobot: {}\n");
  EXPECT_EQ(records.end, JournalEnd::corrupt);
  EXPECT_EQ(records.sound_bytes, 0U);
  EXPECT_TRUE(records.contents.empty());
}

TEST(Numbers, AreTheSameFromTheirBytes) {
  for (const std::uint32_t number : {0U, 1U, 0x80U, 0x12345678U, 0xFFFFFFFFU}) {
    EXPECT_EQ(number_of(bytes_of(number)), number);
  }
  EXPECT_EQ(bytes_of(0x01020304), std::string("\x04\x03\x02\x01"));
}

}  // namespace
}  // namespace demecal
