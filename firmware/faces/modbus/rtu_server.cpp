#include "modbus/rtu_server.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <optional>
#include <utility>

#include "hal_linux/quiet_thread.h"
#include "hal_linux/steady_clock.h"
#include "hal_linux/wakeup.h"
#include "line_stops.h"
#include "protocol/modbus_rtu.h"
#include "rtu_line.h"
#include "unit_set.h"

namespace nplc::modbus {
namespace {

/// An adapter delivers characters in groups; a shorter pause does not end a frame.
constexpr base::Milliseconds kLumps{20};
constexpr base::Milliseconds kBriefly{1};

}  // namespace

/// The thread's main loop.
class RtuServer::Loop {
  public:
    Loop(const Options& options, const faces::Axes& axes) : options_(options), set_(axes, options.settings) {}
    Loop(const Loop&) = delete;
    Loop& operator=(const Loop&) = delete;

    std::string open();
    void run();
    void end() {
        ends_ = true;
        wakeup_.ring();
    }

  private:
    void wait();
    void read(base::Instant now);
    void note_frame(base::Instant now);
    void note_stop(base::Instant now);
    std::optional<std::size_t> index_of(std::uint8_t unit) const;
    std::optional<Answer> hand_over(base::Instant now);
    void serve(base::Instant now);
    void finish_pending(base::Instant now);
    void send(base::Instant now);
    void answer(const Answer& pdu) { frame_ = RtuFrame(unit_, pdu.bytes()); }
    base::Instant due(base::Instant now) const;

    Options options_;
    base::Microseconds gap_ = silence_between_frames(options_.baud);
    hal_linux::SteadyClock clock_;
    hal_linux::Wakeup wakeup_;
    faces::Bell bell_{[this] { wakeup_.ring(); }};
    UnitSet set_;
    std::optional<Session> session_;
    std::unique_ptr<RtuLine> line_;
    RtuReader reader_;
    StopFinder finder_;
    std::array<pollfd, 2> polled_{};

    base::Instant heard_{};     ///< the last character
    base::Instant empty_at_{};  ///< last time when no data were pending
    base::Instant arrived_{};   ///< data read now arrived after this
    std::uint8_t unit_ = 0;     ///< slave of the request in progress
    std::array<std::uint8_t, kMostPdu> request_{};
    base::Instant request_arrived_{};
    std::size_t request_size_ = 0;          ///< 0: no pending request
    std::optional<base::Instant> asked_{};  ///< an image was requested
    std::optional<RtuFrame> frame_;         ///< the answer
    std::size_t sent_ = 0;                  ///< sent bytes of it
    std::atomic<bool> ends_{false};
};

std::string RtuServer::Loop::open() {
    auto opened = RtuLine::open(options_);
    if (!opened.line) return opened.error;
    line_ = std::move(opened.line);
    set_.join(bell_);
    session_.emplace(set_.units(), "Modbus RTU", bell_);
    heard_ = empty_at_ = clock_.now();
    return {};
}

base::Instant RtuServer::Loop::due(base::Instant now) const {
    base::Instant due = now + UnitSet::kTick;
    if (reader_.is_under_way()) due = std::min(due, heard_ + gap_ + kLumps);
    if (frame_) due = std::min(due, sent_ == 0 ? heard_ + gap_ : now + kBriefly);
    if (asked_) due = std::min(due, now + kBriefly);
    if (session_ && session_->is_waiting()) due = std::min(due, now + UnitSet::kBetweenLooks);
    return due;
}

void RtuServer::Loop::wait() {
    polled_[0] = {.fd = wakeup_.descriptor(), .events = POLLIN, .revents = 0};
    polled_[1] = {.fd = line_->descriptor(), .events = POLLIN, .revents = 0};
    const base::Instant now = clock_.now();
    const auto left = std::max(due(now) - now, base::Microseconds(0));
    timespec time{};
    time.tv_nsec = static_cast<long>(std::min(left, base::Microseconds(UnitSet::kTick)).count() * 1'000);
    ::ppoll(polled_.data(), polled_.size(), &time, nullptr);
}

void RtuServer::Loop::run() {
    while (!ends_) {
        wait();
        if ((polled_[0].revents & POLLIN) != 0) wakeup_.drain();
        bell_.arm();
        const base::Instant now = clock_.now();
        line_->look();
        read(now);
        if (request_size_ != 0) serve(now);
        if (const auto ended = session_->take(now)) answer(*ended);
        send(now);
        set_.watch_masters(now);
    }
}

void RtuServer::Loop::read(base::Instant now) {
    std::array<ports::ReceivedByte, 256> bytes{};
    arrived_ = empty_at_;
    const std::size_t count = line_->read(bytes);
    if (count < bytes.size()) empty_at_ = now;
    if (count == 0 && reader_.is_under_way() && now - heard_ > gap_ + kLumps) {
        if (reader_.silence()) note_frame(now);
        return;
    }
    if (count != 0) heard_ = now;
    for (const ports::ReceivedByte& byte : std::span(bytes).first(count)) {
        if (byte.framing_error) {
            reader_.damaged();
            continue;
        }
        const bool is_stop = finder_.take(byte.value);
        if (reader_.take(byte.value))
            note_frame(now);
        else if (is_stop)
            note_stop(now);
    }
}

std::optional<std::size_t> RtuServer::Loop::index_of(std::uint8_t unit) const {
    if (unit < options_.unit || std::size_t{unit} - options_.unit >= set_.size()) return std::nullopt;
    return std::size_t{unit} - options_.unit;
}

/// A new request cancels the answer to the previous one, which is carried out all the same.
void RtuServer::Loop::note_frame(base::Instant now) {
    if (reader_.unit() == kBroadcast) {
        finish_pending(now);
        for (const faces::Command& stop : stops_in(reader_.pdu(), now)) set_.stop_all(stop);
        return;
    }
    if (!index_of(reader_.unit())) return;
    frame_.reset();
    sent_ = 0;
    if (session_->is_waiting()) static_cast<void>(session_->put_aside());
    if (request_size_ != 0) static_cast<void>(hand_over(now));
    if (session_->is_waiting()) static_cast<void>(session_->put_aside());
    unit_ = reader_.unit();
    request_arrived_ = arrived_;
    request_size_ = reader_.pdu().size();
    std::copy(reader_.pdu().begin(), reader_.pdu().end(), request_.begin());
    asked_.reset();
}

/// Outside of a frame: carried out without an answer, for who is to answer here is not certain.
void RtuServer::Loop::note_stop(base::Instant now) {
    finish_pending(now);
    const bool is_for_all = finder_.unit() == kBroadcast;
    const auto index = index_of(finder_.unit());
    for (const faces::Command& stop : stops_in(finder_.pdu(), now)) {
        if (is_for_all) set_.stop_all(stop);
        if (!is_for_all && index) set_.stop(*index, stop);
    }
}

std::optional<Answer> RtuServer::Loop::hand_over(base::Instant now) {
    const auto number = static_cast<std::uint8_t>(unit_ - options_.unit + 1);
    const std::span<const std::uint8_t> pdu = std::span(request_).first(std::exchange(request_size_, 0));
    return session_->serve(number, pdu, {.now = now, .arrived = request_arrived_});
}

/// Answers once there is a recent image.
void RtuServer::Loop::serve(base::Instant now) {
    if (!asked_) asked_ = now;
    if (!set_.is_fresh(now) && now - *asked_ < UnitSet::kImageWait) return;
    finish_pending(now);
}

/// What came before a stop is carried out before it.
void RtuServer::Loop::finish_pending(base::Instant now) {
    if (request_size_ == 0) return;
    asked_.reset();
    if (const auto at_once = hand_over(now)) answer(*at_once);
}

void RtuServer::Loop::send(base::Instant now) {
    if (!frame_ || (sent_ == 0 && now < heard_ + gap_)) return;
    sent_ += line_->write(frame_->bytes().subspan(sent_));
    if (sent_ < frame_->bytes().size()) return;
    frame_.reset();
    sent_ = 0;
}

RtuServer::RtuServer() = default;

RtuServer::Opened RtuServer::open(const Options& options, const faces::Axes& axes) {
    std::unique_ptr<RtuServer> server(new RtuServer);
    server->loop_ = std::make_unique<Loop>(options, axes);
    if (std::string error = server->loop_->open(); !error.empty()) return {nullptr, error};
    server->thread_ = hal_linux::start_quiet_thread([loop = server->loop_.get()] { loop->run(); });
    return {std::move(server), {}};
}

RtuServer::~RtuServer() {
    if (!thread_.joinable()) return;
    loop_->end();
    thread_.join();
}

}  // namespace nplc::modbus
