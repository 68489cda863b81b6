// Whole files as text, in and out, and the hash by which results name their bytes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace demecal::inline yaml {

/// The bytes of the file. Throws InputError naming the file and the reason where it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// Writes the bytes, making the folders on the way; the file appears whole or not at all. Throws InputError naming the
/// file and the reason where it cannot.
void write_file(const std::filesystem::path& path, const std::string& bytes);

/// `name` as written in `file`: relative to that file's folder unless absolute.
std::filesystem::path resolve(const std::filesystem::path& file, const std::string& name);

/// SHA-256 (FIPS 180-4) of the bytes, 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace demecal::inline yaml
