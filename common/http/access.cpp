#include "http/access.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <ranges>
#include <string_view>
#include <system_error>

#include "errors/check.hpp"
#include "errors/input_error.hpp"

namespace demecal::inline http {
namespace {

constexpr int kMostPort = 65535;

bool is_ipv4(const std::string& text) {
  in_addr address{};
  return ::inet_pton(AF_INET, text.c_str(), &address) == 1;
}

bool is_ipv6(const std::string& text) {
  in6_addr address{};
  return ::inet_pton(AF_INET6, text.c_str(), &address) == 1;
}

bool is_port(std::string_view text) {
  int port = -1;
  const char* const end = text.data() + text.size();
  const auto [stop, fault] = std::from_chars(text.data(), end, port);
  return !text.empty() && fault == std::errc() && stop == end && port >= 0 && port <= kMostPort;
}

/// What stands before the port, and the port, which may be missing.
struct HostAndPort {
  std::string host, port;
  bool bracketed = false;
};

HostAndPort host_and_port(const std::string& text) {
  if (text.starts_with('[')) {
    const std::size_t end = text.find(']');
    if (end == std::string::npos) return {text, "", false};
    const std::string rest = text.substr(end + 1);
    if (!rest.empty() && rest.front() != ':') return {text, "", false};
    return {text.substr(1, end - 1), rest.empty() ? "" : rest.substr(1), true};
  }
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) return {text, "", false};
  return {text.substr(0, colon), text.substr(colon + 1), false};
}

std::string lower(std::string text) {
  for (char& letter : text) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return text;
}

}  // namespace

Endpoint parse_endpoint(const std::string& text, const std::string& option) {
  Endpoint endpoint;
  HostAndPort parts = host_and_port(text);
  if (is_port(text)) parts = {endpoint.address, text, false};
  if (parts.host == "localhost") parts.host = endpoint.address;
  const bool is_numeric = parts.bracketed ? is_ipv6(parts.host) : is_ipv4(parts.host);
  if (!is_numeric || !is_port(parts.port)) {
    throw InputError({option, 0}, text,
                     "must be PORT, ADDRESS:PORT or [ADDRESS]:PORT with a numeric address of this machine and a port "
                     "from 0 (any that is free) to 65535, as in 8080 or 192.0.2.10:8080");
  }
  endpoint.address = parts.host;
  std::from_chars(parts.port.data(), parts.port.data() + parts.port.size(), endpoint.port);
  return endpoint;
}

bool is_loopback(const std::string& address) {
  return (is_ipv4(address) && address.starts_with("127.")) || address == "::1";
}

std::string origin_of(const Endpoint& endpoint) {
  const std::string host = is_ipv6(endpoint.address) ? '[' + endpoint.address + ']' : endpoint.address;
  return "http://" + host + ':' + std::to_string(endpoint.port);
}

bool is_trusted_host(const std::string& host, const Endpoint& endpoint, const std::string& own_name) {
  const HostAndPort parts = host_and_port(host);
  if (!parts.port.empty() && !is_port(parts.port)) return false;
  const std::string name = lower(parts.host);
  if (name == "localhost" && !parts.bracketed) return true;
  const bool is_numeric = parts.bracketed ? is_ipv6(name) : is_ipv4(name);
  if (is_loopback(endpoint.address)) return is_numeric && is_loopback(name);
  return is_numeric || (!own_name.empty() && name == lower(own_name));
}

bool is_same_secret(const std::string& shown, const std::string& secret) {
  if (shown.size() != secret.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < secret.size(); ++i) {
    difference |= static_cast<unsigned char>(shown[i]) ^ static_cast<unsigned char>(secret[i]);
  }
  return difference == 0;
}

bool shows_token(const std::string& authorization, const std::string& token) {
  return is_same_secret(authorization, "Bearer " + token);
}

bool is_same_origin(const std::string& origin, const std::string& host) {
  return !host.empty() && (origin == "http://" + host || origin == "https://" + host);
}

std::string random_token() {
  std::array<std::uint8_t, 16> bytes{};
  const auto drawn = ::getrandom(bytes.data(), bytes.size(), 0);
  DEMECAL_CHECK(drawn == static_cast<ssize_t>(bytes.size()), "drawn=" << drawn);
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string token;
  for (const std::uint8_t byte : bytes) {
    token += kDigits[byte / 16];
    token += kDigits[byte % 16];
  }
  return token;
}

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
