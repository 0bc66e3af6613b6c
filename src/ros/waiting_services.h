#pragma once

#include <ros/advertise_service_options.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "frontseat_driver/vehicle/clock.h"
#include "service_threads.h"

namespace frontseat_driver::ros_layer {

/// How long a call waits for its answer.
struct Patience {
  std::chrono::nanoseconds due;         ///< for the session's thread to take it up
  std::chrono::nanoseconds at_most;     ///< for the answer, if that thread is held up
  const char* no_answer;                ///< what the caller is told then
  WhenLate when_late = WhenLate::Drop;  ///< then the caller is told that it is still done
};

/// What must not wait until calls that wait for the vehicle have ended is urgent.
enum class Urgency { Usual, Urgent };

/// Services whose calls each wait on a thread of their own for what the session's thread answers,
/// so that none holds anything else up. An Answer has `success` and `message`; Out is where the
/// session sends.
template <class Answer, class Out>
class WaitingServices {
 public:
  using Respond = std::function<void(const Answer&)>;
  using Task = std::function<void(const vehicle::Now&, Out&)>;
  using Post = std::function<void(Task)>;
  /// A piece of work for the session's thread that answers at once or later.
  using Ask = std::function<void(const vehicle::Now&, Out&, const Respond&)>;

  explicit WaitingServices(Post post) : post_(std::move(post)) {}

  /// Writes what a response has beside success and message.
  template <class Service>
  using Fill = void (*)(typename Service::Response&, const Answer&);

  template <class Service>
  void advertise(ros::NodeHandle& node, const char* name, Urgency urgency,
                 std::function<Answer(typename Service::Request&)> serve,
                 Fill<Service> fill = nullptr) {
    auto options = ros::AdvertiseServiceOptions::create<Service>(
        name,
        [serve = std::move(serve), fill](typename Service::Request& request,
                                         typename Service::Response& response) {
          const Answer answer = serve(request);
          response.success = answer.success;
          response.message = answer.message;
          if (fill != nullptr) fill(response, answer);
          return true;
        },
        ros::VoidConstPtr{}, urgency == Urgency::Urgent ? &urgent_ : &usual_);
    servers_.push_back(node.advertiseService(options));
  }

  /// For a call on its thread: has the work done by the session's, and waits.
  Answer ask(Ask work, const Patience& patience) const {
    // Shared with the work, which may come to run after the wait has ended.
    const auto promise = std::make_shared<std::promise<Answer>>();
    std::future<Answer> answer = promise->get_future();
    const auto called = std::chrono::steady_clock::now();
    // What the caller has been told is late must not be done after all.
    const bool drop = patience.when_late == WhenLate::Drop;
    post_([work = std::move(work), promise, drop, expiry = called + patience.due](
              const vehicle::Now& now, Out& out) {
      if (drop && std::chrono::steady_clock::now() >= expiry) {
        return promise->set_value(refusal("the driver was held up; nothing was done"));
      }
      work(now, out, [promise](const Answer& given) { promise->set_value(given); });
    });
    while (answer.wait_for(kLook) != std::future_status::ready) {
      if (closing_) return refusal(kStopping);
      if (std::chrono::steady_clock::now() < called + patience.at_most) continue;
      return refusal(drop ? patience.no_answer : kHeldUp);
    }
    try {
      return answer.get();
    } catch (const std::future_error&) {  // the work went with the driver's thread
      return refusal(kStopping);
    }
  }

  /// Answers the calls under way at once and takes no more. What was posted before may still run.
  void close() {
    closing_ = true;
    usual_.close();
    urgent_.close();
    servers_.clear();
  }

 private:
  // How soon a waiting call notices that the driver is stopping.
  static constexpr std::chrono::milliseconds kLook{20};
  static constexpr const char* kStopping = "the driver is stopping";
  static constexpr const char* kHeldUp =
      "the driver is held up; it is done as soon as that goes on";

  static Answer refusal(const char* why) {
    Answer answer;
    answer.success = false;
    answer.message = why;
    return answer;
  }

  const Post post_;
  std::atomic<bool> closing_{false};
  ServiceThreads usual_;
  ServiceThreads urgent_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace frontseat_driver::ros_layer
