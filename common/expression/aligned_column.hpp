// Memory for columns of rows that vector units read.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace demecal {

/// Columns start at a cache line, so that no vector of rows straddles two.
template <class T>
struct LineAligned {
  using value_type = T;
  static constexpr std::size_t kBytes = 64;
  static constexpr std::align_val_t kLine{kBytes};
  LineAligned() = default;
  template <class U>
  explicit LineAligned(const LineAligned<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kLine)); }
  void deallocate(T* memory, std::size_t) { ::operator delete(memory, kLine); }
  bool operator==(const LineAligned&) const = default;
};
using AlignedColumn = std::vector<double, LineAligned<double>>;

}  // namespace demecal
