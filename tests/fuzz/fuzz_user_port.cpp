// Any bytes on the user's port, at any time, beside a sequence: nothing is written outside of the storage,
// the active table stays whole, the motor is not written while the sequence runs, and a whole question after
// anything is answered.
#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>

#include "base/bytes.h"
#include "base/crc32.h"
#include "fuzz.h"
#include "gateway/controller.h"
#include "sim/sim_storage.h"

namespace {

using namespace nplc;
namespace mactalk = protocol::mactalk;
namespace reg = registers::gateway;

struct Board final : ports::DigitalInputs,
                     ports::DigitalOutputs,
                     ports::Watchdog,
                     ports::SerialPort,
                     motor::Motor {
    std::uint8_t read() override { return inputs; }
    void write(std::uint8_t levels) override { require(levels < 16); }
    void feed() override {}

    std::size_t write(std::span<const std::uint8_t> bytes) override {
        const std::size_t taken = bytes.size() < 7 ? bytes.size() : 7;
        sent.insert(sent.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(taken));
        return taken;
    }
    std::size_t read(std::span<ports::ReceivedByte> out) override {
        std::size_t count = 0;
        for (; count < out.size() && !received.empty(); ++count) {
            out[count] = received.front();
            received.pop_front();
        }
        return count;
    }
    bool transmitter_idle() override { return true; }

    void poll(base::Instant) override {}
    void begin_orders(base::Instant) override {}
    bool orders_complete() const override { return true; }
    bool has_room() const override { return true; }
    bool can_execute(const motor::Order&) const override { return true; }
    void send(const motor::Order&) override {}
    void stop() override {}
    bool stop_confirmed() const override { return true; }
    void give_up_stop() override {}
    bool begin_access(const motor::Access& access) override {
        require(!access.is_write || may_write());
        require(access.reg != 0);
        last = access;
        state = access.reg % 5 == 0 ? motor::AccessState::failed : motor::AccessState::done;
        return true;
    }
    motor::AccessState access_state() const override { return state; }
    std::uint32_t access_value() const override { return last.reg < 64 ? 0 : last.reg; }
    void drop_access() override { state = motor::AccessState::none; }
    bool in_position() const override { return true; }
    bool error() const override { return false; }
    motor::Link link() const override { return motor::Link::up; }
    motor::Counters counters() const override { return {}; }
    bool longwords_only() const override { return false; }

    std::uint8_t inputs = 0;
    std::function<bool()> may_write;
    std::deque<ports::ReceivedByte> received;
    std::deque<std::uint8_t> sent;
    motor::Access last;
    motor::AccessState state = motor::AccessState::none;
};

class Run {
  public:
    Run() {
        board_.may_write = [this] {
            return controller_.sequence().run_state() == gateway::RunState::stopped ||
                   settings_.get(store::Setting::motor_writes) != 0;
        };
        constexpr std::uint8_t kTable[]{0xC0, 1, 1, 1, 0x80, 5, 0, 0, 0xC1, 0, 1, 0,
                                        0x80, 2, 0, 0, 0x3F, 0, 0, 0, 0,    0, 0, 0};
        require(controller_.tables().use(kTable, now_).ok);
    }

    void hear(std::uint8_t byte, bool framing_error) {
        board_.received.push_back({byte, framing_error});
        poll(base::Microseconds(521));
    }

    void poll(base::Microseconds step) {
        now_ += step;
        controller_.poll(now_);
        const gateway::TableManager& tables = controller_.tables();
        require(base::crc32(tables.active()) == tables.active_crc() || tables.active().empty());
        require(tables.active().size() <= memory_.size());
    }

    void toggle_input() { board_.inputs ^= 1; }

    /// A new whole question is answered, whatever came before.
    void ask() {
        for (int i = 0; i < 40; ++i) poll(base::Microseconds(1000));
        board_.sent.clear();
        const auto address = static_cast<std::uint8_t>(settings_.at_start(store::Setting::gateway_address));
        const auto question =
            mactalk::encode({.kind = mactalk::Kind::read, .address = address, .reg = reg::IDENTITY});
        for (const std::uint8_t byte : question.view()) {
            hear(byte, false);
        }
        for (int i = 0; i < 20; ++i) poll(base::Microseconds(1000));
        mactalk::ReplyDecoder decoder;
        decoder.expect(mactalk::Answer::registers, 4);
        std::optional<mactalk::Reply> reply;
        for (const std::uint8_t byte : board_.sent) {
            if (const auto whole = decoder.receive(byte)) reply = whole;
        }
        require(reply && reply->reg == reg::IDENTITY && base::load_u32(reply->data.data()) == reg::kIdentity);
    }

  private:
    static gateway::SettingsManager& started(gateway::SettingsManager& settings) {
        settings.start({});
        return settings;
    }

    Board board_;
    base::Instant now_{};
    sim::SimStorage flash_{{.size = 24 * 1024, .erase_block = 2048, .program_page = 256, .program_unit = 8}};
    std::array<std::uint8_t, (sequencer::kMaxTerms + 1) * sequencer::kTermBytes> memory_{};
    gateway::SettingsManager settings_{flash_, {.begin = 10 * 2048, .slot_bytes = 2048}};
    gateway::Controller controller_{{.inputs = board_,
                                     .outputs = board_,
                                     .watchdog = board_,
                                     .motor = board_,
                                     .storage = flash_,
                                     .user_line = &board_},
                                    {.begin = 0, .slot_bytes = 5 * 2048},
                                    memory_,
                                    started(settings_),
                                    gateway::StartCause::power_up};
};

/// The input's bytes are messages in short, since random bytes rarely contain the inverses: kind, register,
/// four bytes of value; or raw bytes.
void act(Run& run, std::span<const std::uint8_t> six) {
    const std::uint8_t address = six[0] % 3 == 0 ? std::uint8_t{254} : reg::kDefaultAddress;
    const auto put = [&run](auto&& encoded) {
        for (const std::uint8_t byte : encoded.view()) run.hear(byte, false);
    };
    const auto kind = static_cast<mactalk::Kind>(0x50 + six[0] / 4 % 8);
    switch (six[0] / 32) {
        case 0:
        case 1:
            for (const std::uint8_t byte : six) run.hear(byte, byte == 0x77);
            return;
        case 2:
            run.toggle_input();
            return run.poll(base::Microseconds(six[1] * 1000));
        case 3: {
            std::array<std::uint8_t, mactalk::kMaxLongWrite> piece;
            piece.fill(six[1]);
            return put(mactalk::encode_long_write(address, reg::TABLE_DATA,
                                                  std::span(piece).first(4 * (1 + six[2] % 32U))));
        }
        case 4:
            return put(mactalk::encode({.kind = mactalk::Kind::write,
                                        .address = address,
                                        .reg = reg::COMMAND,
                                        .length = 2,
                                        .value = six[1] % 24U}));
        default:
            return put(mactalk::encode({.kind = kind,
                                        .address = address,
                                        .reg = six[1],
                                        .length = std::uint8_t(kind == mactalk::Kind::write ? 4 : 0),
                                        .value = base::load_u32(&six[2])}));
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > 600) return 0;
    Run run;
    for (std::span rest(data, size); rest.size() >= 6; rest = rest.subspan(6)) act(run, rest.first(6));
    run.ask();
    return 0;
}
