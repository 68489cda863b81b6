// Manual pages and completions name what a program's command line has, and nothing that it hides.
#include "manual/manual.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

struct MadeUpProgram {
  CLI::App app{"weigh: tells what things weigh", "weigh"};
  std::string printed, thing, hands, unit = "kg";
  int times = 3;
  bool quiet = false;

  MadeUpProgram() {
    CLI::App* scale = app.add_subcommand("scale", "put a thing on the scale; it's exact");
    scale->add_option("thing", thing, "THING.yaml")->required();
    scale->add_option("--unit", unit, "of the answer")->check(CLI::IsMember({"kg", "g"}))->capture_default_str();
    scale->add_option("--times", times, "how often")->check(CLI::Range(1, 9))->envname("WEIGH_TIMES");
    scale->add_option("--hands", hands, "that help")->type_name("N|none[:N]");
    scale->add_flag("--quiet", quiet, "say nothing [at all]");
    app.add_subcommand("tare", "set the scale to 0");
    add_manual(app, "0: done.", [this](const std::string& text) { printed = text; });
  }
};

std::string output_of(const std::string& command, const std::string& input) {
  const std::string file = ::testing::TempDir() + "manual_test_input-" + std::to_string(::getpid());
  std::FILE* const written = std::fopen(file.c_str(), "w");
  std::fputs(input.c_str(), written);
  std::fclose(written);
  std::FILE* const pipe = ::popen((command + " <" + file + " 2>&1").c_str(), "r");
  std::string text;
  std::array<char, 256> part{};
  while (std::fgets(part.data(), part.size(), pipe) != nullptr) text += part.data();
  ::pclose(pipe);
  std::remove(file.c_str());
  return text;
}

TEST(ManualPage, NamesOptionsValuesRulesAndDefaults) {
  MadeUpProgram program;
  const std::string page = manual_page(program.app, "scale", "0: done.");
  EXPECT_THAT(page, AllOf(HasSubstr(".TH WEIGH\\-SCALE 1"), HasSubstr("\\fB\\-\\-unit\\fR \\fITEXT\\fR"),
                          HasSubstr("one of kg, g; default kg"), HasSubstr("1 to 9"), HasSubstr("WEIGH_TIMES"),
                          HasSubstr("\\fIN|none[:N]\\fR"), HasSubstr("\\fITHING\\fR"), HasSubstr("0: done.")));
}

TEST(ManualPage, OfTheProgramListsItsCommandsAndHidesWhatHelpHides) {
  MadeUpProgram program;
  const std::string page = manual_page(program.app, "", "0: done.");
  EXPECT_THAT(page, AllOf(HasSubstr("weigh \\- tells what things weigh"), HasSubstr("weigh\\-scale"),
                          HasSubstr("weigh\\-tare"), Not(HasSubstr("completion"))));
  EXPECT_EQ(manual_page(program.app, "no such command", ""), "");
}

TEST(ManualPage, IsPrintedInPlaceOfARun) {
  MadeUpProgram program;
  const char* const words[] = {"weigh", "--manual", "tare"};
  EXPECT_THROW(program.app.parse(3, words), CLI::Success);
  EXPECT_THAT(program.printed, HasSubstr("set the scale to 0"));
}

TEST(ManualPage, RefusesACommandThatIsNotThere) {
  MadeUpProgram program;
  const char* const words[] = {"weigh", "--manual", "ruler"};
  EXPECT_THROW(program.app.parse(3, words), CLI::ValidationError);
}

TEST(Completion, OfBashCompletesCommandsOptionsAndValues) {
  MadeUpProgram program;
  const auto completed = [&](const std::string& words, int index) {
    return output_of("bash", bash_completion(program.app) + "COMP_WORDS=(" + words +
                                 ")\nCOMP_CWORD=" + std::to_string(index) + "\n_weigh\necho \"${COMPREPLY[*]}\"\n");
  };
  EXPECT_EQ(completed("weigh s", 1), "scale\n");
  EXPECT_EQ(completed("weigh scale --u", 2), "--unit\n");
  EXPECT_EQ(completed("weigh scale --unit k", 3), "kg\n");
  EXPECT_EQ(completed("weigh scale thing", 2), "\n");
}

TEST(Completion, OfZshHasEveryCommandAndOption) {
  MadeUpProgram program;
  const std::string script = zsh_completion(program.app);
  EXPECT_THAT(script, AllOf(HasSubstr("#compdef weigh"), HasSubstr("'scale:put a thing on the scale; it'\\''s exact'"),
                            HasSubstr("'--unit[of the answer]:TEXT:(kg g)'"),
                            HasSubstr("'--quiet[say nothing \\[at all\\]]'")));
}

TEST(Completion, OfFishCompletesCommandsOptionsAndValues) {
  MadeUpProgram program;
  const auto completed = [&](const std::string& line) {
    const std::string told = output_of("fish --no-config", fish_completion(program.app) + "complete -C '" + line +
                                                               "' | string replace -r '\\t.*' ''\n");
    std::istringstream stream(told);
    return std::vector<std::string>{std::istream_iterator<std::string>(stream), {}};
  };
  EXPECT_THAT(completed("weigh "), IsSupersetOf({"scale", "tare"}));
  EXPECT_THAT(completed("weigh scale --u"), ElementsAre("--unit"));
  EXPECT_THAT(completed("weigh scale --unit "), UnorderedElementsAre("g", "kg"));
  EXPECT_THAT(completed("weigh scale --"), UnorderedElementsAre("--hands", "--help", "--quiet", "--times", "--unit"));
  EXPECT_THAT(completed("weigh tare --"), ElementsAre("--help"));
  EXPECT_THAT(completed("weigh scale ta"), Not(Contains("tare")));
}

TEST(Commands, AreInTheOrderOfHelp) {
  MadeUpProgram program;
  EXPECT_THAT(command_names(program.app), ElementsAre("scale", "tare"));
}

}  // namespace
}  // namespace demecal
