#include <fmt/format.h>

#include "host/text_file.h"
#include "macsim.h"
#include "sim/axis.h"
#include "sim/bench_line.h"
#include "sim/device_memory.h"
#include "sim/text.h"

namespace nplc::sim {
namespace {

constexpr int kRegisters = 256;

/// The parameter flash: a line for each memory cell that is not 0, of 16 bits, on MAC800 of 32.
class FlashMemory final : public DeviceMemory {
  public:
    explicit FlashMemory(MacMotor& motor) : motor_(motor), taken_(motor.model()) {}

    std::string heading() const override {
        return fmt::format("# parameter flash of a virtual {}", registers::name_of(motor_.model()));
    }
    std::string form() const override { return "REGISTER = VALUE"; }
    std::vector<NamedValue> values() const override {
        std::vector<NamedValue> values;
        for (int reg = 1; reg < kRegisters; ++reg) {
            const std::uint32_t value = motor_.stored().read(static_cast<std::uint8_t>(reg), wide());
            if (value != 0) values.push_back({std::to_string(reg), value});
        }
        return values;
    }
    std::uint32_t writes() const override { return motor_.flash_writes(); }
    bool take(const NamedValue& line) override {
        const auto reg = parse_integer(line.name);
        if (!reg || *reg < 1 || *reg >= kRegisters) return false;
        if (line.value < 0 || line.value > (wide() ? 0xFFFF'FFFF : 0xFFFF)) return false;
        taken_.write(static_cast<std::uint8_t>(*reg), static_cast<std::uint32_t>(line.value), wide());
        return true;
    }
    void restore() override {
        motor_.set_stored(taken_);
        motor_.power_cycle();
    }

  private:
    bool wide() const { return is_mac800(motor_.model()); }

    MacMotor& motor_;
    MotorMemory taken_;
};

std::string describe(const MacMotor& motor) {
    return fmt::format("{} @{} mode {} P_IST {} V {:.0f} rpm ERR_STAT {:04X}",
                       registers::name_of(motor.model()), motor.read(is_mac800(motor.model()) ? 202 : 156),
                       motor.mode(), motor.p_ist(), motor.rpm(), motor.err_stat());
}

class RackService final : public VirtualDevices {
  public:
    RackService(const MacsimOptions& options, std::string& error) : rack_(options.rack) {
        for (std::size_t i = 0; error.empty() && i < rack_.size(); ++i)
            error = files_.add(options.flash, options.rack.units[i].address,
                               std::make_unique<FlashMemory>(rack_.motor(i)));
        if (error.empty() && !(options.scenario.empty() && options.control.empty())) error = play(options);
        if (error.empty()) error = couple(options);
        if (error.empty()) error = control_.open(options.control);
        if (error.empty()) error = fastmac_.open(options.fastmac);
        if (error.empty()) error = mactalk_.open(options.mactalk);
    }
    std::string advance(Time to) override {
        rack_.send_fastmac(fastmac_.read());
        rack_.send_mactalk(mactalk_.read());
        control_.serve([this](std::string_view line) {
            return carry_out(
                line, names_, [this] { return status(); },
                [this](Actions actions) { return rack_.also(std::move(actions)); });
        });
        try {
            rack_.advance(to);
        } catch (const EndlessRules& endless) {
            return endless.what();
        }
        fastmac_.write(rack_.received_fastmac());
        mactalk_.write(rack_.received_mactalk());
        return files_.save_changed();
    }
    std::string endpoints() const override {
        return fastmac_.described("fastmac") + mactalk_.described("mactalk") + control_.described();
    }
    bool has_console() const override { return control_.is_console(); }
    std::string status() const override {
        std::string text;
        for (std::size_t i = 0; i < rack_.size(); ++i)
            text += (i == 0 ? "" : " | ") + describe(rack_.motor(i));
        return text;
    }

  private:
    std::string play(const MacsimOptions& options) {
        names_.motor = rack_.motor(0).model();
        names_.motor_alone = true;
        names_.free_pins = options.fastmac.empty();
        const std::string error = options.scenario.empty() ? std::string() : read(options.scenario);
        if (error.empty()) rack_.play(scenario_, names_);
        return error;
    }

    std::string couple(const MacsimOptions& options) {
        if (options.plant.empty() && !scenario_.plant) return {};
        const AxisReading axis = read_axis(options.plant, scenario_, rack_.motor(0).model());
        if (axis.error.empty()) rack_.motor(0).plant().load() = axis.load;
        return axis.error;
    }

    std::string read(const std::string& file) {
        constexpr std::size_t kLargest = std::size_t{4} << 20U;
        const host::FileContent content = host::read_text(file, kLargest);
        if (!content.problem.empty())
            return fmt::format("{}: cannot be opened: {}; name a scenario", file, content.problem);
        ParsedScenario parsed = parse_scenario(content.bytes, file, names_);
        if (!parsed.mistakes.empty()) return in_words(file, parsed.mistakes);
        scenario_ = std::move(parsed.scenario);
        return {};
    }

    Names names_;
    Scenario scenario_;
    Rack rack_;
    Endpoint fastmac_;
    Endpoint mactalk_;
    ControlPort control_;
    MemoryFiles files_;
};

}  // namespace

std::unique_ptr<VirtualDevices> open_rack(const MacsimOptions& options, std::string& error) {
    return std::make_unique<RackService>(options, error);
}

}  // namespace nplc::sim
