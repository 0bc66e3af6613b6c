#include "supervised.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace frontseat_driver::closed_loop {

using namespace std::chrono_literals;
using protocol::Dialect;
using session::ControlHook;

namespace {

constexpr auto kSlack = 10ms;
constexpr Duration kRepeatedWithin = 5s;  // SPI 0.1, section 7.3
constexpr Duration kAskedWithin = 8s;     // all BPLOG, with other things in between
constexpr auto kAmbiguous = 15s;          // times may come twice after a clock step
constexpr std::uint64_t kSteps = 10000;   // of thrust between 0 and full
constexpr std::size_t kMostUnacknowledged = 128;
constexpr std::string_view kZero = "$PYDIR,0,0*56";

WritingRules rulesOf(const ros_layer::Parameters& parameters) {
  return {parameters.session.format, parameters.max_speed_m_s, parameters.max_yaw_rate_rad_s};
}

/// As a frontseat can take it: names of commands only in small letters.
std::string asSent(std::string text) {
  const auto holds = [&](const char* name) { return text.find(name) != std::string::npos; };
  if (holds("RMB") || holds("LOG") || holds("ABT") || holds("STS") || holds("VER")) {
    for (char& letter : text) letter = static_cast<char>(std::tolower(letter));
  }
  return text;
}

bool canStand(const std::string& text) {
  return text.size() < 170 && std::all_of(text.begin(), text.end(), [](char letter) {
           return letter >= 0x20 && letter < 0x7f && letter != ',' && letter != '*' &&
                  letter != '$';
         });
}

}  // namespace

Supervised::Supervised(ClosedLoop& loop, const ros_layer::Parameters& parameters, Dialect vehicle)
    : loop_(loop),
      options_(parameters.session),
      rules_(rulesOf(parameters)),
      vehicle_(vehicle),
      gate_open_(options_.commands_enabled) {
  loop_.watch.sent = [this](const Sent& sent) { checkSent(sent); };
  loop_.watch.heard = [this](std::string_view line) { hear(line); };
  loop_.watch.step = [this] { checkStep(); };
  loop_.watch.arrives = [this](std::string_view bytes) { ledger_.arrives(bytes); };
  loop_.watch.refused = [this] { refused_at_ = loop_.elapsed(); };
  loop_.watch.answered = [this](std::size_t number, const session::Answer& answer) {
    answered(number, answer);
  };
}

void Supervised::promise(bool kept, const char* what, std::string_view detail) {
  if (kept || !broken_.empty()) return;
  broken_ = std::string{what} + std::string{detail} + ", at " +
            std::to_string(std::chrono::duration<double>(loop_.elapsed()).count()) + " s";
}

// --- The model ---

bool Supervised::permitted() const {
  if (!loop_.connected() || !gate_open_ || !dialect_) return false;
  return isBoat() || options_.control_hook == ControlHook::None || control_.value_or(false);
}

void Supervised::notePermission() {
  const bool is_permitted = permitted();
  if (is_permitted && !was_permitted_) permitted_since_ = loop_.elapsed();
  was_permitted_ = is_permitted;
  if (!is_permitted) endCommand();
}

bool Supervised::alive() const {
  return current_ && loop_.elapsed() < current_->received + options_.command_timeout;
}

void Supervised::endCommand() {
  if (!current_) return;
  ended_ = std::min(loop_.elapsed(), current_->received + options_.command_timeout);
  current_.reset();
}

void Supervised::forgetConnection() {
  ledger_.connectionEnded();
  dialect_.reset();
  control_.reset();
  last_sent_.reset();
  motion_on_wire_ = false;
  zero_allowed_ = false;
  current_.reset();
  ended_.reset();
  was_permitted_ = false;
  asks_from_.reset();
  asked_for_.clear();
  heading_at_.reset();
  depth_at_.reset();
  speed_at_.reset();
  waiting_abort_.reset();
}

void Supervised::hear(std::string_view line) {
  ++seen_.sentences_heard;
  hearing_.reset();
  promise(ledger_.heard(line), "heard what did not come: ", line);
  if (!isSound(line) || line.size() < 10) return;
  const std::string_view talker = line.substr(1, 2);
  if (!dialect_ && talker == "BF") dialect_ = Dialect::Sandshark;
  if (!dialect_ && talker == "CP") dialect_ = Dialect::Kingfisher;
  notePermission();
  if (talker != "BF" || dialect_ != Dialect::Sandshark) return;
  const std::string_view formatter = line.substr(3, 3);
  if (fills()) hearPresent(formatter, Fields{line});
  if (formatter == "ACK") return hearAck(Fields{line});
  const auto hook = options_.control_hook;
  if (formatter == "CTL" && hook == ControlHook::Ctl) {
    const Fields fields{line};
    const std::string_view word = fields.at[2];
    if (word == "1" || word == "0") permissionHeard(word == "1");
  } else if (formatter == "MIS" && hook == ControlHook::Mis) {
    permissionHeard(Fields{line}.at[3].substr(0, 7) == "Running");
  }
}

void Supervised::hearPresent(std::string_view formatter, const Fields& fields) {
  const auto told = [&](std::size_t field) {
    const std::string_view text = fields.at[field];
    return text.empty() || text == "nan" ? std::nullopt : std::optional{loop_.elapsed()};
  };
  if (formatter == "NVG") {
    depth_at_ = told(8);
    heading_at_ = told(9);
  } else if (formatter == "NVR") {
    speed_at_ = told(2) && told(3) ? told(2) : std::nullopt;
  }
}

// What a behavior leaves alone is filled with what the vehicle does, if that is known.
bool Supervised::fillable(const Wanted& wanted) const {
  const auto* behavior = std::get_if<Behavior>(&wanted);
  if (!behavior || !fills()) return true;
  const auto fresh = [&](const std::optional<Duration>& at) {
    return at && loop_.elapsed() - *at <= options_.max_data_age;
  };
  return (behavior->horizontal_mode != Behavior::HORIZONTAL_NONE || fresh(heading_at_)) &&
         (behavior->vertical_mode != Behavior::VERTICAL_NONE || fresh(depth_at_)) &&
         (behavior->speed_mode != Behavior::SPEED_NONE || fresh(speed_at_));
}

void Supervised::permissionHeard(bool granted) {
  control_ = granted;
  notePermission();
}

void Supervised::hearAck(const Fields& fields) {
  const std::string_view name = fields.at[2];
  hearing_ = Ack{std::string{name.size() == 5 ? name.substr(2) : name}, std::string{fields.at[3]},
                 std::string{fields.at[5]}};
  const std::string& status = hearing_->status;
  if (status != "0" && status != "1" && status != "2") return;
  for (Open& open : open_) {
    const bool its_name = hearing_->command == (open.kind == Kind::Abort ? "ABT" : "RMB");
    if (open.kind == Kind::Log || !its_name) continue;
    open.acknowledged |= std::count(open.times.begin(), open.times.end(), hearing_->time) > 0;
  }
}

Duration Supervised::spacing() const {
  if (options_.send_spacing) return *options_.send_spacing;
  return isBoat() ? 20ms : 60ms;
}

Wanted Supervised::numbered(std::uint64_t number) const {
  if (vehicle_ == Dialect::Kingfisher) {
    constexpr double kAll = kSteps;
    return drive(static_cast<double>(number % kSteps + 1) / kAll,
                 static_cast<double>(number / kSteps % kSteps) / kAll);
  }
  return numberedBehavior(number);
}

Behavior Supervised::numberedBehavior(std::uint64_t number) {
  Behavior message;
  message.speed_mode = Behavior::SPEED_RPM;
  message.speed = static_cast<double>(number % 9999999) / 1000.0;
  return message;
}

// A boat's north is the true one; a Sandshark's is that of the grid, known with a position.
std::optional<double> Supervised::convergence_deg(const Wanted& wanted) const {
  if (std::holds_alternative<Behavior>(wanted)) return grid_convergence_deg_;
  return 0.0;
}

void Supervised::seenAt(double latitude_deg, double longitude_deg) {
  grid_convergence_deg_ = sphereConvergence_deg(latitude_deg, longitude_deg);
}

// --- What a user does ---

void Supervised::connect() {
  if (loop_.connected()) return;
  forgetConnection();
  dialect_ = options_.dialect;
  loop_.connect();
}

void Supervised::disconnect() { loop_.disconnect(); }

void Supervised::stepSystemClock(Duration by) {
  ambiguous_until_ = loop_.elapsed() + kAmbiguous;
  loop_.stepSystemClock(by);
}

bool Supervised::expected(const std::optional<Written>& written, Duration waited) const {
  return written && permitted() && !left_ && written->dialect() == *dialect_ &&
         loop_.elapsed() - waited >= permitted_since_ && waited < options_.command_timeout;
}

void Supervised::publish(const Wanted& wanted, Duration waited) {
  const auto written = Written::of(wanted, rules_, convergence_deg(wanted));
  const bool taken = expected(written, waited) && fillable(wanted);
  if (taken) {
    zero_allowed_ = true;
    if (!current_) repeated_at_ = loop_.elapsed();
    current_ = Command{*written, loop_.elapsed() - waited};
    ended_.reset();
    ++seen_.commands_taken;
  } else {
    ++refused_;
    ++seen_.commands_refused;
  }
  const std::string refusal = loop_.publish(wanted, waited);
  promise(refusal.empty() == taken, "a command was refused or taken against the rule: ", refusal);
}

void Supervised::publish() { publish(numbered(++last_number_)); }

void Supervised::publishForeign() {
  publish(vehicle_ == Dialect::Kingfisher ? Wanted{Behavior{}} : drive(0.5, 0.5));
}

void Supervised::publishNonsense() {
  publish(vehicle_ == Dialect::Kingfisher ? Wanted{drive(0.5, NAN)} : Wanted{heading(NAN)});
}

void Supervised::stop() {
  endCommand();
  permitted_since_ = loop_.elapsed();
  zero_allowed_ = true;
  loop_.stop();
}

void Supervised::gate(bool open) {
  gate_open_ = open;
  notePermission();
  loop_.gate(open);
}

void Supervised::leave() {
  endCommand();
  left_ = true;
  loop_.leave();
}

void Supervised::load() {
  disconnect();
  forgetConnection();
  ledger_ = {};
  gate_open_ = options_.commands_enabled;
  left_ = logs_changed_ = false;
  grid_convergence_deg_.reset();
  permitted_since_ = Duration{0};
  status_ok_ = true;
  status_text_ = "OK";
  sentences_sent_ = bytes_sent_ = refused_ = 0;
  loop_.load();
}

// It needs neither gate nor permission, and finds room when nothing else does.
void Supervised::requestAbort(const std::string& reason, bool with_errors) {
  Open open;
  open.kind = Kind::Abort;
  open.flag = with_errors;
  const std::string text = reason + " " + std::to_string(++last_number_);
  open.text = asSent(text);
  const bool taken = loop_.connected() && !isBoat() && !left_ && canStand(text);
  // A boat has no mission to abort; commanding it ends all the same.
  if (taken || (loop_.connected() && isBoat() && !left_)) {
    endCommand();
    permitted_since_ = loop_.elapsed();
  }
  if (taken && !waiting_abort_) {
    waiting_abort_ = loop_.asked().size();
    abort_asked_ = loop_.elapsed();
  }
  const std::size_t number = begin(std::move(open));
  loop_.request(session::AbortRequest{text, with_errors});
  const auto& answers = loop_.asked()[number].answers;
  const bool refused = !answers.empty() && !answers.front().answer.success;
  promise(refused != taken, "an abort was refused or taken against the rule");
}

void Supervised::requestBehavior() {
  Open open;
  open.kind = Kind::Behavior;
  const Behavior message = numberedBehavior(++last_number_);
  open.written = Written::of(message, rules_, std::nullopt);
  begin(std::move(open));
  loop_.modify(message);
}

void Supervised::requestLog(const std::string& sentence, bool enable) {
  logs_changed_ = true;
  Open open;
  open.kind = Kind::Log;
  open.text = sentence;
  open.flag = enable;
  begin(std::move(open));
  loop_.request(session::LogSwitch{sentence, enable});
}

void Supervised::payloadStatus(bool ok, const std::string& message) {
  const bool taken = canStand(message);
  if (taken) {
    status_ok_ = ok;
    status_text_ = asSent(message);
  }
  promise(loop_.payloadStatus(ok, message).empty() == taken, "payload_status against the rule");
}

std::size_t Supervised::begin(Open open) {
  ++seen_.requests;
  open.number = loop_.asked().size();
  open.at = loop_.elapsed();
  open_.push_back(std::move(open));
  return open_.back().number;
}

void Supervised::answered(std::size_t number, const session::Answer& answer) {
  const auto open = std::find_if(open_.begin(), open_.end(),
                                 [&](const Open& one) { return one.number == number; });
  if (open == open_.end()) return promise(false, "answered twice: ", answer.message);
  if (hearing_) {
    ++seen_.acknowledged;
    checkMatch(*open, answer);
  } else {
    promise(!answer.success || answer.message.compare(0, 4, "sent") == 0,
            "success without the vehicle's word: ", answer.message);
  }
  if (waiting_abort_ == number) waiting_abort_.reset();
  open_.erase(open);
}

// The word that answers a request must be the one on its own sentence.
void Supervised::checkMatch(const Open& open, const session::Answer& answer) {
  constexpr const char* kNames[] = {"ABT", "RMB", "LOG"};
  const bool its_name = hearing_->command == kNames[static_cast<int>(open.kind)];
  const bool its_time = open.kind == Kind::Log
                            ? hearing_->time.empty()
                            : std::count(open.times.begin(), open.times.end(), hearing_->time) > 0;
  promise(open.sent && its_name && (its_time || loop_.elapsed() < ambiguous_until_),
          "answered with another sentence's ACK: ", answer.message);
  promise(answer.success == (hearing_->status == "2"),
          "the ACK's status was not told: ", answer.message);
}

// --- What is promised of each sentence ---

void Supervised::checkSent(const Sent& sent) {
  ++sentences_sent_;
  ++seen_.sentences_sent;
  bytes_sent_ += sent.sentence.size() + 2;
  if (last_sent_ && !left_) {
    promise(sent.at - *last_sent_ >= spacing(), "less than send_spacing before ", sent.sentence);
  }
  last_sent_ = sent.at;
  promise(isSound(sent.sentence), "not a sentence: ", sent.sentence);
  const Fields fields{sent.sentence};
  const std::string_view address = fields.at[0];
  if (current_ && !alive()) endCommand();
  const bool own_zero = current_ && !current_->written.moves();
  if (sent.sentence == kZero && !own_zero) return checkZero(sent);
  if (address.substr(0, 2) == "PY") return checkCommand(sent, fields);
  promise(!left_, "sent after leaving: ", sent.sentence);
  // One that was asked for before the dialect was known is ignored by a boat.
  promise(!isBoat() || address == "BPABT", "a boat was sent ", sent.sentence);
  if (address != "BPLOG") checkTime(sent, fields);
  if (address == "BPRMB") return isRequest(sent, fields) ? void() : checkCommand(sent, fields);
  if (address == "BPABT") return checkAbort(sent, fields);
  if (address == "BPSTS") return checkStatus(sent, fields);
  if (address == "BPLOG") return checkLog(sent, fields);
  promise(address != "BPVER" || fields.at[2] == options_.interface_version,
          "BPVER is wrong: ", sent.sentence);
  promise(address == "BPVER", "unknown ", sent.sentence);
}

void Supervised::checkTime(const Sent& sent, const Fields& fields) {
  constexpr Duration kDay = 24h;
  const auto in_day = std::chrono::duration_cast<std::chrono::milliseconds>(loop_.now().utc % kDay);
  promise(milliseconds(fields.at[1]) == in_day.count(), "carries a wrong time: ", sent.sentence);
}

bool Supervised::isRequest(const Sent& sent, const Fields& fields) {
  for (Open& open : open_) {
    if (open.kind != Kind::Behavior || open.sent || !open.written->matches(fields, fills())) {
      continue;
    }
    promise(permitted(), "sent without permission: ", sent.sentence);
    open.sent = true;
    open.times.emplace_back(fields.at[1]);
    return true;
  }
  return false;
}

void Supervised::checkCommand(const Sent& sent, const Fields& fields) {
  ++seen_.commands_sent;
  promise(permitted(), "sent without permission: ", sent.sentence);
  promise(!left_, "sent after leaving: ", sent.sentence);
  promise(current_.has_value(), "nobody commands ", sent.sentence);
  if (!current_) return;
  promise(alive(), "stale: ", sent.sentence);
  promise(current_->written.matches(fields, fills()), "not the newest command: ", sent.sentence);
  repeated_at_ = sent.at;
  motion_on_wire_ = isBoat() && current_->written.moves();
}

void Supervised::checkAbort(const Sent& sent, const Fields& fields) {
  ++seen_.aborts;
  for (Open& open : open_) {
    const bool its_text = open.kind == Kind::Abort && open.text == fields.at[2];
    if (!its_text || fields.at[3] != (open.flag ? "1" : "0")) continue;
    open.sent = true;
    open.times.emplace_back(fields.at[1]);
    waiting_abort_.reset();
    return;
  }
  promise(false, "nobody asks for ", sent.sentence);
}

void Supervised::checkLog(const Sent& sent, const Fields& fields) {
  const bool on = fields.at[2] == "ON";
  promise(fields.at[1].size() == 3 && (on || fields.at[2] == "OFF"), "wrong: ", sent.sentence);
  if (on) asked_for_.emplace(fields.at[1]);
  for (Open& open : open_) {
    if (open.kind == Kind::Log && open.text == fields.at[1] && open.flag == on) open.sent = true;
  }
}

void Supervised::checkZero(const Sent& sent) {
  ++seen_.zeros;
  promise(isBoat(), "zero thrust for a sandshark");
  promise(std::exchange(zero_allowed_, current_.has_value()), "a zero that nothing called for");
  if (motion_on_wire_ && ended_) {
    promise(sent.at <= std::max(*ended_, refused_at_) + spacing() + kSlack, "zero came late");
  }
  motion_on_wire_ = false;
}

void Supervised::checkStatus(const Sent& sent, const Fields& fields) {
  promise(fields.at[2] == (status_ok_ ? "1" : "0") && fields.at[3] == status_text_,
          "not the payload's status: ", sent.sentence);
}

// --- What is promised after each step ---

void Supervised::checkStep() {
  hearing_.reset();
  if (!loop_.connected()) forgetConnection();
  notePermission();
  if (fills() && current_ && !loop_.commanding()) endCommand();
  if (current_ && !alive()) endCommand();
  if (loop_.congested()) congested_at_ = loop_.elapsed();
  checkInTime();
  checkLogRequests();
  checkAnswers();
  checkCounters();
  promise(left_ || loop_.reason().empty() == permitted(), "control says ", loop_.reason());
  promise(loop_.commanding() == current_.has_value(), "control has commanding wrong");
}

void Supervised::checkInTime() {
  const Duration now = loop_.elapsed();
  if (motion_on_wire_ && ended_) {
    promise(now <= std::max(*ended_, refused_at_) + spacing() + kSlack, "no zero in time");
  }
  if (waiting_abort_) {
    promise(now <= std::max(abort_asked_, refused_at_) + spacing(), "no abort in time");
  }
  if (aborting()) repeated_at_ = now;
  if (!current_) return;
  const Duration from = std::max({repeated_at_, refused_at_, congested_at_});
  promise(now <= from + kRepeatedWithin, "a fresh command was not repeated within 5 s");
}

// Aborts go first, all of them.
bool Supervised::aborting() const {
  return std::any_of(open_.begin(), open_.end(),
                     [](const Open& open) { return open.kind == Kind::Abort; });
}

void Supervised::checkLogRequests() {
  const bool asks = dialect_ == Dialect::Sandshark && !left_;
  if (!asks || !asks_from_ || refused_at_ >= *asks_from_ || aborting()) asks_from_.reset();
  if (asks && !asks_from_ && asked_for_.empty()) asks_from_ = loop_.elapsed();
  if (!asks_from_ || logs_changed_ || loop_.elapsed() < *asks_from_ + kAskedWithin) return;
  for (const std::string& sentence : options_.log_sentences) {
    promise(asked_for_.count(sentence) > 0, "was not asked for: ", sentence);
  }
  if (options_.use_acks) promise(asked_for_.count("ACK") > 0, "was not asked for: ACK");
  asks_from_.reset();
}

void Supervised::checkAnswers() {
  if (open_.empty()) return;
  promise(loop_.elapsed() < open_.front().at + options_.ack_timeout, "no answer in time");
  if (loop_.elapsed() < ambiguous_until_) return;
  for (Open& open : open_) {
    promise(!std::exchange(open.acknowledged, false), "the vehicle's answer was not handed on");
  }
}

void Supervised::checkCounters() {
  const session::NmeaCounters counters = loop_.session().counters();
  promise(counters.sentences_sent == sentences_sent_, "sentences_sent is wrong");
  promise(counters.bytes_sent == bytes_sent_, "bytes_sent is wrong");
  promise(counters.refused_commands == refused_, "refused_commands is wrong");
  if (const char* complaint = ledger_.complaint(counters)) promise(false, complaint);
  promise(loop_.session().unacknowledged() <= kMostUnacknowledged, "acknowledgements queue up");
  promise(loop_.session().openRequests() == open_.size(), "requests queue up");
}

}  // namespace frontseat_driver::closed_loop
