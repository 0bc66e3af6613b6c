#include "record.h"

#include <array>
#include <stdexcept>
#include <string_view>

#include "bag_reader.h"
#include "frontseat_driver/capture/byte_source.h"
#include "frontseat_driver/capture/packet_reader.h"
#include "frontseat_driver/capture/text_reader.h"

namespace frontseat_driver::decode {
namespace {

using capture::ByteSource;
using capture::FileSource;

constexpr std::size_t kSignature = 8;

/// A source of which the first bytes were looked at.
class Peeked : public ByteSource {
 public:
  explicit Peeked(std::unique_ptr<ByteSource> source) : source_(std::move(source)) {
    while (peeked_ < kSignature) {
      const std::size_t count = source_->read(first_.data() + peeked_, kSignature - peeked_);
      if (count == 0) break;
      peeked_ += count;
    }
  }

  std::string_view first() const { return {first_.data(), peeked_}; }

  std::size_t read(char* to, std::size_t room) override {
    if (given_ == peeked_) return source_->read(to, room);
    const std::size_t count = first().substr(given_).copy(to, room);
    given_ += count;
    return count;
  }
  std::optional<std::uint64_t> size() const override { return source_->size(); }

 private:
  std::unique_ptr<ByteSource> source_;
  std::array<char, kSignature> first_{};
  std::size_t peeked_ = 0;
  std::size_t given_ = 0;
};

bool beginsWith(std::string_view text, std::string_view begin) {
  return text.substr(0, begin.size()) == begin;
}

struct Packed {
  std::string_view begin;
  const char* unpack;
};

constexpr Packed kPacked[] = {{"\x1F\x8B", "zcat"},
                              {"BZh", "bzcat"},
                              {"\xFD\x37zXZ", "xzcat"},
                              {"\x28\xB5\x2F\xFD", "zstdcat"}};

void refuseCompressed(std::string_view first, const std::string& name) {
  for (const Packed& packed : kPacked) {
    if (!beginsWith(first, packed.begin)) continue;
    throw std::runtime_error(name + " is compressed; unpack it on the way: " + packed.unpack + " " +
                             name + " | nmea_decode");
  }
}

Record openBytes(std::unique_ptr<ByteSource> bytes, const Options& options) {
  const bool from_stdin = options.input == "-";
  auto source = std::make_unique<Peeked>(std::move(bytes));
  refuseCompressed(source->first(), from_stdin ? "standard input" : options.input);
  const auto size = source->size();
  if (beginsWith(source->first(), "#ROSBAG")) {
    if (from_stdin) throw std::runtime_error("a bag cannot be read from standard input; name it");
    return {openBag(options.input, options.vehicle), std::nullopt, false};
  }
  if (capture::PacketReader::recognizes(source->first())) {
    return {std::make_unique<capture::PacketReader>(std::move(source), options.port), size, false};
  }
  return {std::make_unique<capture::TextReader>(std::move(source)), size, false};
}

}  // namespace

Record openRecord(const Options& options) {
  if (options.input == "-") return openBytes(FileSource::standardInput(), options);
  if (FileSource::isSerial(options.input)) {
    auto device = FileSource::openSerial(options.input, options.baud);
    return {std::make_unique<capture::TextReader>(std::move(device)), std::nullopt, true};
  }
  return openBytes(FileSource::open(options.input), options);
}

}  // namespace frontseat_driver::decode
