#include "test/link/interposed.h"

#include <dlfcn.h>
#include <netdb.h>
#include <sys/socket.h>

#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <mutex>
#include <string>
#include <utility>

namespace {

std::mutex mutex;
std::condition_variable released;
bool hanging = true;
std::atomic<bool> to_itself{false};
std::atomic<int> connect_error{0};
std::atomic<int> socket_error{0};

template <class Function>
Function* original(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

int resolve(const char* node, const char* service, const addrinfo* hints, addrinfo** result) {
  static const auto kSystem = original<decltype(getaddrinfo)>("getaddrinfo");
  return kSystem(node, service, hints, result);
}

int resolveTwo(const char* service, const addrinfo* hints, addrinfo** result) {
  addrinfo* second = nullptr;
  resolve("127.0.0.2", service, hints, result);
  resolve("127.0.0.1", service, hints, &second);
  (*result)->ai_next = second;
  return 0;
}

/// Its first address is longer than any of TCP.
int resolveAlien(const char* service, const addrinfo* hints, addrinfo** result) {
  resolveTwo(service, hints, result);
  (*result)->ai_family = AF_UNIX;
  (*result)->ai_addrlen = 110;
  return 0;
}

int outOfFiles() {
  errno = EMFILE;
  return EAI_SYSTEM;
}

}  // namespace

extern "C" int getaddrinfo(const char* node, const char* service, const addrinfo* hints,
                           addrinfo** result) {
  const std::string name = node == nullptr ? "" : node;
  if (name == "absent.test") return EAI_NONAME;
  if (name == "broken.test") return EAI_AGAIN;
  if (name == "files.test") return outOfFiles();
  if (name == "second.test") return resolveTwo(service, hints, result);
  if (name == "mixed.test") return resolveAlien(service, hints, result);
  if (name == "alien.test") {
    resolveAlien(service, hints, result);
    freeaddrinfo(std::exchange((*result)->ai_next, nullptr));
    return 0;
  }
  if (name != "hanging.test") return resolve(node, service, hints, result);
  std::unique_lock<std::mutex> lock(mutex);
  released.wait(lock, [] { return !hanging; });
  return resolve("127.0.0.1", service, hints, result);
}

extern "C" int connect(int fd, const sockaddr* address, socklen_t size) {
  static const auto kSystem = original<int(int, const sockaddr*, socklen_t)>("connect");
  if (connect_error != 0) {
    errno = connect_error;
    return -1;
  }
  const int on = 1;
  if (to_itself && (setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0 ||
                    bind(fd, address, size) != 0)) {
    return -1;
  }
  return kSystem(fd, address, size);
}

extern "C" int socket(int domain, int type, int protocol) {
  static const auto kSystem = original<int(int, int, int)>("socket");
  if (socket_error == 0) return kSystem(domain, type, protocol);
  errno = socket_error;
  return -1;
}

namespace frontseat_driver::link::testing {

void hangNames() {
  const std::lock_guard<std::mutex> lock(mutex);
  hanging = true;
}

void releaseHangingNames() {
  const std::lock_guard<std::mutex> lock(mutex);
  hanging = false;
  released.notify_all();
}

void connectToItself(bool on) { to_itself = on; }

void failConnects(int error) { connect_error = error; }

void failSockets(int error) { socket_error = error; }

}  // namespace frontseat_driver::link::testing
