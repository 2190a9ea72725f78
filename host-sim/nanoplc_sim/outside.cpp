#include "outside.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>

#include "hal_linux/connections.h"
#include "hal_linux/file_storage.h"
#include "hal_linux/key_reader.h"
#include "hal_linux/steady_clock.h"
#include "host/terminal.h"
#include "input_file.h"
#include "listener/exchange.h"
#include "panel_door.h"
#include "session.h"
#include "sim_faces.h"

namespace nplc::sim {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kStatusPeriod = std::chrono::milliseconds{100};
constexpr std::chrono::milliseconds kKeyWait{5};
/// A client program waits for each answer.
constexpr std::chrono::milliseconds kPortWait{1};

/// The gateway's port for outside programs; inactive without --mactalk.
class Door {
  public:
    Door(const RunOptions& options, faces::Seat& operators) {
        if (!options.mactalk) return;
        auto opened = hal_linux::Connections::open(*options.mactalk, {});
        if (!opened.connections) throw InputError("--mactalk " + opened.error);
        connections_ = std::move(opened.connections);
        listener_.emplace(boards::Listener::Options{.name = connections_->name(), .operators = &operators});
        exchange_.emplace(*connections_, *listener_, &clock_);
    }
    bool is_open() const { return exchange_.has_value(); }
    void announce() const {
        if (is_open()) fmt::print("mactalk: {}\n", connections_->name());
    }
    /// By the wall clock: virtual time stops while this process is halted.
    void take_in(Session& session) {
        if (!is_open()) return;
        World& world = session.world();
        if (std::exchange(starts_, world.starts()) != world.starts()) listener_->restarted();
        listener_->set_addresses({world.gateway_address(), world.motor_address()});
        exchange_->bring(world.controller(), clock_.now(), world.instant());
    }
    void hand_out(Session& session) {
        if (is_open())
            exchange_->take_back(session.world().controller(), clock_.now(), session.world().instant());
    }

  private:
    hal_linux::SteadyClock clock_;
    std::unique_ptr<hal_linux::Connections> connections_;
    std::optional<boards::Listener> listener_;
    std::optional<boards::Exchange> exchange_;
    std::uint64_t starts_ = 0;
};

void handle_key(Session& session, char key) {
    if (key == 'q' || key == 'Q') session.stop();
    if (key >= '0' && key < '0' + static_cast<char>(kInputs)) session.press(static_cast<unsigned>(key - '0'));
}

void show_status(const Session& session) {
    const std::string line = session.status_line();
    fmt::print("\r\033[K{}", std::string_view(line).substr(0, host::terminal_columns() - 1));
    std::fflush(stdout);
}

/// Null unless requested.
std::unique_ptr<hal_linux::FileStorage> open_flash(const RunOptions& options) {
    if (!options.flash) return nullptr;
    auto opened = hal_linux::FileStorage::open(*options.flash, World::kFlash);
    if (!opened.storage) throw InputError("--flash " + opened.error);
    return std::move(opened.storage);
}

void open_faces(SimFaces& faces, const RunOptions& options) {
    if (options.modbus) {
        if (const std::string error = faces.open_modbus(*options.modbus); !error.empty())
            throw InputError("--modbus " + error);
    }
    if (options.metrics) {
        if (const std::string error = faces.open_metrics(*options.metrics); !error.empty())
            throw InputError("--metrics " + error);
    }
    if (options.mqtt) {
        if (const std::string error = faces.open_mqtt(*options.mqtt); !error.empty())
            throw InputError("--mqtt " + error);
    }
}

class Everything final : public Outside {
  public:
    Everything(const RunOptions& options, const Program& program)
        : flash_(open_flash(options)), faces_(program.names) {
        open_faces(faces_, options);
        door_.emplace(options, faces_.seat());
        panel_.emplace(options.panel, program, faces_.model());
        if (panel_->is_open())
            faces_.tell_writes([this](const faces::Command& one) { panel_->ordered(one); });
    }
    ports::Storage* flash() override { return flash_.get(); }
    void run(Session& session, const volatile std::sig_atomic_t& interrupted) override;

  private:
    std::unique_ptr<hal_linux::FileStorage> flash_;
    SimFaces faces_;
    std::optional<Door> door_;
    std::optional<PanelDoor> panel_;
};

/// The status line is rewritten in place below the timeline.
void Everything::run(Session& session, const volatile std::sig_atomic_t& interrupted) {
    hal_linux::KeyReader keys;
    const bool live = host::is_terminal(stdout);
    if (live && keys.has_keys()) fmt::print("{}\n", session.keys());
    if (live) session.clear_line_before_each("\r\033[K");
    door_->announce();
    session.after_each_step([this, &session] {
        faces_.count(session.world());
        panel_->look(session);
    });
    panel_->open();
    faces_.announce();
    if (door_->is_open() || panel_->is_open() || faces_.is_open()) fmt::print("ready\n");
    std::fflush(stdout);
    Pace pace(Clock::now());
    auto next_status = Clock::now();
    while (!session.ended() && interrupted == 0) {
        door_->take_in(session);
        panel_->serve(session);
        session.advance(pace.virtual_time(Clock::now(), panel_->speed()));
        door_->hand_out(session);
        faces_.serve(session.world());
        if (Clock::now() >= next_status) {
            next_status = Clock::now() + kStatusPeriod;
            if (live) show_status(session);
            std::fflush(stdout);
        }
        const bool has_clients = door_->is_open() || panel_->is_open() || faces_.is_open();
        if (const auto key = keys.key(has_clients ? kPortWait : kKeyWait, faces_.descriptor()))
            handle_key(session, *key);
    }
    if (live) fmt::print("\r\033[K");
}

}  // namespace

std::unique_ptr<Outside> open_outside(const RunOptions& options, const Program& program) {
    return std::make_unique<Everything>(options, program);
}

}  // namespace nplc::sim
