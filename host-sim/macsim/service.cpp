#include "service.h"

#include <fmt/format.h>

#include <array>

#include "flash_file.h"

namespace nplc::sim {
namespace {

std::string open_server(const std::string& endpoint, std::unique_ptr<hal_linux::ByteServer>& server) {
    if (endpoint.empty()) return {};
    auto opened = hal_linux::ByteServer::open(endpoint);
    server = std::move(opened.server);
    return opened.error;
}

std::vector<std::uint8_t> read_all(hal_linux::ByteServer* server) {
    std::vector<std::uint8_t> bytes;
    if (server == nullptr) return bytes;
    std::array<std::uint8_t, 4096> block{};
    const std::size_t count = server->read(block);
    bytes.assign(block.begin(), block.begin() + static_cast<std::ptrdiff_t>(count));
    return bytes;
}

void write_all(hal_linux::ByteServer* server, const std::vector<std::uint8_t>& bytes) {
    if (server != nullptr && !bytes.empty()) server->write(bytes);
}

std::string about(const MacMotor& motor) {
    return fmt::format("{} @{} mode {} P_IST {} V {:.0f} rpm ERR_STAT {:04X}",
                       registers::name_of(motor.model()), motor.read(is_mac800(motor.model()) ? 202 : 156),
                       motor.mode(), motor.p_ist(), motor.rpm(), motor.err_stat());
}

}  // namespace

Service::Service(const MacsimOptions& options, std::string& error) : rack_(options.rack) {
    error = open_flash(options);
    if (error.empty()) error = open_server(options.fastmac, fastmac_);
    if (error.empty()) error = open_server(options.mactalk, mactalk_);
}

std::string Service::open_flash(const MacsimOptions& options) {
    if (options.flash.empty()) return {};
    for (std::size_t i = 0; i < rack_.size(); ++i) {
        const std::string path =
            i == 0 ? options.flash : fmt::format("{}.{}", options.flash, options.rack.units[i].address);
        flash_.push_back({path});
        if (std::string error = load_flash(path, rack_.motor(i)); !error.empty()) return error;
        if (std::string error = try_flash(path); !error.empty()) return error;
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
    rack_.send_fastmac(read_all(fastmac_.get()));
    rack_.send_mactalk(read_all(mactalk_.get()));
    rack_.advance(to);
    write_all(fastmac_.get(), rack_.received_fastmac());
    write_all(mactalk_.get(), rack_.received_mactalk());
    return keep_flash();
}

std::string Service::endpoints() const {
    std::string text;
    if (fastmac_) text += fmt::format("fastmac: {}\n", fastmac_->name());
    if (mactalk_) text += fmt::format("mactalk: {}\n", mactalk_->name());
    return text;
}

std::string Service::status() const {
    std::string text;
    for (std::size_t i = 0; i < rack_.size(); ++i) text += (i == 0 ? "" : " | ") + about(rack_.motor(i));
    return text;
}

}  // namespace nplc::sim
