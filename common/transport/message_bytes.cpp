#include "transport/message_bytes.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <exception>

#include "transport/wire_form.hpp"
#include "transport/wire_shape.hpp"

namespace demecal {
namespace {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

}  // namespace

template <class Plain>
std::string to_bytes(const Plain& message) {
  const auto encoded = encode(message);
  // The library leaves bytes that only align others as they were.
  std::string bytes(encoded.getCdrSerializedSize(encoded), '\0');
  FastBuffer buffer(bytes.data(), bytes.size());
  Cdr stream(buffer, Cdr::LITTLE_ENDIANNESS);
  encoded.serialize(stream);
  bytes.resize(stream.getSerializedDataLength());
  return bytes;
}

template <class Plain>
std::optional<Plain> message_of(std::string_view bytes) {
  using Wire = decltype(encode(Plain{}));
  if (!has_shape<Wire>(bytes, Endian::little)) return std::nullopt;
  std::string copy(bytes);  // the library takes no read-only bytes
  FastBuffer buffer(copy.data(), copy.size());
  Cdr stream(buffer, Cdr::LITTLE_ENDIANNESS);
  Wire encoded;
  try {
    encoded.deserialize(stream);
  } catch (const std::exception&) {
    return std::nullopt;
  }
  if (stream.getSerializedDataLength() != copy.size()) return std::nullopt;
  return decode(encoded);
}

template std::string to_bytes(const CalibrationData&);
template std::string to_bytes(const IslandTask&);
template std::string to_bytes(const Migrants&);
template std::string to_bytes(const Progress&);
template std::string to_bytes(const Checkpoint&);
template std::string to_bytes(const Outcome&);
template std::string to_bytes(const WorkerStatus&);
template std::string to_bytes(const Control&);
template std::string to_bytes(const LoopNews&);
template std::optional<CalibrationData> message_of(std::string_view);
template std::optional<IslandTask> message_of(std::string_view);
template std::optional<Migrants> message_of(std::string_view);
template std::optional<Progress> message_of(std::string_view);
template std::optional<Checkpoint> message_of(std::string_view);
template std::optional<Outcome> message_of(std::string_view);
template std::optional<WorkerStatus> message_of(std::string_view);
template std::optional<Control> message_of(std::string_view);
template std::optional<LoopNews> message_of(std::string_view);

}  // namespace demecal
