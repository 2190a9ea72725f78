#include "stored.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

#include "gateway/controller.h"
#include "motor/any_driver.h"
#include "no_ports.h"
#include "panel/names.h"
#include "panel_part.h"
#include "table_file.h"

namespace nplc::boards {
namespace {

namespace fs = std::filesystem;
using gateway::Result;
using store::Setting;

/// A read-only copy of a store; blank if there is no store yet.
class StoreCopy final : public ports::Storage {
  public:
    /// Empty, or a one-line error.
    std::string read_file(const std::string& path) {
        std::error_code error;
        const bool is_there = fs::exists(path, error);
        if (!is_there && !error) return {};
        std::ifstream file(path, std::ios::binary);
        file.read(reinterpret_cast<char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
        if (!file.is_open())
            return fmt::format("{}: what is stored cannot be read: {}; look as root or as the service's user",
                               path, error ? error.message() : std::strerror(errno));
        if (file.gcount() == static_cast<std::streamsize>(bytes_.size()) && file.peek() == EOF) return {};
        return fmt::format("{}: this is not a store of {} bytes; remove it, or name another state_directory",
                           path, bytes_.size());
    }

    ports::StorageGeometry geometry() const override { return kMemory; }
    base::Status read(std::uint32_t address, std::span<std::uint8_t> out) override {
        if (address > bytes_.size() || out.size() > bytes_.size() - address) return base::Error::bad_geometry;
        std::copy_n(bytes_.data() + address, out.size(), out.begin());
        return {};
    }
    base::Status program(std::uint32_t, std::span<const std::uint8_t>) override {
        return base::Error::storage_failed;
    }
    base::Status erase(std::uint32_t) override { return base::Error::storage_failed; }
    ports::StorageState state() override { return ports::StorageState::ready; }

  private:
    std::vector<std::uint8_t> bytes_ = std::vector<std::uint8_t>(kMemory.size, 0xFF);
};

/// Simulates the start of an axis with nothing but its store.
class Rehearsal {
  public:
    Rehearsal(const AxisConfig& config, StoreCopy& store) : config_(config), settings_(store, kSettingsArea) {
        settings_.start(config.settings);
        impose_motor(settings_, config);
        motor::Motor& motor =
            driver_.start({.serial = &line_}, gateway::driver_settings_of(settings_.values()));
        controller_.emplace(gateway::Controller::Ports{.inputs = inputs_,
                                                       .outputs = outputs_,
                                                       .watchdog = watchdog_,
                                                       .motor = motor,
                                                       .storage = store,
                                                       .set_points = &kSetPointArea},
                            kTableArea, memory_, settings_, gateway::StartCause::service);
    }

    /// Of the table that would run; 0: none.
    std::uint32_t crc() const { return controller_->tables().active_crc(); }

    void look(StoredFindings& found) {
        const std::string axis = fmt::format("axis[{}]", config_.name);
        for (const StoredSetting& other : stored_settings(settings_, config_))
            found.notes.push_back(
                fmt::format("{}: setting {} is {}, as stored over the user's port; the {} of this file is "
                            "not used",
                            axis, other.name, other.stored, other.configured));
        if (settings_.were_damaged())
            found.troubles.push_back({config_.line, axis,
                                      "the stored settings are damaged; set them anew with `nanoctl settings "
                                      "set ... --keep`"});
        const LoadedTable table = load_first_table(controller_->tables(), settings_, config_, {});
        if (controller_->tables().fell_back())
            found.troubles.push_back(
                {config_.line, axis, "a stored table is damaged; upload it again with `nanoctl upload`"});
        if (table.fault.empty()) return;
        found.troubles.push_back(table.is_configured
                                     ? Mistake{config_.table.line, config_.table.key, table.fault}
                                     : Mistake{config_.line, axis, table.fault});
    }

  private:
    const AxisConfig& config_;
    NoLine line_;
    NoInputs inputs_;
    NoOutputs outputs_;
    NoWatchdog watchdog_;
    std::array<std::uint8_t, gateway::kTableMemory> memory_{};
    gateway::SettingsManager settings_;
    motor::AnyDriver driver_;
    std::optional<gateway::Controller> controller_;
};

/// A program whose SCALE the panel shows, while the faces for a plant show another; empty: they agree.
std::string scale_note(const Config& config, std::size_t index, std::uint32_t crc) {
    const AxisConfig& axis = config.axes[index];
    const bool has_plant = config.modbus.listen.is_there() || config.modbus.rtu_port.is_there() ||
                           config.metrics.listen.is_there() || config.mqtt.broker.is_there();
    if (!has_plant && panel::is_same(axis.scaling, {})) return {};
    const std::string names = StoredNames(config).find(index, crc).text;
    if (names.empty() || panel::is_same(panel::scale_in(names), axis.scaling)) return {};
    return fmt::format(
        "axis[{}].scale: is {}, the SCALE of its program {}: Modbus, MQTT and metrics show "
        "positions in the first, the panel in the second",
        axis.name, panel::in_words(axis.scaling), panel::in_words(panel::scale_in(names)));
}

std::string fault_of(const std::string& which, unsigned term, Result why,
                     const gateway::SettingsManager& settings) {
    const bool may_be_setting =
        why == Result::not_for_motor && settings.values().is_on(Setting::motor_is_mac800);
    return fmt::format("{}: term {}: {}; upload another with `nanoctl upload`{}", which, term,
                       registers::gateway::describe(why),
                       may_be_setting ? ", or set motor_is_mac800 back if the motor is none" : "");
}

}  // namespace

std::string store_file(const std::string& folder) {
    return folder + "/store.bin";
}

void impose_motor(gateway::SettingsManager& settings, const AxisConfig& config) {
    for (const Setting setting : kOfTheMotor) settings.impose(setting, config.settings.get(setting));
}

std::vector<StoredSetting> stored_settings(const gateway::SettingsManager& settings,
                                           const AxisConfig& config) {
    std::vector<StoredSetting> differing;
    for (const registers::gateway::SettingInfo& info : registers::gateway::all_settings()) {
        const std::uint32_t stored = settings.get(info.id);
        const std::uint32_t configured = config.settings.get(info.id);
        if (stored != configured) differing.push_back({info.name, stored, configured});
    }
    return differing;
}

LoadedTable load_first_table(gateway::TableManager& tables, const gateway::SettingsManager& settings,
                             const AxisConfig& config, base::Instant now) {
    const bool has_stored = !tables.is_readable() || tables.stored().length != 0 || tables.fell_back();
    if (has_stored || !config.table.is_there()) {
        const std::uint32_t word = tables.start(now).word();
        const auto result = static_cast<Result>(word & 0xFF);
        if (!has_stored) return {.where_from = "has no table; upload one with `nanoctl upload`"};
        if (result == Result::done) return {.where_from = "has a stored table"};
        return {.fault = fault_of("the stored table", word >> 16, result, settings)};
    }
    const TableFile file = read_table(config.table.text, config.symbols.text);
    if (!file.error.empty()) {
        tables.start(now);
        return {.fault = file.error, .is_configured = true};
    }
    const auto used = tables.use(file.bytes, now);
    if (!used.ok)
        return {.fault = fault_of(config.table.text, used.fault.term, gateway::result_of(used.fault.error),
                                  settings),
                .is_configured = true};
    return {.where_from = fmt::format("runs {} while no table is stored", config.table.text)};
}

StoredFindings look_at_stored(const Config& config) {
    StoredFindings found;
    for (std::size_t i = 0; i < config.axes.size(); ++i) {
        const AxisConfig& axis = config.axes[i];
        StoreCopy store;
        if (const auto error = store.read_file(store_file(config.state_directory + "/" + axis.name));
            !error.empty()) {
            found.troubles.push_back({axis.line, fmt::format("axis[{}]", axis.name), error});
            continue;
        }
        Rehearsal rehearsal(axis, store);
        rehearsal.look(found);
        if (std::string note = scale_note(config, i, rehearsal.crc()); !note.empty())
            found.notes.push_back(std::move(note));
    }
    return found;
}

}  // namespace nplc::boards
