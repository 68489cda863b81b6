// Messages as bytes come back whole, damaged ones are refused, and their texts are printable.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "protocol/message_bytes.hpp"
#include "random/random_stream.hpp"
#include "random_messages.hpp"

namespace demecal {
namespace {

/// Calls `check(message)` for random messages of every kind.
template <class Check>
void with_every_kind(Check check) {
  RandomMessages random(71);
  for (int i = 0; i < 20; ++i) {
    check(random.data());
    check(random.task());
    check(random.migrants());
    check(random.progress());
    check(random.checkpoint());
    check(random.outcome());
    check(random.status());
    check(random.control());
    check(random.news());
    check(random.cause());
    check(random.figures());
    check(random.placed_progress());
    check(MessagePart{random.number(), 1, 2, random.number(), std::vector<std::uint8_t>(random.number() % 500, 9)});
  }
}

template <class Plain>
bool is_message(const Plain&, std::string_view bytes) {
  return from_bytes<Plain>(bytes).has_value();
}

TEST(MessageBytes, OfEveryMessageComeBackToTheBit) {
  with_every_kind([]<class Plain>(const Plain& message) {
    const std::string bytes = to_bytes(message);
    EXPECT_EQ(from_bytes<Plain>(bytes), message);
    EXPECT_EQ(to_bytes(*from_bytes<Plain>(bytes)), bytes);
  });
}

TEST(MessageBytes, CutOffAnywhereAreNone) {
  with_every_kind([](const auto& message) {
    const std::string bytes = to_bytes(message);
    const std::size_t step = 1 + bytes.size() / 50;
    for (std::size_t size = 0; size < bytes.size(); size += step)
      EXPECT_FALSE(is_message(message, std::string_view(bytes).substr(0, size))) << size << " of " << bytes.size();
    EXPECT_FALSE(is_message(message, std::string_view(bytes).substr(0, bytes.size() - 1)));
    EXPECT_FALSE(is_message(message, bytes + "more"));
  });
}

TEST(MessageBytes, OfFiguresThatAreNotKnownComeBackSo) {
  FinalFigures figures = RandomMessages(5).figures();
  figures.accept_before_m = figures.accept_after_m = std::numeric_limits<double>::quiet_NaN();
  const auto read = from_bytes<FinalFigures>(to_bytes(figures));
  ASSERT_TRUE(read.has_value());
  EXPECT_TRUE(std::isnan(read->accept_before_m) && std::isnan(read->accept_after_m));
  EXPECT_EQ(read->validation_after_m, figures.validation_after_m);
}

TEST(MessageBytes, AreTheSameOnEveryMachine) {
  Progress progress;
  progress.run = 0x0102030405060708;
  EXPECT_EQ(to_bytes(progress).substr(0, 8), "\x08\x07\x06\x05\x04\x03\x02\x01");
}

TEST(MessageBytes, WhoseCountPromisesMoreThanFollowsAreNone) {
  std::string bytes = to_bytes(RandomMessages(73).migrants());
  constexpr std::size_t kCount = 20;  // behind run, joint, deme and epoch
  for (const unsigned char byte : {0x7F, 0xFF}) {
    bytes[kCount + 3] = static_cast<char>(byte);
    EXPECT_FALSE(from_bytes<Migrants>(bytes).has_value());
  }
}

TEST(MessageBytes, WhoseFlagIsNeitherTrueNorFalseAreNone) {
  WorkerStatus status = RandomMessages(79).status();
  status.leaving = true;
  const std::string sound = to_bytes(status);
  status.leaving = false;
  const std::string other = to_bytes(status);
  const std::size_t flag = static_cast<std::size_t>(std::ranges::mismatch(sound, other).in1 - sound.begin());
  for (int value = 0; value < 256; ++value) {
    std::string bytes = sound;
    bytes[flag] = static_cast<char>(value);
    EXPECT_EQ(from_bytes<WorkerStatus>(bytes).has_value(), value <= 1);
  }
}

TEST(MessageBytes, OfARunWorkerOrCalibrationThatIsNoneAreNone) {
  const auto of_run_0 = []<class Plain>(Plain message) {
    message.run = 0;
    return from_bytes<Plain>(to_bytes(message)).has_value();
  };
  RandomMessages random(23);
  EXPECT_FALSE(of_run_0(random.data()) || of_run_0(random.task()) || of_run_0(random.migrants()) ||
               of_run_0(random.progress()) || of_run_0(random.checkpoint()) || of_run_0(random.outcome()) ||
               of_run_0(random.control()));
  EXPECT_FALSE(from_bytes<WorkerStatus>(to_bytes(WorkerStatus{})).has_value());
  EXPECT_FALSE(from_bytes<LoopNews>(to_bytes(LoopNews{})).has_value());
  EXPECT_FALSE(from_bytes<FinalFigures>(to_bytes(FinalFigures{})).has_value());
  CauseFound of_none = random.cause(), without_number = random.cause();
  of_none.calibration = 0;
  without_number.number = 0;
  EXPECT_FALSE(from_bytes<CauseFound>(to_bytes(of_none)).has_value());
  EXPECT_FALSE(from_bytes<CauseFound>(to_bytes(without_number)).has_value());
}

TEST(MessageBytes, WhoseTextIsLongerThanItsBoundAreNone) {
  std::string bytes = to_bytes(Control{1, Control::State::running, std::string(1023, 'n')});
  EXPECT_TRUE(from_bytes<Control>(bytes).has_value());
  constexpr std::size_t kLength = 12;  // behind run and state
  bytes[kLength] = 1;
  bytes[kLength + 1] = 4;
  bytes.insert(kLength + 4, "n");
  EXPECT_FALSE(from_bytes<Control>(bytes).has_value());
}

TEST(MessageBytes, TextThatWouldMoveACursorIsMadePrintable) {
  WorkerStatus status = RandomMessages(3).status();
  status.worker = "a\nb";
  status.host = "\033[2J";
  const auto read = from_bytes<WorkerStatus>(to_bytes(status));
  EXPECT_EQ(read->worker, "a?b");
  EXPECT_EQ(read->host, "?[2J");
}

TEST(Samples, AreMessagesBehindTheNameOfTheirForm) {
  with_every_kind([]<class Plain>(const Plain& message) {
    const std::string sample = to_sample(message);
    EXPECT_EQ(sample, std::string("\0\1\0\0", 4) + to_bytes(message));
    EXPECT_EQ(from_sample<Plain>(sample), message);
    for (std::size_t size = 0; size < 4; ++size) EXPECT_FALSE(from_sample<Plain>(sample.substr(0, size)));
    EXPECT_FALSE(from_sample<Plain>(std::string("\0\2\0\0", 4) + to_bytes(message)));
    EXPECT_FALSE(from_sample<Plain>(std::string("\1\1\0\0", 4) + to_bytes(message)));
  });
}

TEST(Samples, MayEndWithWhatFillsAWord) {
  with_every_kind([]<class Plain>(const Plain& message) {
    EXPECT_TRUE(from_sample<Plain>(to_sample(message) + std::string(3, '\0')));
    EXPECT_FALSE(from_sample<Plain>(to_sample(message) + std::string(4, '\0')));
  });
}

TEST(Samples, OfTheOtherOrderOfBytesAreRead) {
  // cancelled: ten bytes with the zero at its end, and two that align the next count.
  std::string content("\0\0\0\0\0\0\0\0\0\0\0\7\0\0\0\12cancelled\0\0\0\0\0\0\3ok", 34);
  content += '\0';
  EXPECT_EQ(from_sample<Control>(content), (Control{7, Control::State::cancelled, "ok"}));
  const std::string bytes = to_bytes(RandomMessages(83).control());
  EXPECT_FALSE(from_sample<Control>(std::string(4, '\0') + bytes));
}

TEST(Samples, AreNoLargerThanIsBelieved) {
  EXPECT_FALSE(from_sample<Control>(std::string(kMostSample_bytes + 1, '\0')));
}

TEST(Weight, GrowsWithWhatAMessageHolds) {
  RandomMessages random(3);
  Checkpoint checkpoint = random.checkpoint();
  const std::size_t before = weight_bytes(checkpoint);
  checkpoint.state.population.push_back({Tree(100), 1.0});
  EXPECT_GE(weight_bytes(checkpoint), before + 100 * sizeof(Node));
  CalibrationData data = random.data();
  const std::size_t without = weight_bytes(data);
  data.tables.push_back({{std::vector<double>(1000)}, {}, {}});
  EXPECT_GE(weight_bytes(data), without + 8000);
  EXPECT_GE(weight_bytes(Control{1, Control::State::running, std::string(500, 'n')}), 500U);
}

TEST(Printable, LeavesTextAsItIs) {
  for (const char* text : {"", "host-1-22", "Größe 5 µm", "机器人", "🤖 ok"}) {
    EXPECT_EQ(printable(text), text);
    EXPECT_TRUE(is_printable(text));
  }
}

TEST(Printable, ReplacesControlCharactersAndWhatTurnsTheLine) {
  EXPECT_EQ(printable("a\nb\tc\x1b[2J\x7f"), "a?b?c?[2J?");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "?31m");
  EXPECT_EQ(printable("x\xe2\x80\xaey"), "x?y");
  EXPECT_EQ(printable("x\xe2\x80\xa8y"), "x?y");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a?b");
}

TEST(Printable, ReplacesWhatIsNoUtf8) {
  EXPECT_EQ(printable("\xff"), "?");
  EXPECT_EQ(printable("\xc3"), "?");
  EXPECT_EQ(printable("\xc0\xaf"), "??");            // overlong
  EXPECT_EQ(printable("\xed\xa0\x80"), "???");       // a surrogate
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "????");  // beyond the last
}

TEST(Printable, OfAnyBytesIsPrintable) {
  RandomStream random{31};
  for (int i = 0; i < 2000; ++i) {
    std::string bytes(random.index(20), '\0');
    for (char& byte : bytes) byte = static_cast<char>(random.index(256));
    EXPECT_TRUE(is_printable(printable(bytes)));
    EXPECT_LE(printable(bytes).size(), bytes.size());
  }
}

}  // namespace
}  // namespace demecal
