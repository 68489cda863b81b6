// Who takes part: identities of participants, the runs that are theirs, and which workers and calibrations are alive.
#pragma once

#include <array>
#include <chrono>
#include <compare>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "protocol/messages.hpp"

namespace demecal::inline transport {

class Mailbox;

/// What distinguishes a network's participants: of DDS the GUID prefix.
using ParticipantId = std::array<std::uint8_t, 12>;

/// The participant of the worker with this name, computed from the name: no other participant can publish for it, since
/// DDS knows no two of one GUID. It is no secret and no signature: whoever forges packets below DDS can forge it.
ParticipantId participant_of(std::string_view worker);

/// A number for a run that shows who publishes its data: nobody else can begin it, or end it while that participant is
/// there. `serial` tells its runs apart. The highest bit says that the number shows that.
std::uint64_t run_of(const ParticipantId& publisher, std::uint16_t serial);
/// Whether a run's number lets this participant publish it: it shows this one, or nobody.
bool may_publish(const ParticipantId& publisher, std::uint64_t run);
/// Whether the number shows who publishes the run.
bool shows_publisher(std::uint64_t run);

/// Whether two runs show the same publisher; of those that show nobody, whether they are one.
bool have_one_publisher(std::uint64_t a, std::uint64_t b);

/// As RTPS writes it: "01.0f.…".
std::string to_string(const ParticipantId& participant);

/// So long after a participant went it may come back: a network that was cut heals.
inline constexpr std::chrono::seconds kLongestAbsence{60};

/// What DDS calls a publication handle: a participant's GUID prefix, and which of its writers.
using WriterId = std::array<std::uint8_t, 16>;
ParticipantId participant_of(const WriterId& writer);

/// Puts statuses and losses into a mailbox in the order in which they are true. Any thread may call.
class Presence {
 public:
  explicit Presence(Mailbox& mailbox) : mailbox_(mailbox) {}

  /// A status was read: put where it is news, that is, changed or of a worker that was lost.
  void receive(const WriterId& writer, WorkerStatus status);
  /// The writer's liveliness ran out: the worker is lost, unless its last status says that it leaves.
  void lost_liveliness(const WriterId& writer);
  /// The writer's liveliness is back: a lost worker is announced again by its last status.
  void regained_liveliness(const WriterId& writer);
  /// The writer is gone for good, as when its process ends: lost, unless it leaves or is lost already.
  void departed(const WriterId& writer);

 private:
  struct Worker {
    WorkerStatus status;
    bool lost = false;
  };
  void lose(const WriterId& writer, Worker& worker);

  Mailbox& mailbox_;
  std::mutex mutex_;
  std::map<WriterId, Worker> workers_;
};

/// Which calibrations' news have a writer. Any thread may call.
class CalibrationPresence {
 public:
  explicit CalibrationPresence(Mailbox& mailbox) : mailbox_(mailbox) {}

  /// News were read: put, unless another writer publishes for that calibration; whether they were.
  bool receive(const WriterId& writer, LoopNews news);
  /// What was found was read: put, unless another participant publishes news for that calibration; whether it was.
  bool receive(const WriterId& writer, CauseFound cause);
  bool receive(const WriterId& writer, FinalFigures figures);
  /// The writer is gone for good: its calibration is lost, unless its last stage says that it is over.
  void departed(const WriterId& writer);

 private:
  struct Calibration {
    std::uint64_t number = 0;
    bool is_over = false;
  };

  template <class Finding>
  bool receive_finding(const WriterId& writer, Finding finding);

  Mailbox& mailbox_;
  std::mutex mutex_;
  std::map<WriterId, Calibration> calibrations_;  ///< by their writers of news
};

}  // namespace demecal::inline transport
