#include "dds/ros2_publisher.hpp"

#include <unistd.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <functional>
#include <map>
#include <stdexcept>
#include <type_traits>
#include <variant>
#include <vector>

#include "dds/participant.hpp"
#include "protocol/message_bytes.hpp"

namespace demecal::inline dds {
namespace {

namespace ros2 = eprosima::fastdds::dds;
using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

/// A type whose samples are bytes already; it has no key, as ROS 2 knows none.
class BytesType final : public ros2::TopicDataType {
 public:
  explicit BytesType(const std::string& name) {
    setName(name.c_str());
    constexpr std::uint32_t kFirstBytes = 1024;
    m_typeSize = kFirstBytes;
    m_isGetKeyDefined = false;
  }

  bool is_bounded() const override { return false; }
  bool serialize(void* data, Payload* payload) override {
    const std::string& bytes = *static_cast<std::string*>(data);
    if (bytes.size() > payload->max_size) return false;
    std::ranges::copy(bytes, payload->data);
    payload->encapsulation = CDR_LE;
    payload->length = static_cast<std::uint32_t>(bytes.size());
    return true;
  }
  bool deserialize(Payload* payload, void* data) override {
    static_cast<std::string*>(data)->assign(reinterpret_cast<const char*>(payload->data), payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<std::string*>(data)->size()); };
  }
  void* createData() override { return new std::string; }
  void deleteData(void* data) override { delete static_cast<std::string*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

struct Ros2Topic {
  const char* name;
  const char* type;
};
constexpr Ros2Topic kRos2Topics[] = {{"rt/demecal/worker", "demecal::msg::dds_::WorkerStatus_"},
                                     {"rt/demecal/run_state", "demecal::msg::dds_::Control_"},
                                     {"rt/demecal/progress", "demecal::msg::dds_::Progress_"},
                                     {"rt/demecal/loop", "demecal::msg::dds_::LoopNews_"},
                                     {"rt/demecal/cause", "demecal::msg::dds_::CauseFound_"},
                                     {"rt/demecal/final_figures", "demecal::msg::dds_::FinalFigures_"},
                                     {"rt/demecal/events", "std_msgs::msg::dds_::String_"}};
constexpr std::size_t kEvents = 6;

/// The place of a kind of message in kRos2Topics; kEvents where it has no topic of its own.
template <class Plain>
constexpr std::size_t topic_place() {
  if constexpr (std::is_same_v<Plain, WorkerStatus>) return 0;
  if constexpr (std::is_same_v<Plain, Control>) return 1;
  if constexpr (std::is_same_v<Plain, Progress>) return 2;
  if constexpr (std::is_same_v<Plain, LoopNews>) return 3;
  if constexpr (std::is_same_v<Plain, CauseFound>) return 4;
  if constexpr (std::is_same_v<Plain, FinalFigures>) return 5;
  return kEvents;
}

/// A std_msgs/String in CDR, little endian, behind the four bytes that say so.
std::string string_sample(const std::string& text) {
  std::string bytes("\0\1\0\0", 4);
  const auto length = static_cast<std::uint32_t>(text.size() + 1);
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(length >> shift & 0xFFU);
  return bytes + text + '\0';
}

ros2::DataWriterQos ros2_qos() {
  ros2::DataWriterQos qos = ros2::DATAWRITER_QOS_DEFAULT;
  qos.reliability().kind = ros2::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = ros2::TRANSIENT_LOCAL_DURABILITY_QOS;
  qos.history().kind = ros2::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = kRos2Depth;
  qos.resource_limits().max_samples = 0;
  qos.resource_limits().max_samples_per_instance = kRos2Depth;
  qos.resource_limits().allocated_samples = 1;
  qos.data_sharing().off();
  qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.publish_mode().kind = ros2::ASYNCHRONOUS_PUBLISH_MODE;
  return qos;
}

}  // namespace

class Ros2Publisher::Implementation {
 public:
  explicit Implementation(const DdsOptions& options) {
    const std::string name = "ros2-" + std::to_string(::getpid());
    participant_ = ros2::DomainParticipantFactory::get_instance()->create_participant(
        options.domain, participant_qos(options, Role::watcher, name));
    if (participant_ == nullptr) throw std::runtime_error("no participant for --ros2 can be made");
    publisher_ = participant_->create_publisher(ros2::PUBLISHER_QOS_DEFAULT);
    for (const Ros2Topic& topic : kRos2Topics) add_writer(topic);
  }
  ~Implementation() {
    participant_->delete_contained_entities();
    ros2::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  void write(std::size_t place, std::string bytes) { writers_.at(place)->write(&bytes); }

 private:
  void add_writer(const Ros2Topic& topic) {
    const ros2::TypeSupport type(new BytesType(topic.type));
    type.register_type(participant_);
    ros2::Topic* made = participant_->create_topic(topic.name, topic.type, ros2::TOPIC_QOS_DEFAULT);
    ros2::DataWriter* writer = made == nullptr ? nullptr : publisher_->create_datawriter(made, ros2_qos());
    if (writer == nullptr) throw std::runtime_error(std::string("no writer of ") + topic.name + " can be made");
    writers_.push_back(writer);
  }

  ros2::DomainParticipant* participant_ = nullptr;
  ros2::Publisher* publisher_ = nullptr;
  std::vector<ros2::DataWriter*> writers_;
};

Ros2Publisher::Ros2Publisher(const DdsOptions& options) : implementation_(std::make_unique<Implementation>(options)) {}

Ros2Publisher::~Ros2Publisher() = default;

void Ros2Publisher::publish(const Message& message, const std::string& line) {
  std::visit(
      [&](const auto& plain) {
        using Plain = std::decay_t<decltype(plain)>;
        constexpr std::size_t kPlace = topic_place<Plain>();
        if constexpr (kPlace != kEvents) implementation_->write(kPlace, to_sample(plain));
      },
      message);
  if (!line.empty()) implementation_->write(kEvents, string_sample(line));
}

}  // namespace demecal::inline dds
