// A server of users whose service keeps what it was asked.
#pragma once

#include <gtest/gtest.h>
#include <httplib.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "http/user_server.hpp"

namespace demecal {

inline const std::string kToken = "0123456789abcdef";
inline const httplib::Headers kMeant{{"Demecal-Request", "1"}};
inline constexpr const char* kBytes = "application/octet-stream";

/// A service that keeps what it was asked.
struct Listener {
  std::mutex mutex;
  std::vector<ServiceRequest> asked;

  ServiceAnswer operator()(const ServiceRequest& request) {
    const std::lock_guard lock(mutex);
    asked.push_back(request);
    return {.body = "{}\n"};
  }
};

inline UserServerOptions with_token() {
  UserServerOptions options;
  options.tokens = {{"ann", kToken}};
  return options;
}

/// Small bounds, so that tests need not wait for the usual ones.
inline UserServerOptions hasty(std::size_t connections) {
  UserServerOptions options;
  options.most_connections = connections;
  options.bounds = {std::chrono::milliseconds(400), std::chrono::milliseconds(900), 4096};
  return options;
}

class ServedUsers : public ::testing::Test {
 protected:
  explicit ServedUsers(const UserServerOptions& options = {})
      : server_(std::make_unique<UserServer>(options,
                                             [this](const ServiceRequest& request) { return listener_(request); })) {}

  void serve(const UserServerOptions& options) {
    server_.reset();
    server_ =
        std::make_unique<UserServer>(options, [this](const ServiceRequest& request) { return listener_(request); });
  }
  httplib::Client client() const {
    httplib::Client made("127.0.0.1", port());
    made.set_read_timeout(20);
    return made;
  }
  int port() const { return server_->endpoint().port; }

  Listener listener_;
  std::unique_ptr<UserServer> server_;
};

}  // namespace demecal
