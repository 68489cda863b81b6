// Who may ask a server: where it is served, by which names, and with which token.
#pragma once

#include <string>

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

}  // namespace demecal::inline http
