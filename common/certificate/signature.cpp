#include <cstddef>
#include <string>
#include <string_view>

#include "certificate/documents.hpp"
#include "errors/check.hpp"

namespace demecal::inline certificate {
namespace {

/// Over the whole document but the signature itself (W3C, XML Signature Syntax and Processing).
constexpr std::string_view kUnsigned =
    R"(<ds:Signature xmlns:ds="http://www.w3.org/2000/09/xmldsig#"><ds:SignedInfo>)"
    R"(<ds:CanonicalizationMethod Algorithm="http://www.w3.org/2001/10/xml-exc-c14n#"/>)"
    R"(<ds:SignatureMethod Algorithm="http://www.w3.org/2001/04/xmldsig-more#rsa-sha256"/><ds:Reference URI="">)"
    R"(<ds:Transforms><ds:Transform Algorithm="http://www.w3.org/2000/09/xmldsig#enveloped-signature"/>)"
    R"(<ds:Transform Algorithm="http://www.w3.org/2001/10/xml-exc-c14n#"/></ds:Transforms>)"
    R"(<ds:DigestMethod Algorithm="http://www.w3.org/2001/04/xmlenc#sha256"/><ds:DigestValue/></ds:Reference>)"
    R"(</ds:SignedInfo><ds:SignatureValue/><ds:KeyInfo><ds:X509Data/></ds:KeyInfo></ds:Signature>)";

}  // namespace

std::string with_empty_signature(std::string xml) {
  const std::size_t end = xml.rfind("</");
  DEMECAL_CHECK(end != std::string::npos, "bytes=" << xml.size());
  return xml.insert(end, std::string(kUnsigned) + '\n');
}

}  // namespace demecal::inline certificate
