#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::bluefin {

/// $BFACK: the answer to one command. SPI 0.1, section 6.4. Sent only after `BPLOG,ACK,ON`.
///
/// $BFACK,hhmmss.sss,c-c,hhmmss.sss,iiii,s,c,m-m,*hh
///        1          2   3          4    5 6 7
struct Acknowledgement {
  static constexpr std::string_view kTitle = "acknowledgement";
  static constexpr std::string_view kTalker = "BF";
  static constexpr std::string_view kFormatter = "ACK";

  std::optional<nmea::TimeOfDay> sent_at;
  std::string_view command;  ///< three letters ("RMB") or five ("BPRMB")
  std::optional<nmea::TimeOfDay>
      command_time;  ///< field 1 of the command; blank for BPLOG, which has none
  std::string_view behavior_id;
  std::optional<std::int64_t> status;  ///< 0 invalid, 1 failed, 2 done, 3 pending
  std::string_view message;            ///< for people; never interpreted

  static Acknowledgement decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::bluefin
