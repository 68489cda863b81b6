#include "hosts.hpp"

#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

#include "program.hpp"

namespace demecal {
namespace {

/// A process that does nothing but keep a network namespace of its own.
pid_t hold_namespace() {
  int ready[2];
  if (::pipe(ready) != 0) throw std::runtime_error("no pipe");
  const pid_t holder = ::fork();
  if (holder == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const char fault = ::unshare(CLONE_NEWNET) == 0 ? '\0' : static_cast<char>(errno);
    if (::write(ready[1], &fault, 1) != 1) ::_exit(1);
    for (;;) ::pause();
  }
  char fault = EIO;
  const bool heard = ::read(ready[0], &fault, 1) == 1;
  ::close(ready[0]);
  ::close(ready[1]);
  if (!heard || fault != '\0') {
    throw std::runtime_error(std::string("no network namespace: ") + std::strerror(fault));
  }
  return holder;
}

void release(pid_t holder) {
  ::kill(holder, SIGKILL);
  ::waitpid(holder, nullptr, 0);
}

/// Runs lines of `ip` commands as that process sees the network.
void ip(pid_t network, const std::string& lines) {
  const std::string script = "PATH=$PATH:/usr/sbin:/sbin; ip -batch - <<END\n" + lines + "END\n";
  const Ended ended = StartedProgram("/bin/sh", {"-c", script}, network).wait();
  if (ended.code != 0) throw std::runtime_error("ip ended with " + std::to_string(ended.code) + ": " + ended.err);
}

std::string port(int host) {
  return "port" + std::to_string(host);
}

}  // namespace

Hosts::Hosts(int count) : bridge_(hold_namespace()) {
  try {
    ip(bridge_, "link add name bridge type bridge mcast_snooping 0\nlink set bridge up\n");
    for (int host = 0; host < count; ++host) {
      hosts_.push_back(hold_namespace());
      connect(host);
    }
  } catch (...) {
    for (const pid_t host : hosts_) release(host);
    release(bridge_);
    throw;
  }
}

Hosts::~Hosts() {
  for (const pid_t host : hosts_) release(host);
  release(bridge_);
}

void Hosts::connect(int host) const {
  ip(bridge_, "link add name " + port(host) + " type veth peer name eth0 netns " + std::to_string(at(host)) +
                  "\nlink set " + port(host) + " master bridge up\n");
  ip(at(host), "link set lo up\naddress add " + address(host) + "/24 dev eth0\nlink set eth0 up\n");
}

void Hosts::set_link(int host, const std::string& state) const {
  ip(bridge_, "link set " + port(host) + " " + state + "\n");
}

}  // namespace demecal
