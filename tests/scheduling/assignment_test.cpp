// Islands are handed out evenly, and moved no more than that takes.
#include "scheduling/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace demecal {
namespace {

std::vector<IslandKey> some_islands(std::uint32_t count) {
  std::vector<IslandKey> islands;
  for (std::uint32_t i = 0; i < count; ++i) islands.push_back({i / 4, i % 4});
  return islands;
}

/// Who holds what, when all moves are followed.
class Followed {
 public:
  void follow(const std::vector<Move>& moves) {
    for (const Move& move : moves) holder_[move.island] = move.worker;
  }
  int held(const std::string& worker) const {
    return static_cast<int>(
        std::count_if(holder_.begin(), holder_.end(), [&](const auto& e) { return e.second == worker; }));
  }
  std::size_t all() const { return holder_.size(); }

 private:
  std::map<IslandKey, std::string> holder_;
};

TEST(Assignment, GivesNothingWhereNoWorkerIs) {
  EXPECT_TRUE(Assignment(some_islands(5)).balance().empty());
}

TEST(Assignment, OneWorkerGetsAll) {
  Assignment assignment(some_islands(5));
  assignment.add_worker("a", 1);
  EXPECT_EQ(assignment.balance().size(), 5U);
  EXPECT_TRUE(assignment.balance().empty());
}

TEST(Assignment, SharesInProportionToSlots) {
  Assignment assignment(some_islands(12));
  assignment.add_worker("one", 1);
  assignment.add_worker("two", 2);
  Followed followed;
  followed.follow(assignment.balance());
  EXPECT_EQ(followed.held("one"), 4);
  EXPECT_EQ(followed.held("two"), 8);
}

TEST(Assignment, ANewcomerIsGivenItsShareAndTheRestStaysWhereItWas) {
  Assignment assignment(some_islands(12));
  assignment.add_worker("a", 1);
  assignment.add_worker("b", 1);
  Followed followed;
  followed.follow(assignment.balance());
  assignment.add_worker("c", 1);
  const std::vector<Move> moves = assignment.balance();
  EXPECT_EQ(moves.size(), 4U);
  EXPECT_TRUE(std::all_of(moves.begin(), moves.end(), [](const Move& move) { return move.worker == "c"; }));
  followed.follow(moves);
  EXPECT_EQ(followed.held("a"), 4);
  EXPECT_EQ(followed.held("b"), 4);
}

TEST(Assignment, ALostWorkersIslandsGoToTheOthersFinishedOnesToo) {
  Assignment assignment(some_islands(6));
  assignment.add_worker("a", 1);
  assignment.add_worker("b", 1);
  Followed followed;
  followed.follow(assignment.balance());
  for (const IslandKey island : some_islands(3)) assignment.finish(island);
  assignment.remove_worker("a");
  followed.follow(assignment.balance());
  EXPECT_EQ(followed.held("b"), 6);
}

TEST(Assignment, FinishedIslandsAreNoLoad) {
  Assignment assignment(some_islands(4));
  assignment.add_worker("a", 1);
  assignment.balance();
  for (const IslandKey island : some_islands(4)) assignment.finish(island);
  assignment.add_worker("b", 1);
  EXPECT_TRUE(assignment.balance().empty());
}

TEST(Assignment, WhoStillHasWorkIsGivenNoMoreOfAnothers) {
  Assignment assignment(some_islands(6));
  assignment.add_worker("a", 1);
  assignment.add_worker("b", 1);
  std::vector<IslandKey> of_a;
  for (const Move& move : assignment.balance())
    if (move.worker == "a") of_a.push_back(move.island);
  ASSERT_EQ(of_a.size(), 3U);
  assignment.finish(of_a[0]);
  assignment.finish(of_a[1]);
  EXPECT_TRUE(assignment.balance().empty());
  assignment.finish(of_a[2]);
  const std::vector<Move> moves = assignment.balance();
  ASSERT_EQ(moves.size(), 1U);
  EXPECT_EQ(moves[0].worker, "a");
}

TEST(Assignment, MovesOnlyWhatMayMoveAndGivesAwayWhatHasNoWorker) {
  Assignment assignment(some_islands(6));
  assignment.add_worker("a", 1);
  const auto none = [](IslandKey) { return false; };
  EXPECT_EQ(assignment.balance(none).size(), 6U);
  assignment.add_worker("b", 1);
  EXPECT_TRUE(assignment.balance(none).empty());
  const std::vector<Move> moves = assignment.balance([](IslandKey island) { return island.joint == 0; });
  ASSERT_EQ(moves.size(), 3U);
  for (const Move& move : moves) EXPECT_EQ(move.island.joint, 0U);
}

TEST(Assignment, MoreWorkersThanIslandsLeavesSomeIdle) {
  Assignment assignment(some_islands(3));
  for (const char* worker : {"a", "b", "c", "d", "e"}) assignment.add_worker(worker, 1);
  EXPECT_EQ(assignment.balance().size(), 3U);
  EXPECT_TRUE(assignment.balance().empty());
}

TEST(Assignment, KeepsNeighboursTogether) {
  Assignment assignment(some_islands(24));
  for (const char* worker : {"a", "b", "c"}) assignment.add_worker(worker, 1);
  for (const Move& move : assignment.balance()) EXPECT_EQ(move.worker, std::string(1, "aabbcc"[move.island.joint]));
}

}  // namespace
}  // namespace demecal
