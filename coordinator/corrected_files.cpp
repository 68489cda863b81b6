#include "coordinator/corrected_files.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <system_error>

#include "coordinator/commands.hpp"
#include "data/text.hpp"
#include "languages/languages.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

constexpr std::string_view kSeal = "sha256:";
constexpr std::string_view kUnsealed = "000000000000";

/// Where the hash of the mark begins; npos: there is none.
std::size_t place_of_seal(std::string_view text) {
  const std::optional<std::size_t> line = marked_line(text);
  std::size_t begin = 0;
  for (std::size_t i = 1; i < line.value_or(0); ++i) begin = text.find('\n', begin) + 1;
  const std::size_t seal = line ? text.find(kSeal, begin) : std::string_view::npos;
  if (seal == std::string_view::npos || text.size() - seal < kSeal.size() + kUnsealed.size()) return text.npos;
  return seal + kSeal.size();
}

/// The hash that belongs at `place`, over the text without any.
std::string seal_at(std::size_t place, std::string text) {
  return sha256(text.replace(place, kUnsealed.size(), kUnsealed)).substr(0, kUnsealed.size());
}

}  // namespace

std::string with_sealed_mark(const std::string& text, const Language& language, const std::string& mark) {
  std::string marked = with_mark(text, language, mark + ' ' + std::string(kSeal) + std::string(kUnsealed));
  const std::size_t place = place_of_seal(marked);
  return place == std::string::npos ? marked : marked.replace(place, kUnsealed.size(), seal_at(place, marked));
}

bool is_as_written(std::string_view text) {
  const std::size_t place = place_of_seal(text);
  return place != std::string_view::npos && text.substr(place, kUnsealed.size()) == seal_at(place, std::string(text));
}

void require_writable(const std::filesystem::path& out, const ProgramFile& original,
                      const std::vector<ProgramFile>& program, bool force) {
  std::error_code none;
  for (const ProgramFile& file : program) {
    if (std::filesystem::equivalent(file.name, out, none) || out == file.name) {
      throw ArgumentError("--out: " + out.string() +
                          " is the program itself, which is never overwritten; name another" +
                          (program.size() > 1 ? " folder" : ""));
    }
  }
  if (force || !std::filesystem::exists(out, none)) return;
  if (std::filesystem::is_regular_file(out, none)) {
    const std::string there = read_file(out);
    if (is_as_written(there) || there == original.text) return;
    if (marked_line(there))
      throw ArgumentError("--out: " + out.string() +
                          " was changed since demecal wrote it, or is by an earlier version, so that this cannot be "
                          "told; name another, or give --force to overwrite it");
  }
  throw ArgumentError("--out: " + out.string() +
                      " is there already, and not a program that demecal corrected; name "
                      "another, or give --force to overwrite it");
}

void write_corrected(const ProgramSource& source, const CorrectedProgram& corrected, const Language& language,
                     const std::string& mark, const std::vector<std::filesystem::path>& places) {
  const std::vector<std::string> texts = corrected_files(source, corrected);
  std::error_code failed;
  if (places.size() > 1) std::filesystem::create_directories(places.front().parent_path(), failed);
  if (failed) {
    throw ArgumentError("--out: " + places.front().parent_path().string() +
                        " cannot be made a folder: " + failed.message());
  }
  for (std::size_t file = 0; file < places.size(); ++file) {
    const bool changed = texts[file] != source.files()[file].text;
    write_file(places[file], changed ? with_sealed_mark(texts[file], language, mark) : texts[file]);
  }
}

std::vector<ProgramFile> applications_beside(const ProgramSource& source, const Language& language) {
  std::vector<ProgramFile> found;
  std::set<std::filesystem::path> folders;
  if (language.application_ending.empty()) return found;
  for (const ProgramFile& file : source.files()) {
    const std::filesystem::path folder = std::filesystem::path(file.name).parent_path();
    folders.insert(folder.empty() ? "." : folder);
  }
  for (const std::filesystem::path& folder : folders) {
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none))
      if (lower_case(entry.path().extension().string()) == '.' + std::string(language.application_ending))
        found.push_back({(folder == "." ? entry.path().filename() : entry.path()).string(), read_file(entry.path())});
  }
  std::ranges::sort(found, {}, &ProgramFile::name);
  return found;
}

}  // namespace demecal
