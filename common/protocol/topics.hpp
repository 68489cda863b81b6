// Which topic a message travels on, who reads and writes it, and which of its values belong together.
#pragma once

#include <array>
#include <compare>
#include <string>

#include "protocol/messages.hpp"

namespace demecal {

/// What a participant reads and writes: coordinators write data, tasks and control and read the rest but migrants;
/// workers the reverse, with migrants both ways; a herald writes a calibration's loop news, and progress where no
/// worker will, and reads nothing; watchers read data, control, progress, worker status and loop news and write
/// nothing.
enum class Role { coordinator, worker, herald, watcher };

enum class Topic { data, task, control, migrants, progress, checkpoint, outcome, worker, loop };
inline constexpr std::array kTopics{Topic::data,       Topic::task,    Topic::control, Topic::migrants, Topic::progress,
                                    Topic::checkpoint, Topic::outcome, Topic::worker,  Topic::loop};

/// Whether a message travels; the others are made by the transport that delivers them.
bool is_sent(const Message& message);
/// The topic of a message; a WorkerLost has none, and asking for it fails a check.
Topic topic_of(const Message& message);

bool writes(Role role, Topic topic);
bool reads(Role role, Topic topic);
/// Whether this role's reader of the topic asks for what it missed, and acknowledges.
bool reads_reliably(Role role, Topic topic);
/// Whether a writer that leaves waits until what it wrote is acknowledged. No topic that watchers read reliably is.
bool is_awaited(Topic topic);

/// What a value is the latest of: its topic with those of the key fields that the topic has.
struct TopicKey {
  Topic topic = Topic::data;
  RunId run = 0;
  IslandKey island;
  std::string worker;
  std::uint64_t calibration = 0;
  std::uint32_t round = 0;
  auto operator<=>(const TopicKey&) const = default;
};
TopicKey key_of(const Message& message);
/// Whether messages of the topic belong to a run and are withdrawn at its end; Control, which reports the end, stays.
bool ends_with_run(Topic topic);
/// Whether a message of the topic may not fit into a datagram.
bool is_large(Topic topic);

/// How many of a key's values wait for those who come late.
int values_kept(Topic topic);

/// Breaks off where a participant of this role and name may not publish under this key.
void check_may_publish(Role role, const std::string& name, const TopicKey& key);

/// The run that this message ends, or 0.
RunId ended_run(const Message& message);

}  // namespace demecal
