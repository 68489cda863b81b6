// Who asks: users by their tokens, and browsers that have shown one by a cookie.
#pragma once

#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace demecal::inline http {

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

}  // namespace demecal::inline http
