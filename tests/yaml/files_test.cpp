// Whole files and their hash.
#include "yaml/files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../config/temporary_folder.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

TEST(Files, RoundTripEveryByte) {
  const TemporaryFolder folder;
  std::string bytes;
  for (int i = 0; i < 1024; ++i) bytes += static_cast<char>(i);
  EXPECT_EQ(read_file(folder.write("deep/er/all.bin", bytes)), bytes);
}

TEST(Files, NameTheReasonWhereTheyCannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_THAT(complaint([&] { read_file(folder.path() / "none.yaml"); }),
              HasSubstr("none.yaml: cannot be read: No such file or directory"));
  EXPECT_THAT(complaint([&] { read_file(folder.path()); }), HasSubstr("cannot be read: Is a directory"));
}

TEST(Files, NameTheReasonWhereTheyCannotBeWritten) {
  const TemporaryFolder folder;
  folder.write("file", "x");
  EXPECT_THAT(complaint([&] { write_file(folder.path() / "file" / "below", "x"); }), HasSubstr("cannot be made"));
  EXPECT_THAT(complaint([&] { write_file(folder.path(), "x"); }), HasSubstr("cannot be written"));
}

TEST(Files, AreNamedRelativeToTheFileThatNamesThem) {
  EXPECT_EQ(resolve("jobs/demo.yaml", "../robots/a.yaml"), "robots/a.yaml");
  EXPECT_EQ(resolve("demo.yaml", "a.yaml"), "a.yaml");
  EXPECT_EQ(resolve("jobs/demo.yaml", "/robots/a.yaml"), "/robots/a.yaml");
}

TEST(Sha256, GivesTheStandardsExamples) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace demecal
