#include "transport/dds_participant.hpp"

#include <fastrtps/attributes/LibrarySettingsAttributes.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#include <algorithm>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <stdexcept>
#include <utility>

#include "errors/input_error.hpp"
#include "transport/dds_log.hpp"
#include "transport/dds_participant_qos.hpp"
#include "transport/dds_qos.hpp"
#include "transport/dds_security.hpp"
#include "transport/dds_types.hpp"

namespace demecal {
namespace {

namespace dds = eprosima::fastdds::dds;

/// The library speaks of errors alone; and it takes the same path between participants of one process as between
/// processes.
void set_up_library() {
  static const bool once = [] {
    set_up_dds_log();
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

Owned<dds::DomainParticipant> join_domain(const DdsOptions& options, Role role, const std::string& name,
                                          Refusals* refusals) {
  set_up_library();
  auto* factory = dds::DomainParticipantFactory::get_instance();
  auto* participant = factory->create_participant(options.domain, participant_qos(options, role, name), refusals,
                                                  dds::StatusMask::none());
  if (participant == nullptr && !options.security.empty()) {
    throw InputError(
        {options.security, 0}, certificate_name(role),
        "this certificate, its key or its permissions are not accepted: expired, altered, or of another authority");
  }
  return own(
      participant, [factory](dds::DomainParticipant* p) { factory->delete_participant(p); },
      "a participant in domain " + std::to_string(options.domain));
}

}  // namespace

DdsParticipant::DdsParticipant(const DdsOptions& options, Role role, const std::string& name)
    : refusals_(!options.security.empty(), role), participant_(join_domain(options, role, name, &refusals_)) {
  auto* participant = participant_.get();
  publisher_ = own(
      participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT),
      [participant](dds::Publisher* p) { participant->delete_publisher(p); }, "a publisher");
  subscriber_ = own(
      participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT),
      [participant](dds::Subscriber* s) { participant->delete_subscriber(s); }, "a subscriber");
}

Owned<dds::DataWriter> DdsParticipant::make_writer(demecal::Topic which, std::uint32_t joint) {
  auto* publisher = publisher_.get();
  return own(
      publisher->create_datawriter(topic(which, joint), writer_qos(which)),
      [publisher](dds::DataWriter* writer) { publisher->delete_datawriter(writer); },
      "a writer of " + topic_name(which, joint));
}

Owned<dds::DataReader> DdsParticipant::make_reader(demecal::Topic which, std::uint32_t joint,
                                                   dds::DataReaderListener* listener, bool reliably) {
  auto* subscriber = subscriber_.get();
  return own(
      subscriber->create_datareader(topic(which, joint), reader_qos(which, reliably), listener),
      [subscriber](dds::DataReader* reader) {
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

dds::Topic* DdsParticipant::topic(demecal::Topic which, std::uint32_t joint) {
  const std::string name = topic_name(which, joint);
  Owned<dds::Topic>& topic = topics_[name];
  if (!topic) {
    auto* participant = participant_.get();
    const dds::TypeSupport type = topic_type(which);
    type.register_type(participant);
    topic = own(
        participant->create_topic(name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT),
        [participant](dds::Topic* t) { participant->delete_topic(t); }, "topic " + name);
  }
  return topic.get();
}

}  // namespace demecal
