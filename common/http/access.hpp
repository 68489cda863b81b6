// Who may ask a server (where it is served, by which names, with which token or cookie), and how much.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace demecal::inline http {

struct Endpoint {
  std::string address = "127.0.0.1";  ///< numeric, IPv6 without brackets
  int port = 0;                       ///< 0: any that is free
};

/// "PORT", "ADDRESS:PORT" or "[ADDRESS]:PORT"; `localhost` is 127.0.0.1. Throws InputError naming the option and
/// the rule.
Endpoint parse_endpoint(const std::string& text, const std::string& option = "--http");

/// Only programs of this machine reach it.
bool is_loopback(const std::string& address);

/// "http://127.0.0.1:8080".
std::string origin_of(const Endpoint& endpoint);

/// Whether a request's Host may be answered. A page from elsewhere may have its own name resolve to this machine and
/// then read as if it had come from here, but it cannot but send that name: numeric addresses and `localhost` are
/// answered, and `own_name` where the server is not for this machine alone.
bool is_trusted_host(const std::string& host, const Endpoint& endpoint, const std::string& own_name);

/// Whether both are the same; takes as long for every wrong one of its length.
bool is_same_secret(const std::string& shown, const std::string& secret);

/// Whether `Authorization: Bearer TOKEN` shows this token; takes as long for every wrong one of its length.
bool shows_token(const std::string& authorization, const std::string& token);

/// Whether a page of this `Origin` came from the server that `Host` names.
bool is_same_origin(const std::string& origin, const std::string& host);

/// 128 bits from the system's generator, in hexadecimal digits.
std::string random_token();

struct UserToken {
  std::string user, token;
};

class SignIn {
 public:
  /// Whoever asks is `everybody` where `tokens` is empty.
  SignIn(std::vector<UserToken> tokens, std::string everybody)
      : tokens_(std::move(tokens)), everybody_(std::move(everybody)) {}

  bool needs_token() const { return !tokens_.empty(); }

  /// Whose token it is, if anybody's. Takes as long whoever's it is, or nearly.
  std::optional<std::string> user_with(const std::string& token) const;

  /// Who asks, by the headers Authorization and Cookie.
  std::optional<std::string> user_of(const std::string& authorization, const std::string& cookie) const;

  /// The value of Set-Cookie for a browser that this user signs in with. Of one user's, the oldest beyond sixteen end.
  std::string begin_session(const std::string& user);
  /// Ends the session that the header Cookie names; the value of Set-Cookie that makes a browser forget it.
  std::string end_session(const std::string& cookie);

 private:
  struct Session {
    std::string id, user;
  };

  std::vector<UserToken> tokens_;
  std::string everybody_;
  mutable std::mutex mutex_;
  std::deque<Session> sessions_;  ///< the oldest first
};

struct RequestBounds {
  std::chrono::milliseconds header_time{5000};  ///< from accepting a connection to the end of its header
  std::chrono::milliseconds rest_time{120000};  ///< for body and answer
  std::size_t header_bytes = 16384;
};

}  // namespace demecal::inline http
