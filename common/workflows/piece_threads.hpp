// Threads that run the independent pieces of a calibration's work at once.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include "pieces/pieces.hpp"

namespace demecal::inline workflows {

/// As many threads as asked for, the calling one included; 0: as many as processors that this process may use. They
/// start with the first pieces. Pieces within pieces run one after another, in the thread of the outer one.
class PieceThreads final : public PieceRunner {
 public:
  explicit PieceThreads(unsigned threads);
  ~PieceThreads() override;
  PieceThreads(const PieceThreads&) = delete;
  PieceThreads& operator=(const PieceThreads&) = delete;

  void run(std::size_t count, const Piece& piece) override;

 private:
  struct Work;
  void start_helpers();
  void help();

  unsigned threads_;
  std::mutex mutex_;
  std::condition_variable begun_, left_;
  Work* work_ = nullptr;
  std::uint64_t turn_ = 0;   ///< counts works, so that no helper takes part in one twice
  std::size_t helping_ = 0;  ///< helpers that are at the present work
  bool ending_ = false;
  std::vector<std::thread> helpers_;
};

}  // namespace demecal::inline workflows
