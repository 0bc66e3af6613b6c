#include "output.h"

#include <cerrno>
#include <system_error>

namespace frontseat_driver::decode {

void TextSink::endLine() {
  constexpr std::size_t kEnough = 64UL * 1024;
  text_ += '\n';
  if (text_.size() >= kEnough) flush();
}

void TextSink::flush() {
  const bool written = std::fwrite(text_.data(), 1, text_.size(), stream_) == text_.size();
  text_.clear();
  if (!written || std::fflush(stream_) != 0) {
    throw std::system_error(errno, std::generic_category(), name_);
  }
}

}  // namespace frontseat_driver::decode
