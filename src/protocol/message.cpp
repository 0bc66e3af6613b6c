#include "frontseat_driver/protocol/message.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace frontseat_driver::protocol {
namespace {

using nmea::DegreeSplit;
using nmea::FieldReader;

constexpr std::string_view kAnyTalker;

/// Up to eight characters as one number, so that an address is compared at once.
constexpr std::uint64_t pack(std::string_view text, std::uint64_t from = 0) {
  for (const char c : text) from = (from << 8) | static_cast<unsigned char>(c);
  return from;
}

/// Turns into its result where that is to be, so that a message is never copied.
template <class Make>
struct InPlace {
  Make make;
  operator decltype(std::declval<Make>()())() const { return make(); }
};

template <class T, class Make>
void put(Message& out, Make make) {
  out.emplace<T>(InPlace<Make>{make});
}

using Decode = void (*)(FieldReader&, Message&);

struct Decoder {
  std::uint64_t address = 0;  ///< talker and formatter; of any talker: the formatter alone
  Decode decode = nullptr;
  KnownSentence sentence{};
};

template <class T>
constexpr Decoder decoderFor(std::string_view talker, std::string_view formatter = T::kFormatter) {
  return {pack(formatter, pack(talker)),
          [](FieldReader& in, Message& out) { put<T>(out, [&in] { return T::decode(in); }); },
          {talker, formatter, T::kTitle}};
}

template <DegreeSplit kSplit>
constexpr Decoder navigationFrom(std::string_view talker) {
  return {pack(NavigationUpdate::kFormatter, pack(talker)),
          [](FieldReader& in, Message& out) {
            put<NavigationUpdate>(out, [&in] { return NavigationUpdate::decode(in, kSplit); });
          },
          {talker, NavigationUpdate::kFormatter, NavigationUpdate::kTitle}};
}

template <class T>
constexpr Decoder decoderFor() {
  return decoderFor<T>(T::kTalker);
}

/// Every sentence that is known. Nothing else lists them.
constexpr Decoder kDecoders[] = {
    navigationFrom<DegreeSplit::FromLeft>("BF"),
    navigationFrom<DegreeSplit::FromPoint>("CP"),
    decoderFor<VelocityUpdate>("BF"),
    decoderFor<VelocityUpdate>("CP"),
    decoderFor<bluefin::VehicleVersion>(),
    decoderFor<bluefin::PayloadShutdown>(),
    decoderFor<bluefin::MissionStatus>(),
    decoderFor<bluefin::Acknowledgement>(),
    decoderFor<bluefin::BackseatControl>(),
    decoderFor<bluefin::Dvl>(),
    decoderFor<bluefin::Ctd>(),
    decoderFor<bluefin::RawVehicleSpeed>(),
    decoderFor<bluefin::BehaviorBegin>(),
    decoderFor<bluefin::BehaviorEnd>(),
    decoderFor<bluefin::SoundSpeed>(),
    decoderFor<bluefin::PayloadVersion>(),
    decoderFor<bluefin::LogRequest>(),
    decoderFor<bluefin::PayloadStatus>(),
    decoderFor<bluefin::BehaviorChange>(),
    decoderFor<bluefin::AbortMission>(),
    decoderFor<kingfisher::RawCompass>(),
    decoderFor<kingfisher::BatteryVoltage>(),
    decoderFor<kingfisher::RawImu>(),
    decoderFor<kingfisher::RawImu>("CP", kingfisher::RawImu::kFieldFormatter),
    decoderFor<kingfisher::ThrustAndYawRate>(),
    decoderFor<kingfisher::HeadingAndSpeed>(),
    decoderFor<kingfisher::MotorThrust>(),
    decoderFor<gps::Fix>(kAnyTalker),
    decoderFor<gps::MinimumData>(kAnyTalker),
    decoderFor<gps::CourseAndSpeed>(kAnyTalker),
};

/// kDecoders spread by a hash of the address, with gaps, so that one look nearly always finds one.
class Index {
 public:
  constexpr Index() {
    for (const Decoder& decoder : kDecoders) {
      slots_[slotOf(decoder.address)] = {decoder.address, decoder.decode};
    }
  }

  constexpr Decode find(std::uint64_t address) const { return slots_[slotOf(address)].decode; }

 private:
  static constexpr std::size_t kSlots = 128;

  /// The slot of `address`, or the free one where it would be.
  constexpr std::size_t slotOf(std::uint64_t address) const {
    std::size_t at = (address * 0x9E3779B97F4A7C15) >> 57;  // Fibonacci hashing to seven bits
    while (slots_[at].decode != nullptr && slots_[at].address != address) at = (at + 1) % kSlots;
    return at;
  }

  struct Slot {
    std::uint64_t address = 0;
    Decode decode = nullptr;
  };

  Slot slots_[kSlots] = {};
};

constexpr Index kIndex;

Decode decoderOf(std::string_view address) {
  if (address.size() != 5) return nullptr;
  const std::uint64_t packed = pack(address);
  constexpr std::uint64_t kFormatterBits = 0xFFFFFF;
  const Decode exact = kIndex.find(packed);
  return exact != nullptr ? exact : kIndex.find(packed & kFormatterBits);
}

// One object and one return, so that it is made where the caller wants it.
nmea::Decoded<Reading> read(const nmea::Sentence& sentence, Decode decode) {
  FieldReader in{sentence};
  nmea::Decoded<Reading> reading{std::in_place};
  decode(in, reading->message);
  reading->faults = in.faults();
  return reading;
}

}  // namespace

const char* toString(Dialect dialect) {
  return dialect == Dialect::Sandshark ? "sandshark" : "kingfisher";
}

std::optional<Dialect> dialectOf(std::string_view talker) {
  if (talker == "BF") return Dialect::Sandshark;
  if (talker == "CP") return Dialect::Kingfisher;
  return std::nullopt;
}

nmea::Decoded<Reading> decode(const nmea::Sentence& sentence) {
  const Decode decode = decoderOf(sentence.address);
  if (decode == nullptr) return nmea::Fault::UnknownType;
  return read(sentence, decode);
}

std::vector<KnownSentence> knownSentences() {
  std::vector<KnownSentence> all;
  for (const Decoder& decoder : kDecoders) all.push_back(decoder.sentence);
  return all;
}

std::string_view titleOf(const Message& message) {
  return std::visit([](const auto& m) { return m.kTitle; }, message);
}

void describe(const Message& message, FieldVisitor& out) {
  std::visit([&out](const auto& m) { m.describe(out); }, message);
}

}  // namespace frontseat_driver::protocol
