#include "formulas/notes.hpp"

#include <algorithm>

namespace demecal {
namespace {

/// What it depends on beside joints and masses, by law.needs(); empty where on nothing.
std::string circumstances(const Needs& needs) {
  std::string words;
  const auto add = [&](bool needed, const char* word) {
    if (needed) words += (words.empty() ? "" : " and ") + std::string(word);
  };
  add(needs.approach, "the side from which joints come");
  add(needs.payload, "the payload");
  add(needs.temperature, "the temperature");
  add(needs.time, "the time");
  return words;
}

/// Whether what the arm carries would change it, though it is not of the payload alone.
bool bears_weight(const Effect& effect, const Robot& robot) {
  const auto with_payload = effect.settings.find("with_payload");
  if (effect.kind == "compliance" && effect.form == "moments") {
    return with_payload != effect.settings.end() && with_payload->second != 0.0;
  }
  return law_of(effect).needs(effect, robot).masses;
}

}  // namespace

std::string note_on(const Effect& effect, const Robot& robot, bool held) {
  const std::string name =
      effect.kind + (effect.joint < 0 ? std::string() : " of joint " + std::to_string(effect.joint + 1));
  const Needs needs = law_of(effect).needs(effect, robot);
  const std::string words = circumstances(needs);
  if (!held) {
    return name + " is left out" + (words.empty() ? "" : ", for it depends on " + words) + '.';
  }
  std::string note;
  if (needs.approach || needs.temperature || needs.time) note = name + " is taken with s = 0 and T = 0.";
  if (bears_weight(effect, robot))
    note += (note.empty() ? "" : " ") + name + " is that of an arm that carries nothing.";
  return note;
}

}  // namespace demecal
