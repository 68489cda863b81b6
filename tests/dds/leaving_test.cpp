// A transport whose library never lets go does not hold the process up.
#include <gtest/gtest.h>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <thread>

#include "dds/dds_transport.hpp"

namespace {

using namespace std::chrono_literals;

[[noreturn]] void exit_while_one_never_leaves(int status) {
  std::mutex held;
  held.lock();
  const bool left = demecal::leave_within(50ms, [&] { held.lock(); });
  std::exit(left ? 1 : status);
}

TEST(Leaving, IsWaitedFor) {
  bool gone = false;
  EXPECT_TRUE(demecal::leave_within(10min, [&] {
    std::this_thread::sleep_for(20ms);
    gone = true;
  }));
  EXPECT_TRUE(gone);
}

TEST(Leaving, ThatNeverEndsIsAbandonedAndTheExitStatusKept) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(exit_while_one_never_leaves(7), testing::ExitedWithCode(7), "");
}

}  // namespace
