#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "frontseat_driver/capture/byte_source.h"
#include "frontseat_driver/capture/reader.h"

namespace frontseat_driver::capture {

/// Gives its text in pieces of at most so many bytes, as a slow line does.
class Pieces : public ByteSource {
 public:
  Pieces(std::string text, std::size_t most) : text_(std::move(text)), most_(most) {}

  std::size_t read(char* to, std::size_t room) override {
    const std::size_t count = std::min({room, most_, text_.size() - at_});
    text_.copy(to, count, at_);
    at_ += count;
    return count;
  }

 private:
  std::string text_;
  std::size_t most_;
  std::size_t at_ = 0;
};

/// The lines of all entries that are left.
inline std::vector<std::string> linesOf(Reader& reader) {
  std::vector<std::string> lines;
  while (const auto entry = reader.next()) lines.emplace_back(entry->line);
  return lines;
}

}  // namespace frontseat_driver::capture
