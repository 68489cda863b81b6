#include "parsed_programs/changed_names.hpp"

#include <algorithm>
#include <utility>

#include "data/text.hpp"

namespace demecal::inline parsed_programs {
namespace {

/// The name in small letters, and its indices: "2,3"; none where there are none or one of them is no number.
std::pair<std::string, std::string> split_name(std::string_view name) {
  const std::size_t open = std::min(name.find_first_of("[{("), name.size());
  std::string indices;
  for (const char letter : name.substr(open)) {
    if (is_digit(letter)) {
      indices += letter;
    } else if (letter == ',' || letter == '}' || letter == ']') {
      indices += ',';
    } else if (is_word_letter(letter) || letter == '+' || letter == '-' || letter == '*') {
      indices.clear();
      break;
    }
  }
  std::string stem = lower_case(name.substr(0, open));
  std::erase_if(stem, [](char letter) { return letter == ' ' || letter == '\t'; });
  return {stem, indices};
}

}  // namespace

std::string ChangedNames::line_of(std::size_t offset) const {
  const TextPlace place = text_.place(offset);
  const auto& files = text_.source().files();
  return "line " + std::to_string(place.line) + (files.size() > 1 ? " of " + files[place.file].name : "");
}

void ChangedNames::add(std::string_view name, const std::string& sentence, bool records) {
  const auto [stem, indices] = split_name(name);
  sentences_[stem].try_emplace(indices, sentence);
  if (!records) besides_recording_[stem].try_emplace(indices, sentence);
}

void ChangedNames::changed(std::string_view name, std::size_t offset) {
  add(name, line_of(offset) + " changes it when the program runs", false);
}

void ChangedNames::recorded(std::string_view name, std::size_t offset) {
  add(name, line_of(offset) + " changes it when the program runs", true);
}

std::string ChangedNames::guided_sentence(std::size_t offset, const std::string& by) const {
  return line_of(offset) + " moves to it with " + by + ", by which sensors shift the motion when the program runs";
}

void ChangedNames::guided(std::string_view name, std::size_t offset, const std::string& by) {
  add(name, guided_sentence(offset, by), false);
}

void ChangedNames::used(std::string_view name, std::size_t offset) {
  add(name, line_of(offset) + " uses it otherwise than to move to it, and what becomes of it there is not followed",
      false);
}

std::string ChangedNames::why(std::string_view name) const {
  return find(sentences_, name);
}

std::string ChangedNames::find(const Sentences& sentences, std::string_view name) {
  const auto [stem, indices] = split_name(name);
  const auto found = sentences.find(stem);
  if (stem.empty() || found == sentences.end()) return "";
  for (const auto& [which, sentence] : found->second) {
    if (which.empty() || indices.empty() || which == indices) return sentence;
  }
  return "";
}

void ChangedNames::mark(std::vector<Target>& targets) const {
  for (Target& target : targets) {
    if (!target.not_sent_to.empty()) continue;
    target.not_sent_to = why(target.name);
    target.only_recorded = !target.not_sent_to.empty() && find(besides_recording_, target.name).empty();
  }
}

}  // namespace demecal::inline parsed_programs
