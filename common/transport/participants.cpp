#include "transport/participants.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "protocol/stages.hpp"
#include "transport/mailbox.hpp"

namespace demecal::inline transport {
namespace {

constexpr std::uint64_t kShows = 1ULL << 63;
constexpr int kSerialBits = 16;

/// FNV-1a (Fowler, Noll, Vo; 64 bits), and a finish by which every bit of the text reaches every bit of the number
/// (splitmix64, Steele et al. 2014).
std::uint64_t hash(std::string_view text, std::uint64_t salt) {
  std::uint64_t value = 0xcbf29ce484222325ULL ^ salt;
  for (const char byte : text) value = (value ^ static_cast<std::uint8_t>(byte)) * 0x100000001b3ULL;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31);
}

}  // namespace

ParticipantId participant_of(std::string_view worker) {
  ParticipantId id{0x01, 0x0f};  // the vendor of Fast DDS, by which peers know what they may use
  const std::uint64_t first = hash(worker, 0), second = hash(worker, 0x9e3779b97f4a7c15ULL);
  for (std::size_t i = 2; i < id.size(); ++i) {
    const std::uint64_t source = i < 8 ? first : second;
    id[i] = static_cast<std::uint8_t>(source >> (8 * (i % 8)));
  }
  return id;
}

std::uint64_t run_of(const ParticipantId& publisher, std::uint16_t serial) {
  return kShows | (hash({reinterpret_cast<const char*>(publisher.data()), publisher.size()}, 0) << kSerialBits) |
         serial;
}

bool shows_publisher(std::uint64_t run) {
  return (run & kShows) != 0;
}

bool may_publish(const ParticipantId& publisher, std::uint64_t run) {
  return !shows_publisher(run) || run == run_of(publisher, static_cast<std::uint16_t>(run));
}

bool have_one_publisher(std::uint64_t a, std::uint64_t b) {
  return a == b || (shows_publisher(a) && a >> kSerialBits == b >> kSerialBits);
}

std::string to_string(const ParticipantId& participant) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : participant) {
    if (!text.empty()) text += '.';
    text += {kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return text;
}

ParticipantId participant_of(const WriterId& writer) {
  ParticipantId participant{};
  std::copy_n(writer.begin(), participant.size(), participant.begin());
  return participant;
}

void Presence::receive(const WriterId& writer, WorkerStatus status) {
  const std::lock_guard lock(mutex_);
  const auto known = workers_.find(writer);
  if (known != workers_.end() && !known->second.lost && known->second.status == status) return;
  mailbox_.put(participant_of(writer), status);
  workers_[writer] = {std::move(status), false};
}

void Presence::lost_liveliness(const WriterId& writer) {
  const std::lock_guard lock(mutex_);
  const auto worker = workers_.find(writer);
  if (worker != workers_.end()) lose(writer, worker->second);
}

void Presence::regained_liveliness(const WriterId& writer) {
  const std::lock_guard lock(mutex_);
  const auto worker = workers_.find(writer);
  if (worker == workers_.end() || !worker->second.lost) return;
  worker->second.lost = false;
  mailbox_.put(participant_of(writer), worker->second.status);
}

void Presence::departed(const WriterId& writer) {
  const std::lock_guard lock(mutex_);
  const auto worker = workers_.find(writer);
  if (worker == workers_.end()) return;
  lose(writer, worker->second);
  workers_.erase(worker);
}

void Presence::lose(const WriterId& writer, Worker& worker) {
  if (worker.lost || worker.status.leaving) return;
  worker.lost = true;
  mailbox_.put(participant_of(writer), WorkerLost{worker.status.worker});
}

bool CalibrationPresence::receive(const WriterId& writer, LoopNews news) {
  const std::lock_guard lock(mutex_);
  const bool is_anothers = std::ranges::any_of(calibrations_, [&](const auto& other) {
    return other.first != writer && other.second.number == news.calibration;
  });
  if (is_anothers) return false;
  Calibration& calibration = calibrations_[writer];
  if (calibration.number != news.calibration) calibration = {news.calibration, false};
  if (news.round == 0) calibration.is_over = is_over(news.stage);
  return mailbox_.put(participant_of(writer), std::move(news));
}

bool CalibrationPresence::receive(const WriterId& writer, CauseFound cause) {
  return receive_finding(writer, std::move(cause));
}

bool CalibrationPresence::receive(const WriterId& writer, FinalFigures figures) {
  return receive_finding(writer, std::move(figures));
}

template <class Finding>
bool CalibrationPresence::receive_finding(const WriterId& writer, Finding finding) {
  const ParticipantId source = participant_of(writer);
  const std::lock_guard lock(mutex_);
  const bool is_anothers = std::ranges::any_of(calibrations_, [&](const auto& other) {
    return participant_of(other.first) != source && other.second.number == finding.calibration;
  });
  return !is_anothers && mailbox_.put(source, std::move(finding));
}

void CalibrationPresence::departed(const WriterId& writer) {
  const std::lock_guard lock(mutex_);
  const auto gone = calibrations_.extract(writer);
  if (gone && !gone.mapped().is_over) mailbox_.put(participant_of(writer), CalibrationLost{gone.mapped().number});
}

}  // namespace demecal::inline transport
