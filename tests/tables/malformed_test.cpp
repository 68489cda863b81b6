// Malformed tables: each is refused with a sentence that names its line, and says what to do where there is a choice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "../errors/complaint.hpp"
#include "data/columns.hpp"
#include "tables/read_table.hpp"
#include "tables/time_stamp.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Columns named `Name`, then numbers X, Y and Z, or a part of them.
struct Malformed {
  std::string bytes;
  std::string where;  ///< what the complaint begins with
  std::string rule;   ///< a part of it
  ToldLayout told{};
};

std::ostream& operator<<(std::ostream& stream, const Malformed& file) {
  return stream << file.bytes.substr(0, 40);
}

/// Reads the table, and X, Y and Z of every row as a data set would.
void read_all(const Malformed& file) {
  const CsvTable table = read_table(file.bytes, "p", file.told).table;
  for (const char* name : {"X", "Y", "Z"}) {
    const TableColumn column(table, {name, {"set.yaml", 5}}, Quantity::length,
                             {.angle = {}, .length = find_unit("mm")});
    for (const CsvRow& row : table.rows) column.number(row);
  }
}

class MalformedTables : public ::testing::TestWithParam<Malformed> {};

TEST_P(MalformedTables, AreRefusedWithTheirLine) {
  const std::string sentence = complaint([] { read_all(GetParam()); });
  EXPECT_THAT(sentence, StartsWith(GetParam().where + ": "));
  EXPECT_THAT(sentence, HasSubstr(GetParam().rule));
}

const std::string kHead = "Name;X;Y;Z\nA;1,5;2;3\nD;4;5,5;6\n";
const std::string kTab = "Name\tX\tY\tZ\nA\t1.5\t2\t3\nD\t4\t5.5\t6\n";
const std::string kBlank = "Name X Y Z\nA 1.5 2 3\nD 4 5.5 6\n";
const std::string kComma = "Name,X,Y,Z\nA,1.5,2,3\nD,4,5.5,6\n";

std::string zero_inside() {
  return kTab + std::string("B\t1\0\t2\t3\n", 9);
}

std::string cut_utf16() {
  std::string bytes = "\xFF\xFE";
  for (const char c : kTab) bytes += std::string{c, '\0'};
  return bytes + 'B';
}

std::string half_character() {
  std::string bytes = "\xFF\xFE";
  for (const char c : kTab) bytes += std::string{c, '\0'};
  return bytes + std::string("\x00\xD8\x41\x00", 4);
}

ToldLayout told_delimiter(Delimiter delimiter) {
  ToldLayout told;
  told.delimiter = delimiter;
  return told;
}
ToldLayout told_header(std::size_t line) {
  ToldLayout told;
  told.header_line = line;
  return told;
}
ToldLayout told_decimal(char sign) {
  ToldLayout told;
  told.decimal = sign;
  return told;
}

INSTANTIATE_TEST_SUITE_P(
    Files, MalformedTables,
    ::testing::Values(
        // no text at all
        Malformed{"", "p", "is empty"}, Malformed{"\xEF\xBB\xBF", "p", "is empty"},
        Malformed{"\n\n  \n", "p", "is empty"}, Malformed{"PK\x03\x04 and more", "p:1", "save it as CSV"},
        Malformed{"\xD0\xCF\x11\xE0 and more", "p:1", "Excel's old format"},
        Malformed{"%PDF-1.4\n1 2 3\n", "p:1", "a PDF"}, Malformed{"\x1F\x8B\x08", "p:1", "unpack it first"},
        Malformed{zero_inside(), "p:4", "zero byte"},
        Malformed{cut_utf16(), "p:4", "ends within a character of UTF-16"},
        Malformed{half_character(), "p:4", "half a character of UTF-16"},
        Malformed{"Name;X\rA;1\r", "p:1", "lines must end in LF"},
        // rows of another width
        Malformed{kHead + "B;1;2\n", "p:4", "the row has 3 fields, but the header has 4 columns"},
        Malformed{kHead + "B;1;2;3;4\n", "p:4", "the row has 5 fields"},
        Malformed{kHead + "B 1 2 3\n", "p:4", "the row has 1 fields"},
        Malformed{kTab + "B\t1\t2\n", "p:4", "the row has 3 fields"},
        Malformed{kTab + "B 1 2\n", "p:4", "the row has 1 fields"},
        Malformed{kBlank + "B 1 2\n", "p:4", "the row has 3 fields"},
        Malformed{kBlank + "B C 1 2 3\n", "p:4", "the row has 5 fields"},
        Malformed{kComma + "B,1,2\n", "p:4", "the row has 3 fields, but the header has 4 columns"},
        Malformed{kComma + "B;1;2;3\n", "p:4", "the row has 1 fields"},
        Malformed{kHead + "60 points\n", "p:4", "can be marked by # as a comment"},
        Malformed{kBlank + "END\n", "p:4", "can be marked by # as a comment"},
        Malformed{"A;1,5;2\nB;1;2;3\nC;1;2;3\n", "p:1", "the row has 3 fields, but those below have 4"},
        Malformed{"1 2\n1 2 3\n4 5 6\n", "p:1", "the row has 2 fields, but those below have 3"},
        Malformed{"1,5;2;3\n4;5\n6;7;8\n", "p:2", "but the other rows have 3"},
        // headings
        Malformed{"Name;X;Y\nA;1,5;2;3\nB;4;5;6\n", "p:1", "there are 3 headings, but the rows below have 4 fields"},
        Malformed{"Name;X\nA;1,5;2;3\nB;4;5;6\n", "p:1", "there are 2 headings, but the rows below have 4"},
        Malformed{"Name;X;Y;Z;W\nA;1,5;2;3\nB;4;5;6\n", "p:1", "`header_line: 0`"},
        Malformed{"one of these\nName X Y\nA 1 2\n", "p:1", "and line 2 may both be the headings"},
        Malformed{"Name;X;Y;Z\nA;-;-;-\nB;1,5;2;3\n", "p:1", "and line 2 may both be the headings"},
        Malformed{kHead, "p:7", "is no line of the file with headings", told_header(7)},
        Malformed{kHead, "p:2", "cannot be the headings", told_header(2)},
        Malformed{"preamble\n" + kHead, "p:1", "cannot be the headings: they must be 4 names", told_header(1)},
        Malformed{"X,X,Y,Z\n1,2,3,4\n", "p:1", "is the name of two columns"},
        Malformed{"X,,Y,Z\n1,2,3,4\n", "p:1", "column 2 of the header has no name"},
        Malformed{"Name,X,Y,Z\n", "p:1", "has a header but no rows"},
        Malformed{"X;X;Y;Z\n1,5;2;3;4\n", "set.yaml:5", "is the name of columns 1 and 2"},
        Malformed{"X;Y;W\n1,5;2;3\n", "set.yaml:5", "is no column of p; the nearest is 'X'"},
        // units
        Malformed{"X [deg];Y;Z\n1,5;2;3\n", "set.yaml:5", "is headed with 'deg', a unit of an angle"},
        Malformed{"X [V];Y;Z\n1,5;2;3\n", "set.yaml:5", "is headed with the unit 'V', which is not supported"},
        Malformed{"X;Y;Z\n[s];[mm];[mm]\n1,5;2;3\n", "set.yaml:5", "a unit of a time"},
        // decimals
        Malformed{"X;Y;Z\n1,234;5,678;9,012\n2,345;6,789;1,234\n", "p:2", "`decimal: comma`"},
        Malformed{"X;Y;Z\n1,5;2.5;3\n", "p:2", "different decimal signs"},
        Malformed{"X;Y;Z\n1,234;2,345;0.5\n", "p:2", "different decimal signs"},
        Malformed{"X;Y;Z\n1,5;2,5;3,5\n1,5;2.5;3,5\n", "p:3", "has a point where the file writes decimal commas"},
        Malformed{"X;Y;Z\n1.5;2.5;3.5\n1.5;2,5;3.5\n", "p:3", "is not a number"},
        Malformed{"X;Y;Z\n12.34,5;2,5;3,5\n", "p:2", "has a point where"},
        Malformed{"X;Y;Z\n1.234;2,5;3,5\n", "p:2", "has a point where"},
        Malformed{"X;Y;Z\n1,234.5;2.5;3.5\n1,234;2.5;3.5\n", "p:3", "looks like a number with separators of thousands"},
        Malformed{"X;Y;Z\n1,5;2;3\n", "p:2", "is not a number", told_decimal('.')},
        Malformed{"X;Y;Z\n1.5;2;3\n", "p:2", "has a point", told_decimal(',')},
        Malformed{"X,Y,Z\n1,5,2,5,3,5\n4,5,5,5,6,5\n", "p:2", "twice as many fields as there are headings"},
        Malformed{"1,5,2,5\n4,5,5,5\n", "p:1", "2 numbers with decimal commas"},
        // separators
        Malformed{kHead, "p", "separated as told", told_delimiter(Delimiter::tab)},
        Malformed{"nothing but words here\nand there\n", "set.yaml:5", "is no column of p"},
        // quotes
        Malformed{kHead + "\"B;1;2;3\n", "p:4", "opens a quote"},
        Malformed{kHead + "\"B\"x;1;2;3\n", "p:4", "opens a quote"},
        Malformed{kComma + "\"B,1,2,3\n", "p:4", "opens a quote"},
        // numbers
        Malformed{kHead + "B;1;;3\n", "p:4", "column Y is empty where a number is expected"},
        Malformed{kHead + "B;1;---;3\n", "p:4", "column Y is not a number: where nothing was measured"},
        Malformed{kHead + "B;1;NaN;3\n", "p:4", "must be a finite number"},
        Malformed{kHead + "B;1;1e999;3\n", "p:4", "column Y is not a number"},
        Malformed{kHead + "B;1;2 mm;3\n", "p:4", "column Y is not a number: write its unit in the heading"},
        Malformed{kHead + "B;1;#REF!;3\n", "p:4", "column Y is not a number"},
        Malformed{kHead + "B;1;1,2,3;3\n", "p:4", "column Y is not a number"}));

std::string time_complaint(const std::string& text) {
  return complaint([&] {
    CsvTable table = read_table(text, "p").table;
    std::optional<double> origin_s;
    write_times_as_seconds(table, 0, origin_s);
    const TableColumn column(table, {"t", {"set.yaml", 5}}, Quantity::time, {});
    for (const CsvRow& row : table.rows) column.number(row);
  });
}

TEST(MalformedTimes, AreRefusedWithTheirLine) {
  EXPECT_THAT(time_complaint("t;x\n12:00:01;1\n12:60:02;2\n"), StartsWith("p:3: '12:60:02': is no time such as"));
  EXPECT_THAT(time_complaint("t;x\n23:59:59;1\n00:00:01;2\n23:59:58;3\n"),
              StartsWith("p:4: '23:59:58': is more than half a day after the row before, behind a midnight"));
  EXPECT_THAT(time_complaint("t;x\n12:00:01;1\n2026-11-24 12:00:02;2\n"), HasSubstr("of another form"));
  EXPECT_THAT(time_complaint("t;x\n2026-02-29 12:00:01;1\n"), StartsWith("p:2: '2026-02-29 12:00:01'"));
  EXPECT_THAT(time_complaint("t;x\n11/12/2026 12:00:01;1\n"), StartsWith("p:2: '11/12/2026 12:00:01'"));
}

}  // namespace
}  // namespace demecal
