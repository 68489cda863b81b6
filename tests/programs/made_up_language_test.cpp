// A language needs a reader and its row: with these alone it is recognised, read, corrected, marked and summed up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corrected_arm.hpp"
#include "languages/languages.hpp"
#include "parsed_programs/language.hpp"
#include "programs/summary.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

/// "go 1 2 3 4 5 6" moves the joints, in degrees.
Program read_dawdle(const ReaderInput& input) {
  const ProgramText code(input.source, {.comment = '%'});
  Program program{.targets = {}, .uncorrected = {}};
  code.for_each_word([&](std::size_t begin, std::size_t end) {
    if (code.code().substr(begin, end - begin) != "go") return;
    Target target{.place = code.place(begin)};
    for (const CellUnit& unit : joint_units(input.arm)) {
      begin = code.skip_spaces(end);
      end = std::min(code.code().find_first_of(" \n", begin), code.code().size());
      target.joints.push_back(code.number(begin, end - begin, unit));
    }
    program.targets.push_back(target);
  });
  return program;
}

const Language kDawdle{.name = "dawdle",
                       .title = "Dawdle",
                       .file_endings = {"daw"},
                       .signs = {"dawdling"},
                       .comment = "%",
                       .headers = {"to "},
                       .read = read_dawdle};
const std::span<const Language> kTable{&kDawdle, 1};

TEST(MadeUpLanguage, IsFoundByNameEndingAndSign) {
  EXPECT_EQ(find_language("Dawdle", kTable), &kDawdle);
  EXPECT_EQ(find_language("krl", kTable), nullptr);
  EXPECT_EQ(recognize_language("", "a.DAW", kTable), &kDawdle);
  EXPECT_EQ(recognize_language("% Dawdling", "a", kTable), &kDawdle);
  EXPECT_EQ(recognize_language("", "a", kTable), nullptr);
}

TEST(MadeUpLanguage, IsCorrectedMarkedAndSummedUp) {
  RandomStream stream{7520};
  const CommandModel model = erring_model(stream, elbow_arm(stream));
  const std::string text = "to work\n  go 10 -20 30 40 50 60 % go 1 2 3 4 5 6\n  go 12 -25 35 45 55 65\nend\n";
  Program program = read_program(kDawdle, text, "a.daw", model.nominal.chain);
  EXPECT_EQ(program.language, "dawdle");
  ASSERT_EQ(program.targets.size(), 2u);
  const CorrectedProgram corrected = correct_program(text, std::move(program), model, {});
  EXPECT_NE(corrected.text, text);
  EXPECT_THAT(summary_json(corrected, model.nominal.chain), HasSubstr("\"language\":\"dawdle\""));
  EXPECT_THAT(summary_table(corrected, model.nominal.chain), HasSubstr("2 targets corrected"));

  const std::string marked = with_mark(corrected.text, kDawdle, correction_mark("1.0", "a job", ""));
  EXPECT_THAT(marked, ::testing::StartsWith("to work\n% corrected by demecal 1.0 with the model of a job\n  go "));
  EXPECT_EQ(marked_line(marked, kTable), 2u);
  const Program again = read_program(kDawdle, marked, "a.daw", model.nominal.chain);
  ASSERT_EQ(again.targets.size(), 2u);
  const JointVector& command = corrected.targets[1].command;
  for (Eigen::Index i = 0; i < command.size(); ++i) {
    EXPECT_NEAR(again.targets[1].joints[static_cast<std::size_t>(i)].inside(), command[i], 1e-6);
  }
}

TEST(Languages, HaveRowsThatNoOtherLanguageContradicts) {
  for (const Language& language : all_languages()) {
    SCOPED_TRACE(language.name);
    EXPECT_EQ(find_language(language.name), &language);
    EXPECT_FALSE(language.title.empty());
    ASSERT_NE(language.read, nullptr);
    for (const std::string_view ending : language.file_endings) {
      EXPECT_EQ(recognize_language("", "a." + std::string(ending)), &language) << ending;
    }
    for (const std::string_view sign : language.signs) EXPECT_EQ(recognize_language(sign, "a"), &language) << sign;
  }
}

}  // namespace
}  // namespace demecal
