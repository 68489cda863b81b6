#include "http/server_setup.hpp"

#include <sys/socket.h>
#include <unistd.h>
#include <array>

#include "errors/input_error.hpp"

namespace demecal::inline http {

const httplib::Headers& strict_headers() {
  static const httplib::Headers headers{
      {"Content-Security-Policy",
       "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'; base-uri 'none'; "
       "form-action 'none'; frame-ancestors 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"X-Frame-Options", "DENY"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Permissions-Policy", "camera=(), microphone=(), geolocation=()"},
      {"Cache-Control", "no-store"}};
  return headers;
}

void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(why + "\n", "text/plain; charset=utf-8");
  response.set_header("Connection", "close");
}

std::string name_of_machine() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return {};
  return name.data();
}

void bind(httplib::Server& server, Endpoint& endpoint) {
  // The library's default lets several programs listen on one port, and each would be told of some requests.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  const bool any = endpoint.port == 0;
  const int port = any ? server.bind_to_any_port(endpoint.address) : endpoint.port;
  if (port <= 0 || (!any && !server.bind_to_port(endpoint.address, port))) {
    throw InputError({}, origin_of(endpoint),
                     "cannot be listened on: the port is taken, or the address is not this machine's; name another");
  }
  endpoint.port = port;
}

}  // namespace demecal::inline http
