#include "macreg/motor.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/bytes.h"
#include "registers/convert.h"
#include "registers/gateway.h"

namespace nplc::macreg {

using mactalk_client::LineError;
using mactalk_client::Width;
using registers::Register;
namespace gw = registers::gateway;
using mactalk_client::Interrupted;
using mactalk_client::Master;
using registers::Model;

namespace {

/// By PROG_VERSION, whose bit 15 the large motors set (004).
Model model_of_version(std::uint32_t version) {
    return (version >> 15 & 1) != 0 ? Model::mac800 : Model::mac140;
}

/// After this many damaged replies a block is read register by register: a tenth of the bytes at a time.
constexpr unsigned kBlockAttempts = 2;
constexpr unsigned kGatewayAttempts = 10;
/// A block takes as many characters on the line as five single reads.
constexpr std::size_t kWorthABlock = 5;

/// 001 §3.2.36, §3.2.43; 004: relative positions and resynchronising add at each write.
bool may_be_repeated(registers::Model model, const Register& reg, std::int64_t value) {
    const std::int64_t resynchronise = model == registers::Model::mac800 ? 1 << 6 : 1 << 10;
    switch (reg.number) {
        case registers::P_REG_P:
            return value == 0;
        case registers::CNTRL_BITS:
            return (value & resynchronise) == 0;
        case registers::MODE_REG:
            return value < 256;
        default:
            return true;
    }
}

constexpr std::uint8_t kEveryone = 255;
constexpr std::uint8_t kLast = 254;
constexpr int kCalls = 3;

class Finder {
  public:
    Finder(host::ByteClient& wire, const FinderOptions& options)
        : options_(options),
          master_(wire, {.baud = options.baud, .patience = options.patience, .attempts = 1}) {}

    Found run() {
        const bool alone = call_everyone();
        if (options_.every_address || (found_.noise && !alone)) {
            found_.units.clear();
            for (unsigned address = 1; address <= kLast; ++address) ask(static_cast<std::uint8_t>(address));
        } else if (!has(gw::kDefaultAddress)) {
            ask(gw::kDefaultAddress);  // a gateway itself does not answer to 255
        }
        return found_;
    }

  private:
    bool has(std::uint8_t address) const {
        for (const FoundUnit& unit : found_.units) {
            if (unit.address == address) return true;
        }
        return false;
    }

    std::optional<std::uint32_t> read(std::uint8_t address, std::uint8_t reg) {
        if (options_.goes_on && !options_.goes_on()) throw Interrupted("interrupted");
        const auto stray = master_.counters().stray_bytes;
        try {
            return master_.read(address, reg);
        } catch (const LineError& error) {
            if (error.kind() != LineError::Kind::no_answer) throw;
            found_.noise = found_.noise || master_.counters().stray_bytes != stray;
            return std::nullopt;
        }
    }

    /// True if exactly one motor is there: its values at 255 equal those at its own address.
    bool call_everyone() {
        for (int i = 0; i < kCalls; ++i) {
            const auto version = read(kEveryone, registers::PROG_VERSION);
            if (!version) continue;
            const Model model = model_of_version(*version);
            const auto address = read(kEveryone, address_register(model).number);
            const auto number = read(kEveryone, serial_register(model).number);
            if (!address || !number) continue;
            const auto own = static_cast<std::uint8_t>(*address);
            if (own < 1 || own > kLast || !ask(own)) continue;
            if (found_.units.back().serial_number == static_cast<std::int32_t>(*number)) return !found_.noise;
        }
        return false;
    }

    bool ask(std::uint8_t address) {
        if (options_.progress) options_.progress(address);
        ++found_.asked;
        auto version = read(address, registers::PROG_VERSION);
        if (!version && found_.noise) version = read(address, registers::PROG_VERSION);
        if (!version || !says_more(address, *version)) return false;
        if (!has(address)) found_.units.push_back(describe(address, *version));
        return true;
    }

    /// An answer has no address: a late one must not be assigned to another address.
    bool says_more(std::uint8_t address, std::uint32_t version) {
        if (version == gw::kIdentity) return true;
        master_.pause(options_.patience);
        const std::uint8_t own = address_register(model_of_version(version)).number;
        return read(address, own).has_value() || read(address, own).has_value();
    }

    FoundUnit describe(std::uint8_t address, std::uint32_t version) {
        FoundUnit unit{.address = address};
        if (version == gw::kIdentity) {
            unit.gateway = true;
            return unit;
        }
        unit.model = model_of_version(version);
        unit.version = static_cast<std::int64_t>(version & 0xFFFF);
        const std::uint8_t serial = serial_register(unit.model).number;
        unit.serial_number = static_cast<std::int32_t>(read(address, serial).value_or(0));
        const std::uint32_t mode = read(address, registers::MODE_REG).value_or(0);
        unit.mode = unit.model == Model::mac800 ? mode : mode & 0xFFFF;
        return unit;
    }

    const FinderOptions& options_;
    Master master_;
    Found found_;
};

}  // namespace

const Register& address_register(Model model) {
    return *registers::find(model, model == Model::mac800 ? "MY_ADDR" : "MYADDR");
}

const Register& serial_register(Model model) {
    return *registers::find(model, model == Model::mac800 ? "SERIAL_NUMBER" : "SERIAL_NMB");
}

std::string family_words(Model model) {
    return model == Model::mac800 ? "MAC800" : "MAC50 to MAC141";
}

registers::Model Motor::find_model(mactalk_client::Master& master, std::uint8_t address) {
    const std::uint32_t value = master.read(address, registers::PROG_VERSION);
    if (value == gw::kIdentity)
        throw WrongUnit(fmt::format(
            "{}: address {} is a gateway's, not a motor's; name the motor's with --address, or use nanoctl",
            master.wire().name(), address));
    return model_of_version(value);
}

std::int64_t Motor::read(const Register& reg) {
    return registers::value_of(registers::format_on_line(model_, reg), master_.read(address_, reg.number));
}

void Motor::store(Snapshot& snapshot, std::uint8_t first, std::span<const std::uint8_t> bytes) {
    const std::size_t cell = model_ == Model::mac800 ? 4 : 2;
    for (const Register& reg : map()) {
        if (reg.number < first) continue;
        const std::size_t at = (reg.number - first) * cell;
        const std::size_t size = registers::bytes_of(model_, reg);
        if (at + size > bytes.size()) break;
        const std::uint32_t bits = size == 4 ? base::load_u32(&bytes[at]) : base::load_u16(&bytes[at]);
        snapshot.set(reg.number, registers::value_of(registers::format_on_line(model_, reg), bits), now());
    }
}

Snapshot Motor::read_block(std::uint8_t first) {
    std::vector<const Register*> inside;
    for (const Register& reg : map()) {
        const bool fits = reg.number >= first && reg.number + registers::cells_of(model_, reg).count <=
                                                     first + block_numbers(model_);
        if (fits) inside.push_back(&reg);
    }
    return read_near(first, inside);
}

Snapshot Motor::read_near(std::uint8_t first, std::span<const Register* const> wanted) {
    Snapshot snapshot(now());
    for (unsigned i = 0; i < kBlockAttempts && !gateway_.value_or(false); ++i) {
        if (const auto block = master_.try_read_block(address_, first)) {
            store(snapshot, first, *block);
            return snapshot;
        }
        static_cast<void>(is_behind_gateway());
    }
    for (const Register* reg : wanted) snapshot.set(reg->number, read(*reg), now());
    return snapshot;
}

Snapshot Motor::read_block(std::span<const Register* const> wanted) {
    std::vector<const Register*> sorted(wanted.begin(), wanted.end());
    std::sort(sorted.begin(), sorted.end(), [](auto* a, auto* b) { return a->number < b->number; });
    Snapshot snapshot(now());
    for (auto next = sorted.begin(); next != sorted.end();) {
        const std::uint8_t first = (*next)->number;
        const auto reached = [&](const Register* reg) {
            return reg->number + registers::cells_of(model_, *reg).count <= first + block_numbers(model_);
        };
        const auto end = std::partition_point(next, sorted.end(), reached);
        const bool single = gateway_.value_or(false) || static_cast<std::size_t>(end - next) < kWorthABlock;
        if (single) {
            snapshot.set(first, read(**next), now());
            ++next;
            continue;
        }
        const Snapshot block = read_near(first, std::span(&*next, static_cast<std::size_t>(end - next)));
        for (; next != end; ++next) snapshot.set((*next)->number, block.at((*next)->number), block.time());
    }
    return snapshot;
}

void Motor::write(const Register& reg, std::int64_t value) {
    if (may_be_repeated(model_, reg, value)) {
        const auto width = static_cast<Width>(registers::bytes_of(model_, reg));
        master_.write(address_, reg.number, registers::bits_of(registers::format_on_line(model_, reg), value),
                      width);
    } else if (!try_write(reg, value)) {
        throw Unconfirmed(
            fmt::format("{}: the write of {} was not accepted; it was not repeated, since it may have been "
                        "carried out: look before you write again",
                        master_.wire().name(), reg.name));
    }
}

bool Motor::try_write(const Register& reg, std::int64_t value) {
    const auto width = static_cast<Width>(registers::bytes_of(model_, reg));
    return master_.try_write(address_, reg.number,
                             registers::bits_of(registers::format_on_line(model_, reg), value), width);
}

bool Motor::is_behind_gateway() {
    if (gateway_) return *gateway_;
    gateway_ = false;
    if (address_ == gw::kDefaultAddress) return false;
    // An absent unit is silent; a damaged reply may have been a gateway's answer.
    for (unsigned i = 0; i < kGatewayAttempts && !*gateway_; ++i) {
        const std::uint64_t strays = master_.counters().stray_bytes;
        const auto block = master_.try_read_block(gw::kDefaultAddress, gw::IDENTITY);
        gateway_ = block && base::load_u32(block->data()) == gw::kIdentity;
        if (block || master_.counters().stray_bytes == strays) break;
    }
    return *gateway_;
}

Found find_units(host::ByteClient& wire, const FinderOptions& options) {
    return Finder(wire, options).run();
}

}  // namespace nplc::macreg
