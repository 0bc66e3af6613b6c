#include "frontseat_driver/nmea/decoded.h"

namespace frontseat_driver::nmea {

const char* toString(Fault fault) {
  switch (fault) {
    case Fault::BadFrame:
      return "malformed frame";
    case Fault::MissingChecksum:
      return "missing checksum";
    case Fault::BadChecksum:
      return "wrong checksum";
    case Fault::UnknownType:
      return "unknown sentence";
    case Fault::MissingField:
      return "missing field";
    case Fault::BadValue:
      return "unreadable value";
    case Fault::OutOfRange:
      return "value out of range";
  }
  return "unknown fault";
}

}  // namespace frontseat_driver::nmea
