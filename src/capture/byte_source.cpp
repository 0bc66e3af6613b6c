#include "frontseat_driver/capture/byte_source.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

namespace frontseat_driver::capture {
namespace {

std::atomic<bool> reading_ended{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

[[noreturn]] void fail(int error, const std::string& name) {
  throw std::system_error(error, std::generic_category(), name);
}

struct Rate {
  unsigned baud;
  speed_t setting;
};

constexpr Rate kRates[] = {
    {1200, B1200},     {2400, B2400},     {4800, B4800},     {9600, B9600},
    {19200, B19200},   {38400, B38400},   {57600, B57600},   {115200, B115200},
    {230400, B230400}, {460800, B460800}, {921600, B921600},
};

speed_t settingOf(unsigned baud) {
  std::string known;
  for (const Rate& rate : kRates) {
    if (rate.baud == baud) return rate.setting;
    known += (known.empty() ? "" : ", ") + std::to_string(rate.baud);
  }
  throw std::invalid_argument("baud rate " + std::to_string(baud) + " is none of " + known);
}

void makeRaw(int descriptor, const std::string& name, speed_t rate) {
  termios settings{};
  if (tcgetattr(descriptor, &settings) != 0) fail(errno, name);
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS);
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  cfsetispeed(&settings, rate);
  cfsetospeed(&settings, rate);
  if (tcsetattr(descriptor, TCSANOW, &settings) != 0) fail(errno, name);
}

int openToRead(const std::string& path, int more_flags) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | more_flags);
  if (descriptor < 0) fail(errno, path);
  return descriptor;
}

}  // namespace

std::size_t MemorySource::read(char* to, std::size_t room) {
  const std::size_t count = std::min(room, rest_.size());
  std::memcpy(to, rest_.data(), count);
  rest_.remove_prefix(count);
  return count;
}

std::unique_ptr<FileSource> FileSource::open(const std::string& path) {
  std::unique_ptr<FileSource> source{new FileSource(openToRead(path, 0), path)};
  source->learnSize();
  return source;
}

std::unique_ptr<FileSource> FileSource::standardInput() {
  const int descriptor = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0);
  if (descriptor < 0) fail(errno, "standard input");
  std::unique_ptr<FileSource> source{new FileSource(descriptor, "standard input")};
  source->learnSize();
  return source;
}

std::unique_ptr<FileSource> FileSource::openSerial(const std::string& path, unsigned baud) {
  const speed_t rate = settingOf(baud);
  // Without O_NONBLOCK the open itself would wait for a carrier.
  const int descriptor = openToRead(path, O_NOCTTY | O_NONBLOCK);
  std::unique_ptr<FileSource> source{new FileSource(descriptor, path)};
  makeRaw(descriptor, path, rate);
  const int flags = fcntl(descriptor, F_GETFL);
  if (flags < 0 || fcntl(descriptor, F_SETFL, flags & ~O_NONBLOCK) != 0) fail(errno, path);
  source->live_ = true;
  return source;
}

void FileSource::learnSize() {
  struct stat status {};
  if (fstat(descriptor_, &status) != 0) fail(errno, name_);
  if (S_ISDIR(status.st_mode)) fail(EISDIR, name_);
  if (S_ISREG(status.st_mode)) size_ = static_cast<std::uint64_t>(status.st_size);
}

FileSource::~FileSource() { ::close(descriptor_); }

std::size_t FileSource::read(char* to, std::size_t room) {
  while (!reading_ended) {
    const ssize_t count = ::read(descriptor_, to, room);
    if (count >= 0) return static_cast<std::size_t>(count);
    // The other side of a pseudo-terminal, or a USB adapter, is gone.
    if (live_ && errno == EIO) return 0;
    if (errno != EINTR) fail(errno, name_);
  }
  return 0;
}

bool FileSource::isSerial(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || !S_ISCHR(status.st_mode)) return false;
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
  if (descriptor < 0) return false;
  const bool terminal = isatty(descriptor) == 1;
  ::close(descriptor);
  return terminal;
}

void FileSource::endReading() { reading_ended = true; }

}  // namespace frontseat_driver::capture
