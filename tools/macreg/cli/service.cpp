#include "macreg/service.h"

#include <fmt/format.h>

#include "cli/session.h"
#include "host/printable.h"
#include "macreg/change.h"
#include "macreg/values.h"

namespace nplc::macreg::cli {
namespace {

using registers::Model;

struct ServiceArguments {
    bool stop = false;
    bool unsaved = false;
};

std::string names(const std::vector<std::string>& all) {
    return fmt::format("{}", fmt::join(all, ", "));
}

/// What the motor will do after the reset, shown before the user confirms.
std::string what_a_start_does(Session& session) {
    Motor& motor = session.motor();
    const Model model = motor.model();
    const std::int64_t home = motor.read(registers::HOME_MODE) & 0xFF;
    const std::int64_t start = motor.read(registers::STARTMODE);
    if (home >= 12 && home <= 14)
        return fmt::format("the motor then homes ({}) and goes on in {}", mode_text(model, home),
                           mode_text(model, start));
    return fmt::format("the motor then starts in {}", mode_text(model, start));
}

void tell_mode(Session& session, const std::string& what) {
    const std::int64_t mode = session.motor().read(registers::MODE_REG);
    const std::string name = mode_text(session.motor().model(), mode);
    session.tell(fmt::format("{}; the motor is in {}", what, name), {{"mode", mode}, {"mode_name", name}});
}

void with_service(Session& session, const ServiceArguments& options,
                  const std::function<void(Service&)>& what) {
    Service service(session.motor(), goes_on);
    if (options.stop) service.allow_stop();
    try {
        what(service);
    } catch (const command_line::Failure&) {
        throw;
    } catch (const mactalk_client::Ended& error) {
        constexpr const char* kOrders[] = {"not sent", "sent, not known to be done", "done"};
        const Trail& trail = service.trail();
        // Refused before anything was sent: nothing to report
        if (error.exit_code() == command_line::kRefused && trail.ran_in.empty() && !trail.in_safe_mode) throw;
        throw command_line::Failure(error.exit_code(),
                                    fmt::format("{}; {}", error.what(), service.left_behind()),
                                    {{"order", kOrders[static_cast<std::size_t>(trail.order)]},
                                     {"told_to_stop", !trail.ran_in.empty()},
                                     {"stopped", trail.stopped},
                                     {"perhaps_in_safe_mode", trail.in_safe_mode}});
    }
}

void save(Session& session, const ServiceArguments& options) {
    session.ask(fmt::format("The motor's flash is written over with what it has in memory, and it resets: {}",
                            what_a_start_does(session)));
    with_service(session, options, [&](Service& service) {
        const auto changed = service.save();
        if (!changed.empty())
            refuse(fmt::format("after the reset these have another value than was to be saved: {}",
                               names(changed)),
                   {{"changed", changed}});
        tell_mode(session, "saved, reset and checked");
    });
}

void defaults(Session& session, const ServiceArguments& options) {
    session.ask(options.unsaved
                    ? "All parameters in the motor's memory become the factory's; its flash stays as it is"
                    : "All parameters of the motor, those in its flash too, become the factory's, and it "
                      "resets. What was set by its owner is lost (`macreg dump` keeps it)");
    with_service(session, options, [&](Service& service) {
        service.defaults(!options.unsaved);
        tell_mode(session, options.unsaved ? "the factory's parameters are in memory, the flash is as it was"
                                           : "the factory's parameters are in memory and flash");
    });
}

void reload(Session& session, const ServiceArguments& options) {
    session.ask("What was changed in the motor's memory and not saved is lost");
    with_service(session, options, [&](Service& service) {
        service.reload();
        tell_mode(session, "the flash's parameters are in memory");
    });
}

void reset(Session& session, const ServiceArguments& options) {
    session.ask(fmt::format("The motor resets, and what was changed and not saved is lost; {}",
                            what_a_start_does(session)));
    with_service(session, options, [&](Service& service) {
        service.reset();
        tell_mode(session, "reset");
    });
}

/// In memory only; a lost line makes it fail, and the first error is the one reported.
void put_back(Motor& motor, const registers::Register& reg, std::int64_t raw) {
    try {
        static_cast<void>(change(motor, reg, raw));
    } catch (const mactalk_client::LineError&) {
        host::complain(fmt::format(
            "macreg: {} could not be put back: it has another value in memory, not in flash", reg.name));
    }
}

/// FastMAC and FlexMAC need the user interface set to communication, which counts from a reset on (001
/// §3.2.36).
void prepare(Session& session, const ServiceArguments& options) {
    constexpr std::int64_t kCommunication = 3;
    Motor& motor = session.motor();
    if (motor.model() == Model::mac800)
        return session.tell("a MAC800 needs no preparation: its FastMAC line is always on",
                            {{"changed", false}});
    const registers::Register& bits = *motor.find(registers::CNTRL_BITS);
    const std::int64_t before = motor.read(bits);
    if ((before & kCommunication) == kCommunication)
        return session.tell(
            "nothing to do: CNTRL_BITS has USERINTF=COMMUNICATION. If FastMAC does not work, it was set and "
            "not saved: `macreg flash save`",
            {{"changed", false}});
    session.ask(
        fmt::format("USERINTF becomes COMMUNICATION (it is {}): the pins of the pulse input belong to "
                    "FastMAC then. All of the motor's memory is saved in flash, and it resets: {}",
                    names_text(bits, motor.model(), before), what_a_start_does(session)));
    with_service(session, options, [&](Service& service) {
        const ChangeResult outcome = [&] {
            try {
                return change(motor, bits, before | kCommunication);
            } catch (const mactalk_client::LineError& error) {
                throw mactalk_client::LineError(
                    error.kind(),
                    fmt::format("{}; CNTRL_BITS may have been written in memory, the flash is as it was",
                                error.what()));
            }
        }();
        if (!outcome.taken) refuse(fmt::format("CNTRL_BITS was not taken: {}", outcome.why));
        std::vector<std::string> changed;
        try {
            changed = service.save();
        } catch (...) {
            // Restored as found: otherwise a later save would store what is in memory
            if (service.trail().order == Trail::Order::none) put_back(motor, bits, before);
            throw;
        }
        if ((motor.read(bits) & kCommunication) != kCommunication || !changed.empty())
            refuse("after the reset the motor has other values than were saved: " + names(changed));
        tell_mode(session, "ready for FastMAC: set, saved, reset and checked");
    });
}

void enter_safe(Session& session, const ServiceArguments& options) {
    with_service(session, options, [&](Service& service) {
        service.enter_safe();
        tell_mode(session, "done");
    });
}

void exit_safe(Session& session, const ServiceArguments& options) {
    with_service(session, options, [&](Service& service) {
        service.exit_safe();
        tell_mode(session, "done");
    });
}

using What = void(Session&, const ServiceArguments&);

auto add(arguments::App& app, Common& common, const char* name, const char* text, What* what) {
    auto added = add_command(app, common, name, text, what);
    added.command.add_flag("--stop", added.options.stop,
                           "Stop the motor first if it is in a mode that moves it");
    return added;
}

}  // namespace

void add_service(arguments::App& app, Common& common) {
    arguments::App& flash = add_command(app, "flash", "The parameters in the motor's flash; asks first");
    flash.require_subcommand(1);
    add(flash, common, "save",
        "Write what the motor has in memory into its flash; it resets, and is compared afterwards", save);
    auto [command, options] =
        add(flash, common, "defaults", "The factory's parameters, in memory and flash", defaults);
    command.add_flag("--unsaved", options.unsaved, "In memory only");
    add(flash, common, "reload", "The flash's parameters back into memory, without a reset", reload);
    arguments::App& safe = add_command(app, "safe", "SAFE_MODE: passive, and deaf to FastMAC (001 4.4.16)");
    safe.require_subcommand(1);
    add(safe, common, "enter", "From INIT_MODE into SAFE_MODE", enter_safe);
    add(safe, common, "exit", "From SAFE_MODE into INIT_MODE", exit_safe);
    add(app, common, "reset", "Restart the motor; asks first", reset);
    add(app, common, "prepare", "Set what FastMAC needs, save it, reset, and check; asks first", prepare);
}

}  // namespace nplc::macreg::cli
