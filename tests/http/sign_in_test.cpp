// Who asks: by a token, by a cookie that a token was shown for, or nobody.
#include "http/access.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace demecal {
namespace {

const std::string kAnn = "ann-0123456789abcdef", kBob = "bob-0123456789abcdef";

/// What a browser sends back of a Set-Cookie.
std::string cookie_of(const std::string& set) {
  return set.substr(0, set.find(';'));
}

TEST(SignIn, KnowsUsersByTheirTokensAndNobodyElse) {
  const SignIn sign_in({{"ann", kAnn}, {"bob", kBob}}, "local");
  EXPECT_EQ(sign_in.user_of("Bearer " + kAnn, ""), "ann");
  EXPECT_EQ(sign_in.user_of("Bearer " + kBob, ""), "bob");
  for (const std::string& wrong :
       {std::string(), kAnn, "bearer " + kAnn, "Bearer " + kAnn + "x", std::string("Bearer "), "Basic " + kAnn,
        "Bearer " + kAnn.substr(1), "Bearer  " + kAnn, std::string("Bearer local")}) {
    EXPECT_EQ(sign_in.user_of(wrong, ""), std::nullopt) << wrong;
  }
}

TEST(SignIn, IsEverybodyWhereThereAreNoTokens) {
  EXPECT_EQ(SignIn({}, "local").user_of("", ""), "local");
  EXPECT_EQ(SignIn({}, "local").user_of("Bearer anything", "demecal-session=x"), "local");
}

TEST(SignIn, RemembersABrowserUntilItSignsOut) {
  SignIn sign_in({{"ann", kAnn}, {"bob", kBob}}, "local");
  const std::string set = sign_in.begin_session("bob"), cookie = cookie_of(set);
  EXPECT_NE(set.find("HttpOnly"), std::string::npos);
  EXPECT_NE(set.find("SameSite=Strict"), std::string::npos);
  EXPECT_EQ(set.find(kBob), std::string::npos);
  EXPECT_EQ(sign_in.user_of("", cookie), "bob");
  EXPECT_EQ(sign_in.user_of("", "a=b; " + cookie + "; c=d"), "bob");
  for (const std::string& wrong : {cookie + "0", cookie.substr(0, cookie.size() - 1), std::string("demecal-session="),
                                   "x" + cookie, std::string(";;; ;"), "a=" + cookie}) {
    EXPECT_EQ(sign_in.user_of("", wrong), std::nullopt) << wrong;
  }
  EXPECT_EQ(sign_in.user_of("Bearer wrong", cookie), std::nullopt);  // a header that is there counts
  EXPECT_NE(sign_in.end_session(cookie).find("Max-Age=0"), std::string::npos);
  EXPECT_EQ(sign_in.user_of("", cookie), std::nullopt);
}

TEST(SignIn, KeepsSixteenSessionsOfAUserAndThoseOfOthers) {
  SignIn sign_in({{"ann", kAnn}, {"bob", kBob}}, "local");
  const std::string others = cookie_of(sign_in.begin_session("ann"));
  std::vector<std::string> cookies;
  for (int i = 0; i < 40; ++i) cookies.push_back(cookie_of(sign_in.begin_session("bob")));
  int known = 0;
  for (const std::string& cookie : cookies) known += sign_in.user_of("", cookie) == "bob" ? 1 : 0;
  EXPECT_EQ(known, 16);
  EXPECT_EQ(sign_in.user_of("", cookies.back()), "bob");
  EXPECT_EQ(sign_in.user_of("", others), "ann");
}

}  // namespace
}  // namespace demecal
