// Clients that are slow, silent, many or large: a user is served all the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <sys/resource.h>

#include <algorithm>
#include <memory>
#include <thread>
#include <vector>

#include "http/user_server.hpp"
#include "raw_connection.hpp"
#include "served_users.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

TEST_F(ServedUsers, AreCutWhereTheyAreSlow) {
  serve(hasty(4));
  const RawConnection silent(port()), dripping(port()), slow_body(port());
  slow_body.send("POST /api/jobs/a/files/x HTTP/1.1\r\nHost: localhost\r\nDemecal-Request: 1\r\nContent-Type: " +
                 std::string(kBytes) + "\r\nContent-Length: 100000\r\n\r\n");
  const auto begin = TestClock::now();
  // A byte now and then is no reason to wait longer.
  while (dripping.sends("x") && Seconds(TestClock::now() - begin).count() < 10.0) {
    slow_body.sends("y");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_LT(Seconds(TestClock::now() - begin).count(), 5.0);
  EXPECT_TRUE(becomes_true([&] { return server_->connections() == 0; }, Seconds(5)));
  EXPECT_LT(Seconds(TestClock::now() - begin).count(), 8.0);
  EXPECT_EQ(listener_.asked.size(), 0U);
  EXPECT_EQ(client().Get("/api/jobs")->status, 200);
}

TEST_F(ServedUsers, AreCutWhereTheyTakeNothing) {
  const UserServer server(hasty(4),
                          [](const ServiceRequest&) -> ServiceAnswer { return {.body = std::string(20 << 20, 'x')}; });
  const RawConnection stopped(server.endpoint().port, 4096);
  stopped.send("GET /api/jobs HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_TRUE(becomes_true([&] { return server.connections() == 1; }));
  EXPECT_TRUE(becomes_true([&] { return server.connections() == 0; }, Seconds(8)));
}

TEST_F(ServedUsers, SendHeadersOfBoundedSize) {
  serve(hasty(4));
  const RawConnection endless(port()), many(port());
  std::string long_line = "GET /", lines = "GET / HTTP/1.1\r\nHost: localhost\r\n";
  long_line.append(100000, 'a');
  for (int i = 0; i < 1000; ++i) lines += "X-" + std::to_string(i) + ": y\r\n";
  endless.sends(long_line);
  many.sends(lines + "\r\n");
  EXPECT_THAT(endless.all(), testing::Not(HasSubstr(" 200 ")));
  EXPECT_THAT(many.all(), testing::Not(HasSubstr(" 200 ")));
  EXPECT_EQ(client().Get("/api/jobs")->status, 200);
}

TEST_F(ServedUsers, AreServedWhileAThousandOthersConnectAndAreSilent) {
  rlimit files{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &files), 0);
  files.rlim_cur = std::max<rlim_t>(files.rlim_cur, std::min<rlim_t>(files.rlim_max, 4096));
  ::setrlimit(RLIMIT_NOFILE, &files);
  UserServerOptions options;
  options.bounds.header_time = std::chrono::minutes(10);  // none goes by itself
  serve(options);
  std::vector<std::unique_ptr<RawConnection>> silent;
  std::thread crowd([&] {
    for (int i = 0; i < 1000; ++i) silent.push_back(std::make_unique<RawConnection>(port()));
  });
  std::size_t most = 0;
  for (int i = 0; i < 20; ++i) {
    const auto answer = client().Get("/api/jobs");
    EXPECT_TRUE(answer && answer->status == 200) << i;
    most = std::max(most, server_->connections());
  }
  crowd.join();
  EXPECT_EQ(silent.size(), 1000U);
  EXPECT_LE(std::max(most, server_->connections()), options.most_connections);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(client().Get("/api/jobs")->status, 200);
  const auto begin = TestClock::now();
  server_.reset();
  EXPECT_LT(Seconds(TestClock::now() - begin).count(), 10.0);
}

TEST_F(ServedUsers, UploadOnlySoMuchAtATime) {
  UserServerOptions options;
  options.most_uploads_each = 1;
  serve(options);
  const std::string head =
      "POST /api/jobs/a/files/x HTTP/1.1\r\nHost: localhost\r\nDemecal-Request: 1\r\nContent-Type: " +
      std::string(kBytes) + "\r\nContent-Length: 5\r\n\r\n";
  // Whichever is heard first may upload; the other is told so.
  const RawConnection one(port()), other(port());
  one.send(head);
  other.send(head);
  ASSERT_TRUE(becomes_true([&] { return one.is_answered() || other.is_answered(); }));
  const RawConnection &refused = one.is_answered() ? one : other, &heard = one.is_answered() ? other : one;
  EXPECT_THAT(refused.first_line(), HasSubstr(" 503 "));
  EXPECT_EQ(client().Post("/api/jobs/a/files/x", kMeant, "hello", kBytes)->status, 503);
  heard.send("hello");
  EXPECT_THAT(heard.first_line(), HasSubstr(" 200 "));
  EXPECT_TRUE(
      becomes_true([&] { return client().Post("/api/jobs/a/files/x", kMeant, "hello", kBytes)->status == 200; }));
}

}  // namespace
}  // namespace demecal
