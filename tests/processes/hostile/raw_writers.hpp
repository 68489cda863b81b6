// Writers of any bytes on every topic, as a participant that keeps to no rules has them.
#pragma once

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <map>
#include <string>
#include <vector>

#include "dds/dds_transport.hpp"
#include "protocol/messages.hpp"

namespace demecal {

/// Takes part in a domain under a name of its own and says what it is told to say, until its process ends.
class RawWriters {
 public:
  RawWriters(const DdsOptions& options, const std::string& name);

  /// Writes bytes as a sample of the topic (of the joint's, counted from 0, where it is migrants). Equal `key`s are one
  /// instance of it, whatever the bytes say.
  void write(Topic topic, std::uint32_t joint, const std::string& bytes, std::uint32_t key);

 private:
  eprosima::fastdds::dds::DataWriter* writer_of(Topic topic, std::uint32_t joint);

  eprosima::fastdds::dds::DomainParticipant* participant_;
  eprosima::fastdds::dds::Publisher* publisher_;
  std::map<std::string, eprosima::fastdds::dds::DataWriter*> writers_;
};

}  // namespace demecal
