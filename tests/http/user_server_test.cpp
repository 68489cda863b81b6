// The server that lets users change something, over real HTTP and against hostile clients: other sites, tokens, sizes,
// names and paths.
#include "http/user_server.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <memory>
#include <vector>

#include "errors/input_error.hpp"
#include "raw_connection.hpp"
#include "served_users.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(ServedUsers, GetAPageThatFetchesNothingFromElsewhere) {
  for (const char* const path : {"/", "/page.css", "/jobs.css", "/jobs.js", "/icon.svg"}) {
    const auto answer = client().Get(path);
    ASSERT_TRUE(answer) << path;
    EXPECT_EQ(answer->status, 200) << path;
    const std::string policy = answer->get_header_value("Content-Security-Policy");
    EXPECT_THAT(policy, HasSubstr("default-src 'none'"));
    EXPECT_EQ(policy.find("unsafe"), std::string::npos);
    EXPECT_FALSE(answer->has_header("Access-Control-Allow-Origin"));
    EXPECT_TRUE(std::string(path) == "/icon.svg" || answer->body.find("://") == std::string::npos) << path;
  }
}

TEST_F(ServedUsers, AreHeardWithWhatTheySend) {
  EXPECT_EQ(client().Get("/api/jobs/a/results/report.html?save=1")->status, 200);
  EXPECT_EQ(client().Post("/api/jobs/a/files/x.csv", kMeant, std::string("1,2\0,3", 6), kBytes)->status, 200);
  ASSERT_EQ(listener_.asked.size(), 2U);
  EXPECT_FALSE(listener_.asked[0].changes);
  EXPECT_THAT(listener_.asked[0].path, ElementsAre("jobs", "a", "results", "report.html"));
  EXPECT_EQ(listener_.asked[0].parameters.at("save"), "1");
  EXPECT_TRUE(listener_.asked[1].changes);
  EXPECT_EQ(listener_.asked[1].body, std::string("1,2\0,3", 6));
  EXPECT_EQ(listener_.asked[1].user, "local");
}

TEST_F(ServedUsers, AreNoOtherSitesPages) {
  const std::string own = "127.0.0.1:" + std::to_string(port());
  const auto post = [&](httplib::Headers headers) {
    headers.emplace("Host", own);
    return client().Post("/api/jobs/a/run", headers, "", kBytes)->status;
  };
  EXPECT_EQ(post({{"Demecal-Request", "1"}}), 200);
  EXPECT_EQ(post({{"Demecal-Request", "1"}, {"Origin", "http://" + own}, {"Sec-Fetch-Site", "same-origin"}}), 200);
  for (const httplib::Headers& foreign :
       {httplib::Headers{}, httplib::Headers{{"Demecal-Request", "0"}}, httplib::Headers{{"Origin", "http://" + own}},
        httplib::Headers{{"Demecal-Request", "1"}, {"Origin", "http://evil.example"}},
        httplib::Headers{{"Demecal-Request", "1"}, {"Origin", "null"}},
        httplib::Headers{{"Demecal-Request", "1"}, {"Origin", "http://" + own + ".evil.example"}},
        httplib::Headers{{"Demecal-Request", "1"}, {"Origin", "http://127.0.0.1:1"}},
        httplib::Headers{{"Demecal-Request", "1"}, {"Sec-Fetch-Site", "cross-site"}},
        httplib::Headers{{"Demecal-Request", "1"}, {"Sec-Fetch-Site", "same-site"}}}) {
    EXPECT_EQ(post(foreign), 403);
  }
  EXPECT_EQ(client().Get("/api/jobs", {{"Sec-Fetch-Site", "cross-site"}})->status, 403);
  EXPECT_EQ(client().Get("/", {{"Sec-Fetch-Site", "cross-site"}})->status, 200);  // a link may lead here
  EXPECT_EQ(client().Get("/api/jobs", {{"Host", "evil.example"}})->status, 421);
  const auto asked_before = client().Options("/api/jobs/a/run");  // as browsers do before a foreign page's request
  EXPECT_EQ(asked_before->status, 405);
  EXPECT_FALSE(asked_before->has_header("Access-Control-Allow-Origin"));
  EXPECT_EQ(listener_.asked.size(), 2U);
}

TEST_F(ServedUsers, ShowTheirTokenOrTheCookieThatItGives) {
  serve(with_token());
  for (const char* const path : {"/api/jobs", "/api/jobs/a/terminal", "/api/nothing"})
    EXPECT_EQ(client().Get(path)->status, 401) << path;
  EXPECT_EQ(client().Post("/api/jobs/a/run", kMeant, "", kBytes)->status, 401);
  EXPECT_EQ(client().Get("/api/jobs", {{"Authorization", "Bearer " + kToken}})->status, 200);
  EXPECT_EQ(client().Get("/api/jobs?token=" + kToken)->status, 401);
  EXPECT_EQ(client().Post("/api/sign-in", kMeant, kToken + "0", kBytes)->status, 401);
  EXPECT_EQ(client().Post("/api/sign-in", kMeant, std::string(300, '0'), kBytes)->status, 413);
  const auto signed_in = client().Post("/api/sign-in", kMeant, kToken, kBytes);
  ASSERT_EQ(signed_in->status, 200);
  const std::string set = signed_in->get_header_value("Set-Cookie"), cookie = set.substr(0, set.find(';'));
  EXPECT_EQ(client().Get("/api/jobs", {{"Cookie", cookie}})->status, 200);
  EXPECT_EQ(listener_.asked.back().user, "ann");
  EXPECT_EQ(client().Post("/api/jobs/a/run", {{"Cookie", cookie}}, "", kBytes)->status, 403);  // another site's form
  EXPECT_EQ(client().Post("/api/sign-out", {{"Cookie", cookie}, {"Demecal-Request", "1"}}, "", kBytes)->status, 200);
  EXPECT_EQ(client().Get("/api/jobs", {{"Cookie", cookie}})->status, 401);
}

TEST_F(ServedUsers, SendNoMoreThanIsAllowed) {
  UserServerOptions options;
  options.most_body_bytes = 1000;
  serve(options);
  EXPECT_EQ(client().Post("/api/jobs/a/files/x", kMeant, std::string(1000, 'x'), kBytes)->status, 200);
  EXPECT_EQ(client().Post("/api/jobs/a/files/x", kMeant, std::string(1001, 'x'), kBytes)->status, 413);
  EXPECT_EQ(client().Post("/api/jobs/a/files/x", kMeant, std::string(400000, 'x'), kBytes)->status, 413);
  EXPECT_EQ(client().Post("/api/jobs/a/files/x", kMeant, "x", "text/plain")->status, 415);
  EXPECT_EQ(client().Post("/api/jobs/a/files/x", kMeant, "x", "multipart/form-data; boundary=y")->status, 415);
  EXPECT_EQ(client().Get("/api/" + std::string(400, 'a'))->status, 414);
  EXPECT_EQ(client().Get("/page.css", {{"Range", "bytes=0-,0-,0-"}})->status,
            416);  // three times as much in one answer
  EXPECT_EQ(client().Get("/page.css", {{"Range", "bytes=0-9"}})->body.size(), 10U);
  const std::string head =
      "POST /api/jobs/a/files/x HTTP/1.1\r\nHost: localhost\r\nDemecal-Request: 1\r\nContent-Type: " +
      std::string(kBytes) + "\r\n";
  for (const std::string& rest :
       {std::string("\r\n"), std::string("Transfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n0\r\n\r\n"),
        std::string("Content-Length: 5\r\nContent-Encoding: gzip\r\n\r\nhello"),
        std::string("Content-Length: -5\r\n\r\nhello"),
        std::string("Content-Length: 99999999999999999999\r\n\r\nhello"),
        std::string("Content-Length: 5x\r\n\r\nhello")}) {
    const RawConnection hostile(port());
    hostile.send(head + rest);
    EXPECT_THAT(hostile.first_line(), HasSubstr(" 4")) << rest;
  }
  EXPECT_EQ(listener_.asked.size(), 1U);
}

TEST_F(ServedUsers, CannotBeNamedByPathsThatClimb) {
  for (const char* const path :
       {"/../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/page.css/..", "//", "/api", "/nothing"})
    EXPECT_EQ(client().Get(path)->status, 404) << path;
  // Below /api/ the parts are given on as they are, decoded once: it is the service that knows names.
  client().Get("/api/jobs/%2e%2e/x");
  ASSERT_EQ(listener_.asked.size(), 1U);
  EXPECT_THAT(listener_.asked[0].path, ElementsAre("jobs", "..", "x"));
}

TEST(UserServer, AnswersFromFilesAndLocksInWhatItShows) {
  const std::string path = ::testing::TempDir() + "demecal-answered-" + std::to_string(::getpid());
  std::string text;
  for (int i = 0; i < 40000; ++i) text += std::to_string(i) + '\n';
  const int written = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0600);
  ASSERT_EQ(::write(written, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  ::close(written);
  const UserServer server({}, [&](const ServiceRequest& request) {
    ServiceAnswer answer;
    answer.file = std::make_shared<AnsweredFile>(::open(path.c_str(), O_RDONLY), text.size());
    answer.file_name = "job-report.html";
    answer.type = "text/html";
    answer.is_shown = request.parameters.empty();
    return answer;
  });
  httplib::Client client("127.0.0.1", server.endpoint().port);
  const auto shown = client.Get("/api/x"), saved = client.Get("/api/x?save=1");
  EXPECT_EQ(shown->body, text);
  EXPECT_EQ(saved->body, text);
  EXPECT_EQ(shown->get_header_value_count("Content-Security-Policy"), 1U);
  EXPECT_THAT(shown->get_header_value("Content-Security-Policy"), HasSubstr("sandbox allow-scripts;"));
  EXPECT_EQ(shown->get_header_value("Content-Security-Policy").find("allow-same-origin"), std::string::npos);
  EXPECT_EQ(saved->get_header_value("Content-Disposition"), "attachment; filename=\"job-report.html\"");
  EXPECT_EQ(saved->get_header_value("Content-Security-Policy").find("unsafe"), std::string::npos);
  ::unlink(path.c_str());
}

TEST(UserServer, SurvivesAServiceThatFails) {
  const UserServer server({}, [](const ServiceRequest&) -> ServiceAnswer { throw std::runtime_error("secret path"); });
  httplib::Client client("127.0.0.1", server.endpoint().port);
  for (int i = 0; i < 3; ++i) {
    const auto answer = client.Get("/api/jobs");
    EXPECT_EQ(answer->status, 500);
    EXPECT_EQ(answer->body.find("secret"), std::string::npos);
  }
}

}  // namespace
}  // namespace demecal
