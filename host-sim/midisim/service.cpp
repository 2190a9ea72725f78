#include <fmt/format.h>

#include "hal_linux/socket_can.h"
#include "midisim.h"
#include "registers/family.h"
#include "sim/bench_line.h"
#include "sim/device_memory.h"
#include "sim/midi_stage.h"

namespace nplc::sim {
namespace {

namespace midi = registers::midi;

struct Entry {
    const char* name;
    std::int64_t min;
    std::int64_t max;
    std::int64_t (*get)(const MidiMemory&);
    void (*set)(MidiMemory&, std::int64_t);
};

#define NPLC_ENTRY(field, min, max)                                                         \
    {                                                                                       \
#field, min, max, [](const MidiMemory& m) { return static_cast<std::int64_t>(m.field); }, \
     [](MidiMemory& m, std::int64_t v) { m.field = static_cast<decltype(m.field)>(v); } \
    }

// Limits as in registers/midi.h; a module for CAN has no address 0.
constexpr Entry kEntries[] = {
    NPLC_ENTRY(address, 0, 0x7F),
    NPLC_ENTRY(baud_code, 1, 3),
    NPLC_ENTRY(upper_stop, INT32_MIN, INT32_MAX),
    NPLC_ENTRY(lower_stop, INT32_MIN, INT32_MAX),
    NPLC_ENTRY(torque, 0, midi::kMostTorque),
    NPLC_ENTRY(period, 1, 0xFFFF),
    NPLC_ENTRY(unstall, 1, 0xFF),
    NPLC_ENTRY(ramp, 0, 0xFF),
    NPLC_ENTRY(standby, 0, 1),
    NPLC_ENTRY(stops, 0, 9),
    NPLC_ENTRY(tolerance, 0, 0xFF),
    NPLC_ENTRY(position, midi::kMinPosition, midi::kMaxPosition),
};

#undef NPLC_ENTRY

class EepromMemory final : public DeviceMemory {
  public:
    explicit EepromMemory(MidiModule& module) : module_(module), taken_(module.memory()) {}

    std::string heading() const override {
        return fmt::format("# EEPROM of a virtual {}", midi::facts_of(module_.model()).name);
    }
    std::string form() const override { return "NAME = VALUE"; }
    std::vector<NamedValue> values() const override {
        std::vector<NamedValue> values;
        for (const Entry& entry : kEntries) values.push_back({entry.name, entry.get(module_.memory())});
        return values;
    }
    std::uint32_t writes() const override { return module_.memory_writes(); }
    bool take(const NamedValue& line) override {
        for (const Entry& entry : kEntries) {
            if (line.name != entry.name) continue;
            if (line.value < entry.min || line.value > entry.max) return false;
            entry.set(taken_, line.value);
            return is_legal();
        }
        return false;
    }
    void restore() override { module_.set_memory(taken_); }

  private:
    /// 000 §VI 03h: only some of 0..9 are valid. A module on CAN has no address 0.
    bool is_legal() const {
        return midi::pack(*midi::find_command(midi::END_STOPS), taken_.stops).has_value() &&
               !(module_.is_can() && taken_.address == 0);
    }

    MidiModule& module_;
    MidiMemory taken_;
};

/// "MAC34-1 @0 P 1200 moves VMOT-OK TOP-ZERO status 00000000": the five LEDs by their names.
std::string describe(const MidiModule& module) {
    const MidiModule::Leds leds = module.leds();
    std::string text = fmt::format("{} @{} P {}", midi::facts_of(module.model()).name,
                                   module.memory().address, module.position());
    for (const auto& [on, word] : {std::pair{module.deaf(), "deaf"}, std::pair{module.moving(), "moves"},
                                   std::pair{leds.supply_good, "VMOT-OK"}, std::pair{leds.fault, "FAULT"},
                                   std::pair{leds.catching_up, "BUSY"}, std::pair{leds.top_zero, "TOP-ZERO"},
                                   std::pair{leds.ballast, "BALLAST"}}) {
        if (on) text += fmt::format(" {}", word);
    }
    return text + fmt::format(" status {:08X}", module.status());
}

/// The part that does not depend on the line.
template <class Rack>
class ModuleService : public VirtualDevices {
  public:
    std::string status() const override {
        std::string text;
        for (std::size_t i = 0; i < rack_->size(); ++i)
            text += (i == 0 ? "" : " | ") + describe(rack_->module(i));
        return text;
    }
    bool has_console() const override { return control_.is_console(); }
    /// Switches the modules off, so that they keep their positions.
    std::string finish() override {
        for (std::size_t i = 0; i < rack_->size(); ++i) rack_->module(i).power_off();
        return files_.save_changed();
    }

  protected:
    /// Returns an error, or an empty text.
    std::string load(const MidisimOptions& options) {
        names_.drive = registers::find_drive(midi::facts_of(rack_->module(0).model()).name);
        names_.motor_alone = true;
        stage_.emplace(rack_->module(0));
        std::string error = control_.open(options.control);
        for (std::size_t i = 0; error.empty() && i < options.units.size(); ++i)
            error = files_.add(options.eeprom, options.units[i].address,
                               std::make_unique<EepromMemory>(rack_->module(i)));
        return error;
    }

    /// Handles lines of the control port, and actions that are due.
    void control(Time now) {
        if (!control_.is_open()) return;
        control_.serve([this, now](std::string_view line) {
            return carry_out(
                line, names_, [this] { return status(); },
                [this, now](Actions actions) { return stage_->also(std::move(actions), now); });
        });
        stage_->observe(now);
    }

    std::unique_ptr<Rack> rack_;
    std::optional<ModuleAlone> stage_;
    Names names_;
    ControlPort control_;
    MemoryFiles files_;
};

class V24Service final : public ModuleService<MidiRack> {
  public:
    V24Service(const MidisimOptions& options, std::string& error) {
        rack_ = std::make_unique<MidiRack>(options.units, options.baud);
        error = load(options);
        if (error.empty()) error = v24_.open(options.v24);
    }
    std::string advance(Time to) override {
        rack_->send(v24_.read());
        control(rack_->now());
        rack_->advance(to);
        v24_.write(rack_->received());
        return files_.save_changed();
    }
    std::string endpoints() const override { return v24_.described("v24") + control_.described(); }

  private:
    Endpoint v24_;
};

class CanService final : public ModuleService<MidiCanRack> {
  public:
    CanService(const MidisimOptions& options, std::string& error) : interface_(options.can) {
        auto opened = hal_linux::SocketCan::open({.interface = options.can});
        port_ = std::move(opened.can);
        if (!opened.error.empty() || port_ == nullptr) {
            error = fmt::format("--can {}: {}", options.can, opened.error);
            return;
        }
        rack_ = std::make_unique<MidiCanRack>(options.units, *port_);
        error = load(options);
    }
    std::string advance(Time to) override {
        if (port_->gone()) return fmt::format("{}: the interface is gone", interface_);
        control(to);
        rack_->advance(to);
        return files_.save_changed();
    }
    std::string endpoints() const override { return "can: " + interface_ + "\n" + control_.described(); }

  private:
    std::string interface_;
    std::unique_ptr<hal_linux::SocketCan> port_;
};

}  // namespace

std::unique_ptr<VirtualDevices> open_modules(const MidisimOptions& options, std::string& error) {
    if (options.can.empty()) return std::make_unique<V24Service>(options, error);
    return std::make_unique<CanService>(options, error);
}

}  // namespace nplc::sim
