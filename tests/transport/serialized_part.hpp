// A part as bytes on the wire.
#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <string>

#include "calibration.h"

namespace demecal {

/// CDR, little endian, without encapsulation.
inline std::string serialized(const wire::Part& part) {
  std::string bytes(part.getCdrSerializedSize(part), '\0');
  eprosima::fastcdr::FastBuffer buffer(bytes.data(), bytes.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS);
  part.serialize(cdr);
  bytes.resize(cdr.getSerializedDataLength());
  return bytes;
}

}  // namespace demecal
