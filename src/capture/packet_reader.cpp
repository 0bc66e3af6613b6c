#include "frontseat_driver/capture/packet_reader.h"

#include <algorithm>
#include <list>
#include <string>
#include <vector>

#include "frontseat_driver/nmea/framer.h"
#include "packet_file.h"
#include "tcp_segment.h"
#include "tcp_stream.h"

namespace frontseat_driver::capture {
namespace {

/// One direction of a connection with what it said so far.
struct Talk {
  std::string ends;  ///< addresses and ports
  Direction direction = Direction::FromVehicle;
  TcpStream stream;
  nmea::Framer framer;
};

std::string endsOf(const TcpSegment& segment) {
  std::string ends{segment.source};
  ends += segment.destination;
  for (const unsigned port : {segment.source_port, segment.destination_port}) {
    ends += static_cast<char>(port >> 8);
    ends += static_cast<char>(port & 0xFF);
  }
  return ends;
}

}  // namespace

class PacketReader::Conversations {
 public:
  Conversations(std::unique_ptr<ByteSource> source, int port)
      : file_(std::move(source)), port_(static_cast<unsigned>(port)) {}

  std::optional<Entry> next() {
    while (at_ == lines_.size()) {
      if (ended_) return std::nullopt;
      readPacket();
    }
    const Line& line = lines_[at_++];
    return Entry{line.time, line.direction, std::string_view{text_}.substr(line.from, line.size)};
  }

  bool ready() const { return at_ != lines_.size() || ended_ || file_.hasBuffered(); }

  ReadCounters counters() const {
    ReadCounters all = closed_;
    for (const Talk& talk : talks_) count(talk, all);
    all.bytes = file_.bytesRead();
    all.breaks_off = file_.breaksOff();
    return all;
  }

 private:
  // Who opens connections without end is forgotten, the one that was silent longest first.
  static constexpr std::size_t kMostTalks = 64;

  struct Line {
    std::size_t from;
    std::size_t size;
    Direction direction;
    TcpStream::Time time;
  };

  static void count(const Talk& talk, ReadCounters& all) {
    const nmea::Framer::Counters& framed = talk.framer.counters();
    all.oversized += framed.oversized;
    all.cut_off += framed.cut_off;
    all.other_lines += framed.noise_lines;
    all.sent_again += talk.stream.sentAgain();
    all.missing += talk.stream.missing();
  }

  void readPacket() {
    lines_.clear();
    text_.clear();
    at_ = 0;
    const auto packet = file_.next();
    if (!packet) return finish();
    const auto segment = tcpSegmentOf(packet->link_type, packet->bytes);
    if (!segment) return;
    const bool ours = segment->source_port == port_ || segment->destination_port == port_;
    if (!ours) return;
    Talk& talk = talkOf(*segment);
    talk.stream.add(*segment, packet->time, sinkOf(talk));
  }

  void finish() {
    ended_ = true;
    for (Talk& talk : talks_) talk.stream.finish(sinkOf(talk));
  }

  /// The talk a segment belongs to, in front of all others.
  Talk& talkOf(const TcpSegment& segment) {
    std::string ends = endsOf(segment);
    const auto found = std::find_if(talks_.begin(), talks_.end(),
                                    [&](const Talk& talk) { return talk.ends == ends; });
    if (found != talks_.end()) {
      talks_.splice(talks_.begin(), talks_, found);
      return talks_.front();
    }
    if (talks_.size() == kMostTalks) forgetLast();
    talks_.emplace_front();
    talks_.front().ends = std::move(ends);
    const bool from_vehicle = segment.source_port == port_;
    talks_.front().direction = from_vehicle ? Direction::FromVehicle : Direction::ToVehicle;
    return talks_.front();
  }

  void forgetLast() {
    talks_.back().stream.finish(sinkOf(talks_.back()));
    count(talks_.back(), closed_);
    talks_.pop_back();
  }

  TcpStream::Sink sinkOf(Talk& talk) {
    return [this, &talk](std::string_view bytes, TcpStream::Time time, bool after_gap) {
      if (after_gap) talk.framer.reset();
      talk.framer.feed(bytes, [&](std::string_view line) {
        lines_.push_back({text_.size(), line.size(), talk.direction, time});
        text_ += line;
      });
    };
  }

  PacketFile file_;
  unsigned port_;
  std::list<Talk> talks_;  ///< latest first
  ReadCounters closed_;    ///< of talks that are forgotten
  std::string text_;       ///< the lines that the last packet completed
  std::vector<Line> lines_;
  std::size_t at_ = 0;
  bool ended_ = false;
};

PacketReader::PacketReader(std::unique_ptr<ByteSource> source, int port)
    : conversations_(std::make_unique<Conversations>(std::move(source), port)) {}

PacketReader::~PacketReader() = default;

bool PacketReader::recognizes(std::string_view first_bytes) {
  return PacketFile::recognizes(first_bytes);
}

std::optional<Entry> PacketReader::next() { return conversations_->next(); }
bool PacketReader::ready() const { return conversations_->ready(); }
ReadCounters PacketReader::counters() const { return conversations_->counters(); }

}  // namespace frontseat_driver::capture
