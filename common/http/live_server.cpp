#include "http/live_server.hpp"

#include <httplib.h>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "http/connection_queue.hpp"
#include "http/event_history.hpp"
#include "http/server_setup.hpp"

namespace demecal::inline http {
namespace {

constexpr std::size_t kMostBytesAtOnce = 64 * 1024;
constexpr std::chrono::milliseconds kBeat{1000};  // how long a stream waits for an event at a time
constexpr int kBeatsOfSilence = 3;                // after which a comment shows either whether the other is there
constexpr int kReadTimeout_s = 3;
constexpr std::size_t kMostRequestBytes = 1024;

std::optional<std::uint64_t> number_in(const std::string& text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, fault] = std::from_chars(text.data(), end, number);
  if (text.empty() || fault != std::errc() || stop != end) return std::nullopt;
  return number;
}

/// From which event on a request wants to be told: behind the last that it names; all where it names none.
std::optional<std::uint64_t> last_seen(const httplib::Request& request) {
  if (request.has_param("after")) return number_in(request.get_param_value("after"));
  if (request.has_header("Last-Event-ID")) return number_in(request.get_header_value("Last-Event-ID"));
  return 0;
}

}  // namespace

class LiveServer::Implementation {
 public:
  explicit Implementation(LiveServerOptions options)
      : options_(std::move(options)), history_(options_.most_events), own_name_(name_of_machine()) {
    configure();
    listen();
  }

  ~Implementation() {
    history_.close();
    if (queue_ != nullptr) queue_->end();
    server_.stop();
    listening_.join();
  }

  const LiveServerOptions& options() const { return options_; }
  EventHistory& history() { return history_; }
  std::size_t streams() const { return streams_; }
  void set_state(std::string json) {
    const std::lock_guard lock(mutex_);
    state_ = std::move(json);
  }

 private:
  void configure();
  void listen();
  void route();
  bool admits(const httplib::Request& request, httplib::Response& response) const;
  void stream(const httplib::Request& request, httplib::Response& response);
  bool tell(std::uint64_t& told, int& silent, httplib::DataSink& sink);

  LiveServerOptions options_;
  EventHistory history_;
  std::string own_name_;
  std::string session_ = random_token();  ///< tells a server's numbers of events from those of another
  httplib::Server server_;
  ConnectionQueue* queue_ = nullptr;  ///< the server's
  std::mutex mutex_;
  std::string state_ = "{}\n";
  std::atomic<std::size_t> streams_ = 0;
  std::thread listening_;
};

void LiveServer::Implementation::configure() {
  server_.new_task_queue = [this] {
    queue_ = new ConnectionQueue(options_.most_connections);  // NOLINT: the server deletes it
    return queue_;
  };
  server_.set_default_headers(strict_headers());
  server_.set_read_timeout(kReadTimeout_s);
  server_.set_keep_alive_timeout(kReadTimeout_s);
  server_.set_write_timeout(options_.write_timeout_s);
  server_.set_payload_max_length(kMostRequestBytes);
  server_.set_tcp_nodelay(true);
  server_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    return admits(request, response) ? httplib::Server::HandlerResponse::Unhandled
                                     : httplib::Server::HandlerResponse::Handled;
  });
  server_.set_exception_handler([](const httplib::Request&, httplib::Response& response, std::exception_ptr) {
    refuse(response, 500, "this request could not be answered");
  });
  route();
}

void LiveServer::Implementation::listen() {
  bind(server_, options_.endpoint);
  listening_ = std::thread([this] { server_.listen_after_bind(); });
  while (!server_.is_running()) std::this_thread::yield();
}

/// Only what is read, by a trusted name, and with the token where there is one; files of the page say nothing of a run.
bool LiveServer::Implementation::admits(const httplib::Request& request, httplib::Response& response) const {
  if (request.method != "GET" && request.method != "HEAD") {
    response.set_header("Allow", "GET, HEAD");
    refuse(response, 405, "this page can only be read");
    return false;
  }
  if (request.ranges.size() > 1) {  // an answer would hold all of them
    refuse(response, 416, "one range may be asked for at a time");
    return false;
  }
  const std::string length = request.get_header_value("Content-Length");
  const bool has_body = request.has_header("Transfer-Encoding") || (!length.empty() && length != "0");
  if (has_body) {
    refuse(response, 400, "a request to read has no body");
    return false;
  }
  if (!is_trusted_host(request.get_header_value("Host"), options_.endpoint, own_name_)) {
    refuse(response, 421, "this server does not answer to that name: open " + origin_of(options_.endpoint));
    return false;
  }
  const bool is_open = options_.token.empty() || !request.path.starts_with("/api/");
  if (!is_open && !shows_token(request.get_header_value("Authorization"), options_.token)) {
    response.set_header("WWW-Authenticate", "Bearer");
    refuse(response, 401, "the token is missing or wrong: open the address that `demecal monitor --http` printed");
    return false;
  }
  return true;
}

void LiveServer::Implementation::route() {
  for (const PageFile& file : page_files()) {
    server_.Get(file.path, [&file](const httplib::Request&, httplib::Response& response) {
      response.set_content(file.text.data(), file.text.size(), file.type);
    });
  }
  server_.Get("/api/state", [this](const httplib::Request&, httplib::Response& response) {
    const std::lock_guard lock(mutex_);
    response.set_content(state_, "application/json");
  });
  server_.Get("/api/events", [this](const httplib::Request& request, httplib::Response& response) {
    const auto after = last_seen(request);
    if (!after) return refuse(response, 400, "`after` must be the number of an event");
    std::string lines;
    std::uint64_t last = *after;
    for (const NumberedLine& line : history_.after(last, 16 * kMostBytesAtOnce, std::chrono::milliseconds(0))) {
      lines += *line.text + '\n';
      last = line.number;
    }
    response.set_header("Demecal-Session", session_);
    response.set_header("Demecal-Last-Event", std::to_string(last));
    response.set_content(lines, "application/x-ndjson");
  });
  server_.Get("/api/stream",
              [this](const httplib::Request& request, httplib::Response& response) { stream(request, response); });
  server_.set_error_handler([](const httplib::Request&, httplib::Response& response) {
    if (response.body.empty()) refuse(response, response.status, "there is nothing here");
  });
}

void LiveServer::Implementation::stream(const httplib::Request& request, httplib::Response& response) {
  const auto after = last_seen(request);
  if (!after) return refuse(response, 400, "`after` must be the number of an event");
  if (++streams_ > options_.most_streams) {
    --streams_;
    return refuse(response, 503, "too many pages are open: close one");
  }
  response.set_header("Demecal-Session", session_);
  response.set_chunked_content_provider(
      "text/event-stream",
      [this, told = *after, silent = kBeatsOfSilence](std::size_t, httplib::DataSink& sink) mutable {
        return tell(told, silent, sink);
      },
      [this](bool) { --streams_; });
}

/// The next events of a stream, or that there are none; false where it is to end.
bool LiveServer::Implementation::tell(std::uint64_t& told, int& silent, httplib::DataSink& sink) {
  std::string text;
  for (const NumberedLine& line : history_.after(told, kMostBytesAtOnce, kBeat)) {
    text += "id: " + std::to_string(line.number) + "\ndata: " + *line.text + "\n\n";
    told = line.number;
  }
  if (history_.is_closed()) return false;
  if (text.empty() && ++silent < kBeatsOfSilence) return true;
  if (text.empty()) text = ": nothing new\n\n";
  silent = 0;
  return sink.write(text.data(), text.size());
}

LiveServer::LiveServer(LiveServerOptions options)
    : implementation_(std::make_unique<Implementation>(std::move(options))) {}

LiveServer::~LiveServer() = default;

const Endpoint& LiveServer::endpoint() const {
  return implementation_->options().endpoint;
}

std::string LiveServer::address() const {
  const LiveServerOptions& options = implementation_->options();
  return origin_of(options.endpoint) + '/' + (options.token.empty() ? "" : "#token=" + options.token);
}

std::size_t LiveServer::streams() const {
  return implementation_->streams();
}

void LiveServer::publish(std::string line, std::string key) {
  implementation_->history().add(std::move(line), std::move(key));
}

void LiveServer::set_state(std::string json) {
  implementation_->set_state(std::move(json));
}

}  // namespace demecal::inline http
