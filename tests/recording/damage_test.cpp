// Recordings that were damaged or cut off: what is whole is shown, and what is not is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "errors/input_error.hpp"
#include "made_up_run.hpp"
#include "random/random_stream.hpp"
#include "recording/event_recording.hpp"
#include "recording/mcap.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kSpacing_s = 0.25;

/// A recording of a made-up run, an event each quarter of a second, and the places of its chunks.
struct DamagedCase {
  std::string bytes;
  std::vector<std::string> lines;
  std::vector<std::pair<std::size_t, std::size_t>> chunks;  ///< with their indexes: begin and end
};

DamagedCase damaged_case() {
  DamagedCase made;
  EventRecording recording(1'700'000'000'000'000'000);
  for (const Message& message : made_up_messages(made_up_data())) {
    const double now_s = kSpacing_s * static_cast<double>(made.lines.size());
    recording.take(message, now_s);
    made.lines.push_back(event_line(message, now_s));
    const std::string due = recording.due_bytes(now_s);
    // The first bytes are the file's head alone.
    if (!made.bytes.empty() && !due.empty())
      made.chunks.emplace_back(made.bytes.size(), made.bytes.size() + due.size());
    made.bytes += due;
  }
  made.bytes += recording.finish();
  return made;
}

std::vector<std::string> whole_lines(const std::string& bytes) {
  std::vector<std::string> lines;
  for (const Event& event : read_recording(bytes, "run.mcap").events)
    lines.push_back(event_line(event.message, event.time_s));
  return lines;
}

/// Whether `part` is `all` without some lines that stand together.
bool lacks_one_stretch(const std::vector<std::string>& part, const std::vector<std::string>& all) {
  if (part.size() > all.size()) return false;
  const auto front = std::ranges::mismatch(part, all).in1 - part.begin();
  return std::equal(part.begin() + front, part.end(), all.end() - (part.end() - part.begin() - front));
}

TEST(DamagedRecording, LacksTheEventsOfTheDamagedChunkAlone) {
  const DamagedCase made = damaged_case();
  ASSERT_GE(made.chunks.size(), 3u);
  for (const auto& [begin, end] : made.chunks) {
    std::string bytes = made.bytes;
    bytes[bytes.find("\"t_s\":", begin) + 2] ^= 1;
    const RecordedEvents read = read_recording(bytes, "run.mcap");
    const auto kept = whole_lines(bytes);
    EXPECT_LT(kept.size(), made.lines.size());
    EXPECT_TRUE(lacks_one_stretch(kept, made.lines));
    EXPECT_GE(kept.size() + 5, made.lines.size());  // a chunk lasts for a second, and is ended by an event
    ASSERT_THAT(read.losses, SizeIs(2));
    EXPECT_THAT(read.losses[0], HasSubstr("bytes " + std::to_string(begin) + " to " + std::to_string(end)));
    EXPECT_EQ(read.losses[1], std::to_string(made.lines.size() - kept.size()) + " of " +
                                  std::to_string(made.lines.size()) + " events are missing");
  }
}

TEST(DamagedRecording, SaysHowMuchTimeIsMissing) {
  DamagedCase made = damaged_case();
  const auto [begin, end] = made.chunks[1];
  made.bytes[(begin + end) / 2] ^= 1;
  const RecordedEvents read = read_recording(made.bytes, "run.mcap");
  const auto gap = std::ranges::adjacent_find(
      read.events, [](const Event& a, const Event& b) { return b.time_s > a.time_s + 1.5 * kSpacing_s; });
  ASSERT_NE(gap, read.events.end());
  char said[64];
  std::snprintf(said, sizeof said, "%.1f s, from %.1f s to %.1f s", gap[1].time_s - gap[0].time_s, gap[0].time_s,
                gap[1].time_s);
  EXPECT_THAT(read.losses[0], HasSubstr(said));
}

TEST(DamagedRecording, IsNamedWhicheverByteChanges) {
  const DamagedCase made = damaged_case();
  RandomStream random{2026, 11, 28};
  for (std::size_t place = 8; place < made.bytes.size(); place += 1 + random.index(60)) {
    std::string bytes = made.bytes;
    bytes[place] = static_cast<char>(bytes[place] ^ (1 + static_cast<int>(random.index(255))));
    const RecordedEvents read = read_recording(bytes, "run.mcap");
    EXPECT_THAT(read.losses, testing::Not(IsEmpty())) << place;
    const auto kept = whole_lines(bytes);
    EXPECT_TRUE(lacks_one_stretch(kept, made.lines)) << place;
    EXPECT_GE(kept.size() + 5, made.lines.size()) << place;
    const auto chunk =
        std::ranges::find_if(made.chunks, [&](const auto& one) { return one.first <= place && place < one.second; });
    if (chunk == made.chunks.end() && place < made.bytes.size() - 8 && place > made.chunks.back().second) {
      // The rest of the last chunk, or the summary: nothing before it is missing.
      EXPECT_TRUE(std::equal(kept.begin(), kept.end(), made.lines.begin())) << place;
    }
  }
}

TEST(DamagedRecording, OfADamagedSummaryLacksNothing) {
  const DamagedCase made = damaged_case();
  const std::size_t schemas = made.bytes.rfind("demecal.worker");  // the summary repeats them
  ASSERT_GT(schemas, made.chunks.back().second);
  for (const std::size_t place : {schemas, made.bytes.size() - 1, made.bytes.size() - 10, made.bytes.size() - 30}) {
    std::string bytes = made.bytes;
    bytes[place] ^= 4;
    const RecordedEvents read = read_recording(bytes, "run.mcap");
    EXPECT_EQ(whole_lines(bytes), made.lines) << place;
    ASSERT_THAT(read.losses, SizeIs(1));
    EXPECT_THAT(read.losses[0], HasSubstr("all that was seen is there"));
  }
}

TEST(DamagedRecording, FindsTheChannelsOfADamagedFirstChunkInTheSummaryOrTheEventsWords) {
  DamagedCase made = damaged_case();
  const auto [begin, end] = made.chunks[0];
  made.bytes[(begin + end) / 2] ^= 1;
  const auto kept = whole_lines(made.bytes);
  EXPECT_GT(kept.size(), made.lines.size() / 2);
  EXPECT_TRUE(std::equal(kept.rbegin(), kept.rend(), made.lines.rbegin()));
  const std::string without_summary = made.bytes.substr(0, made.chunks.back().second);
  const auto cut = whole_lines(without_summary);
  EXPECT_FALSE(cut.empty());
  EXPECT_TRUE(std::equal(cut.begin(), cut.end(), kept.begin()));
}

TEST(DamagedRecording, CutOffAnywhereSaysSo) {
  const DamagedCase made = damaged_case();
  std::size_t before = 0;
  for (std::size_t size = 8; size < made.bytes.size(); size += 61) {
    const RecordedEvents read = read_recording(made.bytes.substr(0, size), "run.mcap");
    ASSERT_THAT(read.losses, SizeIs(1)) << size;
    EXPECT_THAT(read.losses[0],
                testing::AnyOf(HasSubstr("what was seen after "), HasSubstr("all that was seen is there")));
    EXPECT_GE(read.events.size(), before);
    before = read.events.size();
  }
  EXPECT_EQ(before, made.lines.size());
}

/// As file systems leave them after a power failure: the length is there, the last blocks are not.
TEST(DamagedRecording, EndingInZerosKeepsWhatStandsBefore) {
  const DamagedCase made = damaged_case();
  for (std::size_t size = made.chunks[0].second; size < made.bytes.size(); size += 509) {
    std::string bytes = made.bytes.substr(0, size);
    const auto whole = whole_lines(bytes);
    bytes.resize(size + 4096, '\0');
    EXPECT_EQ(whole_lines(bytes), whole) << size;
    EXPECT_THAT(read_recording(bytes, "run.mcap").losses, testing::Not(IsEmpty()));
  }
}

TEST(DamagedRecording, OfWhichNothingIsWholeIsRefused) {
  DamagedCase made = damaged_case();
  for (std::size_t place = 8; place < made.bytes.size(); place += 20) made.bytes[place] ^= 1;
  EXPECT_THROW(read_recording(made.bytes, "run.mcap"), InputError);
}

}  // namespace
}  // namespace demecal
