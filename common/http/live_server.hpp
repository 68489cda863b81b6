// A page for browsers that is alive: its files, the present state and a stream of events, over HTTP. It only tells;
// what it is asked changes nothing, and whoever publishes never waits for a browser.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <string>

#include "http/access.hpp"

namespace demecal::inline http {

struct LiveServerOptions {
  Endpoint endpoint;
  std::string token;                  ///< that requests of state and events must show; empty: none
  std::size_t most_connections = 64;  ///< at once; more wait until one ends
  std::size_t most_streams = 24;      ///< of these, that are told events as they come; more are refused
  std::size_t most_events = 60000;    ///< that are kept for who comes later
  int write_timeout_s = 10;           ///< a browser that takes nothing for so long is dropped
};

class LiveServer {
 public:
  /// Serves from now on. Throws InputError where it cannot listen there.
  explicit LiveServer(LiveServerOptions options);
  /// Ends all connections.
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  /// Where it listens, with the port that was chosen.
  const Endpoint& endpoint() const;
  /// What to open in a browser, with the token in the part of the address that browsers keep to themselves.
  std::string address() const;
  /// Browsers that are being told events.
  std::size_t streams() const;

  /// An event, one line of JSON; `key` as in EventHistory.
  void publish(std::string line, std::string key);
  /// The present state, as one JSON document.
  void set_state(std::string json);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace demecal::inline http
