// The key `certificate`, which jobs, data sets and models may have.
#pragma once

#include <filesystem>
#include <string>

#include "data/certificate_fields.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {

/// What the map states; a key without a value states nothing. Throws InputError at an unknown key, a date or country of
/// another form, or an uncertainty that is not positive.
CertificateFields read_certificate(const YamlNode& node);

/// What the DATASET.yaml states; nothing where it has no such key.
CertificateFields load_certificate(const std::filesystem::path& data_set_file);

/// The key and its map, as read_certificate() takes them; empty where nothing is stated.
std::string certificate_text(const CertificateFields& fields);

}  // namespace demecal::inline config
