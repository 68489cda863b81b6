#include "diagnosis/rivals.hpp"

#include <algorithm>
#include <cmath>

namespace demecal {
namespace {

constexpr double kAlike = 0.9;
constexpr double kRelated = 0.5;
constexpr double kNatsToTell = 5.0;
constexpr std::size_t kMost = 8;

/// Whether `other` is the wave `named` with a phase that is not given: the same formula, no rival.
bool is_its_wave(const Effect& named, const Effect& other) {
  if (named.joint != other.joint || other.form != "wave" || named.formula.empty()) return false;
  const Primitive root = named.formula[0].primitive;
  return (root == Primitive::sine || root == Primitive::cosine) &&
         std::equal(named.formula.begin() + 1, named.formula.end(), other.formula.begin(), other.formula.end());
}

}  // namespace

std::vector<Rival> rivals_of(std::size_t named, const Projection::Trial& explained, const std::vector<Candidate>& all,
                             const std::vector<Score>& scores, const Scan& scan, const EffectColumns& columns,
                             const ResidualField& field) {
  const RowMatrix share = explained.fitted * explained.coefficients;
  const std::vector<double> cosines = scan.cosines(columns.transposed_times(field, share), share.squaredNorm());
  std::vector<Rival> rivals;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i == named || all[i].disguise != Disguise::none) continue;
    const double behind = scores[named].fall_nats - scores[i].fall_nats;
    const bool unnamed = is_symbolic(all[i].effect) && !is_symbolic(all[named].effect);
    if (unnamed) continue;  // a name is preferred to a formula: formulas are no rivals of named effects
    if (is_its_wave(all[named].effect, all[i].effect)) continue;
    if (cosines[i] > kAlike || (cosines[i] > kRelated && std::abs(behind) < kNatsToTell)) {
      rivals.push_back({all[i].effect, cosines[i], behind});
    }
  }
  std::stable_sort(rivals.begin(), rivals.end(), [](const Rival& a, const Rival& b) { return a.cosine > b.cosine; });
  if (rivals.size() > kMost) rivals.resize(kMost);
  return rivals;
}

}  // namespace demecal
