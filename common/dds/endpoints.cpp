#include "dds/participant.hpp"
#include "protocol/messages.hpp"

#include <fastrtps/utils/md5.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <functional>
#include <string>

#include "dds/type_objects.hpp"
#include "protocol/message_bytes.hpp"
#include "transport/transport.hpp"

namespace demecal::inline dds {
namespace {

namespace fastdds = eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;

/// Buffers begin at this size and grow as they must.
constexpr std::uint32_t kFirstBuffer_bytes = 256;

/// Called on any thread, on several at once: nothing is kept between calls. (The types that fastddsgen makes work a key
/// out in a buffer of their own; a sample would at times take the key, and with it the place, of another.)
template <class Plain>
class MessageType final : public fastdds::TopicDataType {
 public:
  explicit MessageType(const char* name) {
    setName(name);
    m_typeSize = kFirstBuffer_bytes;
    m_isGetKeyDefined = true;
  }

  /// Where a type is, Fast DDS takes its first size for its largest, and readers drop what is larger.
  bool is_bounded() const override { return false; }

  bool serialize(void* data, SerializedPayload_t* payload) override {
    const std::string bytes = to_sample(*of(data));
    if (bytes.size() > payload->max_size) return false;
    std::ranges::copy(bytes, payload->data);
    payload->encapsulation = CDR_LE;
    payload->length = static_cast<std::uint32_t>(bytes.size());
    return true;
  }
  bool deserialize(SerializedPayload_t* payload, void* data) override {
    of(data) = from_sample<Plain>({reinterpret_cast<const char*>(payload->data), payload->length});
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(to_sample(*of(data)).size()); };
  }
  void* createData() override { return new Sample<Plain>; }
  void deleteData(void* data) override { delete static_cast<Sample<Plain>*>(data); }

  bool getKey(void* data, InstanceHandle_t* handle, bool force_md5) override {
    const SampleKey key = of(data) ? key_bytes(*of(data)) : key_bytes(Plain{});
    std::array<std::uint8_t, 16> value{};
    if (key.is_long || force_md5) {
      MD5 hash;
      hash.init();
      hash.update(key.bytes.data(), static_cast<MD5::size_type>(key.bytes.size()));
      std::ranges::copy(hash.finalize().digest, value.begin());
    } else {
      std::ranges::copy(key.bytes, value.begin());
    }
    for (std::size_t i = 0; i < value.size(); ++i) handle->value[i] = value[i];
    return true;
  }

 private:
  static Sample<Plain>& of(void* data) { return *static_cast<Sample<Plain>*>(data); }
};

template <class Plain>
fastdds::TypeSupport message_type(const char* name) {
  return fastdds::TypeSupport(new MessageType<Plain>(name));
}

using std::chrono::milliseconds;

constexpr milliseconds kWriterHeartbeat{50};

/// 0 is "no limit" to Fast DDS.
fastdds::ResourceLimitsQosPolicy no_limits() {
  fastdds::ResourceLimitsQosPolicy limits;
  limits.max_samples = 0;
  limits.max_instances = 0;
  limits.max_samples_per_instance = 0;
  limits.allocated_samples = 1;
  return limits;
}

/// What the two ends of a topic must agree on, and what is set alike on both.
template <class Qos>
void set_both_ends(Qos& qos, Topic topic) {
  qos.reliability().kind = fastdds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = fastdds::TRANSIENT_LOCAL_DURABILITY_QOS;
  qos.resource_limits() = no_limits();
  qos.data_sharing().off();
  // The dynamic policies cannot receive a disposal, which is an empty sample: all later ones of its writer would wait.
  qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  if (topic == Topic::worker) {
    qos.liveliness().kind = fastdds::MANUAL_BY_TOPIC_LIVELINESS_QOS;
    qos.liveliness().lease_duration = dds_duration(kLease);
    qos.liveliness().announcement_period = dds_duration(kLease / 3);
  }
}

fastdds::TypeSupport type_of_samples(Topic topic) {
  if (is_large(topic)) return message_type<MessagePart>("demecal::wire::MessagePart");
  if (topic == Topic::progress) return message_type<PlacedProgress>("demecal::wire::PlacedProgress");
  if (topic == Topic::control) return message_type<Control>("demecal::wire::Control");
  if (topic == Topic::loop) return message_type<LoopNews>("demecal::wire::LoopNews");
  if (topic == Topic::cause) return message_type<CauseFound>("demecal::wire::CauseFound");
  if (topic == Topic::final_figures) return message_type<FinalFigures>("demecal::wire::FinalFigures");
  return message_type<WorkerStatus>("demecal::wire::WorkerStatus");
}

}  // namespace

fastdds::TypeSupport topic_type(Topic topic) {
  fastdds::TypeSupport type = type_of_samples(topic);
  add_type_object(*type, topic);
  return type;
}

eprosima::fastrtps::Duration_t dds_duration(milliseconds time) {
  return {static_cast<std::int32_t>(time.count() / 1000), static_cast<std::uint32_t>(time.count() % 1000 * 1'000'000)};
}

std::string topic_name(Topic topic, std::uint32_t joint) {
  switch (topic) {
    case Topic::data:
      return "demecal/11/data";
    case Topic::task:
      return "demecal/11/task";
    case Topic::control:
      return "demecal/11/control";
    case Topic::migrants:
      return "demecal/11/migrants/" + std::to_string(joint + 1);
    case Topic::progress:
      return "demecal/11/progress";
    case Topic::checkpoint:
      return "demecal/11/checkpoint";
    case Topic::outcome:
      return "demecal/11/outcome";
    case Topic::loop:
      return "demecal/11/loop";
    case Topic::cause:
      return "demecal/11/cause";
    case Topic::final_figures:
      return "demecal/11/final_figures";
    case Topic::worker:
      break;
  }
  return "demecal/11/worker";
}

fastdds::DataWriterQos writer_qos(Topic topic) {
  fastdds::DataWriterQos qos = fastdds::DATAWRITER_QOS_DEFAULT;
  set_both_ends(qos, topic);
  qos.history().kind = fastdds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = 1;
  // A thread of its own puts what comes at once into one datagram.
  qos.publish_mode().kind = is_large(topic) ? fastdds::ASYNCHRONOUS_PUBLISH_MODE : fastdds::SYNCHRONOUS_PUBLISH_MODE;
  qos.reliable_writer_qos().times.heartbeatPeriod = dds_duration(kWriterHeartbeat);
  return qos;
}

fastdds::DataReaderQos reader_qos(Topic topic, bool reliably) {
  fastdds::DataReaderQos qos = fastdds::DATAREADER_QOS_DEFAULT;
  set_both_ends(qos, topic);
  if (!reliably) {
    qos.reliability().kind = fastdds::BEST_EFFORT_RELIABILITY_QOS;
    qos.durability().kind = fastdds::VOLATILE_DURABILITY_QOS;
    qos.liveliness() = fastdds::LivelinessQosPolicy();  // carried by heartbeats, which only reliable readers take
  }
  qos.history().kind = fastdds::KEEP_ALL_HISTORY_QOS;
  // How long a newcomer waits before it asks for what it missed; the default is 70 ms.
  qos.reliable_reader_qos().times.initialAcknackDelay = dds_duration(milliseconds{10});
  return qos;
}

}  // namespace demecal::inline dds
