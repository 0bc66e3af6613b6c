#include "frontseat_driver/driver/driver.h"

#include <pthread.h>

#include <atomic>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <mutex>
#include <thread>
#include <utility>

namespace frontseat_driver::driver {

using boost::system::error_code;
using vehicle::Now;
using vehicle::SteadyTime;

namespace {

constexpr std::chrono::seconds kTick{1};
// For the session's last words; with the orderly close after them within the 100 ms of stop().
constexpr std::chrono::milliseconds kLastWords{40};
// Work that took longer, held up by a log line to a terminal that takes none perhaps, must not make
// what has grown stale meanwhile look fresh.
constexpr std::chrono::milliseconds kHeldUp{100};
// A tick that is later tells of a process that was halted: longer than a busy computer takes.
constexpr std::chrono::milliseconds kStoodStill{500};

std::string_view withoutLineEnd(std::string_view sentence) {
  const auto last = sentence.find_last_not_of("\r\n");
  return sentence.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

}  // namespace

class Driver::Impl : public link::TcpClient::Handler, public session::Output {
 public:
  Impl(link::TcpClient::Options options, session::Session& session, Listener& listener, Clock clock)
      : session_(session),
        listener_(listener),
        clock_(std::move(clock)),
        client_(io_, std::move(options), *this) {}

  void start() {
    const std::lock_guard<std::mutex> lock(lifetime_);
    if (stopping_ || thread_.joinable()) return;
    thread_ = std::thread([this] { run(); });
  }

  void stop() {
    const std::lock_guard<std::mutex> lock(lifetime_);
    stopping_ = true;
    if (!thread_.joinable()) return;
    boost::asio::post(io_, [this] { leave(); });
    thread_.join();
  }

  void post(std::function<void(const Now&)> task) {
    if (stopping_) return;
    boost::asio::post(io_, [this, task = std::move(task)] {
      if (left_) return;
      const Now now = wakeUp();
      task(now);
      step(now);
    });
  }

  session::Output& output() { return *this; }

 private:
  void run() {
    pthread_setname_np(pthread_self(), "frontseat");
    client_.start();
    scheduleStep();
    next_tick_ = std::chrono::steady_clock::now() + kTick;
    scheduleTick();
    io_.run();
  }

  /// The link is still up here, so that what must be said last is said before it is closed.
  void leave() {
    const Now now = clock_();
    leaving_ = true;
    session_.leave(now, *this);
    leave_timer_.expires_after(kLastWords);
    leave_timer_.async_wait([this](const error_code&) { finishLeaving(); });
    step(now);
  }

  /// Ends all that keeps run() going.
  void finishLeaving() {
    if (std::exchange(left_, true)) return;
    client_.close();
    leave_timer_.cancel();
    step_timer_.cancel();
    tick_timer_.cancel();
    work_.reset();
  }

  // What the link reports.

  void onConnected(const std::string& endpoint) override {
    const Now now = clock_();
    listener_.onConnected(now, endpoint);
    session_.connected(now, *this);
    step(now);
  }

  void onBytes(std::string_view bytes) override {
    const Now now = wakeUp();
    session_.receive(now, bytes, *this);
    step(now);
  }

  void onDisconnected(const std::string& reason) override {
    const Now now = clock_();
    session_.disconnected(now, *this);
    if (!left_) step(now);
    listener_.onDisconnected(now, reason);
  }

  void onConnectFailed(const std::string& reason, std::chrono::milliseconds retry_in) override {
    listener_.onConnectFailed(clock_(), reason, retry_in);
  }

  // What the session says.

  bool send(const Now& now, std::string_view sentence) override {
    if (!client_.write(sentence)) return false;
    listener_.onSent(now, withoutLineEnd(sentence));
    return true;
  }

  // Three sentences: a host acknowledges within 40 ms, two spacings of a Kingfisher.
  bool congested() const override { return client_.unacknowledgedBytes() > 3UL * 80; }

  void heard(const Now& now, std::string_view line) override { listener_.onHeard(now, line); }

  void event(const Now& now, const vehicle::Event& event) override {
    listener_.onEvent(now, event);
  }

  void confirmed() override { client_.confirm(); }

  // Time.

  /// The time, for what comes first after a wait.
  Now wakeUp() {
    const Now now = clock_();
    if (now.steady <= next_tick_ + kStoodStill) return now;
    session_.stoodStill(now, *this);
    scheduleStep();
    return now;
  }

  void step(const Now& begun) {
    const bool held_up = std::chrono::steady_clock::now() > begun.steady + kHeldUp;
    session_.step(held_up ? clock_() : begun, *this);
    if (leaving_ && (session_.hasLeft() || !client_.connected())) return finishLeaving();
    scheduleStep();
  }

  /// A timer that expires too early is left alone: at the rates of a vehicle, moving it at every
  /// read would cost more than the step it saves. One that is due at once still lets the link have
  /// its turn first.
  void scheduleStep() {
    const SteadyTime due = session_.nextStep();
    if (due >= step_timer_due_) return;
    step_timer_due_ = due;
    step_timer_.expires_at(due);
    step_timer_.async_wait([this](const error_code& error) {
      if (!error) stepIfDue();
    });
  }

  void stepIfDue() {
    if (left_) return;
    step_timer_due_ = SteadyTime::max();
    const Now now = wakeUp();
    if (now.steady >= session_.nextStep()) return step(now);
    scheduleStep();
  }

  void scheduleTick() {
    tick_timer_.expires_at(next_tick_);
    tick_timer_.async_wait([this](const error_code& error) {
      if (!error) tick();
    });
  }

  void tick() {
    if (left_) return;
    listener_.onTick(wakeUp());
    const SteadyTime now = std::chrono::steady_clock::now();
    while (next_tick_ <= now) next_tick_ += kTick;  // what was missed is not made up for
    scheduleTick();
  }

  session::Session& session_;
  Listener& listener_;
  const Clock clock_;
  boost::asio::io_context io_{1};  // one thread
  boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_{
      io_.get_executor()};
  boost::asio::steady_timer step_timer_{io_};
  boost::asio::steady_timer tick_timer_{io_};
  boost::asio::steady_timer leave_timer_{io_};
  SteadyTime step_timer_due_ = SteadyTime::max();  ///< max: the timer does not run
  SteadyTime next_tick_{};
  link::TcpClient client_;
  bool leaving_ = false;  ///< touched by the driver's thread only, as left_ is
  bool left_ = false;
  std::atomic<bool> stopping_{false};
  std::mutex lifetime_;  ///< of the thread
  std::thread thread_;
};

Driver::Driver(link::TcpClient::Options options, session::Session& session, Listener& listener,
               Clock clock)
    : impl_(std::make_unique<Impl>(std::move(options), session, listener, std::move(clock))) {}

Driver::~Driver() { stop(); }

void Driver::start() { impl_->start(); }

void Driver::stop() { impl_->stop(); }

session::Output& Driver::output() { return impl_->output(); }

void Driver::post(std::function<void(const Now&)> task) { impl_->post(std::move(task)); }

}  // namespace frontseat_driver::driver
