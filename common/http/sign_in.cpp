#include "http/sign_in.hpp"

#include <algorithm>
#include <string_view>

#include "http/access.hpp"

namespace demecal::inline http {
namespace {

constexpr std::string_view kCookie = "demecal-session=";
constexpr std::string_view kCookieRules = "; Path=/; HttpOnly; SameSite=Strict";
constexpr std::string_view kBearer = "Bearer ";
constexpr std::ptrdiff_t kMostSessions = 16;

/// The session that a header Cookie names; empty where it names none.
std::string session_in(const std::string& cookie) {
  std::string_view left = cookie;
  while (!left.empty()) {
    left.remove_prefix(std::min(left.find_first_not_of("; "), left.size()));
    const std::string_view one = left.substr(0, left.find(';'));
    if (one.starts_with(kCookie)) return std::string(one.substr(kCookie.size()));
    left.remove_prefix(one.size());
  }
  return {};
}

}  // namespace

std::optional<std::string> SignIn::user_with(const std::string& token) const {
  std::optional<std::string> found;
  for (const UserToken& known : tokens_) {
    if (is_same_secret(token, known.token)) found = known.user;
  }
  return found;
}

std::optional<std::string> SignIn::user_of(const std::string& authorization, const std::string& cookie) const {
  if (!needs_token()) return everybody_;
  if (!authorization.empty())
    return authorization.starts_with(kBearer) ? user_with(authorization.substr(kBearer.size())) : std::nullopt;
  const std::string session = session_in(cookie);
  if (session.empty()) return std::nullopt;
  const std::lock_guard lock(mutex_);
  std::optional<std::string> found;
  for (const Session& known : sessions_) {
    if (is_same_secret(session, known.id)) found = known.user;
  }
  return found;
}

std::string SignIn::begin_session(const std::string& user) {
  const std::lock_guard lock(mutex_);
  const auto is_theirs = [&](const Session& session) { return session.user == user; };
  if (std::ranges::count_if(sessions_, is_theirs) >= kMostSessions)
    sessions_.erase(std::ranges::find_if(sessions_, is_theirs));
  sessions_.push_back({random_token(), user});
  return std::string(kCookie) + sessions_.back().id + std::string(kCookieRules);
}

std::string SignIn::end_session(const std::string& cookie) {
  const std::string id = session_in(cookie);
  const std::lock_guard lock(mutex_);
  std::erase_if(sessions_, [&](const Session& session) { return is_same_secret(id, session.id); });
  return std::string(kCookie) + std::string(kCookieRules) + "; Max-Age=0";
}

}  // namespace demecal::inline http
