// Which participant owns a run: what others publish about it is rejected.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/messages.hpp"
#include "transport/mailbox.hpp"
#include "transport/participants.hpp"

namespace demecal::inline transport {

/// Puts data, tasks and control into a mailbox. A run belongs to the participant that its number shows, or else to the
/// one whose data come first; what others publish about it is rejected. Tasks and control that come before the data
/// wait for them. An end from elsewhere waits until the owner is gone: a coordinator that resumes a job ends the run
/// that its dead predecessor left. A run that ends without data is over: its data were withdrawn. A run whose owner has
/// been gone for long is over too, for those that wait. Any thread may call.
///
/// Numbers that show nobody serve tests alone: whoever is quick could take such a run.
class RunOwners {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds kLateGrace{2000};

  /// `waits`: whether what comes before its run's data waits for them; otherwise it is put at once.
  RunOwners(Mailbox& mailbox, RejectionLog& rejections, bool waits)
      : mailbox_(mailbox), rejections_(rejections), waits_(waits) {}

  /// `name`: of the source, for people.
  void receive(const ParticipantId& source, const std::string& name, CalibrationData data, Time now);
  void receive(const ParticipantId& source, const std::string& name, IslandTask task, Time now);
  void receive(const ParticipantId& source, const std::string& name, Control control, Time now);
  /// The participant is gone, as far as the network tells.
  void departed(const ParticipantId& source, Time now);
  /// It is there, for the first time or again.
  void arrived(const ParticipantId& source);
  /// Puts the ends that have waited long enough for data, and those of runs whose owner has been gone for too long; to
  /// be called now and then.
  void release(Time now);

 private:
  struct Run {
    ParticipantId owner;
    std::optional<Time> owner_gone{};  ///< since when
    bool is_over = false;
    std::uint64_t order = 0;  ///< of appearance
    std::optional<Control> end_from_elsewhere{};
  };
  /// What one source published about runs without data.
  struct Early {
    struct Entry {
      Message message;
      Time came;
    };
    std::map<TopicKey, Entry> last;  ///< of each key
    std::size_t bytes = 0;
  };

  void put(const ParticipantId& source, const std::string& name, Message message);
  /// Puts a message of the run's owner; whether that, or rejecting it, was all there was to do.
  bool is_settled(const ParticipantId& source, const std::string& name, const Message& message, RunId run);
  void wait(const ParticipantId& source, const std::string& name, Message message, Time now);
  Message take_back(Early& early, std::map<TopicKey, Early::Entry>::iterator entry);
  bool has_room(const ParticipantId& owner) const;
  void forget_first_of_many();
  void end_abandoned(Time now);
  void give_early(RunId run, const ParticipantId& owner, const std::string& name);

  Mailbox& mailbox_;
  RejectionLog& rejections_;
  const bool waits_;
  std::mutex mutex_;
  std::uint64_t order_ = 0;
  std::map<RunId, Run> runs_;
  std::map<ParticipantId, Early> early_;
};

}  // namespace demecal::inline transport
