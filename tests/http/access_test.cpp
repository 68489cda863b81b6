// Who may look: where the page is served, by which names, and with which token.
#include "http/access.hpp"

#include <gtest/gtest.h>

#include <set>

#include "errors/input_error.hpp"

namespace demecal {
namespace {

TEST(Endpoint, IsThisMachineUnlessAnAddressIsNamed) {
  for (const char* const text : {"8080", "127.0.0.1:8080", "localhost:8080"}) {
    EXPECT_EQ(origin_of(parse_endpoint(text)), "http://127.0.0.1:8080") << text;
  }
  EXPECT_EQ(origin_of(parse_endpoint("0")), "http://127.0.0.1:0");
  EXPECT_EQ(origin_of(parse_endpoint("192.0.2.10:9")), "http://192.0.2.10:9");
  EXPECT_EQ(origin_of(parse_endpoint("[::1]:65535")), "http://[::1]:65535");
  EXPECT_EQ(parse_endpoint("[2001:db8::1]:80").address, "2001:db8::1");
}

TEST(Endpoint, IsRefusedWithItsRule) {
  for (const char* const text :
       {"", "x", "-1", "65536", "80 ", "1e3", "example.org:80", "127.0.0.1", "127.0.0.1:", ":80", "127.0.0.1:x",
        "::1:80", "[::1]", "[::1]80", "[127.0.0.1]:80", "1.2.3:80", "1.2.3.4:99999"}) {
    EXPECT_THROW(parse_endpoint(text), InputError) << text;
  }
}

TEST(Endpoint, KnowsLoopback) {
  for (const char* const address : {"127.0.0.1", "127.3.2.1", "::1"}) EXPECT_TRUE(is_loopback(address)) << address;
  for (const char* const address : {"0.0.0.0", "192.0.2.1", "::", "127.example.org", "1270.0.1", ""}) {
    EXPECT_FALSE(is_loopback(address)) << address;
  }
}

TEST(TrustedHost, IsNoNameThatSomebodyElseCanGiveThisMachine) {
  const Endpoint here{"127.0.0.1", 8080}, everywhere{"0.0.0.0", 8080};
  for (const char* const host : {"127.0.0.1:8080", "localhost:8080", "LOCALHOST", "127.0.0.1", "[::1]:8080"}) {
    EXPECT_TRUE(is_trusted_host(host, here, "arm-cell")) << host;
    EXPECT_TRUE(is_trusted_host(host, everywhere, "arm-cell")) << host;
  }
  for (const char* const host :
       {"", "evil.example", "evil.example:8080", "127.0.0.1.evil.example", "localhost.evil.example:8080",
        "127.0.0.1:8080@evil.example", "127.0.0.1:x", "[::1", "[localhost]:8080", "localhost:8080:8080"}) {
    EXPECT_FALSE(is_trusted_host(host, here, "arm-cell")) << host;
    EXPECT_FALSE(is_trusted_host(host, everywhere, "arm-cell")) << host;
  }
  for (const char* const host : {"192.0.2.10:8080", "[2001:db8::1]:8080", "arm-cell:8080", "ARM-CELL"}) {
    EXPECT_TRUE(is_trusted_host(host, everywhere, "arm-cell")) << host;
    EXPECT_FALSE(is_trusted_host(host, here, "arm-cell")) << host;
  }
  EXPECT_FALSE(is_trusted_host("", everywhere, ""));
}

TEST(Token, IsShownWholeOrNotAtAll) {
  const std::string token = random_token();
  EXPECT_TRUE(shows_token("Bearer " + token, token));
  for (const std::string& wrong :
       {std::string(), token, std::string("Bearer "), "bearer " + token, "Bearer " + token + "0",
        "Bearer " + token.substr(1), "Bearer " + std::string(token.size(), '0')}) {
    EXPECT_FALSE(shows_token(wrong, token)) << wrong;
  }
}

TEST(Token, IsDrawnAnewEachTime) {
  std::set<std::string> drawn;
  for (int i = 0; i < 100; ++i) drawn.insert(random_token());
  EXPECT_EQ(drawn.size(), 100u);
  for (const std::string& token : drawn) {
    EXPECT_EQ(token.size(), 32u);
    EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
  }
}

}  // namespace
}  // namespace demecal
