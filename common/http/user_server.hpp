// A page and an API for users who may change something: who asks, where from and how much is settled here, before
// anything is read that they send; what is answered is the business of a function.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "http/access.hpp"

namespace demecal::inline http {

/// An open file that is closed when it is no longer answered from.
class AnsweredFile {
 public:
  /// Takes the descriptor over.
  AnsweredFile(int descriptor, std::uint64_t bytes) : descriptor_(descriptor), bytes_(bytes) {}
  ~AnsweredFile();
  AnsweredFile(const AnsweredFile&) = delete;
  AnsweredFile& operator=(const AnsweredFile&) = delete;

  int descriptor() const { return descriptor_; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  int descriptor_;
  std::uint64_t bytes_;
};

/// What a user asks for below /api/.
struct ServiceRequest {
  std::string user;
  bool changes = false;           ///< it came by POST, and from no other site's page
  std::vector<std::string> path;  ///< the parts behind /api/
  std::map<std::string, std::string> parameters;
  std::string body;
};

struct ServiceAnswer {
  int status = 200;
  std::string body{};                    ///< JSON; a sentence where the status is none of success
  std::shared_ptr<AnsweredFile> file{};  ///< in place of the body
  std::string file_name{};               ///< how a browser is to save it
  std::string type = "application/json";
  bool is_shown = false;  ///< a page with scripts of its own: shown, but locked in, so that it can ask nothing here
};

using Service = std::function<ServiceAnswer(const ServiceRequest&)>;

struct UserServerOptions {
  Endpoint endpoint;
  std::vector<UserToken> tokens;  ///< empty: nobody shows one, and everybody is `everybody`
  std::string everybody = "local";
  std::size_t most_connections = 64;  ///< at once; who is silent makes room for who comes
  std::size_t most_body_bytes = 16 << 20;
  std::size_t most_uploads = 8, most_uploads_each = 2;  ///< at once, of all and of one user
  RequestBounds bounds;
};

class UserServer {
 public:
  /// Serves from now on; `service` is called from several threads. Throws InputError where it cannot listen there.
  UserServer(UserServerOptions options, Service service);
  /// Ends all connections.
  ~UserServer();
  UserServer(const UserServer&) = delete;
  UserServer& operator=(const UserServer&) = delete;

  const Endpoint& endpoint() const;
  /// Connections that are being served.
  std::size_t connections() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace demecal::inline http
