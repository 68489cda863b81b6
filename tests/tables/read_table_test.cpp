// Tables as other programs write them: whatever their habits, the same rows come back; and what is said of them.
#include "tables/read_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../errors/complaint.hpp"
#include "data/columns.hpp"
#include "kinematics/units.hpp"
#include "written_table.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

void expect_same(const CsvTable& read, const RandomTable& truth, const Habit& habit) {
  ASSERT_EQ(read.rows.size(), truth.names.size());
  for (std::size_t column = 0; column < truth.numbers[0].size(); ++column) {
    ColumnName name{habit.headings ? column_name(column) : "", {"set.yaml", 1}};
    if (!habit.headings) name.number = column + 2;
    const TableColumn found(read, name);
    for (std::size_t row = 0; row < read.rows.size(); ++row) {
      EXPECT_EQ(found.number(read.rows[row]), truth.numbers[row][column]);
      EXPECT_EQ(read.rows[row].fields[0], truth.names[row]);
    }
  }
}

std::vector<Habit> all_habits() {
  std::vector<Habit> habits;
  for (const Delimiter delimiter : {Delimiter::comma, Delimiter::semicolon, Delimiter::tab, Delimiter::blanks}) {
    for (unsigned bits = 0; bits < 128; ++bits) {
      Habit habit{.delimiter = delimiter,
                  .decimal = (bits & 1) != 0 ? ',' : '.',
                  .preamble = (bits & 2) != 0 ? 3 : 0,
                  .headings = (bits & 4) != 0,
                  .units = (bits & 8) != 0,
                  .quotes = (bits & 16) != 0,
                  .returns = (bits & 32) != 0,
                  .comments = (bits & 64) != 0};
      const bool clashes = delimiter == Delimiter::comma && habit.decimal == ',' && !habit.quotes;
      if (!clashes) habits.push_back(habit);
    }
  }
  return habits;
}

TEST(ReadTable, GivesTheSameNumbersWhateverTheHabitsOfTheWriter) {
  RandomStream random{71};
  for (const Habit& habit : all_habits()) {
    const RandomTable truth = random_table(random, 7, 4);
    const std::string text = written(truth, habit);
    SCOPED_TRACE(text);
    const RecognisedTable read = read_table(text, "points.txt");
    expect_same(read.table, truth, habit);
    if (habit.headings && habit.units) {
      EXPECT_THAT(read.table.units, ElementsAre("", "mm", "mm", "mm", "mm"));
    }
    if (habit.decimal == ',') {
      EXPECT_THAT(read.found, HasSubstr("decimal commas"));
    }
    if (habit.preamble > 0) {
      EXPECT_THAT(read.found, HasSubstr("3 lines before them left out"));
    }
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(ReadTable, SaysNothingOfPlainCsv) {
  EXPECT_EQ(read_table("a,b\n1.5,2\n", "p.csv").found, "");
  EXPECT_EQ(read_table("\xEF\xBB\xBF# remark\na,b\r\n1.5,2\r\n", "p.csv").found, "");
}

TEST(ReadTable, SaysInOneLineHowATableIsWritten) {
  EXPECT_EQ(
      read_table("Job 7\nX [mm];Y [mm]\n1,5;2,25\n-3;4\n", "p.txt").found,
      "semicolons between 2 columns, decimal commas, headings in line 2 with units, 1 line before them left out, 2 "
      "rows");
}

TEST(ReadTable, ReadsEveryEncoding) {
  RandomStream random{72};
  const RandomTable truth = random_table(random, 5, 3);
  const Habit habit{.delimiter = Delimiter::tab, .decimal = ','};
  for (const bool little : {true, false}) {
    for (const bool mark : {true, false}) {
      const RecognisedTable read = read_table(as_utf16(written(truth, habit), little, mark), "p.txt");
      expect_same(read.table, truth, habit);
      EXPECT_THAT(read.found, HasSubstr("UTF-16"));
    }
  }
  const RecognisedTable degrees = read_table("q1 [\xB0]\tx [mm]\n1.5\t2\n", "p.txt");
  EXPECT_EQ(degrees.table.units[0], "°");
  EXPECT_THAT(degrees.found, HasSubstr("Latin-1"));
}

TEST(ReadTable, KeepsTheLinesOfRows) {
  const CsvTable table = read_table("a b\n\n1 2\n# none\n3 4\n", "p.txt").table;
  EXPECT_EQ(table.header_line, 1u);
  EXPECT_EQ(table.rows[0].line, 3u);
  EXPECT_EQ(table.rows[1].line, 5u);
}

TEST(ReadTable, TakesUnitsFromBracketsAndFromARowBelowTheNames) {
  const CsvTable below = read_table("Name;q1;X\n;deg;[m]\nP1;10;2,5\nP2;20;3,5\n", "p.txt").table;
  EXPECT_THAT(below.units, ElementsAre("", "deg", "m"));
  const CsvTable beside = read_table("Name\tq1 (deg)\tX/m\tTool (left)\nP1\t10\t2\t1\n", "p.txt").table;
  EXPECT_THAT(beside.columns, ElementsAre("Name", "q1", "X", "Tool (left)"));
  EXPECT_THAT(beside.units, ElementsAre("", "deg", "m", ""));
  const TableColumn metres(below, {"X", {}}, Quantity::length, {});
  EXPECT_DOUBLE_EQ(metres.number(below.rows[1]), 3.5);
  const TableColumn whole(beside, {"q1 (deg)", {}}, Quantity::angle, {});
  EXPECT_NEAR(whole.number(beside.rows[0]), 0.1745, 1e-4);
}

TEST(ReadTable, ConvertsEveryUnitOfHeadings) {
  const CsvTable table =
      read_table("a [um];b [in];c [mrad];d [ms];e [gon]\n1500;2;3;250;200\n4;5;6;7;8\n", "p.txt").table;
  const auto value = [&](const char* name, Quantity quantity) {
    return TableColumn(table, {name, {}}, quantity, {}).number(table.rows[0]);
  };
  EXPECT_DOUBLE_EQ(value("a", Quantity::length), 0.0015);
  EXPECT_DOUBLE_EQ(value("b", Quantity::length), 0.0508);
  EXPECT_DOUBLE_EQ(value("c", Quantity::angle), 0.003);
  EXPECT_DOUBLE_EQ(value("d", Quantity::time), 0.25);
  EXPECT_DOUBLE_EQ(value("e", Quantity::angle), radians(180.0));
  EXPECT_THAT(complaint([&] { value("a", Quantity::angle); }), HasSubstr("a unit of a length"));
}

TEST(ReadTable, FindsHeadingsInTheLastCommentBeforeTheRows) {
  const RecognisedTable read = read_table("# written by a script\n# x y z\n1.5 2 3\n4 5 6\n", "p.txt");
  EXPECT_THAT(read.table.columns, ElementsAre("x", "y", "z"));
  EXPECT_THAT(read.found, HasSubstr("headings in line 2 (a comment)"));
}

TEST(ReadTable, TakesWhatTheUserSays) {
  ToldLayout told;
  told.decimal = ',';
  const CsvTable thousands = read_table("x;y\n1,234;5,678\n2,345;6,789\n", "p.txt", told).table;
  EXPECT_DOUBLE_EQ(TableColumn(thousands, {"x", {}}).number(thousands.rows[0]), 1.234);
  told = {};
  told.header_line = 3;
  const CsvTable third = read_table("Point X Y\nName of\nN A B\nP1 1 2\n", "p.txt", told).table;
  EXPECT_THAT(third.columns, ElementsAre("N", "A", "B"));
  told = {};
  told.delimiter = Delimiter::semicolon;
  EXPECT_EQ(read_table("a;b\n1,2;3,4\n5,6;7,8\n", "p.txt", told).table.rows.size(), 2u);
}

TEST(ReadTable, TakesThousandsTogetherWhereDecimalsStandBehindThem) {
  for (const auto& [text, separator] :
       {std::pair{"P;X;Y\nP1;-1.542,6625;-812,844\nP2;1.234.567,5;2\n", "decimal commas"},
        {"P;X;Y\nP1;-1,542.6625;-812.844\nP2;1,234,567.5;2\n", "decimal points"}}) {
    const RecognisedTable read = read_table(text, "p.txt");
    EXPECT_THAT(read.found, AllOf(HasSubstr(separator), HasSubstr("separators of thousands left out")));
    const TableColumn x(read.table, {"X", {}}), y(read.table, {"Y", {}});
    EXPECT_EQ(x.number(read.table.rows[0]), -1542.6625);
    EXPECT_EQ(x.number(read.table.rows[1]), 1234567.5);
    EXPECT_EQ(y.number(read.table.rows[0]), -812.844);
  }
  // Every number has its thousands apart: the table's rows are known by them.
  const CsvTable all = read_table("1.542,66;2.000,01;3.000,00\n", "p.txt").table;
  EXPECT_EQ(TableColumn(all, {"2", {}}).number(all.rows[0]), 2000.01);
}

TEST(ReadTable, LetsRowsEndInASeparator) {
  const CsvTable table = read_table("x;y;\n1,5;2;\n3;4;\n", "p.txt").table;
  EXPECT_THAT(table.columns, ElementsAre("x", "y"));
  EXPECT_THAT(read_table("x;y\n1,5;2;\n3;4;\n", "p.txt").table.columns, ElementsAre("x", "y"));
}

TEST(ReadTable, RefusesNamesThatStandTwiceUnlessTheirNumberIsGiven) {
  const CsvTable table = read_table("Name;X;Y;X;Y\nP;1,5;2;3;4\n", "p.txt").table;
  EXPECT_THAT(complaint([&] {
                TableColumn(table, {"X", {"set.yaml", 4}});
              }),
              HasSubstr("set.yaml:4: 'X': is the name of columns 2 and 4 of p.txt; give the number"));
  EXPECT_EQ(TableColumn(table, {"4", {}, 4}).number(table.rows[0]), 3.0);
}

TEST(ReadTable, ReadsRowsOfSpreadsheetsThatNameTheirSeparator) {
  EXPECT_THAT(read_table("sep=;\nx;y\n1;2\n", "p.csv").table.columns, ElementsAre("x", "y"));
}

}  // namespace
}  // namespace demecal
