#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "frontseat_driver/nmea/sentence.h"
#include "frontseat_driver/session/nmea_session.h"
#include "frontseat_driver/session/sentence_text.h"
#include "fuzz.h"

// A whole conversation: the bytes are a script of what vehicle, link, clock and user do.

namespace frontseat_driver::fuzz {
namespace {

using namespace std::chrono_literals;
using protocol::Dialect;
using session::NmeaOptions;
using vehicle::Now;
using vehicle::SteadyTime;

constexpr int kMostStepsAtOnce = 1000;

NmeaOptions anyOptions(Dice& dice) {
  NmeaOptions options;
  const unsigned dialect = dice.byte() % 3;
  if (dialect != 0) options.dialect = dialect == 1 ? Dialect::Sandshark : Dialect::Kingfisher;
  options.control_hook = static_cast<session::ControlHook>(dice.byte() % 3);
  options.use_acks = dice.flag();
  options.commands_enabled = dice.flag();
  options.listen_only = dice.byte() % 16 == 15;
  options.format.fill_behavior_fields = dice.flag();
  options.send_spacing = std::chrono::milliseconds{dice.byte()};
  return options;
}

class Conversation : private session::Output {
 public:
  explicit Conversation(Dice& dice) : dice_(dice), options_(anyOptions(dice)), session_(options_) {}

  void run() {
    step();
    while (!dice_.empty()) {
      act();
      step();
    }
    pass(20s);  // longer than any request may take
    promise(answered_ == asked_, "a request was not answered");
  }

 private:
  void act() {
    switch (dice_.byte() % 16) {
      case 0:
        return connect();
      case 1:
        return disconnect();
      case 2:
        return pass(std::chrono::milliseconds{dice_.value<std::uint16_t>()});
      case 3:
        return command();
      case 4:
        return session_.stop(now(), *this);
      case 5:
        return session_.setCommandsEnabled(now(), dice_.flag(), *this);
      case 6:
        return ask(anyRequest());
      case 7:
        utc_error_ = std::chrono::seconds{dice_.value<std::int32_t>()};
        return;
      case 8:
        takes_ = dice_.flag();
        return;
      case 9:
        congested_ = dice_.flag();
        return;
      case 10:
        return leave();
      case 11:
        return hear(dice_.take(dice_.byte()));
      default:
        return hearSentence(dice_.take(dice_.byte() % 128));
    }
  }

  void connect() {
    if (std::exchange(connected_, true)) return;
    last_sent_.reset();
    session_.connected(now(), *this);
  }

  void disconnect() {
    if (!std::exchange(connected_, false)) return;
    session_.disconnected(now(), *this);
  }

  void leave() {
    left_ = true;
    session_.leave(now(), *this);
  }

  void pass(std::chrono::nanoseconds duration) {
    const SteadyTime end = steady_ + duration;
    for (int at_once = 0; session_.nextStep() <= end;) {
      at_once = session_.nextStep() > steady_ ? 0 : at_once + 1;
      promise(at_once < kMostStepsAtOnce, "steps are asked for without end");
      steady_ = std::max(steady_, session_.nextStep());
      step();
    }
    steady_ = end;
  }

  void step() { session_.step(now(), *this); }

  void command() {
    vehicle::Command command = anyCommand();
    const std::string refusal = session_.command(now(), command, steady_, *this);
    if (!connected_ || left_) promise(!refusal.empty(), "a command was taken without a link");
  }

  vehicle::Command anyCommand() {
    switch (dice_.byte() % 4) {
      case 0:
        return anyBehavior();
      case 1:
        return vehicle::DriveCommand{part(), part()};
      case 2:
        return vehicle::HelmCommand{part(), part()};
      default:
        return vehicle::CourseCommand{(part() + 1.0) * 179.0, part() + 1.0};
    }
  }

  vehicle::BehaviorCommand anyBehavior() {
    vehicle::BehaviorCommand behavior;
    if (dice_.flag()) behavior.horizontal = {vehicle::BehaviorCommand::Horizontal::Heading, 90.0};
    if (dice_.flag()) behavior.vertical = {vehicle::BehaviorCommand::Vertical::Depth, 3.0};
    behavior.speed = {vehicle::BehaviorCommand::Speed::Rpm, part() * 1000.0};
    return behavior;
  }

  double part() { return (static_cast<double>(dice_.byte()) - 128.0) / 128.0; }

  session::Request anyRequest() {
    switch (dice_.byte() % 4) {
      case 0:
        return session::AbortRequest{text(), dice_.flag()};
      case 1:
        return session::LogSwitch{text(), dice_.flag()};
      case 2:
        return session::RawSentence{text()};
      default:
        return anyBehavior();
    }
  }

  std::string text() { return std::string{dice_.take(dice_.byte() % 32)}; }

  void ask(session::Request request) {
    raw_ |= std::holds_alternative<session::RawSentence>(request);
    const std::size_t number = asked_++;
    answers_.push_back(0);
    session_.request(
        now(), std::move(request),
        [this, number](const session::Answer& answer) {
          promise(++answers_[number] == 1, "a request was answered twice");
          promise(answer.success || !answer.message.empty(), "a refusal without a reason");
          ++answered_;
        },
        *this);
  }

  void hear(std::string_view bytes) {
    if (connected_) session_.receive(now(), bytes, *this);
  }

  /// With frame and checksum, so that more than noise is heard.
  void hearSentence(std::string_view body) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    const unsigned sum = nmea::checksum(body);
    std::string line = "$" + std::string{body} + "*";
    line += kDigits[sum >> 4U];
    line += kDigits[sum & 15U];
    hear(line + "\r\n");
  }

  Now now() const {
    const vehicle::UtcTime utc = 1700000000s + steady_.time_since_epoch() + utc_error_;
    return {steady_, utc, utc};
  }

  // session::Output
  bool send(const Now&, std::string_view sentence) override {
    promise(connected_ && !options_.listen_only, "something was sent where nothing may be");
    promise(sentence.size() <= session::kMostBytesSent, "a sentence is too long");
    promise(sentence.substr(sentence.size() - 2) == "\r\n", "no CR LF at the end");
    const auto read =
        nmea::parseSentence(sentence.substr(0, sentence.size() - 2), nmea::ChecksumRule::Required);
    promise(static_cast<bool>(read), "what was sent is no sentence");
    if (takes_) checkSent(*read);
    return takes_;
  }

  void checkSent(const nmea::Sentence& sent) {
    // The last zero thrust of a driver that leaves does not wait for long spacing.
    const bool spaced = !last_sent_ || steady_ - *last_sent_ >= *options_.send_spacing;
    promise(spaced || left_, "two sentences without the spacing between them");
    last_sent_ = steady_;
    if (raw_) return;  // the user may have sent anything
    const bool zero = sent.address == "PYDIR" && sent.fields == "0,0";
    const bool motion = sent.talker() == "PY" || sent.address == "BPRMB";
    promise(!motion || zero || session_.control().reason.empty(),
            "a command without permission: " + std::string{session_.control().reason});
    promise(!left_ || !motion || zero, "a command after leaving");
    const auto dialect = session_.dialect();
    if (motion)
      promise(dialect == (sent.talker() == "PY" ? Dialect::Kingfisher : Dialect::Sandshark),
              "a command for the other vehicle");
  }

  bool congested() const override { return congested_; }
  void heard(const Now&, std::string_view line) override {
    promise(!line.empty() && line[0] == '$' && line.size() <= nmea::Framer::kMaxLine, "a line");
  }
  void event(const Now&, const vehicle::Event&) override {}
  void confirmed() override {}

  Dice& dice_;
  const NmeaOptions options_;
  session::NmeaSession session_;
  SteadyTime steady_{1h};
  std::chrono::seconds utc_error_{0};
  bool connected_ = false, takes_ = true, congested_ = false, left_ = false, raw_ = false;
  std::optional<SteadyTime> last_sent_;
  std::vector<int> answers_;
  std::size_t asked_ = 0, answered_ = 0;
};

}  // namespace

void run(std::string_view bytes) {
  Dice dice{bytes};
  Conversation{dice}.run();
}

}  // namespace frontseat_driver::fuzz
