// cpp-httplib's server with bounds that hostile clients cannot stretch: the time and size of a request's header, the
// time of everything after it, one request a connection, and room for who speaks where others connect and are silent.
#pragma once

#include <httplib.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <list>
#include <mutex>
#include <utility>

#include "http/access.hpp"

namespace demecal::inline http {

/// Connections that are being served, and which of them have not said yet what they want.
class OpenConnections {
 public:
  /// One that is open for as long as this lives.
  class Entry {
   public:
    Entry(OpenConnections& all, int socket) : all_(all), place_(all.enter(socket)) {}
    ~Entry() { all_.leave(place_); }
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;

    /// A user's request: others are cut first to make room.
    void has_asked() { all_.has_asked(place_); }

   private:
    friend class OpenConnections;
    struct State {
      int socket = -1;
      std::chrono::steady_clock::time_point begin;
      bool has_asked = false, is_cut = false;
    };
    OpenConnections& all_;
    std::list<State>::iterator place_;
  };

  /// Ends the oldest of those that have not asked or, where all have, the oldest that has been served for ten seconds.
  void make_room();
  /// Ends all, and whoever comes from now on.
  void cut_all();
  std::size_t size() const;

 private:
  using Place = std::list<Entry::State>::iterator;
  Place enter(int socket);
  void leave(Place place);
  void has_asked(Place place);

  mutable std::mutex mutex_;
  std::list<Entry::State> entries_;  ///< the oldest first
  bool is_closed_ = false;
};

/// One request a connection. Unless `is_of_user`, all of it has to fit into the bounds of a header.
class BoundedServer final : public httplib::Server {
 public:
  using IsOfUser = std::function<bool(const httplib::Request&)>;

  /// `connections` outlives the server.
  BoundedServer(RequestBounds bounds, OpenConnections& connections, IsOfUser is_of_user)
      : bounds_(bounds), connections_(connections), is_of_user_(std::move(is_of_user)) {}

  /// Once it is bound: the library lets only five wait, and whoever comes beyond that tries again a second later.
  void let_many_wait();

 private:
  bool process_and_close_socket(socket_t socket) override;

  RequestBounds bounds_;
  OpenConnections& connections_;
  IsOfUser is_of_user_;
};

}  // namespace demecal::inline http
