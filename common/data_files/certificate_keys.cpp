#include "data/certificate_fields.hpp"
#include "data_files/data_set_file.hpp"
#include "yaml/yaml_node.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinematics/units.hpp"
#include "yaml/yaml_text.hpp"

namespace demecal::inline data_files {
namespace {

constexpr const char* kUncertainty = "instrument_uncertainty_mm";

const std::vector<std::string>& certificate_keys() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> all;
    for (const CertificateField& field : kCertificateFields) all.emplace_back(field.key);
    all.emplace_back(kUncertainty);
    return all;
  }();
  return keys;
}

/// A day of the calendar as ISO 8601 writes it.
bool is_date(const std::string& text) {
  constexpr std::string_view kForm = "dddd-dd-dd";
  if (text.size() != kForm.size()) return false;
  for (std::size_t i = 0; i < kForm.size(); ++i) {
    const bool digit = text[i] >= '0' && text[i] <= '9';
    if (kForm[i] == 'd' ? !digit : text[i] != '-') return false;
  }
  const int year = std::stoi(text.substr(0, 4)), month = std::stoi(text.substr(5, 2)), day = std::stoi(text.substr(8));
  const bool leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  const int days[] = {31, leap ? 29 : 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  return year > 0 && month >= 1 && month <= 12 && day >= 1 && day <= days[month - 1];
}

bool is_country(const std::string& text) {
  const auto capital = [](char letter) { return letter >= 'A' && letter <= 'Z'; };
  return text.size() == 2 && capital(text[0]) && capital(text[1]);
}

}  // namespace

CertificateFields read_certificate(const YamlNode& node) {
  CertificateFields fields;
  if (node.kind == YamlNode::Kind::nothing) return fields;
  node.with_keys(certificate_keys());
  for (const YamlNode& entry : node.children) {
    if (entry.kind == YamlNode::Kind::nothing) continue;
    if (entry.name == kUncertainty) {
      fields.instrument_uncertainty_m = metres(entry.positive());
      continue;
    }
    const std::string& text = entry.text();
    if (std::ranges::all_of(text, [](unsigned char letter) { return std::isspace(letter) != 0; })) continue;
    if (entry.name == "date" && !is_date(text)) entry.fail("must be a day written as 2026-01-31");
    if (entry.name == "country" && !is_country(text)) entry.fail("must be two capital letters, as in DE (ISO 3166-1)");
    fields.texts[entry.name] = text;
  }
  return fields;
}

CertificateFields load_certificate(const std::filesystem::path& data_set_file) {
  const YamlNode root = read_yaml(data_set_file);
  const YamlNode* certificate = root.find("certificate");
  return certificate == nullptr ? CertificateFields{} : read_certificate(*certificate);
}

std::string certificate_text(const CertificateFields& fields) {
  if (fields.empty()) return {};
  std::string text = "certificate:\n";
  for (const auto& [key, value] : fields.texts) text += "  " + key + ": " + yaml_text(value) + '\n';
  if (fields.instrument_uncertainty_m)
    text += std::string("  ") + kUncertainty + ": " + millimetres_text(*fields.instrument_uncertainty_m) + '\n';
  return text;
}

}  // namespace demecal::inline data_files
