// MacTalk on a line (001 §5.1): each request with its answer.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "base/bytes.h"
#include "macreg/frames.h"
#include "macreg/monitor.h"
#include "protocol/mactalk.h"
#include "registers/gateway.h"
#include "registers/layout.h"

namespace nplc::macreg {

namespace mactalk = protocol::mactalk;
namespace reg = registers;

namespace {

constexpr base::Microseconds kLongestPause{100'000};  // more than the latency of a USB adapter
constexpr std::size_t kAddressAt = 3;
constexpr std::size_t kRegisterReply = 11;  // bytes of an answer without its data; each data byte takes two
constexpr std::size_t kSampleReply = 9;

class MactalkMonitor final : public Monitor {
  public:
    explicit MactalkMonitor(const MonitorOptions& options) : options_(options) {}

    void receive(Side side, std::uint8_t byte, base::Instant at) override {
        FrameCutter& cutter = cutter_of(side);
        cutter.receive(byte, at);
        look(side, cutter);
    }
    void framing_error(Side side, base::Instant at) override {
        FrameCutter& cutter = cutter_of(side);
        cutter.finish();
        look(side, cutter);
        tell_framing_error(at);
    }
    void pass(base::Instant now) override {
        each([&](FrameCutter& cutter) { cutter.pass(now); });
        if (pending_ && now - pending_->event.at > options_.longest_answer) tell_no_answer();
    }
    void finish() override {
        each([](FrameCutter& cutter) { cutter.finish(); });
        tell_no_answer();
    }
    std::optional<base::Instant> since() const override {
        std::optional<base::Instant> first;
        if (pending_) first = pending_->event.at;
        for (const FrameCutter& cutter : cutters_) {
            const auto begun = cutter.since();
            if (begun && (!first || *begun < *first)) first = begun;
        }
        return first;
    }

  private:
    struct Pending {
        mactalk::Request request;
        MonitorEvent event;
    };

    FrameCutter& cutter_of(Side side) { return cutters_[static_cast<std::size_t>(side)]; }
    template <class What>
    void each(What what) {
        for (std::size_t i = 0; i < cutters_.size(); ++i) {
            what(cutters_[i]);
            look(static_cast<Side>(i), cutters_[i]);
        }
    }

    void look(Side side, FrameCutter& cutter) {
        for (Frame& frame : cutter.take()) {
            if (frame.kind == Frame::Kind::message)
                message(side, frame);
            else if (frame.kind == Frame::Kind::accept)
                answer(side, frame, mactalk::Reply{}, mactalk::Answer::accept);
            else
                tell_flaw(side, frame, frame.kind == Frame::Kind::noise ? "noise" : frame.flaw);
        }
    }

    void tell_flaw(Side side, Frame& frame, const std::string& what) {
        MonitorEvent event{.at = frame.at};
        event.flaw = fmt::format("{}{}: {}", what, side == Side::motor ? " in what the motor sends" : "",
                                 hex_words(frame.bytes));
        (side == Side::motor ? event.received : event.sent) = std::move(frame.bytes);
        tell(std::move(event));
    }

    void message(Side side, Frame& frame) {
        const bool from_motor = frame.bytes.front() == static_cast<std::uint8_t>(mactalk::Kind::write) &&
                                frame.bytes[kAddressAt] == mactalk::kMasterAddress;
        if (from_motor) return reply(side, frame);
        mactalk::RequestDecoder decoder;
        decoder.take_long_writes(frame.bytes[kAddressAt]);
        std::optional<mactalk::Request> request;
        for (const std::uint8_t byte : frame.bytes) request = decoder.receive(byte);
        if (!request) return tell_flaw(side, frame, "length and data do not fit");
        tell_no_answer();
        MonitorEvent event{.at = frame.at};
        event.request = request_words(*request);
        event.address = request->address;
        if (request->reg != 0) event.reg = request->reg;
        if (request->kind == mactalk::Kind::write) event.value = request->value;
        if (side == Side::motor) event.flaw = "a request from the motor's side: are the two ports exchanged?";
        event.sent = std::move(frame.bytes);
        if (mactalk::answer_to(request->kind) == mactalk::Answer::none) return tell(std::move(event));
        pending_ = Pending{*request, std::move(event)};
    }

    void reply(Side side, Frame& frame) {
        // No number of bytes matches both forms: registers come 4 or 64 at a time, samples 8 or 16
        for (const auto& [form, data] : {std::pair{mactalk::Answer::registers, mactalk::kReadBytes},
                                         std::pair{mactalk::Answer::registers, mactalk::kBlockBytes},
                                         std::pair{mactalk::Answer::samples, mactalk::kSampleBytes},
                                         std::pair{mactalk::Answer::samples, mactalk::kMac800SampleBytes}}) {
            const std::size_t beside = form == mactalk::Answer::registers ? kRegisterReply : kSampleReply;
            if (frame.bytes.size() != beside + 2 * data) continue;
            mactalk::ReplyDecoder decoder;
            decoder.expect(form, data);
            std::optional<mactalk::Reply> found;
            for (const std::uint8_t byte : frame.bytes) found = decoder.receive(byte);
            if (found) return answer(side, frame, *found, form);
        }
        tell_flaw(side, frame, "length and data do not fit");
    }

    void answer(Side side, Frame& frame, const mactalk::Reply& found, mactalk::Answer form) {
        const bool fits = pending_ && mactalk::answer_to(pending_->request.kind) == form &&
                          (form != mactalk::Answer::registers || found.reg == pending_->request.reg);
        MonitorEvent event{.at = frame.at};
        if (fits) event = std::move(pending_->event);
        if (!fits && pending_) tell_no_answer();
        event.answer = answer_words(found, form, event.address.value_or(0));
        if (!fits) event.flaw = "an answer to no request that was heard";
        if (side == Side::master)
            event.flaw = "an answer from the master's side: are the two ports exchanged?";
        if (form == mactalk::Answer::registers) {
            event.reg = found.reg;
            if (found.length == mactalk::kReadBytes) event.value = base::load_u32(found.data.data());
        }
        event.received = std::move(frame.bytes);
        pending_.reset();
        tell(std::move(event));
    }

    void tell_no_answer() {
        if (!pending_) return;
        pending_->event.answer = "no answer";
        tell(std::move(pending_->event));
        pending_.reset();
    }

    bool is_gateway(std::uint8_t address) const {
        return options_.gateway != 0 && address == options_.gateway;
    }

    std::string unit_words(std::uint8_t address) const {
        if (address == mactalk::kEveryone) return "every motor";
        return fmt::format("{} {}", is_gateway(address) ? "gateway" : "motor", address);
    }

    std::string name_of(std::uint8_t address, std::uint8_t number) const {
        if (!is_gateway(address)) return register_words(options_.model, number);
        const auto* row = reg::gateway::find(number);
        if (row == nullptr) return fmt::format("register {}", number);
        return row->number == number ? fmt::format("{} ({})", row->name, number)
                                     : fmt::format("{}+{} ({})", row->name, number - row->number, number);
    }

    std::string data_words(std::uint8_t address, std::uint8_t number, std::uint32_t value,
                           std::size_t bytes) const {
        if (is_gateway(address)) return fmt::format("{:08X} = {}", value, value);
        return bytes_words(options_.model, number, value, bytes);
    }

    std::string request_words(const mactalk::Request& request) const {
        return unit_words(request.address) + ": " + order_words(request);
    }

    std::string order_words(const mactalk::Request& request) const {
        const std::uint8_t to = request.address;
        switch (request.kind) {
            case mactalk::Kind::read:
                return "read " + name_of(to, request.reg);
            case mactalk::Kind::read_block:
                return fmt::format("read {} and what follows, 64 bytes", name_of(to, request.reg));
            case mactalk::Kind::write: {
                std::string words = "write " + name_of(to, request.reg) + " := ";
                if (request.length > mactalk::kReadBytes)
                    return words + fmt::format("{} bytes", request.length);
                words += data_words(to, request.reg, request.value, request.length);
                return words + overflow_words(request);
            }
            case mactalk::Kind::read_samples:
                return "read the next sample";
            case mactalk::Kind::safe_mode:
                return "go to SAFE_MODE";
            case mactalk::Kind::init_mode:
                return "go to INIT_MODE";
            case mactalk::Kind::write_flash:
                return "write the parameters to flash, and reset";
            case mactalk::Kind::reset:
                return "reset";
        }
        return {};
    }

    /// Four bytes written to a 16-bit register overwrite the next one too.
    std::string overflow_words(const mactalk::Request& request) const {
        if (is_gateway(request.address) || request.length != mactalk::kReadBytes) return {};
        const reg::Register* found = reg::find(options_.model, request.reg);
        if (found == nullptr || reg::bytes_of(options_.model, *found) == request.length) return {};
        return fmt::format(", and {} := {:04X} (4 bytes to a 16-bit register)",
                           name_of(request.address, static_cast<std::uint8_t>(request.reg + 1)),
                           request.value >> 16);
    }

    std::string answer_words(const mactalk::Reply& found, mactalk::Answer form, std::uint8_t address) const {
        if (form == mactalk::Answer::accept) return "accepted";
        if (form == mactalk::Answer::samples) return "sample " + hex_words(found.view());
        const std::string data =
            found.length == mactalk::kReadBytes
                ? data_words(address, found.reg, base::load_u32(found.data.data()), mactalk::kReadBytes)
                : hex_words(found.view());
        return address == 0 ? name_of(address, found.reg) + ": " + data : data;
    }

    MonitorOptions options_;
    std::array<FrameCutter, 3> cutters_{FrameCutter(kLongestPause), FrameCutter(kLongestPause),
                                        FrameCutter(kLongestPause)};
    std::optional<Pending> pending_;
};

}  // namespace

std::unique_ptr<Monitor> make_mactalk_monitor(const MonitorOptions& options) {
    return std::make_unique<MactalkMonitor>(options);
}

std::vector<MonitorEvent> InOrder::take(Monitor& monitor) {
    for (MonitorEvent& event : monitor.take()) waiting_.push_back(std::move(event));
    std::stable_sort(waiting_.begin(), waiting_.end(),
                     [](const MonitorEvent& a, const MonitorEvent& b) { return a.at < b.at; });
    const auto since = monitor.since();
    const auto end = std::find_if(waiting_.begin(), waiting_.end(),
                                  [&](const MonitorEvent& event) { return since && event.at > *since; });
    std::vector<MonitorEvent> ready(std::make_move_iterator(waiting_.begin()), std::make_move_iterator(end));
    waiting_.erase(waiting_.begin(), end);
    return ready;
}

std::string line_of(const MonitorEvent& event, base::Instant start) {
    const auto since = (event.at - start).count();
    std::string line = fmt::format("{}.{:03} s", since / 1'000'000, since % 1'000'000 / 1'000);
    if (!event.request.empty()) line += "  -> " + event.request;
    if (!event.answer.empty()) line += (event.request.empty() ? "  <- " : "   <- ") + event.answer;
    if (!event.flaw.empty()) line += "  !! " + event.flaw;
    return line;
}

}  // namespace nplc::macreg
