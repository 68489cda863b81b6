#include "coordinator/xml_signature.hpp"

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <vector>

#include "coordinator/child_process.hpp"
#include "coordinator/commands.hpp"
#include "errors/input_error.hpp"
#include "yaml/files.hpp"

namespace demecal {

std::string require_signer() {
  if (const std::optional<std::string> signer = find_program({"xmlsec1"})) return *signer;
  throw ArgumentError(
      "--sign needs the program xmlsec1, which is not in PATH: install it (Debian package xmlsec1), or leave out "
      "--sign");
}

std::string signed_document(const std::string& signer, const std::string& xml, const SigningFiles& files) {
  const ScratchFolder scratch;
  if (scratch.path().empty()) throw std::runtime_error("no temporary folder for signing");
  for (const std::string& file : {files.key, files.certificate}) read_file(file);
  // Under names of our own: xmlsec1 takes a comma in a name for the end of it.
  const std::string key = scratch.path() + "/key", certificate = scratch.path() + "/certificate";
  std::filesystem::create_symlink(std::filesystem::absolute(files.key), key);
  std::filesystem::create_symlink(std::filesystem::absolute(files.certificate), certificate);
  const std::string document = scratch.path() + "/document", result = scratch.path() + "/signed";
  write_file(document, xml);
  // Without the empty passphrase it would ask a terminal for one.
  if (!runs_well(
          {signer, "--sign", "--pwd", "", "--privkey-pem", key + ',' + certificate, "--output", result, document}))
    throw InputError({files.key, 0}, "",
                     "is no key that xmlsec1 can sign with, or " + files.certificate +
                         " is no certificate that it can read: give an RSA key in PEM without a passphrase, and by "
                         "--certificate its X.509 certificate in PEM");
  if (!runs_well({signer, "--verify", "--enabled-key-data", "rsa", "--pubkey-cert-pem", certificate, result}))
    throw InputError({files.certificate, 0}, "",
                     "is not the certificate of the key " + files.key + ": give the one that was issued for it");
  return read_file(result);
}

}  // namespace demecal
