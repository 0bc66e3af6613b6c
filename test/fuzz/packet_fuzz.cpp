#include <memory>
#include <stdexcept>

#include "frontseat_driver/capture/packet_reader.h"
#include "frontseat_driver/nmea/framer.h"
#include "fuzz.h"

// A packet capture, from anybody.

namespace frontseat_driver::fuzz {

namespace {

void readAll(capture::PacketReader& reader, std::size_t size) {
  std::size_t in_lines = 0;
  while (const auto entry = reader.next()) {
    promise(!entry->line.empty() && entry->line[0] == '$',
            "a line that begins with something else");
    promise(entry->line.size() <= nmea::Framer::kMaxLine, "a line is too long");
    promise(entry->direction.has_value(), "a packet goes neither way");
    in_lines += entry->line.size();
  }
  promise(in_lines <= size, "there are more lines than bytes");
  promise(reader.counters().bytes <= size, "bytes came from nowhere");
}

}  // namespace

void run(std::string_view bytes) {
  if (!capture::PacketReader::recognizes(bytes.substr(0, 4))) return;
  capture::PacketReader reader{std::make_unique<capture::MemorySource>(bytes), 29500};
  readAll(reader, bytes.size());
}

}  // namespace frontseat_driver::fuzz
