// A client that does with a connection to this machine what it likes, and a way to wait for what follows.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>

namespace demecal {

using Seconds = std::chrono::duration<double>;
using TestClock = std::chrono::steady_clock;

/// A connection that does with TCP what it likes.
class RawConnection {
 public:
  explicit RawConnection(int port, int receive_bytes = 0) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    if (receive_bytes > 0) ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_bytes, sizeof receive_bytes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    ::inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
    connected_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  }
  ~RawConnection() { ::close(socket_); }
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;

  bool connected() const { return connected_; }
  void send(const std::string& bytes) const {
    EXPECT_EQ(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
  }
  /// Whether bytes are taken: no more are once the other end has closed.
  bool sends(const std::string& bytes) const { return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) > 0; }
  /// Whether something came that was not read yet.
  bool is_answered() const {
    char letter = 0;
    return ::recv(socket_, &letter, 1, MSG_PEEK | MSG_DONTWAIT) == 1;
  }
  /// All that comes until the other end closes.
  std::string all() const {
    std::string text;
    char letter = 0;
    while (::recv(socket_, &letter, 1, 0) == 1) text += letter;
    return text;
  }
  std::string first_line() const {
    std::string line;
    char letter = 0;
    while (::recv(socket_, &letter, 1, 0) == 1 && letter != '\r') line += letter;
    return line;
  }

 private:
  int socket_;
  bool connected_ = false;
};

inline bool becomes_true(const std::function<bool()>& condition, Seconds patience = Seconds(20)) {
  const auto end = TestClock::now() + patience;
  while (!condition() && TestClock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return condition();
}

}  // namespace demecal
