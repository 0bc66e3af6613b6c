#include "frontseat_driver/session/command_slot.h"

namespace frontseat_driver::session {

void CommandSlot::put(const vehicle::Command& command, SteadyTime received) {
  command_ = command;
  stale_at_ = received + timeout_;
  due_at_ = received;
  sent_ = false;
}

void CommandSlot::clear() { command_.reset(); }

const vehicle::Command* CommandSlot::due(SteadyTime now) const {
  const bool is_due = command_ && now >= due_at_ && now < stale_at_;
  return is_due ? &*command_ : nullptr;
}

void CommandSlot::sent(SteadyTime now) {
  due_at_ = now + period_;
  sent_ = true;
}

}  // namespace frontseat_driver::session
