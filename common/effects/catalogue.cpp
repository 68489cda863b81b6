#include "effects/catalogue.hpp"

#include <algorithm>
#include <functional>
#include <ranges>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "effects/effect.hpp"
#include "errors/check.hpp"

namespace demecal::inline effects {

// Each is defined in the file of its law.
const EffectLaw& registration_law();
const EffectLaw& tool_law();
const EffectLaw& joint_offset_law();
const EffectLaw& geometry_law();
const EffectLaw& gain_law();
const EffectLaw& eccentricity_law();
const EffectLaw& gear_harmonic_law();
const EffectLaw& compliance_law();
const EffectLaw& balancer_law();
const EffectLaw& link_bending_law();
const EffectLaw& coupling_law();
const EffectLaw& jump_law();
const EffectLaw& backlash_law();
const EffectLaw& hysteresis_law();
const EffectLaw& axis_wobble_law();
const EffectLaw& thermal_offset_law();
const EffectLaw& thermal_length_law();
const EffectLaw& drift_law();
const EffectLaw& sensor_scale_law();
const EffectLaw& symbolic_law();

namespace {

constexpr int kLast = 99;

struct CatalogueLine {
  const EffectLaw* law;
  CauseGroup group;
  int rarity;              ///< place among the causes, the most common first
  int place_among_limits;  ///< see Cause
  std::string_view words;
  double largest_turn_rad, largest_shift_m;
};

// The lines stand in the order in which effects are proposed and models list them.
//
// Rarity is engineering judgement around what the thesis reports (section 1): geometry makes the largest part of an
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
const std::vector<CatalogueLine>& catalogue_lines() {
  static const std::vector<CatalogueLine> lines{
      {&registration_law(), CauseGroup::instrument, 2, kLast, "the base's place", 0.1, 0.1},
      {&tool_law(), CauseGroup::tool, 3, kLast, "the tool point", 0.1, 0.1},
      {&joint_offset_law(), CauseGroup::zero, 1, kLast, "the zero", 0.1, 0.02},
      {&geometry_law(), CauseGroup::link_geometry, 0, kLast, "link geometry", 0.02, 0.02},
      {&gain_law(), CauseGroup::transmission, 8, kLast, "the gain", 0.02, 0.02},
      {&eccentricity_law(), CauseGroup::transmission, 4, 2, "eccentricity of the gear or encoder", 0.005, 0.005},
      {&gear_harmonic_law(), CauseGroup::transmission, 5, 5, "running error of the gear", 0.005, 0.005},
      {&compliance_law(), CauseGroup::elasticity, 7, 1, "compliance", 0.02, 0.02},
      {&balancer_law(), CauseGroup::balance_spring, 10, kLast, "the balancer's pull", 0.02, 0.02},
      {&link_bending_law(), CauseGroup::elasticity, 11, 7, "bending of the link", 0.02, 0.02},
      {&coupling_law(), CauseGroup::transmission, 12, 4, "coupling to another joint", 0.02, 0.02},
      {&jump_law(), CauseGroup::encoder, 17, kLast, "a jump", 0.005, 0.005},
      {&backlash_law(), CauseGroup::lost_motion, 6, 0, "backlash", 0.005, 0.005},
      {&hysteresis_law(), CauseGroup::lost_motion, 9, 3, "friction hysteresis", 0.005, 0.005},
      {&axis_wobble_law(), CauseGroup::bearing, 13, 6, "wobble of the axis", 0.005, 0.005},
      {&thermal_offset_law(), CauseGroup::heat, 14, 8, "the zero's shift with temperature", 0.005, 0.005},
      {&thermal_length_law(), CauseGroup::heat, 15, kLast, "thermal growth", 0.005, 0.005},
      {&drift_law(), CauseGroup::instrument, 16, 9, "drift of base or instrument", 0.005, 0.005},
      {&sensor_scale_law(), CauseGroup::instrument, 19, kLast, "instrument scale", 0.005, 0.005},
      {&symbolic_law(), CauseGroup::formula, 18, kLast, "a formula", 0.02, 0.02}};
  return lines;
}

std::vector<Cause> causes_by_rarity() {
  std::vector<CatalogueLine> lines = catalogue_lines();
  std::ranges::sort(lines, {}, &CatalogueLine::rarity);
  std::vector<Cause> causes;
  for (const CatalogueLine& line : lines) {
    causes.push_back({line.law->kind(), line.words, line.largest_turn_rad, line.largest_shift_m, line.group,
                      line.place_among_limits});
  }
  return causes;
}

}  // namespace

const std::vector<const EffectLaw*>& catalogue() {
  static const std::vector<const EffectLaw*> laws = [] {
    std::vector<const EffectLaw*> all;
    for (const CatalogueLine& line : catalogue_lines()) all.push_back(line.law);
    return all;
  }();
  return laws;
}

const EffectLaw* find_law(std::string_view kind) {
  static const auto by_kind = [] {  // asked for at every pose
    std::unordered_map<std::string_view, const EffectLaw*> laws;
    for (const EffectLaw* const law : catalogue()) laws.emplace(law->kind(), law);
    return laws;
  }();
  const auto found = by_kind.find(kind);
  return found == by_kind.end() ? nullptr : found->second;
}

const EffectLaw& law_of(const Effect& effect) {
  const EffectLaw* law = find_law(effect.kind);
  DEMECAL_CHECK(law != nullptr, "kind '" << effect.kind << "'");
  return *law;
}

std::span<const Cause> causes() {
  static const std::vector<Cause> all = causes_by_rarity();
  return all;
}

std::size_t rarity(std::string_view kind) {
  const auto all = causes();
  return static_cast<std::size_t>(std::ranges::find(all, kind, &Cause::kind) - all.begin());
}

const Cause& cause_of(std::string_view kind) {
  const std::size_t place = rarity(kind);
  DEMECAL_CHECK(place < causes().size(), "kind '" << kind << "'");
  return causes()[place];
}

int place_among_limits(std::string_view kind) {
  const std::size_t place = rarity(kind);
  return place < causes().size() ? causes()[place].place_among_limits : kLast;
}

bool is_harmonic(std::string_view kind) {
  const EffectLaw* law = find_law(kind);
  return law != nullptr && law->is_harmonic();
}

}  // namespace demecal::inline effects
