#include "dds/participant.hpp"

#include <fastrtps/attributes/LibrarySettingsAttributes.h>
#include <fastrtps/types/DynamicDataFactory.h>
#include <fastrtps/types/DynamicTypeBuilderFactory.h>
#include <fastrtps/types/TypeObjectFactory.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#include <algorithm>
#include <cstdio>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/log/StdoutErrConsumer.hpp>
#include <set>
#include <stdexcept>
#include <utility>

#include "errors/input_error.hpp"
#include "protocol/message_bytes.hpp"

namespace demecal::inline dds {
namespace {

namespace fastdds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

/// How long a handshake may take on a busy machine.
constexpr std::chrono::seconds kHandshake{5};

std::string address_text(const rtps::ParticipantProxyData& participant) {
  if (participant.default_locators.unicast.empty()) return "";
  return " at " + rtps::IPLocator::ip_to_string(participant.default_locators.unicast[0]);
}

bool shows_certificate(const rtps::ParticipantProxyData& participant) {
  return !participant.identity_token_.class_id().empty();
}

class OnceEach final : public fastdds::StdoutErrConsumer {
 public:
  /// Called on one thread of the library.
  void Consume(const fastdds::Log::Entry& entry) override {
    constexpr std::size_t kMostKinds = 200;
    std::string kind = entry.message;
    std::erase_if(kind, [](char c) { return c >= '0' && c <= '9'; });
    if (logged_.size() < kMostKinds && logged_.insert(std::move(kind)).second) StdoutErrConsumer::Consume(entry);
  }

 private:
  std::set<std::string> logged_;
};

/// Only errors, on standard error, not where results are printed; each kind of error once, since a participant that
/// sends nonsense can cause one with every packet.
void set_up_log() {
  fastdds::Log::SetVerbosity(fastdds::Log::Kind::Error);
  fastdds::Log::ClearConsumers();
  auto to_stderr = std::make_unique<OnceEach>();
  to_stderr->stderr_threshold(fastdds::Log::Kind::Info);
  fastdds::Log::RegisterConsumer(std::move(to_stderr));
}

/// The library logs errors alone; it takes the same path between participants of one process as between processes; and
/// it has all that it makes types of before a thread of discovery can want it: it guards none of that while it is made.
void set_up_library() {
  static const bool once = [] {
    set_up_log();
    eprosima::fastrtps::types::TypeObjectFactory::get_instance();
    eprosima::fastrtps::types::DynamicTypeBuilderFactory::get_instance();
    eprosima::fastrtps::types::DynamicDataFactory::get_instance();
    eprosima::fastrtps::LibrarySettingsAttributes settings;
    settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
    eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
    return true;
  }();
  static_cast<void>(once);
}

template <class Entity, class Delete>
Owned<Entity> own(Entity* entity, Delete take_back, const std::string& what) {
  if (entity == nullptr) throw std::runtime_error("DDS: cannot make " + what);
  return Owned<Entity>(entity, take_back);
}

Owned<fastdds::DomainParticipant> join_domain(const DdsOptions& options, Role role, const std::string& name,
                                              PeerLog* peers) {
  set_up_library();
  auto* factory = fastdds::DomainParticipantFactory::get_instance();
  auto* participant = factory->create_participant(options.domain, participant_qos(options, role, name), peers,
                                                  fastdds::StatusMask::none());
  if (participant == nullptr && !options.security.empty()) {
    throw InputError(
        {options.security, 0}, certificate_name(role),
        "this certificate, its key or its permissions are not accepted: expired, altered, or of another authority");
  }
  return own(
      participant, [factory](fastdds::DomainParticipant* p) { factory->delete_participant(p); },
      "a participant in domain " + std::to_string(options.domain));
}

}  // namespace

void PeerLog::on_participant_discovery(fastdds::DomainParticipant*, rtps::ParticipantDiscoveryInfo&& found) {
  const std::lock_guard lock(mutex_);
  if (found.status == rtps::ParticipantDiscoveryInfo::REMOVED_PARTICIPANT ||
      found.status == rtps::ParticipantDiscoveryInfo::DROPPED_PARTICIPANT) {
    others_.erase(found.info.m_guid);
    return;
  }
  const bool certified = shows_certificate(found.info);
  const bool settled = !secured_ && !certified;
  const std::string name = printable(found.info.m_participantName.to_string());
  Other& other = others_.try_emplace(found.info.m_guid, Other{name, address_text(found.info), Clock::now(), settled})
                     .first->second;
  if (secured_ && !certified) log(other, "is refused: it shows no certificate");
  if (!secured_ && certified)
    log(other, "does not talk to this one: it demands a certificate, which --security would show");
}

void PeerLog::onParticipantAuthentication(fastdds::DomainParticipant*, rtps::ParticipantAuthenticationInfo&& result) {
  const std::lock_guard lock(mutex_);
  const auto other = others_.find(result.guid);
  if (other == others_.end()) return;
  if (result.status == rtps::ParticipantAuthenticationInfo::UNAUTHORIZED_PARTICIPANT)
    log(other->second, "is refused: its certificate is not valid for the authority of this one");
  other->second.settled = true;
}

std::string PeerLog::name_of(const ParticipantId& participant) {
  Guid guid;
  std::ranges::copy(participant, guid.guidPrefix.value);
  guid.entityId = eprosima::fastrtps::rtps::c_EntityId_RTPSParticipant;
  const std::lock_guard lock(mutex_);
  const auto other = others_.find(guid);
  return other == others_.end() || other->second.name.empty() ? "participant " + to_string(participant)
                                                              : other->second.name;
}

void PeerLog::log_unauthenticated(Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  for (auto& [guid, other] : others_)
    if (now - other.found > kHandshake) log(other, "is kept out: it has not proved its identity for 5 s");
}

void PeerLog::log(Other& other, const std::string& what) const {
  if (!silent_ && !other.settled)
    std::fprintf(stderr, "'%s'%s %s\n", other.name.c_str(), other.place.c_str(), what.c_str());
  other.settled = true;
}

DdsParticipant::DdsParticipant(const DdsOptions& options, Role role, const std::string& name)
    : peers_(!options.security.empty(), role), participant_(join_domain(options, role, name, &peers_)) {
  auto* participant = participant_.get();
  publisher_ = own(
      participant->create_publisher(fastdds::PUBLISHER_QOS_DEFAULT),
      [participant](fastdds::Publisher* p) { participant->delete_publisher(p); }, "a publisher");
  subscriber_ = own(
      participant->create_subscriber(fastdds::SUBSCRIBER_QOS_DEFAULT),
      [participant](fastdds::Subscriber* s) { participant->delete_subscriber(s); }, "a subscriber");
}

Owned<fastdds::DataWriter> DdsParticipant::make_writer(demecal::Topic which, std::uint32_t joint) {
  auto* publisher = publisher_.get();
  return own(
      publisher->create_datawriter(topic(which, joint), writer_qos(which)),
      [publisher](fastdds::DataWriter* writer) { publisher->delete_datawriter(writer); },
      "a writer of " + topic_name(which, joint));
}

Owned<fastdds::DataReader> DdsParticipant::make_reader(demecal::Topic which, std::uint32_t joint,
                                                       fastdds::DataReaderListener* listener, bool reliably) {
  auto* subscriber = subscriber_.get();
  return own(
      subscriber->create_datareader(topic(which, joint), reader_qos(which, reliably), listener),
      [subscriber](fastdds::DataReader* reader) {
        reader->set_listener(nullptr);
        subscriber->delete_datareader(reader);
      },
      "a reader of " + topic_name(which, joint));
}

bool DdsParticipant::is_own(const eprosima::fastrtps::rtps::InstanceHandle_t& publication) const {
  return eprosima::fastrtps::rtps::iHandle2GUID(publication).guidPrefix == participant_->guid().guidPrefix;
}

bool DdsParticipant::is_of_this_process(const eprosima::fastrtps::rtps::InstanceHandle_t& publication) const {
  return eprosima::fastrtps::rtps::iHandle2GUID(publication).is_on_same_process_as(participant_->guid());
}

ParticipantId DdsParticipant::id() const {
  ParticipantId id{};
  std::ranges::copy(participant_->guid().guidPrefix.value, id.begin());
  return id;
}

fastdds::Topic* DdsParticipant::topic(demecal::Topic which, std::uint32_t joint) {
  const std::string name = topic_name(which, joint);
  Owned<fastdds::Topic>& topic = topics_[name];
  if (!topic) {
    auto* participant = participant_.get();
    const fastdds::TypeSupport type = topic_type(which);
    type.register_type(participant);
    topic = own(
        participant->create_topic(name, type.get_type_name(), fastdds::TOPIC_QOS_DEFAULT),
        [participant](fastdds::Topic* t) { participant->delete_topic(t); }, "topic " + name);
  }
  return topic.get();
}

}  // namespace demecal::inline dds
