// Purposes of random numbers: no two share a stream.
#include "random/random_purpose.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <regex>

namespace demecal {
namespace {

/// The numbers that an enumeration's definition gives its names.
std::map<std::string, std::uint64_t> numbers_of(const std::string& enumeration) {
  std::ifstream stream(DEMECAL_SOURCE_DIR "/common/random/random_purpose.hpp");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t begin = text.find("enum class " + enumeration);
  const std::string body = text.substr(begin, text.find("};", begin) - begin);
  static const std::regex entry(R"((\w+) = (0x[0-9A-Fa-f]+|\d+))");
  std::map<std::string, std::uint64_t> numbers;
  for (std::sregex_iterator match(body.begin(), body.end(), entry), end; match != end; ++match) {
    numbers[(*match)[1].str()] = std::stoull((*match)[2].str(), nullptr, 0);
  }
  return numbers;
}

TEST(RandomPurpose, HasANumberOfItsOwnForEveryUse) {
  for (const auto& [enumeration, least] : {std::pair{"RandomPurpose", 12u}, std::pair{"SimulationPurpose", 4u}}) {
    const std::map<std::string, std::uint64_t> numbers = numbers_of(enumeration);
    EXPECT_GE(numbers.size(), least) << enumeration;
    std::map<std::uint64_t, std::string> names;
    for (const auto& [name, number] : numbers) {
      const auto [first, fresh] = names.try_emplace(number, name);
      EXPECT_TRUE(fresh) << enumeration << ": " << name << " and " << first->second << " are both " << number;
    }
  }
}

}  // namespace
}  // namespace demecal
