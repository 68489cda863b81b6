// Tables as comma-separated text: what is accepted, what is refused and with which sentence.
#include "data/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "small_arm.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;

TEST(Csv, KeepsLinesOverCommentsBlanksAndCarriageReturns) {
  const CsvTable table = table_of("\xEF\xBB\xBF# a comment\r\n\r\na, b\r\n 1 ,\t2\r\n\r\n# more\r\n3,4");
  EXPECT_EQ(table.header_line, 3u);
  EXPECT_THAT(table.columns, ElementsAre("a", "b"));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0].line, 4u);
  EXPECT_THAT(table.rows[0].fields, ElementsAre("1", "2"));
  EXPECT_EQ(table.rows[1].line, 7u);
  EXPECT_THAT(table.rows[1].fields, ElementsAre("3", "4"));
}

TEST(Csv, TakesQuotesOff) {
  const CsvTable table = table_of("a,\"b\",c\n \"x,y\" , \"say \"\"no\"\"\",\n");
  EXPECT_THAT(table.columns, ElementsAre("a", "b", "c"));
  EXPECT_THAT(table.rows[0].fields, ElementsAre("x,y", "say \"no\"", ""));
}

TEST(Csv, FindsColumnsByName) {
  const CsvTable table = table_of("a,b\n1,2\n");
  EXPECT_EQ(table.find("b"), 1u);
  EXPECT_EQ(table.find("c"), std::nullopt);
}

TEST(Csv, RefusesFaultyTablesWithFileLineValueAndRule) {
  struct Case {
    const char* text;
    const char* sentence;
  };
  for (const auto& [text, sentence] : {
           Case{"", "poses.csv: is empty; a header row and rows of values are expected"},
           Case{"# nothing\n\n", "poses.csv: is empty; a header row and rows of values are expected"},
           Case{"a,b\n", "poses.csv:1: has a header but no rows"},
           Case{"a,b\n1,2\n3\n", "poses.csv:3: the row has 1 fields, but the header has 2 columns"},
           Case{"a,b\n1,2,\n", "poses.csv:2: the row has 3 fields, but the header has 2 columns"},
           Case{"a,b,a\n1,2,3\n", "poses.csv:1: 'a': is the name of two columns; names must differ"},
           Case{"a,,b\n1,2,3\n", "poses.csv:1: column 2 of the header has no name"},
           Case{"a;b\n1;2\n",
                "poses.csv:1: 'a;b': columns must be separated by commas; other separators are recognised where "
                "most fields are plain numbers, with their units (deg, mm) in the headings alone"},
           Case{"a,b\n1,\"2\n", "poses.csv:2: '\"2': opens a quote that its line does not close"},
           Case{"a,b\n\"1\"2,3\n", "poses.csv:2: '\"1\"2,3': has text after a closing quote"},
           Case{"a,b\r1,2\r", "poses.csv:1: lines must end in LF or CR LF, not in CR"},
       }) {
    EXPECT_EQ(complaint([&] { table_of(text); }), sentence);
  }
}

TEST(Csv, RoundTripsWhateverTheFieldsHold) {
  std::mt19937_64 bits(11);
  const std::string letters = "ab, \"#\t;1";
  for (int trial = 0; trial < 200; ++trial) {
    CsvTable table{.file = "poses.csv", .header_line = 1, .columns = {"#a", "b,\"c\"", " d "}, .rows = {}};
    for (std::size_t row = 0; row < 5; ++row) {
      table.rows.push_back({row + 2, {"", "", ""}});
      for (std::string& field : table.rows.back().fields) {
        for (std::uint64_t i = bits() % 5; i > 0; --i) field += letters[bits() % letters.size()];
      }
    }
    const CsvTable back = table_of(csv_text(table));
    EXPECT_EQ(back.columns, table.columns);
    ASSERT_EQ(back.rows.size(), table.rows.size());
    for (std::size_t row = 0; row < 5; ++row) {
      EXPECT_EQ(back.rows[row].fields, table.rows[row].fields);
      EXPECT_EQ(back.rows[row].line, table.rows[row].line);
    }
  }
}

}  // namespace
}  // namespace demecal
