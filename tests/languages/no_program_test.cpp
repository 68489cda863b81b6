// Texts that are no program are refused by name; programs without a motion are programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "errors/input_error.hpp"
#include "kinematics/random_arm.hpp"
#include "languages/languages.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// What refuses the text as a program of the language; empty: nothing does.
std::string refusal_as(const Language& language, const std::string& text) {
  try {
    const ProgramSource source(text, "hello." + std::string(written_ending(language)));
    require_program(language, source, read_program(language, source, wrist_arm()));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(NoProgram, IsAnyTextThatHasNoLineOfOne) {
  for (const Language& language : all_languages()) {
    SCOPED_TRACE(language.name);
    for (const char* text : {"Hello, world.\n", "Dear colleague,\nthe arm stands in hall 4.\n\n", "\n"})
      EXPECT_NE(refusal_as(language, text), "");
  }
  EXPECT_THAT(refusal_as(*find_language("fanuc_ls"), "hello\n"),
              AllOf(HasSubstr("hello.ls"), HasSubstr("is no program in FANUC"), HasSubstr("/prog"),
                    HasSubstr("no motion, no point")));
}

TEST(NoProgram, IsNoneThatHasNoMotion) {
  const std::vector<std::pair<const char*, const char*>> programs{
      {"fanuc_ls", "/PROG  HELLO\n/ATTR\n/MN\n   1:  DO[1]=ON ;\n/POS\n/END\n"},
      {"yaskawa_jbi", "/JOB\n//NAME HELLO\n//POS\n///NPOS 0,0,0,0,0,0\n//INST\nNOP\nDOUT OT#(1) ON\nEND\n"},
      {"krl", "DEF hello( )\n$OUT[1]=TRUE\nEND\n"},
      {"rapid", "MODULE hello\nPROC main()\nSetDO do1,1;\nENDPROC\nENDMODULE\n"},
      {"urscript", "def hello():\n  set_digital_out(1, True)\nend\n"},
      {"urscript", "  def hello():\n  textmsg(\"hello\")\nend\n"},
      {"kawasaki_as", ".PROGRAM hello()\nSIGNAL 1\n.END\n"},
      {"val2", ".PROGRAM hello\nTYPE \"hello\"\n.END\n"}};
  for (const auto& [language, text] : programs) EXPECT_EQ(refusal_as(*find_language(language), text), "") << text;
}

}  // namespace
}  // namespace demecal
