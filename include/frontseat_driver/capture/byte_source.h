#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace frontseat_driver::capture {

/// Bytes from somewhere, in order.
class ByteSource {
 public:
  virtual ~ByteSource() = default;

  /// Waits for bytes and puts up to `room` of them at `to`. Returns how many; 0 is the end.
  /// Throws std::system_error that names the source.
  virtual std::size_t read(char* to, std::size_t room) = 0;

  /// How many bytes there are in all, where that is known beforehand.
  virtual std::optional<std::uint64_t> size() const { return std::nullopt; }

  /// The bytes come as they happen, and when they come is when they were said.
  virtual bool live() const { return false; }
};

/// Bytes that are in memory already; they must outlive the source.
class MemorySource : public ByteSource {
 public:
  explicit MemorySource(std::string_view bytes) : rest_(bytes), size_(bytes.size()) {}

  std::size_t read(char* to, std::size_t room) override;
  std::optional<std::uint64_t> size() const override { return size_; }

 private:
  std::string_view rest_;
  std::uint64_t size_;
};

/// A file, a pipe, or a device, read by its descriptor. A signal whose handler
/// calls endReading() ends a wait, and the input.
class FileSource : public ByteSource {
 public:
  /// Throws std::system_error that names the file: not there, not readable, a folder.
  static std::unique_ptr<FileSource> open(const std::string& path);

  static std::unique_ptr<FileSource> standardInput();

  /// A serial device, raw, 8N1, without flow control. Throws std::system_error if it is none, and
  /// std::invalid_argument for a rate that there is no setting for.
  static std::unique_ptr<FileSource> openSerial(const std::string& path, unsigned baud);

  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;
  ~FileSource() override;

  std::size_t read(char* to, std::size_t room) override;
  std::optional<std::uint64_t> size() const override { return size_; }
  bool live() const override { return live_; }

  /// True for a terminal or serial device, which openSerial() is for.
  static bool isSerial(const std::string& path);

  /// From now on every FileSource is at its end. May be called by a signal handler.
  static void endReading();

 private:
  FileSource(int descriptor, std::string name) : descriptor_(descriptor), name_(std::move(name)) {}

  void learnSize();

  int descriptor_;
  std::string name_;
  std::optional<std::uint64_t> size_;
  bool live_ = false;
};

}  // namespace frontseat_driver::capture
