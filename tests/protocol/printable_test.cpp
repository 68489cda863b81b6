// Text from elsewhere cannot move a cursor.
#include "protocol/printable.hpp"

#include <gtest/gtest.h>

#include "random/random_stream.hpp"

namespace demecal {
namespace {

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
