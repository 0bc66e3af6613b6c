#include "clients.h"

#include <algorithm>

namespace frontseat_driver::sim {
namespace {

/// An observer owes no watchdog, so those that vanished are only told by their number.
constexpr std::size_t kMostClients = 64;

}  // namespace

std::uint32_t BlueyeClients::connect(const bp::ClientInfo& info, vehicle::UtcTime now) {
  if (clients_.size() >= kMostClients) {
    auto oldest = clients_.end();
    for (auto client = clients_.begin(); client != clients_.end(); ++client) {
      if (client->first == in_control_) continue;
      if (oldest == clients_.end() || client->second.heard < oldest->second.heard) oldest = client;
    }
    clients_.erase(oldest);
  }
  const std::uint32_t client = ++last_;
  clients_[client] = {info, now};
  if (in_control_ == 0) promote(now);
  return client;
}

bool BlueyeClients::disconnect(std::uint32_t client, vehicle::UtcTime now) {
  if (clients_.erase(client) == 0) return false;
  if (client == in_control_) promote(now);
  return true;
}

void BlueyeClients::promote(vehicle::UtcTime now) {
  const auto next = std::find_if(clients_.begin(), clients_.end(), [](const auto& entry) {
    return !entry.second.info.is_observer();
  });
  in_control_ = next == clients_.end() ? 0 : next->first;
  control_heard_ = now;
  petted_ = false;
}

void BlueyeClients::pet(std::uint32_t client, vehicle::UtcTime now) {
  if (client == 0) {
    anonymous_ = true;
    anonymous_heard_ = now;
    return;
  }
  const auto found = clients_.find(client);
  if (found == clients_.end()) return;
  found->second.heard = now;
  if (client != in_control_) return;
  control_heard_ = now;
  petted_ = true;
}

bool BlueyeClients::drop(vehicle::UtcTime now, vehicle::UtcTime timeout) {
  if (anonymous_ && now - anonymous_heard_ > timeout) {
    anonymous_ = false;
    if (in_control_ == 0) return true;
  }
  if (in_control_ == 0 || now - control_heard_ <= timeout) return false;
  disconnect(in_control_, now);
  return true;
}

bool BlueyeClients::armed(vehicle::UtcTime now, vehicle::UtcTime timeout) const {
  if (anonymous_ && now - anonymous_heard_ <= timeout) return true;
  return in_control_ != 0 && petted_ && now - control_heard_ <= timeout;
}

std::vector<bp::ConnectedClient> BlueyeClients::list() const {
  std::vector<bp::ConnectedClient> all;
  for (const auto& [number, client] : clients_) {
    bp::ConnectedClient entry;
    entry.set_client_id(number);
    *entry.mutable_client_info() = client.info;
    all.push_back(std::move(entry));
  }
  return all;
}

}  // namespace frontseat_driver::sim
