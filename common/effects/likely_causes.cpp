#include "effects/likely_causes.hpp"

#include <algorithm>
#include <array>

#include "errors/check.hpp"

namespace demecal {
namespace {

// The order is engineering judgement around what the thesis reports (section 1): geometry makes the largest part of an
// uncalibrated arm's error (zeros of joints almost 90 % of one arm's; another went from 3 to 0.69 mm by geometry alone
// and to 0.58 mm with all else). Errors and lost motion of gears come next, then what gives way under load; joints that
// drag others, warmth and drift are rarer, and a wrong scale of an instrument is the rarest: instruments are calibrated
// against lengths.
//
// The largest motions: 20 mrad and 20 mm are what links and mountings are made and put up to at worst, and what gears
// and bearings under load give way by before they count as broken; lost zeros of joints are larger. 5 mrad (17 arcmin)
// is many times what makers allow gears as lost motion or running error (1 to 3 arcmin, and some 10 where worn). 5 mm
// is 0.2 % of a large arm's reach: more than steel and aluminium grow by 40 K, and what wire instruments are wrong by
// at worst.
constexpr std::array<Cause, 18> kCauses{{{"geometry", "link geometry", 0.02, 0.02},
                                         {"joint_offset", "the zero", 0.1, 0.02},
                                         {"registration", "the base's place", 0.1, 0.1},
                                         {"tool", "the tool point", 0.1, 0.1},
                                         {"eccentricity", "eccentricity of the gear or encoder", 0.005, 0.005},
                                         {"gear_harmonic", "running error of the gear", 0.005, 0.005},
                                         {"backlash", "backlash", 0.005, 0.005},
                                         {"compliance", "compliance", 0.02, 0.02},
                                         {"gain", "the gain", 0.02, 0.02},
                                         {"hysteresis", "friction hysteresis", 0.005, 0.005},
                                         {"link_bending", "bending of the link", 0.02, 0.02},
                                         {"coupling", "coupling to another joint", 0.02, 0.02},
                                         {"axis_wobble", "wobble of the axis", 0.005, 0.005},
                                         {"thermal_offset", "the zero's shift with temperature", 0.005, 0.005},
                                         {"thermal_length", "thermal growth", 0.005, 0.005},
                                         {"drift", "drift of base or instrument", 0.005, 0.005},
                                         {"symbolic", "a formula", 0.02, 0.02},
                                         {"sensor_scale", "instrument scale", 0.005, 0.005}}};

}  // namespace

std::span<const Cause> causes() {
  return kCauses;
}

std::size_t rarity(std::string_view kind) {
  return static_cast<std::size_t>(std::ranges::find(kCauses, kind, &Cause::kind) - kCauses.begin());
}

const Cause& cause_of(std::string_view kind) {
  const std::size_t place = rarity(kind);
  DEMECAL_CHECK(place < kCauses.size(), "kind '" << kind << "'");
  return kCauses[place];
}

}  // namespace demecal
