#include "frontseat_driver/capture/byte_source.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/time.h>
#include <termios.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>

namespace frontseat_driver::capture {
namespace {

std::string readAll(ByteSource& source) {
  std::string all;
  char room[7];
  while (const std::size_t count = source.read(room, sizeof room)) all.append(room, count);
  return all;
}

TEST(MemorySource, GivesItsBytesOnce) {
  MemorySource source{"$A*00\n$B*00\n"};
  EXPECT_EQ(source.size(), 12U);
  EXPECT_EQ(readAll(source), "$A*00\n$B*00\n");
  EXPECT_EQ(readAll(source), "");
}

TEST(FileSource, ReadsAFileAndKnowsItsSize) {
  const auto source = FileSource::open(std::string{CAPTURES} + "/heron_2014.nmea");
  EXPECT_EQ(source->size(), 960U);
  EXPECT_FALSE(source->live());
  EXPECT_EQ(readAll(*source).substr(0, 10), "$CPIMU,164");
}

TEST(FileSource, NamesTheFileThatIsNotThere) {
  try {
    const auto source = FileSource::open("no/such\nfile");
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code().value(), ENOENT);
    EXPECT_EQ(std::string{error.what()}, "no/such\nfile: No such file or directory");
  }
}

/// Puts a file in the place of the standard input while it lives.
class StandardInput {
 public:
  explicit StandardInput(int file) : before_(dup(STDIN_FILENO)) {
    ::close(STDIN_FILENO);
    if (file >= 0) dup2(file, STDIN_FILENO);
  }
  ~StandardInput() {
    dup2(before_, STDIN_FILENO);
    ::close(before_);
  }
  StandardInput(const StandardInput&) = delete;
  StandardInput& operator=(const StandardInput&) = delete;

 private:
  int before_;
};

TEST(FileSource, ReadsWhatIsPipedIntoIt) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const StandardInput input{ends[0]};
  ASSERT_EQ(write(ends[1], "$A*00\n", 6), 6);
  ::close(ends[1]);
  const auto source = FileSource::standardInput();
  ::close(ends[0]);
  EXPECT_EQ(source->size(), std::nullopt);
  EXPECT_FALSE(source->live());
  EXPECT_EQ(readAll(*source), "$A*00\n");
}

TEST(FileSource, SaysThatThereIsNoStandardInput) {
  const StandardInput none{-1};
  try {
    const auto source = FileSource::standardInput();
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(std::string{error.what()}, "standard input: Bad file descriptor");
  }
}

TEST(FileSource, RefusesAFolder) {
  EXPECT_THROW((void)FileSource::open(CAPTURES), std::system_error);
}

/// Two ends of a line, as a serial cable has them.
class Terminal {
 public:
  Terminal() : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) {
      throw std::runtime_error("no pseudo-terminal");
    }
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal() { hangUp(); }

  std::string path() const { return ptsname(master_); }
  void write(const std::string& text) const {
    ASSERT_EQ(::write(master_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void hangUp() {
    if (master_ >= 0) ::close(master_);
    master_ = -1;
  }

 private:
  int master_;
};

TEST(FileSource, ReadsASerialDeviceRaw) {
  Terminal terminal;
  EXPECT_TRUE(FileSource::isSerial(terminal.path()));
  const auto source = FileSource::openSerial(terminal.path(), 115200);
  EXPECT_TRUE(source->live());
  EXPECT_EQ(source->size(), std::nullopt);
  terminal.write("\x03\x04$A*00\r\n\x11");  // none of them is a command to a raw line
  std::string got;
  char room[32];
  while (got.size() < 10) got.append(room, source->read(room, sizeof room));
  EXPECT_EQ(got, "\x03\x04$A*00\r\n\x11");
  terminal.hangUp();
  EXPECT_EQ(source->read(room, sizeof room), 0U);
}

TEST(FileSource, SetsTheRate) {
  Terminal terminal;
  const auto source = FileSource::openSerial(terminal.path(), 4800);
  const int other = ::open(terminal.path().c_str(), O_RDONLY | O_NOCTTY);
  termios settings{};
  ASSERT_EQ(tcgetattr(other, &settings), 0);
  ::close(other);
  EXPECT_EQ(cfgetispeed(&settings), static_cast<speed_t>(B4800));
}

TEST(FileSource, NamesTheRatesThatThereAre) {
  try {
    const auto source = FileSource::openSerial("/dev/null", 12345);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string{error.what()}.substr(0, 34), "baud rate 12345 is none of 1200, 2");
  }
}

/// In a process of its own, since nothing takes the end back.
TEST(FileSourceDeathTest, ASignalEndsAReadThatWaits) {
  const auto read_until_told = [] {
    Terminal terminal;
    const auto source = FileSource::openSerial(terminal.path(), 9600);
    struct sigaction interrupt {};
    interrupt.sa_handler = [](int) {
      static volatile std::sig_atomic_t signals = 0;
      signals = signals + 1;
      if (signals == 2) FileSource::endReading();  // after the first it waits again
    };
    sigaction(SIGALRM, &interrupt, nullptr);
    const itimerval often{{0, 10000}, {0, 10000}};
    setitimer(ITIMER_REAL, &often, nullptr);
    char room[8];
    std::exit(source->read(room, sizeof room) == 0 ? 0 : 1);
  };
  EXPECT_EXIT(read_until_told(), testing::ExitedWithCode(0), "");
}

TEST(FileSource, TakesOnlyATerminalForSerial) {
  EXPECT_FALSE(FileSource::isSerial("/dev/null"));
  EXPECT_FALSE(FileSource::isSerial(std::string{CAPTURES} + "/heron_2014.nmea"));
  EXPECT_FALSE(FileSource::isSerial("no/such/file"));
  EXPECT_THROW((void)FileSource::openSerial("/dev/null", 9600), std::system_error);
}

}  // namespace
}  // namespace frontseat_driver::capture
