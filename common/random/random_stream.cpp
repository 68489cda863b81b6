#include "random/random_stream.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace demecal::inline random {
namespace {

std::mt19937_64 engine_named(std::initializer_list<std::uint64_t> name) {
  std::vector<std::uint32_t> words;
  for (const std::uint64_t part : name) {
    words.push_back(static_cast<std::uint32_t>(part));
    words.push_back(static_cast<std::uint32_t>(part >> 32));
  }
  std::seed_seq sequence(words.begin(), words.end());
  return std::mt19937_64(sequence);
}

}  // namespace

RandomStream::RandomStream(std::initializer_list<std::uint64_t> name) : engine_(engine_named(name)) {}

std::uint64_t RandomStream::draw() {
  ++drawn_;
  return engine_();
}

void RandomStream::skip(std::uint64_t numbers) {
  engine_.discard(numbers);
  drawn_ += numbers;
}

std::size_t RandomStream::index(std::size_t n) {
  // The product's high half is uniform to 2^-64 n, far below what any experiment here could see (Lemire, 2019).
  __extension__ using Wide = unsigned __int128;
  return static_cast<std::size_t>((static_cast<Wide>(draw()) * n) >> 64);
}

void RandomStream::indices(std::size_t n, std::span<std::size_t> values) {
  __extension__ using Wide = unsigned __int128;
  for (std::size_t i = 0; i < values.size(); i += 2) {
    const Wide product = static_cast<Wide>(draw()) * n;
    values[i] = static_cast<std::size_t>(product >> 64);
    // Where in its part of the range the number fell is uniform again.
    if (i + 1 < values.size())
      values[i + 1] = static_cast<std::size_t>((static_cast<Wide>(static_cast<std::uint64_t>(product)) * n) >> 64);
  }
}

double RandomStream::real() {
  return static_cast<double>(draw() >> 11) * 0x1.0p-53;
}

double RandomStream::normal() {
  const double radius = std::sqrt(-2.0 * std::log1p(-real()));
  return radius * std::cos(2.0 * std::numbers::pi * real());
}

void RandomStream::normals(std::span<double> values) {
  for (std::size_t i = 0; i < values.size(); i += 2) {
    const double radius = std::sqrt(-2.0 * std::log1p(-real()));
    const double angle_rad = 2.0 * std::numbers::pi * real();
    values[i] = radius * std::cos(angle_rad);
    if (i + 1 < values.size()) values[i + 1] = radius * std::sin(angle_rad);
  }
}

}  // namespace demecal::inline random
