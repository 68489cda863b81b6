// The DDS types of the topics: those that fastddsgen made of idl/calibration.idl, but wary of what they read.
#pragma once

#include <fastdds/dds/topic/TypeSupport.hpp>

#include "transport/topic.hpp"

namespace demecal {

/// The generated types throw where a flag is neither true nor false, on threads of Fast DDS that do not catch. These
/// make of bytes that are no sample an empty one, which decode() refuses, so that the reader learns who sent it.
eprosima::fastdds::dds::TypeSupport topic_type(Topic topic);

}  // namespace demecal
