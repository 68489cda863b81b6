// Name, type and quality of service of each topic, as idl/calibration.idl states them.
#pragma once

#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <optional>
#include <string>

#include "protocol/topics.hpp"

namespace demecal {

/// What writers take and readers give: nothing where bytes came that are no such message, so that the reader learns who
/// sent them. `Plain` is what travels on the topic.
template <class Plain>
using Sample = std::optional<Plain>;

/// What is large travels in MessageParts, Progress with its place, all else as it is.
eprosima::fastdds::dds::TypeSupport topic_type(Topic topic);

/// The name on the wire; `joint` (from 0) matters for migrants alone.
std::string topic_name(Topic topic, std::uint32_t joint = 0);

eprosima::fastdds::dds::DataWriterQos writer_qos(Topic topic);
/// As the topic's writers offer it where `reliably`, else BEST_EFFORT: what passes while one looks.
eprosima::fastdds::dds::DataReaderQos reader_qos(Topic topic, bool reliably = true);

/// A length of time as Fast DDS takes it.
eprosima::fastrtps::Duration_t dds_duration(std::chrono::milliseconds time);

}  // namespace demecal
