#include "service.h"

#include <fmt/format.h>

#include "flash_file.h"
#include "sim/value_file.h"

namespace nplc::sim {
namespace {

std::string about(const MacMotor& motor) {
    return fmt::format("{} @{} mode {} P_IST {} V {:.0f} rpm ERR_STAT {:04X}",
                       registers::name_of(motor.model()), motor.read(is_mac800(motor.model()) ? 202 : 156),
                       motor.mode(), motor.p_ist(), motor.rpm(), motor.err_stat());
}

}  // namespace

Service::Service(const MacsimOptions& options, std::string& error) : rack_(options.rack) {
    error = open_flash(options);
    if (error.empty()) error = fastmac_.open(options.fastmac);
    if (error.empty()) error = mactalk_.open(options.mactalk);
}

std::string Service::open_flash(const MacsimOptions& options) {
    if (options.flash.empty()) return {};
    for (std::size_t i = 0; i < rack_.size(); ++i) {
        const std::string path =
            i == 0 ? options.flash : fmt::format("{}.{}", options.flash, options.rack.units[i].address);
        flash_.push_back({path});
        if (std::string error = load_flash(path, rack_.motor(i)); !error.empty()) return error;
        if (std::string error = try_values(path); !error.empty()) return error;
    }
    return {};
}

std::string Service::keep_flash() {
    for (std::size_t i = 0; i < flash_.size(); ++i) {
        if (rack_.motor(i).flash_writes() == flash_[i].written) continue;
        flash_[i].written = rack_.motor(i).flash_writes();
        if (std::string error = save_flash(flash_[i].path, rack_.motor(i)); !error.empty()) return error;
    }
    return {};
}

std::string Service::advance(Time to) {
    rack_.send_fastmac(fastmac_.read());
    rack_.send_mactalk(mactalk_.read());
    rack_.advance(to);
    fastmac_.write(rack_.received_fastmac());
    mactalk_.write(rack_.received_mactalk());
    return keep_flash();
}

std::string Service::endpoints() const {
    return fastmac_.described("fastmac") + mactalk_.described("mactalk");
}

std::string Service::status() const {
    std::string text;
    for (std::size_t i = 0; i < rack_.size(); ++i) text += (i == 0 ? "" : " | ") + about(rack_.motor(i));
    return text;
}

}  // namespace nplc::sim
