#include "transport/dds_log.hpp"

#include <algorithm>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/log/StdoutErrConsumer.hpp>
#include <memory>
#include <set>
#include <string>

namespace demecal {
namespace {

namespace dds = eprosima::fastdds::dds;

class OnceEach final : public dds::StdoutErrConsumer {
 public:
  /// Called on one thread of the library.
  void Consume(const dds::Log::Entry& entry) override {
    constexpr std::size_t kMostKinds = 200;
    std::string kind = entry.message;
    std::erase_if(kind, [](char c) { return c >= '0' && c <= '9'; });
    if (told_.size() < kMostKinds && told_.insert(std::move(kind)).second) StdoutErrConsumer::Consume(entry);
  }

 private:
  std::set<std::string> told_;
};

}  // namespace

void set_up_dds_log() {
  dds::Log::SetVerbosity(dds::Log::Kind::Error);
  dds::Log::ClearConsumers();
  auto to_stderr = std::make_unique<OnceEach>();
  to_stderr->stderr_threshold(dds::Log::Kind::Info);
  dds::Log::RegisterConsumer(std::move(to_stderr));
}

}  // namespace demecal
