#include "transport/dds_security.hpp"

#include <filesystem>
#include <fstream>

#include "errors/input_error.hpp"

namespace demecal {
namespace {

/// The file as a property names it.
std::string readable(const std::filesystem::path& folder, const std::string& file) {
  const std::filesystem::path path = folder / file;
  if (!std::filesystem::is_regular_file(path) || !std::ifstream(path)) {
    throw InputError({path.string(), 0}, "",
                     "is missing or unreadable; `scripts/security DIR` makes a folder of certificates");
  }
  return "file://" + std::filesystem::absolute(path).string();
}

}  // namespace

std::string certificate_name(Role role) {
  switch (role) {
    case Role::coordinator:
    case Role::herald:
      return "coordinator";
    case Role::worker:
      return "worker";
    case Role::watcher:
      break;
  }
  return "watcher";
}

void set_security(eprosima::fastdds::dds::DomainParticipantQos& qos, const std::string& folder, Role role) {
  const std::string name = certificate_name(role);
  const std::string authority = readable(folder, "authority.pem");
  const std::string identity = "dds.sec.auth.builtin.PKI-DH.", access = "dds.sec.access.builtin.Access-Permissions.";
  auto& properties = qos.properties().properties();
  properties.emplace_back("dds.sec.auth.plugin", "builtin.PKI-DH");
  properties.emplace_back(identity + "identity_ca", authority);
  properties.emplace_back(identity + "identity_certificate", readable(folder, name + ".pem"));
  properties.emplace_back(identity + "private_key", readable(folder, name + ".key"));
  properties.emplace_back("dds.sec.access.plugin", "builtin.Access-Permissions");
  properties.emplace_back(access + "permissions_ca", authority);
  properties.emplace_back(access + "governance", readable(folder, "governance.p7s"));
  properties.emplace_back(access + "permissions", readable(folder, name + ".p7s"));
  properties.emplace_back("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC");
}

}  // namespace demecal
