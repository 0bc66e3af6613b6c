#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include "decoded_line.h"

namespace frontseat_driver::decode {

/// What is done with the lines of a record.
class Output {
 public:
  virtual ~Output() = default;

  /// Throws std::system_error when there is no room to write.
  virtual void write(const DecodedLine& line) = 0;

  /// What was written can be seen from now on.
  virtual void flush() = 0;
};

/// Text on its way to a stream, in large pieces.
class TextSink {
 public:
  /// `name` is for messages. The stream stays open.
  TextSink(std::FILE* stream, std::string name) : stream_(stream), name_(std::move(name)) {}

  /// What was put here goes out when there is enough of it.
  std::string& text() { return text_; }
  void endLine();
  void flush();

 private:
  std::FILE* stream_;
  std::string name_;
  std::string text_;
};

}  // namespace frontseat_driver::decode
