#pragma once

#include <string>
#include <string_view>

#include "frontseat_driver/vehicle/clock.h"
#include "frontseat_driver/vehicle/event.h"

namespace frontseat_driver::session {

using vehicle::Now;
using vehicle::SteadyTime;

/// Where a session's output goes. All calls come from inside the session's own calls.
class Output {
 public:
  virtual ~Output() = default;

  /// Bytes for the vehicle, one sentence with its line end; false if the link did not take them.
  virtual bool send(const Now& now, std::string_view sentence) = 0;

  /// The link has not got rid of what it was given before: another command would only queue up.
  virtual bool congested() const { return false; }

  /// A complete line from the vehicle that starts with `$`, without its line end, not yet checked.
  virtual void heard(const Now& now, std::string_view line) = 0;

  /// Something the vehicle told, or that changed in the conversation.
  virtual void event(const Now& now, const vehicle::Event& event) = 0;

  /// The vehicle said something good: it is a vehicle.
  virtual void confirmed() = 0;
};

/// The conversation with one vehicle: bytes and time in, sentences and events out. It has no
/// thread, socket, clock or logger, so that whole missions run in a test in virtual time.
class Session {
 public:
  virtual ~Session() = default;

  virtual void connected(const Now& now, Output& out) = 0;
  virtual void disconnected(const Now& now, Output& out) = 0;
  virtual void receive(const Now& now, std::string_view bytes, Output& out) = 0;

  /// Does what is due at `now`. Call after every other call and at nextStep().
  virtual void step(const Now& now, Output& out) = 0;

  /// When step() has something to do next; SteadyTime::max() if nothing is planned.
  virtual SteadyTime nextStep() const = 0;

  /// This process did not run for a while, halted or held up: what it reads now may have lain in
  /// the kernel for as long, so that nobody can tell how old it is.
  virtual void stoodStill(const Now& /*now*/, Output& /*out*/) {}

  /// The program is going to end: plans what the vehicle must still hear, and nothing after it.
  virtual void leave(const Now& /*now*/, Output& /*out*/) {}

  /// Everything planned by leave() has been sent.
  virtual bool hasLeft() const { return true; }
};

}  // namespace frontseat_driver::session
