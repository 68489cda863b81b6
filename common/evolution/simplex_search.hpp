// Looks for the least value of a function without its slopes: the simplex of Nelder and Mead (1965).
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace demecal {

/// Keeps its memory between searches.
class SimplexSearch {
 public:
  using Function = std::function<double(std::span<const double>)>;

  /// Moves `point`, whose value is `value`, to the best that `evaluations` calls find, and returns its value, never
  /// above `value`. Corners of the first simplex lie a tenth of each coordinate's size, and a tenth, away. Values that
  /// are not finite count as worst.
  double operator()(const Function& function, std::span<double> point, double value, int evaluations);

 private:
  std::span<double> corner(std::size_t i) { return {corners_.data() + i * unknowns_, unknowns_}; }
  std::size_t least() const;
  void start(const Function& function, std::span<const double> point, double value);
  void move(const Function& function);
  double try_at(const Function& function, double from_centre);
  void replace_worst(double value);
  void shrink(const Function& function, std::size_t best);

  std::size_t unknowns_ = 0;
  int left_ = 0;  ///< evaluations
  std::vector<double> corners_, values_, centre_, trial_;
  std::size_t worst_ = 0;
};

}  // namespace demecal
