#pragma once

#include <cstdint>
#include <string_view>

#include "frontseat_driver/nmea/decoded.h"

namespace frontseat_driver::nmea {

/// A line whose frame and checksum were found right. Views into the line; valid as long as it is.
struct Sentence {
  std::string_view address;  ///< between `$` and the first comma: talker and formatter, "BFNVG"
  std::string_view fields;   ///< after that comma, up to the `*`; no comma: empty
  bool has_fields = false;   ///< false for `$BFXYZ*hh`, which has not even one empty field

  std::string_view talker() const { return address.substr(0, 2); }  ///< "BF"
  std::string_view formatter() const { return address.substr(2); }  ///< "NVG"
};

/// Vehicles always send a checksum (SPI 0.1, section 4.2; Kingfisher 0.1, section 2.4); a payload
/// may leave it out.
enum class ChecksumRule { Required, Optional };

/// XOR of all bytes; of a sentence those between `$` and `*`, both excluded (Kingfisher 0.1,
/// section 2.6).
std::uint8_t checksum(std::string_view bytes);

/// Checks the frame of one line without its line end: `$`, an address, printable ASCII only
/// (0x20..0x7F), one `*`, and two hex digits of either case that match. Blanks may follow them.
///
/// An address is 3 to 8 upper-case letters or digits. Both dialects use five; the rest is for the
/// proprietary sentences of GPS receivers, which are well-formed and simply of no known type.
///
/// With ChecksumRule::Optional the line may also end with the `*` (Kingfisher 0.1, section 2.5) or,
/// as old test clients send it, before it. Fails with BadFrame, MissingChecksum, or BadChecksum; a
/// wrong checksum is told before a wrong address.
Decoded<Sentence> parseSentence(std::string_view line, ChecksumRule rule);

}  // namespace frontseat_driver::nmea
