#include "raw_writers.hpp"

#include <cstring>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <stdexcept>

#include "dds/participant.hpp"

namespace demecal {
namespace {

namespace fastdds = eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;

struct Raw {
  std::string bytes;
  std::uint32_t key = 0;
};

/// Goes by the name of another type and sends bytes as they are.
class RawType final : public fastdds::TopicDataType {
 public:
  explicit RawType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 256;
    m_isGetKeyDefined = true;
  }
  bool serialize(void* data, SerializedPayload_t* payload) override {
    const std::string& bytes = static_cast<Raw*>(data)->bytes;
    std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<std::uint32_t>(bytes.size());
    return true;
  }
  bool deserialize(SerializedPayload_t*, void*) override { return false; }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<Raw*>(data)->bytes.size()); };
  }
  void* createData() override { return new Raw; }
  void deleteData(void* data) override { delete static_cast<Raw*>(data); }
  bool getKey(void* data, InstanceHandle_t* handle, bool) override {
    for (std::size_t i = 0; i < 4; ++i)
      handle->value[i] = static_cast<std::uint8_t>(static_cast<Raw*>(data)->key >> (8 * i));
    handle->value[15] = 1;
    return true;
  }
};

}  // namespace

RawWriters::RawWriters(const DdsOptions& options, const std::string& name) {
  auto* factory = fastdds::DomainParticipantFactory::get_instance();
  participant_ = factory->create_participant(options.domain, participant_qos(options, Role::coordinator, name));
  if (participant_ == nullptr) throw std::runtime_error("no participant");
  publisher_ = participant_->create_publisher(fastdds::PUBLISHER_QOS_DEFAULT);
}

fastdds::DataWriter* RawWriters::writer_of(Topic topic, std::uint32_t joint) {
  const std::string name = topic_name(topic, joint);
  fastdds::DataWriter*& writer = writers_[name];
  if (writer == nullptr) {
    const std::string type = topic_type(topic).get_type_name();
    if (participant_->find_type(type).empty()) fastdds::TypeSupport(new RawType(type)).register_type(participant_);
    writer = publisher_->create_datawriter(participant_->create_topic(name, type, fastdds::TOPIC_QOS_DEFAULT),
                                           writer_qos(topic));
  }
  if (writer == nullptr) throw std::runtime_error("no writer of " + name);
  return writer;
}

void RawWriters::write(Topic topic, std::uint32_t joint, const std::string& bytes, std::uint32_t key) {
  Raw raw{bytes, key};
  writer_of(topic, joint)->write(&raw);
}

}  // namespace demecal
