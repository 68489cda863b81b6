// Recordings: what was seen, back from the file to the bit; bounds, checksums and files that were not written to their
// end.
#include "recording/event_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "errors/input_error.hpp"
#include "made_up_run.hpp"
#include "recording/mcap.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::json;

constexpr std::uint64_t kBegin_ns = 1'700'000'000'000'000'000;

std::vector<Message> all_events() {
  std::vector<Message> messages = made_up_messages(made_up_data());
  messages.emplace_back(Control{kRun, Control::State::cancelled, "note"});
  for (Message& found : made_up_findings()) messages.push_back(std::move(found));
  messages.emplace_back(CalibrationLost{kCalibration});
  return messages;
}

std::string recorded(const std::vector<Message>& messages) {
  EventRecording recording(kBegin_ns);
  std::string bytes;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    const double now_s = 0.3 * static_cast<double>(i);
    recording.take(messages[i], now_s);
    bytes += recording.due_bytes(now_s);
  }
  return bytes + recording.finish();
}

std::vector<std::string> lines_of_events(const std::vector<Event>& events) {
  std::vector<std::string> lines;
  for (const Event& event : events) lines.push_back(event_line(event.message, event.time_s));
  return lines;
}

std::vector<std::string> lines_of_all() {
  std::vector<std::string> lines;
  for (const Message& message : all_events())
    lines.push_back(event_line(message, 0.3 * static_cast<double>(lines.size())));
  return lines;
}

TEST(Crc32, HasTheCheckValueOfItsStandardAndGoesOn) {
  EXPECT_EQ(crc32("123456789"), 0xCBF43926U);
  EXPECT_EQ(crc32("456789", crc32("123")), 0xCBF43926U);
  EXPECT_EQ(crc32(""), 0U);
}

TEST(EventRecording, GivesBackWhatWasSeen) {
  const RecordedEvents read = read_recording(recorded(all_events()), "run.mcap");
  EXPECT_EQ(lines_of_events(read.events), lines_of_all());
  EXPECT_THAT(read.losses, IsEmpty());
}

TEST(EventRecording, HasAChannelForEveryIslandAndTimesOfTheDay) {
  std::set<std::string> islands;
  for (const McapMessage& message : read_mcap(recorded(all_events()), "run.mcap").messages) {
    if (message.topic.starts_with("/demecal/progress/")) islands.insert(message.topic);
    const Json json = Json::parse(message.data);
    EXPECT_EQ(message.time_ns, kBegin_ns + static_cast<std::uint64_t>(std::llround(1e9 * json["t_s"].get<double>())));
    for (const auto& [key, value] : json.items()) EXPECT_FALSE(value.is_null()) << key;
  }
  EXPECT_EQ(islands.size(), 12u);
  EXPECT_TRUE(islands.contains("/demecal/progress/joint_6/island_2"));
}

TEST(EventSchemas, DescribeEveryMemberWithItsType) {
  std::map<std::string, Json> schemas;
  for (const EventSchema& schema : event_schemas()) schemas[schema.word] = Json::parse(schema.json);
  for (const Message& message : all_events()) {
    const Json event = Json::parse(event_line(message, 1.0));
    const Json& members = schemas.at(event["event"])["properties"];
    EXPECT_EQ(members.size(), event.size()) << event;
    for (const auto& [key, value] : event.items()) {
      ASSERT_TRUE(members.contains(key)) << key;
      const std::string type = members[key]["type"];
      if (value.is_null()) continue;
      EXPECT_TRUE((type == "string" && value.is_string()) || (type == "boolean" && value.is_boolean()) ||
                  (type == "integer" && value.is_number_integer()) || (type == "number" && value.is_number()) ||
                  (type == "array" && value.is_array()))
          << key << " " << type << " " << value;
    }
  }
}

TEST(EventRecording, KeepsWhatIsWholeOfAFileThatWasCutOffAnywhere) {
  const std::string whole = recorded(all_events());
  const std::vector<std::string> all = lines_of_all();
  std::size_t before = 0;
  for (std::size_t size = 8; size <= whole.size(); size += 97) {
    const std::vector<std::string> kept = lines_of_events(read_recording(whole.substr(0, size), "run.mcap").events);
    ASSERT_LE(kept.size(), all.size());
    EXPECT_GE(kept.size(), before);
    before = kept.size();
    EXPECT_TRUE(std::equal(kept.begin(), kept.end(), all.begin()));
  }
  EXPECT_EQ(before, all.size());
}

TEST(EventRecording, SurvivesAnyBytes) {
  RandomStream random{77};
  const std::string whole = recorded(all_events());
  for (int i = 0; i < 400; ++i) {
    std::string bytes = whole;
    for (int change = 0; change < 3; ++change) bytes[random.index(bytes.size())] = static_cast<char>(random.index(256));
    try {
      read_recording(bytes, "run.mcap");
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("run.mcap"));
    }
  }
  EXPECT_THROW(read_recording("{\"event\":\"begin\"}\n", "events.jsonl"), InputError);
  EXPECT_THROW(read_recording("", "empty"), InputError);
}

}  // namespace
}  // namespace demecal
