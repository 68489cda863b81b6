// Corrected programs that somebody edited since: they are known, and not overwritten.
#include "coordinator/corrected_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "coordinator/commands.hpp"
#include "languages/languages.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

const std::string kProgram = "/PROG  A\n/MN\n   1:J P[1] 100% FINE    ;\n   2:J P[2] 100% FINE    ;\n/POS\n/END\n";

TEST(CorrectedFiles, AreKnownAsWrittenUntilSomebodyEditsThem) {
  for (const Language& language : all_languages()) {
    const std::string text = with_sealed_mark(kProgram, language, correction_mark("1.0", "a job", "0123456789abcdef"));
    EXPECT_TRUE(marked_line(text)) << language.name;
    EXPECT_TRUE(is_as_written(text)) << text;
    EXPECT_EQ(text.find("000000000000"), std::string::npos) << text;
    EXPECT_FALSE(is_as_written(text + " "));
    std::string edited = text;
    EXPECT_FALSE(is_as_written(edited.replace(edited.find("P[2]"), 4, "P[3]")));
    edited = text;
    EXPECT_FALSE(is_as_written(edited.replace(edited.find("a job"), 5, "b job"))) << "nor its mark";
  }
  EXPECT_FALSE(is_as_written(kProgram));
  EXPECT_FALSE(is_as_written(with_mark(kProgram, all_languages().front(), correction_mark("1.0", "a job", ""))))
      << "of an earlier version";
  EXPECT_FALSE(is_as_written("; corrected by demecal 1.0 sha256:12"));
}

TEST(CorrectedFiles, AreOverwrittenWhereTheyAreAsWritten) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("demecal-corrected-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::filesystem::path out = folder / "out.ls";
  const ProgramFile program{(folder / "in.ls").string(), kProgram};
  write_file(program.name, kProgram);
  const auto refusal = [&](bool force = false) -> std::string {
    try {
      require_writable(out, program, {program}, force);
    } catch (const ArgumentError& error) {
      return error.what();
    }
    return "";
  };
  const std::string marked = with_sealed_mark(kProgram, *find_language("fanuc_ls"), correction_mark("1.0", "a", ""));
  EXPECT_EQ(refusal(), "");
  write_file(out, marked);
  EXPECT_EQ(refusal(), "");
  write_file(out, marked + "!added by hand\n");
  EXPECT_NE(refusal().find("was changed since demecal wrote it"), std::string::npos) << refusal();
  EXPECT_EQ(refusal(true), "");
  write_file(out, "another\n");
  EXPECT_NE(refusal().find("not a program that demecal corrected"), std::string::npos);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace demecal
