#include "mischief.h"

#include <algorithm>

#include "written.h"

namespace frontseat_driver::simulation {

using protocol::Dialect;

namespace {

constexpr std::string_view kAck = "$BFACK,";
constexpr std::size_t kCommandTime = 3;
constexpr std::size_t kStatus = 5;

std::string withField(const closed_loop::Fields& fields, std::size_t number,
                      std::string_view text) {
  std::string body{fields.at[0]};
  for (std::size_t i = 1; i < fields.count; ++i) {
    body.append(1, ',').append(i == number ? text : fields.at[i]);
  }
  return closed_loop::sentence(body) + "\r\n";
}

}  // namespace

bool Mischief::does(Kind kind, double chance) {
  const auto i = static_cast<std::size_t>(kind);
  if (!on_[i] || !random_.chance(chance)) return false;
  ++done_[i];
  return true;
}

std::string Mischief::spoil(std::string_view said) {
  std::string out;
  while (!said.empty()) {
    const std::size_t end = said.find_first_not_of("\r\n", std::min(said.find('\r'), said.size()));
    const std::string_view line = said.substr(0, end);
    if (does(Kind::Garbage, 0.3)) out += garbage();
    if (does(Kind::OtherDialect, 0.3)) out += otherDialect();
    if (line.substr(0, kAck.size()) == kAck) {
      spoilAck(line, out);
    } else if (!does(Kind::SentencesLost, 0.3)) {
      out += line;
    }
    said.remove_prefix(std::min(said.size(), line.size()));
  }
  return out;
}

void Mischief::spoilAck(std::string_view line, std::string& out) {
  const std::string_view text = line.substr(0, line.find('\r'));
  const closed_loop::Fields fields{text};
  if (does(Kind::AcksLost, 0.7)) return;
  if (does(Kind::AcksTwice, 0.7)) out += line;
  const bool timed = !fields.at[kCommandTime].empty();
  if (does(Kind::AcksPending, 0.8)) {
    out += withField(fields, kStatus, "3");
  } else if (does(Kind::AcksLying, 0.7)) {
    out += withField(fields, kStatus, oneOf<std::string_view>(random_, {"0", "1", "2", "7", ""}));
  } else if (timed && !earlier_time_.empty() && does(Kind::AcksForOthers, 0.5)) {
    out += withField(fields, kCommandTime, earlier_time_);
  } else {
    out += line;
  }
  if (timed && random_.chance(0.3)) earlier_time_ = std::string{fields.at[kCommandTime]};
}

std::string Mischief::otherDialect() {
  const bool boat = dialect_ == Dialect::Kingfisher;
  const char* const of_boat[] = {
      "CPNVG,120000.000,4221.4800,N,07105.2200,W,1,,,90.0,0.0,0.0,120000.000",
      "CPNVR,120000.000,0.1,0.2,0.0,0.0,0.0,0.0", "CPRBS,120000.000,1,15.1,3.7,3.8,20.0"};
  const char* const of_shark[] = {
      "BFNVG,120000.000,4221.4800,N,07105.2200,W,1,5.0,1.0,90.0,0.0,0.0,120000.000",
      "BFCTL,120000.000,1", "BFMIS,120000.000,a.dive,Running,", "BFVER,120000.000,SS_0.0"};
  return closed_loop::sentence(boat ? oneOf(random_, of_shark) : oneOf(random_, of_boat)) + "\r\n";
}

// Lines that never end, half sentences, control characters, and what looks like a sentence.
std::string Mischief::garbage() {
  const char* const hard[] = {"$",
                              "$$$",
                              "\r\n",
                              "$BFCTL,1",
                              "$BFNVG,,,,,,,,,,,*\r\n",
                              "*00\r\n",
                              "$BFACK,*5B\r\n",
                              "$,,,,*00\r\n",
                              "$BFMIS,*zz\n"};
  if (random_.chance(0.4)) return oneOf(random_, hard);
  std::string bytes(random_.chance(0.1) ? 1500 : 1 + random_.below(60), ' ');
  const bool printable = random_.chance(0.5);
  for (char& byte : bytes) {
    byte = static_cast<char>(printable ? 0x20 + random_.below(0x5f) : random_.below(256));
  }
  return bytes;
}

}  // namespace frontseat_driver::simulation
