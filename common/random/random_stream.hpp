// Streams of random numbers that are a function of what they are for, the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <span>

namespace demecal::inline random {

/// A stream named by integers, such as (seed, joint, deme, epoch): equal names give equal numbers, on any platform.
/// Draws are made from the engine's bits directly, since the standard's distributions are not portable.
class RandomStream {
 public:
  explicit RandomStream(std::initializer_list<std::uint64_t> name);

  /// Uniform in [0, n); n >= 1. One number of the stream.
  std::size_t index(std::size_t n);
  /// As many of them, each pair from one number: to 2^-64 n^2 as good as two. n < 2^24.
  void indices(std::size_t n, std::span<std::size_t> values);
  /// Uniform in [0, 1). One number.
  double real();
  double real(double lower, double upper) { return lower + (upper - lower) * real(); }
  bool chance(double probability) { return real() < probability; }
  /// Standard normal (Box and Muller). Two numbers.
  double normal();
  /// As many of them, each pair from two numbers: an odd last one takes two.
  void normals(std::span<double> values);
  /// One number, to name further streams by: what is made in pieces, by whichever thread and in any order, is drawn
  /// from RandomStream{name, number of the piece}.
  std::uint64_t name() { return draw(); }

  /// Numbers drawn so far: a stream of the same name that skips as many goes on as this one does.
  std::uint64_t drawn() const { return drawn_; }
  void skip(std::uint64_t numbers);

 private:
  std::uint64_t draw();

  std::mt19937_64 engine_;
  std::uint64_t drawn_ = 0;
};

}  // namespace demecal::inline random
