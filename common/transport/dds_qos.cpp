#include "transport/dds_qos.hpp"

namespace demecal {
namespace {

namespace dds = eprosima::fastdds::dds;
using std::chrono::milliseconds;

constexpr milliseconds kHeartbeat{50};

/// 0 is "no limit" to Fast DDS.
dds::ResourceLimitsQosPolicy no_limits() {
  dds::ResourceLimitsQosPolicy limits;
  limits.max_samples = 0;
  limits.max_instances = 0;
  limits.max_samples_per_instance = 0;
  limits.allocated_samples = 1;
  return limits;
}

/// What the two ends of a topic must agree on, and what is set alike on both.
template <class Qos>
void set_both_ends(Qos& qos, Topic topic) {
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = dds::TRANSIENT_LOCAL_DURABILITY_QOS;
  qos.resource_limits() = no_limits();
  qos.data_sharing().off();
  // The dynamic policies cannot receive a disposal, which is an empty sample: all later ones of its writer would wait.
  qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  if (topic == Topic::worker) {
    qos.liveliness().kind = dds::MANUAL_BY_TOPIC_LIVELINESS_QOS;
    qos.liveliness().lease_duration = dds_duration(kLease);
    qos.liveliness().announcement_period = dds_duration(kLease / 3);
  }
}

}  // namespace

eprosima::fastrtps::Duration_t dds_duration(milliseconds time) {
  return {static_cast<std::int32_t>(time.count() / 1000), static_cast<std::uint32_t>(time.count() % 1000 * 1'000'000)};
}

std::string topic_name(Topic topic, std::uint32_t joint) {
  switch (topic) {
    case Topic::data:
      return "demecal/5/data";
    case Topic::task:
      return "demecal/5/task";
    case Topic::control:
      return "demecal/5/control";
    case Topic::migrants:
      return "demecal/5/migrants/" + std::to_string(joint + 1);
    case Topic::progress:
      return "demecal/5/progress";
    case Topic::checkpoint:
      return "demecal/5/checkpoint";
    case Topic::outcome:
      return "demecal/5/outcome";
    case Topic::loop:
      return "demecal/5/loop";
    case Topic::worker:
      break;
  }
  return "demecal/5/worker";
}

dds::DataWriterQos writer_qos(Topic topic) {
  dds::DataWriterQos qos = dds::DATAWRITER_QOS_DEFAULT;
  set_both_ends(qos, topic);
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = 1;
  // A thread of its own puts what comes at once into one datagram; figures come one by one.
  const bool comes_at_once = ends_with_run(topic) && topic != Topic::progress;
  qos.publish_mode().kind = comes_at_once ? dds::ASYNCHRONOUS_PUBLISH_MODE : dds::SYNCHRONOUS_PUBLISH_MODE;
  qos.reliable_writer_qos().times.heartbeatPeriod = dds_duration(kHeartbeat);
  return qos;
}

dds::DataReaderQos reader_qos(Topic topic, bool reliably) {
  dds::DataReaderQos qos = dds::DATAREADER_QOS_DEFAULT;
  set_both_ends(qos, topic);
  if (!reliably) {
    qos.reliability().kind = dds::BEST_EFFORT_RELIABILITY_QOS;
    qos.durability().kind = dds::VOLATILE_DURABILITY_QOS;
    qos.liveliness() = dds::LivelinessQosPolicy();  // told by heartbeats, which only reliable readers take
  }
  qos.history().kind = dds::KEEP_ALL_HISTORY_QOS;
  // How long a newcomer waits before it asks for what it missed; the default is 70 ms.
  qos.reliable_reader_qos().times.initialAcknackDelay = dds_duration(milliseconds{10});
  return qos;
}

}  // namespace demecal
