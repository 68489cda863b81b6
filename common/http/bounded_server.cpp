#include "http/bounded_server.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <ratio>
#include <string>

namespace demecal::inline http {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLingering{500};
constexpr std::chrono::seconds kFairTime{10};
constexpr std::size_t kMostLeftOver = 1 << 20;  // bytes of a refused body that are read so that the answer arrives

/// Whether the socket is ready for `events` before `deadline`.
bool is_ready(int socket, short events, Clock::time_point deadline) {
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
  if (left.count() <= 0) return false;
  pollfd polled{socket, events, 0};
  return ::poll(&polled, 1, static_cast<int>(left.count())) == 1;
}

/// A connection with one deadline for all that is read and written, however slowly, and a bound on the header's bytes.
class DeadlineStream final : public httplib::Stream {
 public:
  DeadlineStream(int socket, const RequestBounds& bounds)
      : socket_(socket), bounds_(bounds), deadline_(Clock::now() + bounds.header_time) {}

  /// The header is over: another deadline, and no bound on bytes.
  void begin_rest() {
    in_header_ = false;
    deadline_ = Clock::now() + bounds_.rest_time;
  }

  bool is_readable() const override { return begin_ < end_ || is_ready(socket_, POLLIN, deadline_); }
  bool is_writable() const override { return is_ready(socket_, POLLOUT, deadline_); }

  ssize_t read(char* bytes, std::size_t size) override {
    if (begin_ == end_) {
      if (!is_ready(socket_, POLLIN, deadline_)) return -1;
      const ssize_t got = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
      if (got <= 0) return got;
      begin_ = 0;
      end_ = static_cast<std::size_t>(got);
    }
    const std::size_t taken = std::min(size, end_ - begin_);
    if (in_header_ && (header_bytes_ += taken) > bounds_.header_bytes) return -1;
    std::memcpy(bytes, buffer_.data() + begin_, taken);
    begin_ += taken;
    return static_cast<ssize_t>(taken);
  }

  ssize_t write(const char* bytes, std::size_t size) override {
    if (!is_writable()) return -1;
    return ::send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
  }

  void get_remote_ip_and_port(std::string& address, int& port) const override {
    address.clear();
    port = 0;
  }
  void get_local_ip_and_port(std::string& address, int& port) const override { get_remote_ip_and_port(address, port); }
  socket_t socket() const override { return socket_; }

 private:
  int socket_;
  const RequestBounds& bounds_;
  Clock::time_point deadline_;
  std::array<char, 16384> buffer_{};
  std::size_t begin_ = 0, end_ = 0, header_bytes_ = 0;
  bool in_header_ = true;
};

/// Closed with bytes unread, a connection is reset, and its client may never see the answer.
void linger(int socket) {
  ::shutdown(socket, SHUT_WR);
  const auto end = Clock::now() + kLingering;
  std::array<char, 16384> bytes{};
  for (std::size_t read = 0; read < kMostLeftOver && is_ready(socket, POLLIN, end);) {
    const ssize_t got = ::recv(socket, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (got <= 0) return;
    read += static_cast<std::size_t>(got);
  }
}

}  // namespace

void OpenConnections::make_room() {
  const std::lock_guard lock(mutex_);
  const auto fair = Clock::now() - kFairTime;
  auto chosen = std::ranges::find_if(entries_, [](const auto& one) { return !one.has_asked && !one.is_cut; });
  if (chosen == entries_.end())
    chosen = std::ranges::find_if(entries_, [&](const auto& one) { return !one.is_cut && one.begin < fair; });
  if (chosen == entries_.end()) return;
  chosen->is_cut = true;
  ::shutdown(chosen->socket, SHUT_RDWR);
}

void OpenConnections::cut_all() {
  const std::lock_guard lock(mutex_);
  is_closed_ = true;
  for (const Entry::State& one : entries_) ::shutdown(one.socket, SHUT_RDWR);
}

std::size_t OpenConnections::size() const {
  const std::lock_guard lock(mutex_);
  return entries_.size();
}

OpenConnections::Place OpenConnections::enter(int socket) {
  const std::lock_guard lock(mutex_);
  if (is_closed_) ::shutdown(socket, SHUT_RDWR);
  return entries_.insert(entries_.end(), {socket, Clock::now(), false, is_closed_});
}

void OpenConnections::leave(Place place) {
  const std::lock_guard lock(mutex_);
  entries_.erase(place);
}

void OpenConnections::has_asked(Place place) {
  const std::lock_guard lock(mutex_);
  place->has_asked = true;
}

void BoundedServer::let_many_wait() {
  ::listen(svr_sock_, SOMAXCONN);
}

bool BoundedServer::process_and_close_socket(socket_t socket) {
  bool is_answered = false;
  {
    OpenConnections::Entry connection(connections_, socket);
    DeadlineStream stream(socket, bounds_);
    bool is_closed = false;
    is_answered = process_request(stream, true, is_closed, [&](httplib::Request& request) {
      if (!is_of_user_(request)) return;
      connection.has_asked();
      stream.begin_rest();
    });
    if (is_answered) linger(socket);
  }
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
  return is_answered;
}

}  // namespace demecal::inline http
