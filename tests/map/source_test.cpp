// What the rules see of a source file: no comments, no words, the right line numbers.
#include "source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace demecal::map {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Code, LeavesOutCommentsAndKeepsLines) {
  const std::string code = code_of("int a;  // time(0)\n/* rand()\n rand() */ int b;\n");
  EXPECT_THAT(code, Not(HasSubstr("time")));
  EXPECT_THAT(code, Not(HasSubstr("rand")));
  EXPECT_THAT(lines_of(code).at(2), HasSubstr("int b;"));
}

TEST(Code, LeavesOutLiterals) {
  const std::string code = code_of(R"outer(f("a \" rand() // b"); g('"'); h(R"x(rand() " )x"); int last;)outer");
  EXPECT_THAT(code, Not(HasSubstr("rand")));
  EXPECT_THAT(code, HasSubstr("g("));
  EXPECT_THAT(code, HasSubstr("int last;"));
}

TEST(Code, TakesTheQuoteInANumberForNoLiteral) {
  EXPECT_EQ(code_of("f(1'000, rand(), 2'000);"), "f(1'000, rand(), 2'000);");
}

TEST(Code, EndsWithTheTextWhereSomethingIsLeftOpen) {
  for (const std::string text :
       {"int a; /* open", "int a; \"open", "int a; \"open\\", "int a; R\"x(open", "int a; R\""}) {
    EXPECT_THAT(code_of(text), HasSubstr("int a; ")) << text;
    EXPECT_EQ(lines_of(code_of(text)).size(), 1u) << text;
  }
}

TEST(Includes, HaveLineNameAndQuotes) {
  const Source source{"common/a/a.cpp", "// first\n#include \"a/a.hpp\"\n\n#  include <vector>  // why\n"};
  const std::vector<Include> includes = includes_of(source);
  ASSERT_EQ(includes.size(), 2u);
  EXPECT_EQ(includes[0].line, 2);
  EXPECT_EQ(includes[0].name, "a/a.hpp");
  EXPECT_TRUE(includes[0].quoted);
  EXPECT_EQ(includes[1].line, 4);
  EXPECT_EQ(includes[1].name, "vector");
  EXPECT_FALSE(includes[1].quoted);
}

TEST(Includes, InCommentsAreNone) {
  EXPECT_TRUE(includes_of({"a.cpp", "// #include <thread>\n/*\n#include <mutex>\n*/\n"}).empty());
}

TEST(Home, IsTheRoomOrTheTopFolder) {
  EXPECT_EQ(home_of({"common/data/pose.hpp", ""}), "data");
  EXPECT_EQ(home_of({"coordinator/main.cpp", ""}), "coordinator");
  EXPECT_EQ(home_of({"tests/data/pose_test.cpp", ""}), "tests");
}

}  // namespace
}  // namespace demecal::map
