// Every decoder against some thousand spoilt inputs, the same ones each time, and against those that once broke one.
// scripts/fuzz searches on its own, for as long as one likes.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "random/random_stream.hpp"
#include "targets.hpp"

namespace demecal::fuzz {
namespace {

/// Bytes with some changed, lost, doubled or taken from elsewhere.
class Mutation {
 public:
  explicit Mutation(std::uint64_t seed) : random_{seed, 2024} {}

  std::string operator()(const Target& target) {
    std::string bytes = target.seeds[random_.index(target.seeds.size())];
    for (std::size_t changes = 1 + random_.index(4); changes > 0 && !bytes.empty(); --changes) change(bytes, target);
    return bytes;
  }

 private:
  void change(std::string& bytes, const Target& target) {
    const std::size_t at = random_.index(bytes.size());
    switch (random_.index(7)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random_.index(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(random_.index(256));
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.erase(at, 1 + random_.index(8));
        break;
      case 4:
        bytes.insert(at, bytes.substr(random_.index(bytes.size()), random_.index(40)));
        break;
      case 5: {
        const std::string& other = target.seeds[random_.index(target.seeds.size())];
        bytes.insert(at, other.substr(random_.index(other.size()), random_.index(40)));
        break;
      }
      default:
        overwrite_word(bytes, at / 4 * 4);
    }
  }

  /// Counts stand at multiples of four.
  void overwrite_word(std::string& bytes, std::size_t at) {
    constexpr std::uint32_t kWords[] = {0, 1, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x00FFFFFF, 0x7FF00000, 0x7FF80000};
    const std::uint32_t word = kWords[random_.index(std::size(kWords))];
    for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i) bytes[at + i] = static_cast<char>(word >> (8 * i));
  }

  RandomStream random_;
};

class Decoders : public ::testing::TestWithParam<Target> {};

INSTANTIATE_TEST_SUITE_P(All, Decoders, ::testing::ValuesIn(targets()),
                         [](const auto& parameter) { return parameter.param.name; });

TEST_P(Decoders, TakeTheirSeeds) {
  ASSERT_FALSE(GetParam().seeds.empty());
  for (const std::string& seed : GetParam().seeds) GetParam().read(seed);
}

TEST_P(Decoders, SurviveSpoiltBytes) {
  constexpr int kRounds = 250;
  Mutation mutation(7);
  for (int round = 0; round < kRounds; ++round) GetParam().read(mutation(GetParam()));
}

TEST_P(Decoders, SurviveEveryBeginningOfASeed) {
  const std::string& seed = GetParam().seeds.front();
  const std::size_t step = 1 + seed.size() / 60;
  for (std::size_t size = 0; size < seed.size(); size += step) GetParam().read(std::string_view(seed).substr(0, size));
}

TEST_P(Decoders, SurviveWhatOnceBrokeThem) {
  const std::filesystem::path folder = std::filesystem::path(DEMECAL_SOURCE_DIR) / "tests/fuzz/found" / GetParam().name;
  if (!std::filesystem::exists(folder)) return;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    std::ifstream stream(file.path(), std::ios::binary);
    GetParam().read(std::string{std::istreambuf_iterator<char>(stream), {}});
  }
}

}  // namespace
}  // namespace demecal::fuzz
