// The fleet over DDS: the coordinator's participant, and the local worker processes it starts.
#pragma once

#include <memory>
#include <optional>

#include "coordinator/calibrate.hpp"
#include "coordinator/local_workers.hpp"
#include "dds/dds_transport.hpp"

namespace demecal {

class DdsFleet : public Fleet {
 public:
  /// Joins the domain; will start `local_workers` processes, each with one slot, that serve this coordinator alone; or,
  /// where certificates are shown, one process with as many slots: handshakes grow with the square of the processes.
  DdsFleet(const DdsOptions& options, int local_workers);

  Transport& transport() override { return *transport_; }
  void launch(RunId run) override;

 private:
  DdsOptions options_;
  int local_workers_;
  std::unique_ptr<Transport> transport_;
  std::optional<LocalWorkers> workers_;
};

}  // namespace demecal
