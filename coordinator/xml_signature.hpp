// Documents signed by the program xmlsec1, which happens to be installed or not.
#pragma once

#include <string>

namespace demecal {

struct SigningFiles {
  std::string key, certificate;  ///< in PEM: an RSA key without a passphrase, and its X.509 certificate
};

/// The path of xmlsec1. Throws ArgumentError where it is not in PATH.
std::string require_signer();

/// The document with its empty signature (with_empty_signature) filled in, and the certificate in it. Throws InputError
/// naming key or certificate where one cannot be read or they do not belong together.
std::string signed_document(const std::string& signer, const std::string& xml, const SigningFiles& files);

}  // namespace demecal
