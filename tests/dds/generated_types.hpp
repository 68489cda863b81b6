// Messages as the types see them that fastddsgen makes of idl/calibration.idl: what any other DDS program has.
#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "calibration.h"
#include "protocol/message_bytes.hpp"

namespace demecal {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

/// The message's bytes read by the generated type `Wire`, to the last.
template <class Wire, class Plain>
Wire encode(const Plain& message) {
  std::string bytes = to_bytes(message);
  FastBuffer buffer(bytes.data(), bytes.size());
  Cdr stream(buffer, Cdr::LITTLE_ENDIANNESS);
  Wire read;
  read.deserialize(stream);
  EXPECT_EQ(stream.getSerializedDataLength(), bytes.size());
  return read;
}

/// What the generated type writes, without encapsulation.
template <class Wire>
std::string written(const Wire& message) {
  std::string bytes(message.getCdrSerializedSize(message), '\0');
  FastBuffer buffer(bytes.data(), bytes.size());
  Cdr stream(buffer, Cdr::LITTLE_ENDIANNESS);
  message.serialize(stream);
  bytes.resize(stream.getSerializedDataLength());
  return bytes;
}

template <class Plain, class Wire>
std::optional<Plain> decode(const Wire& message) {
  return from_bytes<Plain>(written(message));
}

}  // namespace demecal
