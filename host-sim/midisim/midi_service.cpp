#include "midi_service.h"

#include <fmt/format.h>

#include "eeprom_file.h"
#include "sim/value_file.h"

namespace nplc::sim {

std::string describe(const MidiModule& module) {
    const MidiModule::Leds leds = module.leds();
    std::string text = fmt::format("{} @{} P {}", registers::midi::facts_of(module.model()).name,
                                   module.memory().address, module.position());
    for (const auto& [on, word] : {std::pair{module.deaf(), "deaf"}, std::pair{module.moving(), "moves"},
                                   std::pair{leds.supply_good, "VMOT-OK"}, std::pair{leds.fault, "FAULT"},
                                   std::pair{leds.catching_up, "BUSY"}, std::pair{leds.top_zero, "TOP-ZERO"},
                                   std::pair{leds.ballast, "BALLAST"}}) {
        if (on) text += fmt::format(" {}", word);
    }
    return text + fmt::format(" status {:08X}", module.status());
}

namespace {

template <class Rack>
std::string describe_all(const Rack& rack) {
    std::string text;
    for (std::size_t i = 0; i < rack.size(); ++i) text += (i == 0 ? "" : " | ") + describe(rack.module(i));
    return text;
}

template <class Rack>
void switch_off(Rack& rack) {
    for (std::size_t i = 0; i < rack.size(); ++i) rack.module(i).power_off();
}

}  // namespace

std::string EepromFiles::open(const MidisimOptions& options, const ModuleAt& module_at) {
    if (options.eeprom.empty()) return {};
    for (std::size_t i = 0; i < options.units.size(); ++i) {
        const std::string path =
            i == 0 ? options.eeprom : fmt::format("{}.{}", options.eeprom, options.units[i].address);
        MidiModule& module = module_at(i);
        if (std::string error = load_eeprom(path, module); !error.empty()) return error;
        if (std::string error = try_values(path); !error.empty()) return error;
        files_.push_back({path, &module, module.memory_writes()});
    }
    return {};
}

std::string EepromFiles::keep() {
    for (File& file : files_) {
        if (file.module->memory_writes() == file.written) continue;
        file.written = file.module->memory_writes();
        if (std::string error = save_eeprom(file.path, *file.module); !error.empty()) return error;
    }
    return {};
}

MidiService::MidiService(const MidisimOptions& options, std::string& error)
    : rack_(options.units, options.baud) {
    error = files_.open(options, [this](std::size_t i) -> MidiModule& { return rack_.module(i); });
    if (error.empty()) error = v24_.open(options.v24);
}

std::string MidiService::advance(Time to) {
    rack_.send(v24_.read());
    rack_.advance(to);
    v24_.write(rack_.received());
    return files_.keep();
}

std::string MidiService::finish() {
    switch_off(rack_);
    return files_.keep();
}

std::string MidiService::status() const {
    return describe_all(rack_);
}

MidiCanService::MidiCanService(const MidisimOptions& options, std::string& error) : interface_(options.can) {
    auto opened = hal_linux::SocketCan::open({.interface = options.can});
    port_ = std::move(opened.can);
    if (!opened.error.empty() || port_ == nullptr) {
        error = fmt::format("--can {}: {}", options.can, opened.error);
        return;
    }
    rack_ = std::make_unique<MidiCanRack>(options.units, *port_);
    error = files_.open(options, [this](std::size_t i) -> MidiModule& { return rack_->module(i); });
}

std::string MidiCanService::advance(Time to) {
    if (port_->gone()) return fmt::format("{}: the interface is gone", interface_);
    rack_->advance(to);
    return files_.keep();
}

std::string MidiCanService::finish() {
    switch_off(*rack_);
    return files_.keep();
}

std::string MidiCanService::status() const {
    return describe_all(*rack_);
}

}  // namespace nplc::sim
