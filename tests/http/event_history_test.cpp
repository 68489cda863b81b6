// What is kept for browsers: order, bounds, and the last of every state whatever is thinned out.
#include "http/event_history.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <thread>

#include "random/random_stream.hpp"

namespace demecal {
namespace {

constexpr std::chrono::milliseconds kAtOnce{0};
constexpr std::size_t kMuch = 1 << 20;

TEST(EventHistory, GivesEveryReaderWhatFollowsInOrder) {
  EventHistory history(1000);
  for (int i = 1; i <= 50; ++i) history.add("line " + std::to_string(i), i % 3 == 0 ? "key" : "");
  const auto all = history.after(0, kMuch, kAtOnce);
  ASSERT_EQ(all.size(), 50u);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(*all[i].text, "line " + std::to_string(i + 1));
  const auto rest = history.after(all[19].number, kMuch, kAtOnce);
  ASSERT_EQ(rest.size(), 30u);
  EXPECT_EQ(*rest.front().text, "line 21");
  EXPECT_TRUE(history.after(all.back().number, kMuch, kAtOnce).empty());
  EXPECT_EQ(history.after(0, 20, kAtOnce).size(), 3u);
  EXPECT_EQ(history.after(0, 1, kAtOnce).size(), 1u);
}

TEST(EventHistory, StaysWithinItsBoundAndKeepsTheLastOfEveryKeyAndWhatHappensOnce) {
  RandomStream random{41};
  constexpr std::size_t kMost = 400;
  EventHistory history(kMost);
  std::map<std::string, std::string> last;
  std::set<std::string> once;
  for (int i = 0; i < 20000; ++i) {
    const std::string text = std::to_string(i);
    const bool happens_once = i % 400 == 7;
    const std::string key = happens_once ? "" : "island " + std::to_string(random.index(24));
    if (happens_once) once.insert(text);
    if (!happens_once) last[key] = text;
    history.add(text, key);
    ASSERT_LE(history.after(0, kMuch, kAtOnce).size(), kMost);
  }
  std::set<std::string> kept;
  std::uint64_t before = 0;
  for (const NumberedLine& line : history.after(0, kMuch, kAtOnce)) {
    EXPECT_GT(line.number, before);
    before = line.number;
    kept.insert(*line.text);
  }
  EXPECT_GT(kept.size(), kMost / 4);
  for (const auto& [key, text] : last) EXPECT_TRUE(kept.contains(text)) << key;
  for (const std::string& text : once) EXPECT_TRUE(kept.contains(text)) << text;
}

TEST(EventHistory, IsBoundedWhateverIsAdded) {
  EventHistory history(100);
  for (int i = 0; i < 5000; ++i) history.add(std::to_string(i), i % 2 == 0 ? "" : std::to_string(i));
  const auto kept = history.after(0, kMuch, kAtOnce);
  EXPECT_LE(kept.size(), 100u);
  EXPECT_EQ(*kept.back().text, "4999");
}

TEST(EventHistory, WakesWhoWaitsByALineOrByItsEnd) {
  EventHistory history(100);
  std::size_t told = 0;
  std::thread waiting([&] {
    told = history.after(0, kMuch, std::chrono::seconds(60)).size();
    history.after(1, kMuch, std::chrono::seconds(60));
  });
  history.add("line", "");
  history.close();
  waiting.join();
  EXPECT_EQ(told, 1u);
  EXPECT_TRUE(history.is_closed());
}

}  // namespace
}  // namespace demecal
