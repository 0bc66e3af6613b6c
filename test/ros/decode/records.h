#pragma once

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "../../nmea/lines.h"
#include "decode/decoded_line.h"
#include "decode/output.h"
#include "frontseat_driver/capture/text_reader.h"

namespace frontseat_driver::decode {

/// Decodes a text log line by line.
template <class Take>
void forEachLine(const std::string& text, Take&& take) {
  capture::TextReader reader{std::make_unique<capture::MemorySource>(text)};
  LineDecoder decoder;
  while (const auto entry = reader.next()) take(decoder.decode(*entry));
}

/// A stream whose bytes can be looked at.
class Paper {
 public:
  Paper() : stream_(open_memstream(&bytes_, &size_)) {}
  Paper(const Paper&) = delete;
  Paper& operator=(const Paper&) = delete;
  ~Paper() {
    std::fclose(stream_);
    std::free(bytes_);
  }

  std::FILE* stream() const { return stream_; }
  std::string text() const {
    std::fflush(stream_);
    return {bytes_, size_};
  }

 private:
  char* bytes_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* stream_;
};

/// What an output makes of a text log.
template <class Out>
std::string written(const std::string& text) {
  const Paper paper;
  Out out{paper.stream()};
  forEachLine(text, [&](const DecodedLine& line) { out.write(line); });
  out.flush();
  return paper.text();
}

}  // namespace frontseat_driver::decode
