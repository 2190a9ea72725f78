#pragma once

#include <fmt/format.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "faces/axis_loop.h"
#include "faces/program_version.h"
#include "hal_linux/wakeup.h"
#include "metrics/server.h"
#include "modbus/rtu_server.h"
#include "modbus/tcp_server.h"
#include "mqtt/client.h"
#include "sim/world.h"

namespace nplc::sim {

/// By SCALE of the program; revolutions without one.
inline faces::Scaling scaling_of(const Names& names) {
    if (!names.machine) return {};
    return {.unit = names.machine->name, .per_revolution = names.machine->per_rev};
}

/// The faces' view of the simulated axis, whose name is "sim". Faces use the wall clock, the gateway virtual
/// time, which follows it.
class SimFaces {
  public:
    explicit SimFaces(const Names& names = {}) : model_("sim", scaling_of(names)) {
        model_.wake_loop_with(bell_);
    }
    SimFaces(const SimFaces&) = delete;
    SimFaces& operator=(const SimFaces&) = delete;

    faces::AxisModel& model() { return model_; }
    faces::Seat& seat() { return loop_.seat(); }
    /// As AxisLoop::tell_writes, during serve().
    void tell_writes(std::function<void(const faces::Command&)> tell) { loop_.tell_writes(std::move(tell)); }
    /// CLOCK_MONOTONIC, as hal_linux::SteadyClock reads it.
    static base::Instant now() {
        return base::Instant(std::chrono::duration_cast<base::Microseconds>(
            std::chrono::steady_clock::now().time_since_epoch()));
    }

    /// To be called before the run. Empty, or an error.
    std::string open_modbus(const std::string& listen) {
        if (!listen.starts_with("pty:") && !listen.starts_with("rtu:")) {
            auto opened = modbus::TcpServer::open({.listen = listen}, {&model_});
            modbus_ = std::move(opened.server);
            return opened.error;
        }
        const std::string port = listen.starts_with("rtu:") ? listen.substr(4) : listen;
        auto opened = modbus::RtuServer::open({.port = port}, {&model_});
        modbus_rtu_ = std::move(opened.server);
        rtu_port_ = port;
        return opened.error;
    }
    std::string open_metrics(const std::string& listen) {
        if (std::string mistake = metrics::Server::mistake_in(listen); !mistake.empty())
            return fmt::format("\"{}\" {}", listen, mistake);
        auto opened =
            metrics::Server::open({.listen = listen, .program = faces::program_version()}, {&model_});
        metrics_ = std::move(opened.server);
        return opened.error;
    }
    /// With all commands enabled, since it moves no real machine.
    std::string open_mqtt(const std::string& broker) {
        using registers::gateway::Command;
        mqtt::Options options;
        options.node = "sim";
        options.commands = {Command::run,  Command::stop, Command::safe,
                            Command::hold, Command::step, Command::scan};
        options.set_points = {"*"};
        options.recipes = true;
        options.tell = [](bool, const std::string& text) { fmt::print(stderr, "mqtt: {}\n", text); };
        if (!broker::read_address(broker, options))
            return fmt::format("\"{}\" is no broker; write HOST:PORT such as 127.0.0.1:1883", broker);
        auto opened = mqtt::Client::open(options, {&model_});
        mqtt_ = std::move(opened.client);
        return opened.error;
    }
    bool is_open() const {
        return mqtt_ != nullptr || modbus_ != nullptr || modbus_rtu_ != nullptr || metrics_ != nullptr;
    }
    void announce() const {
        if (modbus_) fmt::print("modbus: {}\n", modbus_->name());
        if (modbus_rtu_) fmt::print("modbus: {}\n", rtu_port_);
        if (metrics_) fmt::print("metrics: {}\n", metrics_->url());
    }
    /// Readable when a face needs serve().
    int descriptor() const { return wakeup_.descriptor(); }

    /// After every step of the world: counts scans and events.
    void count(World& world) {
        if (world.starts() != starts_) loop_.restarted();
        starts_ = world.starts();
        loop_.count(world.controller());
    }
    /// Between two steps, every millisecond or so.
    void serve(World& world) {
        if (world.starts() != starts_) loop_.restarted();
        starts_ = world.starts();
        wakeup_.drain();
        loop_.poll(world.controller(), world.instant(), now(), &world.any_driver());
    }

  private:
    hal_linux::Wakeup wakeup_;
    faces::Bell bell_{[this] { wakeup_.ring(); }};
    faces::AxisModel model_;
    faces::AxisLoop loop_{model_, {}};
    std::uint64_t starts_ = 0;
    std::unique_ptr<modbus::TcpServer> modbus_;
    std::unique_ptr<modbus::RtuServer> modbus_rtu_;
    std::string rtu_port_;
    std::unique_ptr<mqtt::Client> mqtt_;
    std::unique_ptr<metrics::Server> metrics_;
};

}  // namespace nplc::sim
