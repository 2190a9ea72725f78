#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "macreg/causes.h"
#include "mactalk_client/master.h"
#include "registers/layout.h"
#include "registers/mac.h"

/// A MAC motor's registers over its MacTalk line, whichever model (001 §3.2, §5.1, 004).
namespace nplc::macreg {

/// MYADDR, or its name on a MAC800.
const registers::Register& address_register(registers::Model model);
/// SERIAL_NMB.
const registers::Register& serial_register(registers::Model model);
/// "MAC800", "MAC50 to MAC141": what the motor's own answers show of its model.
std::string family_words(registers::Model model);

/// The unit that answers is no motor.
class WrongUnit : public mactalk_client::EndedWith<mactalk_client::kNoAnswer> {
    using EndedWith::EndedWith;
};

/// A write without an accept that was not repeated, because the register must be written only once: it may
/// have been carried out.
class Unconfirmed : public mactalk_client::EndedWith<mactalk_client::kNoAnswer> {
    using EndedWith::EndedWith;
};

/// All requests throw mactalk_client::LineError. Reads are repeated, up to the master's attempts.
class Motor {
  public:
    using Model = registers::Model;
    using Register = registers::Register;

    /// `address` 255 is the broadcast address: for a single motor only.
    Motor(mactalk_client::Master& master, std::uint8_t address, Model model)
        : master_(master), address_(address), model_(model) {}

    /// By PROG_VERSION, whose bit 15 the large motors set (004). MAC50, 95, 140 and 141 have the same
    /// registers and cannot be told apart: they answer as MAC140. Throws WrongUnit for a gateway.
    static Model find_model(mactalk_client::Master& master, std::uint8_t address);

    Model model() const { return model_; }
    std::uint8_t address() const { return address_; }
    mactalk_client::Master& master() { return master_; }
    base::Instant now() { return master_.wire().now(); }

    const Register* find(std::uint8_t number) const { return registers::find(model_, number); }
    const Register* find(std::string_view name) const { return registers::find(model_, name); }
    std::span<const Register> map() const { return registers::map_of(model_); }

    std::int64_t read(const Register& reg);
    /// Of a number in the map.
    std::int64_t read(std::uint8_t number) { return read(*find(number)); }
    /// By a name of 001 §3.2 that the model has.
    std::int64_t read(std::string_view name) { return read(*find(name)); }

    /// In as few messages as possible. Registers that lie close together are read as one block, as below.
    Snapshot read_block(std::span<const Register* const> registers);
    /// The registers of the map that lie in the block of 64 bytes from `first` on. All of one instant, unless
    /// the block was damaged twice, or through a gateway: then each register is read alone.
    Snapshot read_block(std::uint8_t first);

    /// With the register's exact width, so that no other register changes. Out of its format's range:
    /// std::out_of_range. A write that may be repeated is repeated until accepted; else Unconfirmed.
    void write(const Register& reg, std::int64_t value);
    /// Sent once, for registers that must not be written twice. False: no accept came.
    bool try_write(const Register& reg, std::int64_t value);

    /// Whether a unit at the gateway's address identifies itself as one. Asked once per run of the program.
    bool is_behind_gateway();

  private:
    void store(Snapshot& snapshot, std::uint8_t first, std::span<const std::uint8_t> bytes);
    /// In a block from `first` on, of one instant; on a bad line one by one.
    Snapshot read_near(std::uint8_t first, std::span<const Register* const> wanted);

    mactalk_client::Master& master_;
    std::uint8_t address_;
    Model model_;
    std::optional<bool> gateway_;
};

/// Register numbers that one block read (51h) reaches: 32 words, on MAC800 16 longwords.
constexpr unsigned block_numbers(registers::Model model) {
    return model == registers::Model::mac800 ? 16 : 32;
}

// Which units are on a MacTalk line (001 §5.1: a unit answers to its own address and to 255).

struct FoundUnit {
    std::uint8_t address = 0;
    bool gateway = false;
    registers::Model model = registers::Model::mac140;  ///< mac140 stands for any of MAC50 to MAC141
    std::int64_t serial_number = 0;
    std::int64_t version = 0;
    std::int64_t mode = 0;
};

struct FinderOptions {
    std::uint32_t baud = 19'200;
    base::Microseconds patience{60'000};
    bool every_address = false;  ///< also when a single motor answers to 255
    std::function<bool()> goes_on{};
    std::function<void(unsigned address)> progress{};
};

struct Found {
    std::vector<FoundUnit> units{};
    bool noise =
        false;  ///< bytes were received that were no answer: a wrong baud rate, or several units at once
    unsigned asked = 0;  ///< addresses that were asked one by one
};

/// At one baud rate. No answer to 255 ends the search at once; a single motor is identified by its own
/// answer, several by requests to each address. Writes nothing. Throws LineError if the port is gone,
/// mactalk_client::Interrupted.
Found find_units(host::ByteClient& wire, const FinderOptions& options);

}  // namespace nplc::macreg
