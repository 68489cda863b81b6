// Which workers are there, told from what their writers of WorkerStatus say and from when those fall silent.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <mutex>

#include "transport/mailbox.hpp"

namespace demecal {

/// What DDS calls a publication handle: a participant's GUID prefix, and which of its writers.
/// So long after a participant went it may come back: a network that was cut heals.
inline constexpr std::chrono::seconds kLongestAbsence{60};

using WriterId = std::array<std::uint8_t, 16>;
ParticipantId participant_of(const WriterId& writer);

/// Puts statuses and losses into a mailbox in the order in which they are true. Any thread may call.
class Presence {
 public:
  explicit Presence(Mailbox& mailbox) : mailbox_(mailbox) {}

  /// A status was read: put where it is news, that is, changed or of a worker that was lost.
  void heard(const WriterId& writer, WorkerStatus status);
  /// The writer's liveliness ran out: the worker is lost, unless it said that it leaves.
  void fell_silent(const WriterId& writer);
  /// The writer's liveliness is back: a lost worker is announced again by its last status.
  void spoke_again(const WriterId& writer);
  /// The writer is gone for good, as when its process ends: lost, unless it said that it leaves or is lost already.
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
class Heralds {
 public:
  explicit Heralds(Mailbox& mailbox) : mailbox_(mailbox) {}

  /// News were read: put, unless another writer tells of that calibration; whether they were.
  bool heard(const WriterId& writer, LoopNews news);
  /// The writer is gone for good, whether or not it had said all.
  void departed(const WriterId& writer);

 private:
  Mailbox& mailbox_;
  std::mutex mutex_;
  std::map<WriterId, std::uint64_t> calibrations_;
};

}  // namespace demecal
