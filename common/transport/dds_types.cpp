#include "transport/dds_types.hpp"

#include <exception>
#include <memory>
#include <mutex>

#include "calibrationPubSubTypes.h"
#include "transport/wire_shape.hpp"

namespace demecal {
namespace {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;

/// Sequences without a bound make the generated types claim megabytes, which every sample would then occupy: buffers
/// begin at this size and grow as they must.
constexpr std::uint32_t kFirstBuffer_bytes = 256;

/// Plain CDR behind its four bytes of encapsulation (RTPS 2.3, 10.2): two that name the form, two of options.
template <class Wire>
bool is_sample(const SerializedPayload_t& payload) {
  constexpr std::uint32_t kEncapsulation_bytes = 4;
  if (payload.data == nullptr || payload.length < kEncapsulation_bytes) return false;
  if (payload.data[0] != 0 || payload.data[1] > 1) return false;
  const std::string_view content(reinterpret_cast<const char*>(payload.data) + kEncapsulation_bytes,
                                 payload.length - kEncapsulation_bytes);
  return has_shape<Wire>(content, payload.data[1] == 1 ? Endian::little : Endian::big);
}

template <class Generated>
class Wary final : public Generated {
 public:
  using Wire = typename Generated::type;

  Wary() { this->m_typeSize = kFirstBuffer_bytes; }

  /// Where a type is, Fast DDS takes its first size for its largest, and readers drop what is larger.
  bool is_bounded() const override { return false; }

  bool deserialize(SerializedPayload_t* payload, void* data) override {
    if (!is_sample<Wire>(*payload) || !is_read(payload, data)) *static_cast<Wire*>(data) = Wire();
    return true;
  }

  /// The generated types work a key out in a buffer of their own, which the threads that write and those that receive
  /// share: a sample would at times take the key, and with it the place, of another.
  bool getKey(void* data, InstanceHandle_t* handle, bool force_md5) override {
    const std::lock_guard lock(mutex_);
    return Generated::getKey(data, handle, force_md5);
  }

 private:
  bool is_read(SerializedPayload_t* payload, void* data) {
    try {
      return Generated::deserialize(payload, data);
    } catch (const std::exception&) {
      return false;
    }
  }

  std::mutex mutex_;
};

template <class Generated>
dds::TypeSupport wary() {
  return dds::TypeSupport(new Wary<Generated>());
}

}  // namespace

dds::TypeSupport topic_type(Topic topic) {
  if (ends_with_run(topic)) return wary<wire::PartPubSubType>();
  if (topic == Topic::control) return wary<wire::ControlPubSubType>();
  if (topic == Topic::loop) return wary<wire::LoopNewsPubSubType>();
  return wary<wire::WorkerStatusPubSubType>();
}

}  // namespace demecal
