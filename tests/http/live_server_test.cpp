// The server over real HTTP: what it answers, whom it refuses, and that nobody who publishes waits for a browser.
#include "http/live_server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <chrono>
#include <thread>

#include "errors/input_error.hpp"
#include "raw_connection.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

LiveServerOptions options_of(const std::string& token = "") {
  LiveServerOptions options;
  options.token = token;
  return options;
}

httplib::Client client_of(const LiveServer& server) {
  httplib::Client client(server.endpoint().address, server.endpoint().port);
  client.set_read_timeout(20);
  return client;
}

TEST(LiveServer, ServesThePageWithAPolicyThatLetsNothingIn) {
  const LiveServer server(options_of());
  auto client = client_of(server);
  for (const char* const path : {"/", "/page.css", "/page.js", "/state.js", "/charts.js", "/arm.js", "/icon.svg"}) {
    const auto answer = client.Get(path);
    ASSERT_TRUE(answer) << path;
    EXPECT_EQ(answer->status, 200) << path;
    EXPECT_GT(answer->body.size(), 100u) << path;
    const std::string policy = answer->get_header_value("Content-Security-Policy");
    EXPECT_THAT(policy, HasSubstr("default-src 'none'"));
    EXPECT_THAT(policy, HasSubstr("frame-ancestors 'none'"));
    EXPECT_EQ(policy.find("unsafe"), std::string::npos);
    EXPECT_EQ(policy.find("http"), std::string::npos);
    EXPECT_EQ(answer->get_header_value("X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(answer->get_header_value("Referrer-Policy"), "no-referrer");
    EXPECT_FALSE(answer->has_header("Access-Control-Allow-Origin"));
    // No file names another place to fetch from; the icon names its own language.
    const bool is_icon = std::string(path) == "/icon.svg";
    EXPECT_TRUE(is_icon || answer->body.find("://") == std::string::npos) << path;
  }
}

TEST(LiveServer, TellsStateAndEventsAsTheyWerePublished) {
  LiveServer server(options_of());
  server.set_state("{\"demecal_state\":1}\n");
  for (int i = 1; i <= 5; ++i) server.publish("{\"i\":" + std::to_string(i) + "}", "");
  auto client = client_of(server);
  EXPECT_EQ(client.Get("/api/state")->body, "{\"demecal_state\":1}\n");
  EXPECT_EQ(client.Get("/api/events")->body, "{\"i\":1}\n{\"i\":2}\n{\"i\":3}\n{\"i\":4}\n{\"i\":5}\n");
  const auto rest = client.Get("/api/events?after=3");
  EXPECT_EQ(rest->body, "{\"i\":4}\n{\"i\":5}\n");
  EXPECT_EQ(rest->get_header_value("Demecal-Last-Event"), "5");
  EXPECT_EQ(client.Get("/api/events?after=x")->status, 400);
  EXPECT_EQ(client.Get("/api/events?after=-1")->status, 400);
}

TEST(LiveServer, StreamsEventsAsTheyComeAndGoesOnWhereAReaderLeftOff) {
  LiveServer server(options_of());
  server.publish("first", "");
  server.publish("second", "");
  auto client = client_of(server);
  std::string told;
  httplib::Headers behind{{"Last-Event-ID", "1"}};
  client.Get("/api/stream", behind, [&](const char* data, std::size_t size) {
    told.append(data, size);
    if (told.find("second") != std::string::npos && told.find("third") == std::string::npos)
      server.publish("third", "");
    return told.find("third") == std::string::npos;
  });
  EXPECT_EQ(told, "id: 2\ndata: second\n\nid: 3\ndata: third\n\n");
  EXPECT_TRUE(becomes_true([&] { return server.streams() == 0; }));
}

TEST(LiveServer, IsReadOnly) {
  const LiveServer server(options_of());
  auto client = client_of(server);
  for (const char* const path : {"/", "/api/state", "/api/events", "/nothing"}) {
    EXPECT_EQ(client.Post(path, "x", "text/plain")->status, 405) << path;
    EXPECT_EQ(client.Put(path, "x", "text/plain")->status, 405) << path;
    EXPECT_EQ(client.Delete(path)->status, 405) << path;
    EXPECT_EQ(client.Options(path)->status, 405) << path;
  }
  EXPECT_EQ(client.Head("/api/state")->status, 200);
  EXPECT_EQ(client.Get("/page.js", {{"Range", "bytes=0-,0-,0-"}})->status, 416);
  for (const char* const path :
       {"/nothing", "/../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/api/", "/page.js/", "/api/stream/x"}) {
    EXPECT_EQ(client.Get(path)->status, 404) << path;
  }
}

TEST(LiveServer, RefusesNamesThatAreNotItsOwn) {
  const LiveServer server(options_of());
  auto client = client_of(server);
  for (const char* const path : {"/", "/api/state", "/api/stream"}) {
    const auto answer = client.Get(path, httplib::Headers{{"Host", "evil.example"}});
    EXPECT_EQ(answer->status, 421) << path;
    EXPECT_EQ(answer->body.find("demecal_state"), std::string::npos);
  }
}

TEST(LiveServer, TellsOfARunOnlyWhoShowsTheToken) {
  LiveServer server(options_of("0123456789abcdef"));
  server.set_state("{\"demecal_state\":1}\n");
  EXPECT_THAT(server.address(), HasSubstr("/#token=0123456789abcdef"));
  auto client = client_of(server);
  for (const char* const path : {"/api/state", "/api/events", "/api/stream", "/api/nothing"}) {
    EXPECT_EQ(client.Get(path)->status, 401) << path;
    EXPECT_EQ(client.Get(path, httplib::Headers{{"Authorization", "Bearer 0123456789abcdee"}})->status, 401) << path;
    EXPECT_EQ(client.Get(std::string(path) + "?token=0123456789abcdef")->status, 401) << path;
  }
  EXPECT_EQ(client.Get("/")->status, 200);
  const auto shown = client.Get("/api/state", httplib::Headers{{"Authorization", "Bearer 0123456789abcdef"}});
  EXPECT_EQ(shown->body, "{\"demecal_state\":1}\n");
}

TEST(LiveServer, CapsStreamsAndConnectionsAndServesAgainWhenTheyEnd) {
  LiveServerOptions options;
  options.most_connections = 4;
  options.most_streams = 2;
  LiveServer server(options);
  {
    const RawConnection first(server.endpoint().port), second(server.endpoint().port), third(server.endpoint().port);
    for (const RawConnection* one : {&first, &second}) one->send("GET /api/stream HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_TRUE(becomes_true([&] { return server.streams() == 2; }));
    third.send("GET /api/stream HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_THAT(third.first_line(), HasSubstr("503"));
    std::vector<std::unique_ptr<RawConnection>> many;
    for (int i = 0; i < 8; ++i)
      many.push_back(std::make_unique<RawConnection>(server.endpoint().port));  // that say nothing
  }
  EXPECT_TRUE(becomes_true([&] { return server.streams() == 0; }));
  EXPECT_EQ(client_of(server).Get("/api/state")->status, 200);
}

TEST(LiveServer, DropsABrowserThatIsStoppedAndNeverWaitsForIt) {
  LiveServerOptions options;
  options.write_timeout_s = 1;
  LiveServer server(options);
  const RawConnection stopped(server.endpoint().port, 4096);  // reads nothing
  stopped.send("GET /api/stream HTTP/1.1\r\nHost: localhost\r\n\r\n");
  ASSERT_TRUE(becomes_true([&] { return server.streams() == 1; }));
  const std::string line(4000, 'x');
  double longest_s = 0.0;
  const bool dropped = becomes_true(
      [&] {
        for (int i = 0; i < 100; ++i) {
          const auto begin = TestClock::now();
          server.publish(line, "key");
          longest_s = std::max(longest_s, Seconds(TestClock::now() - begin).count());
        }
        return server.streams() == 0;
      },
      Seconds(60));
  EXPECT_TRUE(dropped);
  EXPECT_LT(longest_s, 1.0);  // of thousands; a busy machine may take the processor away for a while
  EXPECT_EQ(client_of(server).Get("/api/state")->status, 200);
}

TEST(LiveServer, SurvivesWhatIsNoRequest) {
  const LiveServer server(options_of());
  for (const std::string& bytes :
       {std::string("\0\1\2\3\r\n\r\n", 8), std::string("GET\r\n\r\n"), std::string("GET / HTTP/9.9\r\n\r\n"),
        "GET /" + std::string(20000, 'a') + " HTTP/1.1\r\n\r\n",
        "GET / HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(20000, 'a') + "\r\n\r\n",
        std::string("GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 99999999999999999999\r\n\r\n"),
        std::string("GET / HTTP/1.1\r\n\r\n"),
        std::string("GET /api/events?after=99999999999999999999999 HTTP/1.1\r\nHost: localhost\r\n\r\n")}) {
    const RawConnection hostile(server.endpoint().port);
    ASSERT_TRUE(hostile.connected());
    hostile.send(bytes);
    EXPECT_THAT(hostile.first_line(), testing::Not(HasSubstr(" 200 "))) << bytes.substr(0, 60);
  }
  EXPECT_EQ(client_of(server).Get("/api/state")->status, 200);
}

TEST(LiveServer, SaysWhereItCannotListen) {
  const LiveServer server(options_of());
  LiveServerOptions same;
  same.endpoint = server.endpoint();
  EXPECT_THROW(LiveServer{same}, InputError);
  LiveServerOptions elsewhere;
  elsewhere.endpoint = {"192.0.2.1", 0};
  EXPECT_THROW(LiveServer{elsewhere}, InputError);
}

TEST(LiveServer, EndsAtOnceWhoeverLooks) {
  auto server = std::make_unique<LiveServer>(options_of());
  const RawConnection looking(server->endpoint().port), silent(server->endpoint().port);
  looking.send("GET /api/stream HTTP/1.1\r\nHost: localhost\r\n\r\n");
  ASSERT_TRUE(becomes_true([&] { return server->streams() == 1; }));
  const auto begin = TestClock::now();
  server.reset();
  EXPECT_LT(Seconds(TestClock::now() - begin).count(), 10.0);
}

}  // namespace
}  // namespace demecal
