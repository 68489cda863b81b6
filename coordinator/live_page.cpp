#include "coordinator/live_page.hpp"

#include <utility>

#include "coordinator/commands.hpp"
#include "errors/input_error.hpp"
#include "http/access.hpp"
#include "monitor/events.hpp"
#include "monitor/state_json.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

constexpr double kIslandInterval_s = 0.5;
constexpr double kStateInterval_s = 1.0;
constexpr std::size_t kFewestOfToken = 16;

/// The first line of the file, where it is fit to be sent.
std::string token_in(const std::string& file) {
  const std::string text = read_file(file);
  const std::string token = text.substr(0, text.find_first_of("\r\n"));
  constexpr const char* kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~";
  if (token.size() < kFewestOfToken || token.find_first_not_of(kLetters) != std::string::npos) {
    throw InputError({file, 1}, "", "must be a token of 16 or more letters, digits and -._~");
  }
  return token;
}

LiveServerOptions server_options(const std::string& where, const std::string& token_file) {
  LiveServerOptions options;
  try {
    options.endpoint = parse_endpoint(where);
  } catch (const InputError& error) {
    throw ArgumentError(error.what());
  }
  if (!token_file.empty()) {
    options.token = token_in(token_file);
  } else if (!is_loopback(options.endpoint.address)) {
    options.token = random_token();
  }
  return options;
}

}  // namespace

LivePage::LivePage(const std::string& where, const std::string& token_file, std::string place)
    : place_(std::move(place)), server_(server_options(where, token_file)), events_(kIslandInterval_s) {
  server_.publish(first_event_line(), "");
  server_.set_state(state_json(events_.watched(), 0.0, place_));
}

void LivePage::take(const Message& message, double now_s) {
  publish(events_.take(message, now_s));
}

void LivePage::tick(double now_s) {
  publish(events_.due(now_s));
  if (!changed_ || now_s - state_set_s_ < kStateInterval_s) return;
  server_.set_state(state_json(events_.watched(), now_s, place_));
  state_set_s_ = now_s;
  changed_ = false;
}

void LivePage::publish(std::vector<PacedLine> lines) {
  for (PacedLine& line : lines) {
    server_.publish(std::move(line.text), std::move(line.key));
    changed_ = true;
  }
}

}  // namespace demecal
