// One participant in a DDS domain, and the writers and readers made from it: how it reaches the others, and the name,
// type and quality of service of each topic, as idl/calibration.idl states them.
#pragma once

#include <chrono>
#include <cstdint>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "dds/dds_transport.hpp"
#include "protocol/messages.hpp"
#include "transport/participants.hpp"

namespace demecal::inline dds {

/// What writers take and readers give: nothing where bytes came that are no such message, so that the reader learns who
/// sent them. `Plain` is what travels on the topic.
template <class Plain>
using Sample = std::optional<Plain>;

/// What is large travels in MessageParts, Progress with its place, all else as it is.
eprosima::fastdds::dds::TypeSupport topic_type(Topic topic);

/// The name on the wire; `joint` (from 0) matters for migrants alone.
std::string topic_name(Topic topic, std::uint32_t joint = 0);

eprosima::fastdds::dds::DataWriterQos writer_qos(Topic topic);
/// As the topic's writers offer it where `reliably`, else BEST_EFFORT: what passes while one looks.
eprosima::fastdds::dds::DataReaderQos reader_qos(Topic topic, bool reliably = true);

/// A length of time as Fast DDS takes it.
eprosima::fastrtps::Duration_t dds_duration(std::chrono::milliseconds time);

/// The name of the certificate by which a role takes part: a reporter publishes for its coordinator.
std::string certificate_name(Role role);

/// A worker's participant is the one that its name stands for (participant_of). Throws InputError where a peer or the
/// discovery server is no address, or a file of the security folder is missing.
eprosima::fastdds::dds::DomainParticipantQos participant_qos(const DdsOptions& options, Role role,
                                                             const std::string& name);

/// A participant's listener, called on Fast DDS's threads. A sentence goes to standard error for each participant with
/// which this one does not talk because of certificates; from a reporter none, since its coordinator logs the same.
class PeerLog final : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  using Clock = std::chrono::steady_clock;

  PeerLog(bool secured, Role role) : secured_(secured), silent_(role == Role::reporter) {}

  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& found) override;
  void onParticipantAuthentication(eprosima::fastdds::dds::DomainParticipant* participant,
                                   eprosima::fastrtps::rtps::ParticipantAuthenticationInfo&& result) override;

  /// What a participant that is there calls itself; its GUID prefix where it is not known.
  std::string name_of(const ParticipantId& participant);

  /// Logs those whose handshake takes too long: who begins one gets no notice that the other end does not accept it.
  void log_unauthenticated(Clock::time_point now);

 private:
  using Guid = eprosima::fastrtps::rtps::GUID_t;
  struct Other {
    std::string name;
    std::string place;  ///< its address, as it announces it
    Clock::time_point found;
    bool settled;  ///< whether it was accepted, or logged
  };
  void log(Other& other, const std::string& what) const;

  const bool secured_;
  const bool silent_;
  std::mutex mutex_;
  std::map<Guid, Other> others_;  ///< those that are there
};

/// A DDS entity together with how its maker takes it back.
template <class Entity>
using Owned = std::unique_ptr<Entity, std::function<void(Entity*)>>;

class DdsParticipant {
 public:
  /// Joins the domain; the role matters where certificates are shown. Throws InputError where an address is none or a
  /// certificate is missing or not accepted, std::runtime_error where Fast DDS refuses.
  DdsParticipant(const DdsOptions& options, Role role, const std::string& name);

  /// An end of a topic (with `joint` from 0, for migrants); it must not outlive the participant, nor the listener the
  /// reader. Throws std::runtime_error where Fast DDS refuses.
  Owned<eprosima::fastdds::dds::DataWriter> make_writer(Topic which, std::uint32_t joint = 0);
  Owned<eprosima::fastdds::dds::DataReader> make_reader(Topic which, std::uint32_t joint,
                                                        eprosima::fastdds::dds::DataReaderListener* listener,
                                                        bool reliably = true);

  /// Whether the writer with this handle is one of this participant's.
  bool is_own(const eprosima::fastrtps::rtps::InstanceHandle_t& publication) const;
  /// Whether the writer is of this process: of a participant whose GUID is not made of a name.
  bool is_of_this_process(const eprosima::fastrtps::rtps::InstanceHandle_t& publication) const;
  ParticipantId id() const;
  /// What a participant that is there calls itself; its GUID prefix where it is not known.
  std::string name_of(const ParticipantId& participant) { return peers_.name_of(participant); }

  /// Logs who has had long enough to prove its identity, and has not; to be called now and then.
  void log_unauthenticated() { peers_.log_unauthenticated(std::chrono::steady_clock::now()); }

 private:
  eprosima::fastdds::dds::Topic* topic(Topic which, std::uint32_t joint);

  PeerLog peers_;
  Owned<eprosima::fastdds::dds::DomainParticipant> participant_;
  Owned<eprosima::fastdds::dds::Publisher> publisher_;
  Owned<eprosima::fastdds::dds::Subscriber> subscriber_;
  std::map<std::string, Owned<eprosima::fastdds::dds::Topic>> topics_;
};

}  // namespace demecal::inline dds
