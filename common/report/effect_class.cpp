#include "report/effect_class.hpp"

#include <algorithm>
#include <cctype>

#include "effects/likely_causes.hpp"

namespace demecal {
namespace {

constexpr double kAsOne = 0.98;  ///< cosine above which an effect goes by the name of its class

bool same_place(const Effect& a, const Effect& b) {
  return a.kind == b.kind && a.joint == b.joint;
}

std::string kind_words(const std::string& kind) {
  return rarity(kind) < causes().size() ? std::string(cause_of(kind).words) : kind;
}

/// " of joints 2, 3 and 4".
std::string joints_words(const std::vector<int>& joints) {
  if (joints.empty()) return {};
  std::string text = joints.size() == 1 ? " of joint " : " of joints ";
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const bool last = i + 1 == joints.size();
    text += (i == 0 ? "" : last ? " and " : ", ") + std::to_string(joints[i] + 1);
  }
  return text;
}

}  // namespace

std::vector<Effect> effect_class(const Round& round) {
  std::vector<Effect> members{round.effect};
  for (const Rival& rival : round.rivals) {
    const auto is_it = [&rival](const Effect& member) { return same_place(member, rival.effect); };
    if (rival.cosine > kAsOne && std::ranges::none_of(members, is_it)) members.push_back(rival.effect);
  }
  if (members.size() < 2) return {};
  std::ranges::stable_sort(members, [](const Effect& a, const Effect& b) {
    return std::pair(rarity(a.kind), a.joint) < std::pair(rarity(b.kind), b.joint);
  });
  return members;
}

std::string class_words(const std::vector<Effect>& members) {
  std::string text;
  const auto elsewhere = [&members](const Effect& member) { return member.joint != members.front().joint; };
  if (!members.empty() && members.front().joint >= 0 && std::ranges::none_of(members, elsewhere)) {
    for (const Effect& member : members) text += (text.empty() ? "" : " or ") + kind_words(member.kind);
    return text + joints_words({members.front().joint});
  }
  for (std::size_t i = 0; i < members.size();) {
    std::vector<int> joints;
    const std::string& kind = members[i].kind;
    for (; i < members.size() && members[i].kind == kind; ++i) {
      if (members[i].joint >= 0) joints.push_back(members[i].joint);
    }
    text += (text.empty() ? "" : " or ") + kind_words(kind) + joints_words(joints);
  }
  return text;
}

std::string class_sentence(const std::vector<Effect>& members) {
  if (members.empty()) return {};
  std::string text = class_words(members) + ": these poses cannot tell.";
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace demecal
