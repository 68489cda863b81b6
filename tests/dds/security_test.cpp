// What the certificates of scripts/security allow is what idl/calibration.idl says of each role, topic by topic.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>

#include "dds/participant.hpp"
#include "errors/input_error.hpp"
#include "network.hpp"
#include "random_messages.hpp"

namespace demecal {
namespace {

/// A folder of certificates, for all tests of this process.
class Certificates {
 public:
  Certificates() {
    char name[] = "/tmp/demecal-certificates-XXXXXX";
    folder_ = ::mkdtemp(name);
    const std::string script = std::string(DEMECAL_SOURCE_DIR) + "/scripts/security ";
    made_ = std::system((script + folder_ + " >/dev/null").c_str()) == 0;
  }
  ~Certificates() { std::filesystem::remove_all(folder_); }
  const std::string& folder() const {
    EXPECT_TRUE(made_);
    return folder_;
  }

 private:
  std::string folder_;
  bool made_;
};

DdsOptions secured_options() {
  static const Certificates certificates;
  DdsOptions options = local_options();
  options.security = certificates.folder();
  return options;
}

/// Whether the certificate that a role shows is one by which a role may do that.
template <class May>
bool any_of_certificate(Role role, May may) {
  for (const Role other : {Role::coordinator, Role::worker, Role::reporter, Role::watcher})
    if (certificate_name(other) == certificate_name(role) && may(other)) return true;
  return false;
}

template <class Make>
bool is_allowed(Make make) {
  try {
    return make() != nullptr;
  } catch (const std::runtime_error&) {
    return false;
  }
}

TEST(Security, CertificatesAllowEachRoleItsTopicsAndNoOthers) {
  for (const Role role : {Role::coordinator, Role::worker, Role::watcher}) {
    DdsParticipant participant(secured_options(), role, "participant");
    for (const Topic topic : kTopics) {
      const std::string what = certificate_name(role) + ", topic " + std::to_string(static_cast<int>(topic));
      EXPECT_EQ(is_allowed([&] { return participant.make_writer(topic); }),
                any_of_certificate(role, [&](Role one) { return writes(one, topic); }))
          << what;
      EXPECT_EQ(is_allowed([&] { return participant.make_reader(topic, 0, nullptr); }),
                any_of_certificate(role, [&](Role one) { return reads(one, topic); }))
          << what;
    }
  }
}

TEST(Security, AWatcherCannotTakeTheCoordinatorsPermissions) {
  DdsOptions options = secured_options();
  const std::filesystem::path mixed = options.security + "/mixed";
  std::filesystem::create_directory(mixed);
  for (const std::string file : {"authority.pem", "governance.p7s", "watcher.pem", "watcher.key"})
    std::filesystem::copy(options.security + "/" + file, mixed / file);
  std::filesystem::copy(options.security + "/coordinator.p7s", mixed / "watcher.p7s");
  options.security = mixed;
  EXPECT_THROW(DdsParticipant(options, Role::watcher, "watcher"), InputError);
}

TEST(Security, EveryRolesMessagesArrive) {
  DdsNetwork network(secured_options());
  const auto coordinator = network.join(Role::coordinator, "coordinator");
  const auto worker = network.join(Role::worker, "worker");
  const auto watcher = network.join(Role::watcher, "watcher");
  worker->publish(status_of("worker"));
  receive_up_to(*coordinator, status_of("worker"));
  const CalibrationData data = RandomMessages(7).data();
  const Message begins = Control{data.run, Control::State::running, ""};
  coordinator->publish(data);
  coordinator->publish(begins);
  receive_until(*worker, [&](const auto& messages) { return messages == std::vector<Message>{data, begins}; });
  Progress progress;
  progress.run = 1;
  progress.worker = "worker";
  worker->publish(progress);
  receive_up_to(*watcher, progress);
}

}  // namespace
}  // namespace demecal
