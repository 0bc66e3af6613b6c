#include "supervised.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "frontseat_driver/nmea/sentence.h"

namespace frontseat_driver::closed_loop {

using namespace std::chrono_literals;
using protocol::Dialect;

namespace {

constexpr auto kVehicleTick = 10ms;
constexpr std::uint64_t kSteps = 10000;  // of thrust between 0 and full

std::string decimals(std::uint64_t value, unsigned places) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*f", static_cast<int>(places),
                static_cast<double>(value) / std::pow(10.0, places));
  return text.data();
}

/// The sentence's own part: what tells this command from all others.
std::string keyOf(Dialect dialect, std::uint64_t number) {
  if (dialect == Dialect::Sandshark) return decimals(number, 3);
  return decimals(number % kSteps + 1, 2) + "," + decimals(number / kSteps, 2);
}

std::string keyOf(const std::string& sentence) {
  const std::vector<std::string> field = fields(sentence);
  if (field[0] == "BPRMB") return field[5];
  return field[1] + "," + field[2];
}

}  // namespace

Supervised::Supervised(ClosedLoop& loop, const session::NmeaOptions& options, Dialect vehicle)
    : loop_(loop), options_(options), vehicle_(vehicle), gate_open_(options.commands_enabled) {
  loop_.watch.sent = [this](const Sent& sent) { checkSent(sent); };
  loop_.watch.heard = [this](std::string_view line) { hear(line); };
  loop_.watch.step = [this] { checkStep(); };
}

void Supervised::promise(bool kept, const std::string& what) {
  if (kept || !broken_.empty()) return;
  broken_ = what + ", at " +
            std::to_string(std::chrono::duration<double>(loop_.elapsed()).count()) + " s";
}

// --- The model ---

bool Supervised::permitted() const {
  if (!loop_.connected() || !gate_open_ || !dialect_) return false;
  return vehicle_ == Dialect::Kingfisher || options_.control_hook == session::ControlHook::None ||
         control_.value_or(false);
}

bool Supervised::alive() const {
  return current_ != 0 && loop_.elapsed() < accepted_.at(current_) + options_.command_timeout;
}

void Supervised::endCommand() {
  if (current_ == 0) return;
  ended_ = std::min(loop_.elapsed(), accepted_.at(current_) + options_.command_timeout);
  current_ = 0;
}

void Supervised::forgetConnection() {
  dialect_.reset();
  control_.reset();
  last_sent_.reset();
  motion_on_wire_ = false;
  zero_allowed_ = false;
  current_ = 0;
  ended_.reset();
}

void Supervised::hear(std::string_view line) {
  ++lines_;
  const auto sentence = nmea::parseSentence(line, nmea::ChecksumRule::Required);
  if (!sentence) return;
  const auto spoken = protocol::dialectOf(sentence->talker());
  if (!dialect_) dialect_ = spoken;
  if (sentence->address != "BFCTL" || dialect_ != Dialect::Sandshark) return;
  const std::string control = fields(std::string{line})[2];
  control_ = control == "1";
  if (!permitted()) endCommand();
}

Duration Supervised::spacing() const {
  if (options_.send_spacing) return *options_.send_spacing;
  return dialect_ == Dialect::Kingfisher ? 20ms : 60ms;
}

Wanted Supervised::wanted(std::uint64_t number) const {
  if (vehicle_ == Dialect::Kingfisher) {
    constexpr double kAll = kSteps;
    return drive(static_cast<double>(number % kSteps + 1) / kAll,
                 static_cast<double>(number / kSteps) / kAll);
  }
  Behavior message;
  message.speed_mode = Behavior::SPEED_RPM;
  message.speed = static_cast<double>(number) / 1000.0;
  return message;
}

// --- What a user does ---

void Supervised::connect() {
  if (loop_.connected()) return;
  forgetConnection();
  dialect_ = options_.dialect;
  loop_.connect();
}

void Supervised::disconnect() {
  forgetConnection();
  loop_.disconnect();
}

void Supervised::setTakes(bool takes) {
  if (takes && !loop_.link.takes) takes_since_ = loop_.elapsed();
  loop_.link.takes = takes;
}

void Supervised::publish() {
  const std::uint64_t number = ++last_number_;
  const bool expected = permitted() && !left_;
  if (expected) {
    issued_[keyOf(vehicle_, number)] = {loop_.elapsed(), std::nullopt};
    accepted_[number] = loop_.elapsed();
    current_ = number;
    ended_.reset();
    zero_allowed_ = true;
  } else {
    ++refused_;
  }
  const std::string refusal = loop_.publish(wanted(number));
  promise(refusal.empty() == expected, "command refused: '" + refusal + "'");
}

void Supervised::publishForeign() {
  ++refused_;
  const Wanted foreign = vehicle_ == Dialect::Kingfisher ? Wanted{Behavior{}} : drive(0.5, 0.5);
  promise(!loop_.publish(foreign).empty(), "the other vehicle's command was taken");
}

void Supervised::publishNonsense() {
  ++refused_;
  Behavior behavior = heading(NAN);
  const Wanted nonsense =
      vehicle_ == Dialect::Kingfisher ? Wanted{drive(0.5, NAN)} : Wanted{behavior};
  promise(!loop_.publish(nonsense).empty(), "nonsense was taken");
}

void Supervised::stop() {
  endCommand();
  zero_allowed_ = true;
  loop_.stop();
}

void Supervised::gate(bool open) {
  gate_open_ = open;
  if (!open) endCommand();
  loop_.gate(open);
}

void Supervised::leave() {
  endCommand();
  left_ = true;
  loop_.leave();
}

// It needs neither gate nor permission, and finds room when nothing else does.
void Supervised::requestAbort() {
  const bool expected = loop_.connected() && dialect_ != Dialect::Kingfisher && !left_;
  if (expected) {
    ++aborts_;
    if (!waiting_abort_) waiting_abort_ = loop_.asked().size();
    endCommand();
  }
  ask(session::AbortRequest{"leak", true});
  const auto& answers = loop_.asked().back().answers;
  const bool refused = !answers.empty() && !answers.front().answer.success;
  promise(refused != expected, "abort refused or taken against the rule");
}

void Supervised::requestBehavior() {
  const std::uint64_t number = ++last_number_;
  issued_[keyOf(Dialect::Sandshark, number)] = {loop_.elapsed(), loop_.asked().size()};
  vehicle::BehaviorCommand command;
  command.speed = {vehicle::BehaviorCommand::Speed::Rpm, static_cast<double>(number) / 1000.0};
  ask(command);
}

void Supervised::requestLog(const std::string& sentence) {
  ask(session::LogSwitch{sentence, true});
}

void Supervised::ask(session::Request request) {
  open_requests_.push_back(loop_.asked().size());
  loop_.request(std::move(request));
}

// --- What is promised of each sentence ---

void Supervised::checkSent(const Sent& sent) {
  bytes_sent_ += sent.sentence.size() + 2;
  if (last_sent_ && !left_) {
    promise(sent.at - *last_sent_ >= spacing(), "less than send_spacing before " + sent.sentence);
  }
  last_sent_ = sent.at;
  const std::string address = sent.sentence.substr(1, 5);
  if (sent.sentence == "$PYDIR,0,0*56") return checkZero();
  if (address == "PYDIR" || address == "BPRMB") return checkCommand(sent);
  promise(!left_, "sent after leaving: " + sent.sentence);
  if (address == "BPABT") {
    waiting_abort_.reset();
    return promise(aborts_ > 0, "an abort that nobody asked for");
  }
  const bool talk = address == "BPVER" || address == "BPLOG" || address == "BPSTS";
  promise(talk, "unknown " + sent.sentence);
  const bool boat_was_asked = dialect_ == Dialect::Kingfisher;
  promise(!boat_was_asked, "a boat was sent " + sent.sentence);
}

void Supervised::checkCommand(const Sent& sent) {
  promise(permitted(), "sent without permission: " + sent.sentence);
  promise(!left_, "sent after leaving: " + sent.sentence);
  const auto found = issued_.find(keyOf(sent.sentence));
  if (found == issued_.end()) return promise(false, "nobody commanded " + sent.sentence);
  Issued& issued = found->second;
  const Duration age = sent.at - issued.at;
  if (issued.request) {
    promise(!std::exchange(issued.sent, true), "sent twice: " + sent.sentence);
    promise(age < options_.ack_timeout, "sent too late: " + sent.sentence);
    promise(loop_.asked()[*issued.request].answers.empty(), "answered before: " + sent.sentence);
    return;
  }
  promise(age < options_.command_timeout, "stale: " + sent.sentence);
  promise(current_ != 0, "ended before: " + sent.sentence);
  promise(keyOf(vehicle_, current_) == found->first, "not the newest: " + sent.sentence);
  motion_on_wire_ = vehicle_ == Dialect::Kingfisher;
}

void Supervised::checkZero() {
  promise(vehicle_ == Dialect::Kingfisher, "zero thrust for a sandshark");
  promise(std::exchange(zero_allowed_, current_ != 0), "a zero that nothing called for");
  motion_on_wire_ = false;
}

// --- What is promised after each step ---

void Supervised::checkStep() {
  if (!loop_.connected()) forgetConnection();
  if (current_ != 0 && !alive()) endCommand();
  checkZeroInTime();
  checkAbortInTime();
  checkRequests();
  checkCounters();
  promise(left_ || loop_.reason().empty() == permitted(), "control says '" + loop_.reason() + "'");
  promise(loop_.commanding() == (current_ != 0), "control has commanding wrong");
}

void Supervised::checkZeroInTime() {
  if (!motion_on_wire_ || !ended_ || !loop_.link.takes) return;
  const Duration from = std::max(*ended_, takes_since_);
  promise(loop_.elapsed() <= from + spacing() + kVehicleTick, "no zero in time");
}

void Supervised::checkAbortInTime() {
  if (waiting_abort_ && !loop_.asked()[*waiting_abort_].answers.empty()) waiting_abort_.reset();
  if (!waiting_abort_ || !loop_.link.takes) return;
  const Duration from = std::max(loop_.asked()[*waiting_abort_].at, takes_since_);
  promise(loop_.elapsed() <= from + spacing(), "no abort in time");
}

void Supervised::checkRequests() {
  const auto done = [&](std::size_t request) {
    const Asked& asked = loop_.asked()[request];
    const bool answered = !asked.answers.empty();
    promise(answered || loop_.elapsed() < asked.at + options_.ack_timeout, "no answer in time");
    return answered;
  };
  open_requests_.erase(std::remove_if(open_requests_.begin(), open_requests_.end(), done),
                       open_requests_.end());
  for (const Asked& asked : loop_.asked()) promise(asked.answers.size() <= 1, "answered twice");
}

void Supervised::checkCounters() {
  const session::NmeaCounters counters = loop_.session().counters();
  promise(counters.sentences_sent == loop_.sent().size(), "sentences_sent is wrong");
  promise(counters.bytes_sent == bytes_sent_, "bytes_sent is wrong");
  promise(counters.sentences_received == lines_, "sentences_received is wrong");
  promise(counters.refused_commands == refused_, "refused_commands is wrong");
  const std::uint64_t explained =
      counters.decoded + counters.unknown + counters.bad_checksums + counters.bad_frames;
  promise(explained >= lines_, "a sentence was counted nowhere");
}

}  // namespace frontseat_driver::closed_loop
