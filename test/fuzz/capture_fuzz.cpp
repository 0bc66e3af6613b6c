#include <memory>

#include "frontseat_driver/capture/text_reader.h"
#include "fuzz.h"

// A record as text, from anybody.

namespace frontseat_driver::fuzz {

void run(std::string_view bytes) {
  capture::TextReader reader{std::make_unique<capture::MemorySource>(bytes)};
  std::size_t in_lines = 0;
  while (const auto entry = reader.next()) {
    promise(!entry->line.empty() && entry->line[0] == '$',
            "a line that begins with something else");
    promise(entry->line.size() <= nmea::Framer::kMaxLine, "a line is too long");
    in_lines += entry->line.size();
  }
  promise(in_lines <= bytes.size(), "there are more lines than bytes");
  promise(reader.counters().bytes == bytes.size(), "a byte was not read");
}

}  // namespace frontseat_driver::fuzz
