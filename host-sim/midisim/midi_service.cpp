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

MidiService::MidiService(const MidisimOptions& options, std::string& error)
    : rack_(options.units, options.baud) {
    error = open_files(options);
    if (error.empty()) error = v24_.open(options.v24);
}

std::string MidiService::open_files(const MidisimOptions& options) {
    if (options.eeprom.empty()) return {};
    for (std::size_t i = 0; i < rack_.size(); ++i) {
        const std::string path =
            i == 0 ? options.eeprom : fmt::format("{}.{}", options.eeprom, options.units[i].address);
        if (std::string error = load_eeprom(path, rack_.module(i)); !error.empty()) return error;
        if (std::string error = try_values(path); !error.empty()) return error;
        files_.push_back({path, rack_.module(i).memory_writes()});
    }
    return {};
}

std::string MidiService::keep_files() {
    for (std::size_t i = 0; i < files_.size(); ++i) {
        if (rack_.module(i).memory_writes() == files_[i].written) continue;
        files_[i].written = rack_.module(i).memory_writes();
        if (std::string error = save_eeprom(files_[i].path, rack_.module(i)); !error.empty()) return error;
    }
    return {};
}

std::string MidiService::advance(Time to) {
    rack_.send(v24_.read());
    rack_.advance(to);
    v24_.write(rack_.received());
    return keep_files();
}

std::string MidiService::finish() {
    for (std::size_t i = 0; i < rack_.size(); ++i) rack_.module(i).power_off();
    return keep_files();
}

std::string MidiService::status() const {
    std::string text;
    for (std::size_t i = 0; i < rack_.size(); ++i) text += (i == 0 ? "" : " | ") + describe(rack_.module(i));
    return text;
}

}  // namespace nplc::sim
