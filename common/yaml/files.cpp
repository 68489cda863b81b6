#include "yaml/files.hpp"

#include <openssl/evp.h>
#include <array>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

#include "errors/check.hpp"
#include "errors/input_error.hpp"

namespace demecal::inline yaml {
namespace {

[[noreturn]] void fail_file(const std::filesystem::path& path, const std::string& what, const std::string& why) {
  throw InputError({path.string(), 0}, "", what + ": " + why);
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) fail_file(path, "cannot be read", system_reason(EISDIR));
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail_file(path, "cannot be read", system_reason(errno));
  std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad()) fail_file(path, "cannot be read", system_reason(errno));
  return bytes;
}

void write_file(const std::filesystem::path& path, const std::string& bytes) {
  std::error_code folder_fault;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), folder_fault);
  if (folder_fault) fail_file(path.parent_path(), "cannot be made", folder_fault.message());
  std::filesystem::path unfinished = path;
  unfinished += ".part";
  errno = 0;
  std::ofstream stream(unfinished, std::ios::binary);
  stream << bytes;
  stream.close();
  if (!stream) fail_file(path, "cannot be written", system_reason(errno));
  std::error_code renaming_fault;
  std::filesystem::rename(unfinished, path, renaming_fault);
  if (renaming_fault) fail_file(path, "cannot be written", renaming_fault.message());
}

std::filesystem::path resolve(const std::filesystem::path& file, const std::string& name) {
  return (file.parent_path() / name).lexically_normal();
}

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned int size = 0;
  const int done = EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr);
  DEMECAL_CHECK(done == 1 && size == 32, "size=" << size);
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (unsigned int i = 0; i < size; ++i) {
    text += kDigits[digest[i] >> 4];
    text += kDigits[digest[i] & 15];
  }
  return text;
}

}  // namespace demecal::inline yaml
