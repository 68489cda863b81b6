// What is announced of a topic's type beside its name, so that programs that have no IDL read it.
#pragma once

#include <fastdds/dds/topic/TopicDataType.hpp>

#include "protocol/messages.hpp"

namespace demecal::inline dds {

/// Gives `type`, that of the topic, its complete TypeObject where all fields are numbers, texts and columns of numbers:
/// of what is for people to see. Of other types nothing is announced: Fast DDS 2.9 sends no type that another one
/// names, and what it says in place of types (TYPE_INFORMATION) makes Cyclone DDS discard the writer.
void add_type_object(eprosima::fastdds::dds::TopicDataType& type, Topic topic);

}  // namespace demecal::inline dds
