// The quality of service and name of each topic, as idl/calibration.idl states them.
#pragma once

#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <string>

#include "transport/topic.hpp"

namespace demecal {

/// The name on the wire; `joint` (from 0) matters for migrants alone.
std::string topic_name(Topic topic, std::uint32_t joint = 0);

eprosima::fastdds::dds::DataWriterQos writer_qos(Topic topic);
/// As the topic's writers offer it where `reliably`, else BEST_EFFORT: what passes while one looks.
eprosima::fastdds::dds::DataReaderQos reader_qos(Topic topic, bool reliably = true);

/// A length of time as Fast DDS takes it.
eprosima::fastrtps::Duration_t dds_duration(std::chrono::milliseconds time);

}  // namespace demecal
