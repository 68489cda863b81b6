// Who may be served: lines of names and tokens, and what is wrong with them without telling a token.
#include "serving/token_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "errors/input_error.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::Pair;

const std::string kOne = "0123456789abcdef", kTwo = "fedcba9876543210-._~";

TEST(TokenFile, HasALineForEachUser) {
  EXPECT_THAT(parse_tokens("# users\n\nann " + kOne + "\r\n  bob\t" + kTwo + "  \n", "f"),
              ElementsAre(Pair("ann", kOne), Pair("bob", kTwo)));
}

TEST(TokenFile, IsRefusedWithItsLineAndWithoutTokens) {
  for (const auto& [text, says] : {std::pair{"ann " + kOne + "\n../x " + kTwo, "f:2"},
                                   {"ann " + kOne + " more", "f:1"},
                                   {"ann secret-short", "16 to 128"},
                                   {"ann", "16 to 128"},
                                   {"ann " + kOne + "\nann " + kTwo, "stands twice"},
                                   {"ann " + kOne + "\nbob " + kOne, "its own"},
                                   {std::string("# nobody\n"), "no user"},
                                   {"ann " + kOne + "/", "16 to 128"},
                                   {"ann " + std::string(129, 'a'), "16 to 128"}}) {
    try {
      parse_tokens(text, "f");
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(says));
      EXPECT_THAT(error.what(), Not(HasSubstr(kOne)));
      EXPECT_THAT(error.what(), Not(HasSubstr("secret")));
    }
  }
}

}  // namespace
}  // namespace demecal
