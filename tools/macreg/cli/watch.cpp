#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/session.h"
#include "host/terminal.h"
#include "macreg/values.h"

namespace nplc::macreg::cli {
namespace {

using registers::Model;
using registers::Register;

struct WatchArguments {
    std::vector<std::string> names;
    unsigned interval_ms = 200;
    double seconds = 0;
    bool all = false;
};

/// Between two looks whether it is to end.
constexpr base::Microseconds kLook{100'000};

/// What one wants to see of any motor.
const std::vector<std::string> kUsual{"MODE_REG", "P_SOLL", "P_IST",  "V_SOLL",
                                      "V_IST",    "VF_OUT", "FLWERR", "ERR_STAT"};

std::string seconds_text(base::Microseconds time) {
    return fmt::format("{:.3f}", static_cast<double>(time.count()) / 1e6);
}

/// A table that is drawn over, or a line or document at every change.
class Table {
  public:
    Table(Session& session, const WatchArguments& options, std::vector<const Register*> registers)
        : session_(session),
          options_(options),
          registers_(std::move(registers)),
          model_(session.motor().model()),
          drawn_over_(host::is_terminal(stdout) && !session.json()),
          begun_(session.now()) {}

    void show(const Snapshot& snapshot) {
        if (drawn_over_) return draw(snapshot);
        if (!options_.all && last_ && last_->values() == snapshot.values()) return;
        session_.json() ? document(snapshot) : line(snapshot);
        last_ = snapshot;
    }

  private:
    void draw(const Snapshot& snapshot) {
        std::string text = last_ ? fmt::format("\033[{}A", registers_.size() + 1) : "";
        text += fmt::format("\033[K{} s, Ctrl-C ends\n", seconds_text(snapshot.time() - begun_));
        for (const Register* reg : registers_) {
            const std::int64_t raw = snapshot.at(reg->number);
            const bool changed = last_ && last_->at(reg->number) != raw;
            text += fmt::format("\033[K{}{:<14} {:<28} {:>12}\033[0m\n", changed ? "\033[1m" : "", reg->name,
                                value_text(*reg, model_, raw), raw);
        }
        fmt::print("{}", text);
        std::fflush(stdout);
        last_ = snapshot;
    }

    void line(const Snapshot& snapshot) {
        std::string text = fmt::format("{:>9}", seconds_text(snapshot.time() - begun_));
        for (const Register* reg : registers_)
            text += fmt::format("  {} {}", reg->name, value_text(*reg, model_, snapshot.at(reg->number)));
        session_.tell(text, {});
    }

    void document(const Snapshot& snapshot) {
        Json values = Json::object();
        for (const Register* reg : registers_) values[std::string(reg->name)] = snapshot.at(reg->number);
        session_.tell("", {{"seconds", static_cast<double>((snapshot.time() - begun_).count()) / 1e6},
                           {"raw", values}});
    }

    Session& session_;
    const WatchArguments& options_;
    std::vector<const Register*> registers_;
    Model model_;
    bool drawn_over_;
    base::Instant begun_;
    std::optional<Snapshot> last_;
};

void watch(Session& session, const WatchArguments& options) {
    const auto registers =
        find_registers(session.motor().model(), options.names.empty() ? kUsual : options.names);
    Table table(session, options, registers);
    const base::Instant begun = session.now();
    const base::Microseconds limit{static_cast<std::int64_t>(options.seconds * 1e6)};
    const auto ends = [&] {
        return !goes_on() || !output_has_reader() || (options.seconds > 0 && session.now() - begun >= limit);
    };
    while (!ends()) {
        table.show(session.motor().read_block(registers));
        const base::Instant next = session.now() + base::Milliseconds{options.interval_ms};
        while (session.now() < next && !ends())
            session.pause(std::min<base::Microseconds>(kLook, next - session.now()));
    }
}

}  // namespace

void add_watch(arguments::App& app, Common& common) {
    const auto options = std::make_shared<WatchArguments>();
    arguments::App& command = add_command(
        app, "watch",
        "Registers as they change: a table on a terminal, else a line (or with --json a document) "
        "at every change. Ctrl-C ends it");
    command.add_option("registers", options->names,
                       "Names or numbers; else mode, positions, velocities, torque, errors");
    command.add_option("--interval", options->interval_ms, "Milliseconds between two looks")
        ->capture_default_str()
        ->in_range(0, 60'000);
    command.add_option("--for", options->seconds, "End after so many seconds; 0: at Ctrl-C")->non_negative();
    command.add_flag("--all", options->all, "A line at every look, changed or not");
    command.callback([options, &common] { work(common, [&](Session& s) { watch(s, *options); }); });
}

}  // namespace nplc::macreg::cli
