#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "frontseat_driver/nmea/field_reader.h"
#include "frontseat_driver/nmea/sentence_writer.h"
#include "frontseat_driver/protocol/field_visitor.h"

namespace frontseat_driver::protocol::bluefin {

/// $BFCTD: conductivity, temperature and pressure. Public extra Bluefin sentence; named in
/// Kingfisher 0.1, Appendix A.
///
/// $BFCTD,hhmmss.sss,c.c,t.t,p.p,hhmmss.sss*hh
struct Ctd {
  static constexpr std::string_view kTitle = "conductivity, temperature, pressure";
  static constexpr std::string_view kTalker = "BF";
  static constexpr std::string_view kFormatter = "CTD";

  std::optional<nmea::TimeOfDay> sent_at;
  std::optional<double> conductivity_us_cm;  ///< microsiemens per centimetre
  std::optional<double> temperature_c;
  std::optional<double> pressure_kpa;
  std::optional<nmea::TimeOfDay> measured_at;

  static Ctd decode(nmea::FieldReader& in);
  void encode(nmea::SentenceWriter& out) const;
  void describe(FieldVisitor& out) const;
};

}  // namespace frontseat_driver::protocol::bluefin
