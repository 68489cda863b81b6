// The mark of corrected programs: where it stands, and that it is found again.
#include <gtest/gtest.h>

#include <algorithm>

#include "languages/written_program.hpp"

namespace demecal {
namespace {

TEST(Mark, IsACommentThatReadersPassOverAndASecondRunFinds) {
  const std::string mark = correction_mark("1.0", "a job", "0123456789abcdef");
  EXPECT_EQ(mark, "corrected by demecal 1.0 with the model of a job (data 0123456789ab)");
  RandomStream stream{7510};
  const Chain arm = wrist_arm();
  for (const WrittenIn language : kLanguages) {
    if (!has_joint_targets(language)) continue;
    for (const char* line_break : {"\n", "\r\n"}) {
      SCOPED_TRACE(to_string(language));
      const auto line = [&](int index) { return joints_line(language, random_joints(stream, arm), index, 4); };
      const std::string text = written(language, false, 3, line, line_break);
      EXPECT_EQ(marked_line(text), std::nullopt);
      const std::string marked = with_mark(text, row_of(language), mark);
      const auto found = marked_line(marked);
      ASSERT_TRUE(found);
      // What was added are whole lines in one place.
      const std::size_t place = static_cast<std::size_t>(std::ranges::mismatch(text, marked).in1 - text.begin());
      const std::size_t begin = place == 0 ? 0 : text.rfind('\n', place - 1) + 1;
      EXPECT_EQ(marked.substr(0, begin) + marked.substr(begin + marked.size() - text.size()), text);
      EXPECT_EQ(marked[begin + marked.size() - text.size() - 1], '\n');
      EXPECT_EQ(read_program(language, marked, "p", arm).targets.size(), 3u);
    }
  }
}

TEST(Mark, StandsBehindTheHeaderOfAModule) {
  EXPECT_EQ(with_mark("&ACCESS RVP\nDEF a()\nEND\n", row_of(WrittenIn::krl), "m"), "&ACCESS RVP\nDEF a()\n; m\nEND\n");
  EXPECT_EQ(with_mark("&ACCESS RVP\nPTP {A1 0}\n", row_of(WrittenIn::krl), "m"), "&ACCESS RVP\n; m\nPTP {A1 0}\n");
  EXPECT_EQ(with_mark("%%%\n%%%\nMODULE m\nENDMODULE", row_of(WrittenIn::rapid), "m"),
            "%%%\n%%%\nMODULE m\n! m\nENDMODULE");
  EXPECT_EQ(with_mark("\xEF\xBB\xBFq1_deg\n1\n", row_of(WrittenIn::csv), "m"), "\xEF\xBB\xBF# m\nq1_deg\n1\n");
}

TEST(Mark, TakesAsManyLinesAsAControllersCommentsNeed) {
  const std::string mark = correction_mark("1.0", "a--job; of <many> words", "0123456789abcdef");
  EXPECT_EQ(with_mark("/PROG  A\n/MN\n   1:J P[1] 100% FINE    ;\n/POS\n/END\n", row_of(WrittenIn::fanuc_ls), mark),
            "/PROG  A\n/MN\n   :  ! corrected by demecal 1.0 with ;\n   :  ! the model of a- job  of  many ;\n"
            "   :  ! words (data 0123456789ab) ;\n   1:J P[1] 100% FINE    ;\n/POS\n/END\n");
  EXPECT_EQ(
      with_mark("//INST\r\nNOP\r\nEND\r\n", row_of(WrittenIn::yaskawa_jbi), "corrected by demecal 1.0 with a model"),
      "//INST\r\nNOP\r\n' corrected by demecal 1.0 with a\r\n' model\r\nEND\r\n");
  EXPECT_EQ(with_mark("<?xml ?>\n<Database>\n", row_of(WrittenIn::val3), "a -- b"),
            "<?xml ?>\n<!-- a -  b -->\n<Database>\n");
}

TEST(Mark, IsFoundWhereAControllerHasCountedItsLines) {
  EXPECT_EQ(marked_line("/MN\n   1:  !corrected by demecal 1.0 with ;\n"), 2u);
  EXPECT_EQ(marked_line("NOP\n'corrected by demecal 1.0\n"), 2u);
  EXPECT_EQ(marked_line("<?xml ?>\n<!-- corrected by demecal 1.0 -->\n"), 2u);
}

TEST(Mark, IsNoneInAString) {
  EXPECT_EQ(marked_line("textmsg(\"corrected by demecal\")\n"), std::nullopt);
  EXPECT_EQ(marked_line("a\n\n  ! corrected by demecal 2\n"), 3u);
}

}  // namespace
}  // namespace demecal
