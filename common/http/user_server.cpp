#include "http/user_server.hpp"

#include <httplib.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <exception>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "http/bounded_server.hpp"
#include "http/connection_queue.hpp"
#include "http/server_setup.hpp"

namespace demecal::inline http {
namespace {

constexpr std::size_t kLongestPath = 256;
constexpr std::size_t kMostTokenBytes = 256;
constexpr std::string_view kApi = "/api/";
constexpr const char* kSignIn = "/api/sign-in";
constexpr const char* kSignOut = "/api/sign-out";
constexpr const char* kBodyType = "application/octet-stream";

/// A page that the program wrote from what users uploaded: its scripts run, but as of nowhere, and reach nothing.
constexpr const char* kLockedIn =
    "sandbox allow-scripts; default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

struct Refused {
  int status = 0;
  std::string why;
};

std::vector<std::string> path_parts(std::string_view path) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t slash = path.find('/');
    parts.emplace_back(path.substr(0, slash));
    if (slash == std::string_view::npos) return parts;
    path.remove_prefix(slash + 1);
  }
}

std::optional<std::size_t> length_of_body(const httplib::Request& request) {
  const std::string text = request.get_header_value("Content-Length");
  std::size_t length = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, fault] = std::from_chars(text.data(), end, length);
  if (text.empty() || fault != std::errc() || stop != end) return std::nullopt;
  return length;
}

/// Browsers say where a request comes from; what is no browser has to say that it means it.
std::optional<Refused> refusal_of_site(const httplib::Request& request) {
  const std::string site = request.get_header_value("Sec-Fetch-Site");
  const std::string origin = request.get_header_value("Origin");
  const bool is_foreign = (!site.empty() && site != "same-origin" && site != "none") ||
                          (!origin.empty() && !is_same_origin(origin, request.get_header_value("Host")));
  if (is_foreign && request.path.starts_with(kApi)) return Refused{403, "requests of other sites are refused"};
  if (request.method == "POST" && request.get_header_value("Demecal-Request") != "1")
    return Refused{403, "what changes something needs the header `Demecal-Request: 1`"};
  return std::nullopt;
}

std::optional<Refused> refusal_of_body(const httplib::Request& request, std::size_t most_bytes) {
  if (request.has_header("Transfer-Encoding") || request.has_header("Content-Encoding"))
    return Refused{411, "a body must state its length (Content-Length) and be sent as it is"};
  const auto length = length_of_body(request);
  if (request.method != "POST") {
    if (length.value_or(0) > 0) return Refused{400, "a request to read has no body"};
    return std::nullopt;
  }
  if (!length) return Refused{411, "a body must state its length (Content-Length)"};
  if (*length > most_bytes) return Refused{413, "at most " + std::to_string(most_bytes) + " bytes may be sent at once"};
  if (*length > 0 && request.get_header_value("Content-Type") != kBodyType)
    return Refused{415, std::string("a body must be sent as ") + kBodyType};
  return std::nullopt;
}

void answer_from(const std::shared_ptr<AnsweredFile>& file, const std::string& type, httplib::Response& response) {
  if (file->bytes() == 0) return response.set_content("", type);
  response.set_content_provider(static_cast<std::size_t>(file->bytes()), type,
                                [file](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
                                  std::array<char, 65536> bytes{};
                                  const std::size_t wanted = std::min(length, bytes.size());
                                  const ssize_t got =
                                      ::pread(file->descriptor(), bytes.data(), wanted, static_cast<off_t>(offset));
                                  return got > 0 && sink.write(bytes.data(), static_cast<std::size_t>(got));
                                });
}

}  // namespace

AnsweredFile::~AnsweredFile() {
  ::close(descriptor_);
}

class UserServer::Implementation {
 public:
  Implementation(UserServerOptions options, Service service)
      : options_(std::move(options)),
        service_(std::move(service)),
        sign_in_(options_.tokens, options_.everybody),
        uploads_(options_.most_uploads, options_.most_uploads_each),
        server_(options_.bounds, connections_,
                [this](const httplib::Request& request) { return user_of(request).has_value(); }) {
    configure();
    bind(server_, options_.endpoint);
    server_.let_many_wait();
    listening_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::yield();
  }

  ~Implementation() {
    connections_.cut_all();
    if (queue_ != nullptr) queue_->end();
    server_.stop();
    listening_.join();
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  const UserServerOptions& options() const { return options_; }
  std::size_t connections() const { return connections_.size(); }

 private:
  void configure();
  std::optional<Refused> refusal_of(const httplib::Request& request) const;
  std::optional<std::string> user_of(const httplib::Request& request) const {
    return sign_in_.user_of(request.get_header_value("Authorization"), request.get_header_value("Cookie"));
  }
  void answer(const httplib::Request& request, std::string body, httplib::Response& response);
  void take(const httplib::Request& request, httplib::Response& response, const httplib::ContentReader& read);
  void sign_in(const std::string& token, httplib::Response& response);

  UserServerOptions options_;
  Service service_;
  SignIn sign_in_;
  UploadCount uploads_;
  std::string own_name_ = name_of_machine();
  OpenConnections connections_;
  BoundedServer server_;
  ConnectionQueue* queue_ = nullptr;  ///< the server's
  std::thread listening_;
};

void UserServer::Implementation::configure() {
  server_.new_task_queue = [this] {
    queue_ = new ConnectionQueue(options_.most_connections, [this] { connections_.make_room(); });  // NOLINT
    return queue_;  // the server deletes it
  };
  server_.set_default_headers(strict_headers());
  server_.set_payload_max_length(options_.most_body_bytes);
  server_.set_tcp_nodelay(true);
  server_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    const auto refused = refusal_of(request);
    if (!refused) return httplib::Server::HandlerResponse::Unhandled;
    if (refused->status == 401) response.set_header("WWW-Authenticate", "Bearer");
    refuse(response, refused->status, refused->why);
    return httplib::Server::HandlerResponse::Handled;
  });
  server_.set_exception_handler([](const httplib::Request&, httplib::Response& response, const std::exception_ptr&) {
    refuse(response, 500, "this request could not be answered");
  });
  server_.set_error_handler([](const httplib::Request&, httplib::Response& response) {
    if (response.body.empty()) refuse(response, response.status, "there is nothing here");
  });
  for (const PageFile& file : jobs_page_files()) {
    server_.Get(file.path, [&file](const httplib::Request&, httplib::Response& response) {
      response.set_content(file.text.data(), file.text.size(), file.type);
    });
  }
  server_.Get("/api/.*",
              [this](const httplib::Request& request, httplib::Response& response) { answer(request, "", response); });
  server_.Post("/api/.*", [this](const httplib::Request& request, httplib::Response& response,
                                 const httplib::ContentReader& read) { take(request, response, read); });
}

/// All that can be said of a request before its body is read.
std::optional<Refused> UserServer::Implementation::refusal_of(const httplib::Request& request) const {
  if (request.method != "GET" && request.method != "HEAD" && request.method != "POST")
    return Refused{405, "only GET, HEAD and POST are answered"};
  if (request.path.size() > kLongestPath) return Refused{414, "no address here is as long as that"};
  if (!is_trusted_host(request.get_header_value("Host"), options_.endpoint, own_name_))
    return Refused{421, "this server does not answer to that name: open " + origin_of(options_.endpoint)};
  if (request.ranges.size() > 1) return Refused{416, "one range may be asked for at a time"};
  if (const auto refused = refusal_of_site(request)) return refused;
  const bool is_signing_in = request.path == kSignIn;
  const std::size_t most_bytes = is_signing_in ? kMostTokenBytes : options_.most_body_bytes;
  if (request.path.starts_with(kApi) && !is_signing_in && !user_of(request))
    return Refused{401, "the token is missing or wrong: sign in, or send `Authorization: Bearer TOKEN`"};
  return refusal_of_body(request, most_bytes);
}

void UserServer::Implementation::take(const httplib::Request& request, httplib::Response& response,
                                      const httplib::ContentReader& read) {
  const UploadCount::Upload upload(uploads_, user_of(request).value_or(""));
  if (!upload.has_place()) return refuse(response, 503, "too much is being uploaded: wait until it is done");
  std::string body;
  const std::size_t length = length_of_body(request).value_or(0);
  const bool is_whole = read([&](const char* bytes, std::size_t size) {
    body.append(bytes, size);
    return body.size() <= length;
  });
  if (!is_whole || body.size() != length) return refuse(response, 400, "what was sent ended too early");
  if (request.path == kSignIn) return sign_in(body, response);
  if (request.path == kSignOut)
    return response.set_header("Set-Cookie", sign_in_.end_session(request.get_header_value("Cookie")));
  answer(request, std::move(body), response);
}

void UserServer::Implementation::sign_in(const std::string& token, httplib::Response& response) {
  const auto user = sign_in_.user_with(token);
  if (!user) return refuse(response, 401, "nobody has that token");
  response.set_header("Set-Cookie", sign_in_.begin_session(*user));
}

void UserServer::Implementation::answer(const httplib::Request& request, std::string body,
                                        httplib::Response& response) {
  ServiceRequest asked;
  asked.user = user_of(request).value_or("");
  asked.changes = request.method == "POST";
  asked.path = path_parts(std::string_view(request.path).substr(kApi.size()));
  for (const auto& [name, value] : request.params) asked.parameters[name] = value;
  asked.body = std::move(body);
  const ServiceAnswer answered = service_(asked);
  if (answered.status >= 300) return refuse(response, answered.status, answered.body);
  response.status = answered.status;
  if (answered.is_shown) {
    response.headers.erase("Content-Security-Policy");
    response.set_header("Content-Security-Policy", kLockedIn);
  } else if (!answered.file_name.empty()) {
    response.set_header("Content-Disposition", "attachment; filename=\"" + answered.file_name + '"');
  }
  if (answered.file) return answer_from(answered.file, answered.type, response);
  response.set_content(answered.body, answered.type);
}

UserServer::UserServer(UserServerOptions options, Service service)
    : implementation_(std::make_unique<Implementation>(std::move(options), std::move(service))) {}

UserServer::~UserServer() = default;

const Endpoint& UserServer::endpoint() const {
  return implementation_->options().endpoint;
}

std::size_t UserServer::connections() const {
  return implementation_->connections();
}

}  // namespace demecal::inline http
