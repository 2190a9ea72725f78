#include "macreg/finder.h"

#include "macreg/motor.h"
#include "registers/gateway.h"

namespace nplc::macreg {

using mactalk_client::Interrupted;
using mactalk_client::LineError;
using mactalk_client::Master;
using registers::Model;

namespace {

namespace gw = registers::gateway;

constexpr std::uint8_t kEveryone = 255;
constexpr std::uint8_t kLast = 254;
constexpr int kCalls = 3;

class Finder {
  public:
    Finder(mactalk_client::Wire& wire, const FinderOptions& options)
        : options_(options),
          master_(wire, {.baud = options.baud, .patience = options.patience, .attempts = 1}) {}

    Found run() {
        const bool alone = call_everyone();
        if (options_.every_address || (found_.noise && !alone)) {
            found_.units.clear();
            for (unsigned address = 1; address <= kLast; ++address) ask(static_cast<std::uint8_t>(address));
        } else if (!has(gw::kDefaultAddress)) {
            ask(gw::kDefaultAddress);  // a gateway does not answer to 255 itself
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

    /// True if exactly one motor is there: what it says of itself at 255 is what it says at its own address.
    bool call_everyone() {
        for (int i = 0; i < kCalls; ++i) {
            const auto version = read(kEveryone, registers::PROG_VERSION);
            if (!version) continue;
            const Model model = (*version >> 15 & 1) != 0 ? Model::mac800 : Model::mac140;
            const bool large = model == Model::mac800;
            const std::uint8_t serial =
                registers::find(model, large ? "SERIAL_NUMBER" : "SERIAL_NMB")->number;
            const auto address =
                read(kEveryone, registers::find(model, large ? "MY_ADDR" : "MYADDR")->number);
            const auto number = read(kEveryone, serial);
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
        if (!version) return false;
        if (!has(address)) found_.units.push_back(describe(address, *version));
        return true;
    }

    FoundUnit describe(std::uint8_t address, std::uint32_t version) {
        FoundUnit unit{.address = address};
        if (version == gw::kIdentity) {
            unit.gateway = true;
            return unit;
        }
        unit.model = (version >> 15 & 1) != 0 ? Model::mac800 : Model::mac140;
        const bool large = unit.model == Model::mac800;
        unit.version = static_cast<std::int64_t>(version & 0xFFFF);
        const std::uint8_t serial =
            registers::find(unit.model, large ? "SERIAL_NUMBER" : "SERIAL_NMB")->number;
        unit.serial_number = static_cast<std::int32_t>(read(address, serial).value_or(0));
        const std::uint32_t mode = read(address, registers::MODE_REG).value_or(0);
        unit.mode = large ? mode : mode & 0xFFFF;
        return unit;
    }

    const FinderOptions& options_;
    Master master_;
    Found found_;
};

}  // namespace

Found find_units(mactalk_client::Wire& wire, const FinderOptions& options) {
    return Finder(wire, options).run();
}

}  // namespace nplc::macreg
