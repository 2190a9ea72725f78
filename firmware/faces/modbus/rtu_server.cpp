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
#include "protocol/modbus_rtu.h"
#include "rtu_line.h"
#include "unit_set.h"

namespace nplc::modbus {
namespace {

/// An adapter delivers characters in groups; a shorter pause does not end a frame.
constexpr base::Milliseconds kLumps{20};
constexpr base::Milliseconds kBriefly{1};

/// A broadcast of stop, safe or hold, as coil or command.
std::optional<faces::Command> stop_in(std::span<const std::uint8_t> pdu, base::Instant now) {
    namespace gw = registers::gateway;
    const auto [request, exception] = decode(pdu);
    if (exception != Exception::none || !request.writes || request.count != 1) return std::nullopt;
    if (request.space == Space::coil && request.bit(0)) {
        if (request.address == kStop) return faces::Command::of(gw::Command::stop, now);
        if (request.address == kSafe) return faces::Command::of(gw::Command::safe, now);
        if (request.address == kHold) return faces::Command::of(gw::Command::hold, now);
    }
    if (request.space != Space::holding_register || request.address != kCommand) return std::nullopt;
    const auto command = faces::Command::of(static_cast<gw::Command>(request.word(0)), now);
    return command.is_stop() ? std::optional(command) : std::nullopt;
}

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
    void serve(base::Instant now);
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
        if (byte.framing_error)
            reader_.damaged();
        else if (reader_.take(byte.value))
            note_frame(now);
    }
}

/// A new request cancels the answer to the previous one.
void RtuServer::Loop::note_frame(base::Instant now) {
    if (reader_.unit() == kBroadcast) {
        if (const auto stop = stop_in(reader_.pdu(), now)) set_.stop_all(*stop);
        return;
    }
    const std::size_t index = std::size_t{reader_.unit()} - options_.unit;
    if (reader_.unit() < options_.unit || index >= set_.units().size()) return;
    frame_.reset();
    sent_ = 0;
    if (session_->is_waiting()) static_cast<void>(session_->put_aside());
    unit_ = reader_.unit();
    request_arrived_ = arrived_;
    request_size_ = reader_.pdu().size();
    std::copy(reader_.pdu().begin(), reader_.pdu().end(), request_.begin());
    asked_.reset();
}

/// Answers once there is a recent image.
void RtuServer::Loop::serve(base::Instant now) {
    if (!asked_) asked_ = now;
    if (!set_.is_fresh(now) && now - *asked_ < UnitSet::kImageWait) return;
    asked_.reset();
    const auto number = static_cast<std::uint8_t>(unit_ - options_.unit + 1);
    const std::span<const std::uint8_t> pdu = std::span(request_).first(std::exchange(request_size_, 0));
    if (const auto at_once = session_->serve(number, pdu, {.now = now, .arrived = request_arrived_}))
        answer(*at_once);
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
