#include "session.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include "host/printable.h"
#include "input_file.h"
#include "junit.h"
#include "sim/axis.h"

namespace nplc::sim {
namespace {

constexpr Time kDefaultLength = std::chrono::seconds{10};
WorldOptions world_options(const RunOptions& options, const Names& names, const Scenario& scenario,
                           ports::Storage* storage) {
    WorldOptions world;
    world.registers = scenario.registers;
    world.motor = names.motor;
    world.storage = storage;
    world.baud = options.jvl_baud();
    if (options.drive != nullptr) {
        world.drive = {.model = options.drive,
                       .can = options.can.value_or(false),
                       .rate = options.baud.value_or(0),
                       .seed = options.seed};
    }
    AxisReading axis = read_axis(options.plant.value_or(""), scenario, names.motor);
    if (!axis.error.empty()) throw InputError(axis.error);
    world.load = axis.load;
    world.seed = options.seed;
    world.faults = options.faults;
    world.safe_communication = !options.rapid;
    world.old_register_codes = options.old_register_codes;
    world.gateway.debounce = std::chrono::duration_cast<base::Microseconds>(options.debounce);
    world.is_new = options.is_new;
    world.user_submits = options.mactalk.has_value();
    if (options.keep_motor) world.gateway.on_start = gateway::OnStart::keep;
    return world;
}

/// Identifies the table of a trace; not by a file name, which could contain anything.
std::string identity(const Program& program) {
    return fmt::format("{}table CRC-32 {:08X}",
                       program.name.empty() ? "" : fmt::format("program {}, ", program.name), program.crc32);
}

constexpr std::string_view kLeftByTrace = "  \"trace\": {\"counts_per_rev\":";

/// Removes symbols left by an earlier run only.
void remove_left(const std::string& path) {
    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    file.close();
    std::error_code ignored;
    if (text.find(kLeftByTrace) != std::string::npos) std::filesystem::remove(path, ignored);
}

/// Parses --inputs: the terminal, and its level when the name is on.
std::pair<unsigned, bool> input_named(std::string_view name, const Program& program) {
    std::string known;
    for (unsigned i = 0; i < kInputs; ++i) {
        const std::string own = program.names.input(i);
        if (same_name(own, name)) return {i, !program.names.is_inverted(i)};
        if (same_name(fmt::format("IN{}", i), name)) return {i, true};
        known += (known.empty() ? "" : ", ") + own;
    }
    throw InputError(
        fmt::format("--inputs: {} has no input '{}'; its inputs are {}", program.file, name, known));
}

std::string in_words(std::string_view direction, const LineCounters& c) {
    return fmt::format(
        "{}: {} characters, {} lost, {} damaged, {} with framing error, {} delayed, {} while cut", direction,
        c.sent, c.dropped, c.damaged, c.framing, c.delayed, c.cut);
}

std::string list(const OrderList& orders, const Names& names) {
    std::vector<std::string> words;
    for (const SentOrder& order : orders.first) words.push_back(in_words(order, names.motor));
    const std::size_t others = orders.count - orders.first.size();
    const std::string more = others != 0 ? fmt::format(" and {} more", others) : "";
    return words.empty() ? "nothing" : fmt::format("{}{}", fmt::join(words, ", "), more);
}

}  // namespace

Session::Session(const RunOptions& options, const Program& program, const Scenario& scenario,
                 const Palette& palette, std::size_t columns, ports::Storage* storage)
    : program_(program),
      options_(options),
      scenario_(scenario),
      palette_(palette),
      columns_(columns),
      timeline_(program.names, palette, columns),
      world_(program.content(), world_options(options, program.names, scenario, storage)),
      runner_(scenario, program.names, world_),
      auditor_(options.old_register_codes ? protocol::fastmac::RegisterCode::older_example
                                          : protocol::fastmac::RegisterCode::format_list),
      length_(options.length) {
    if (const auto& loaded = world_.load_result(); !loaded.ok) {
        if (const auto why = world_.why_not(); !why.empty())
            throw InputError(fmt::format("{}: term {}: {}", program.file, loaded.fault.term, why));
        throw InputError(fmt::format("{}: term {}: {}; write the program for {}", program.file,
                                     loaded.fault.term, sequencer::describe(loaded.fault.error),
                                     registers::name_of(program.names.motor)));
    }
    for (const std::string& name : options.inputs) {
        const auto [input, level] = input_named(name, program);
        world_.set_input(input, level);
    }
    if (options.csv) csv_.emplace(*options.csv);
    if (options.vcd) vcd_.emplace(*options.vcd, program.names, identity(program));
    if (options.junit) junit_.emplace(*options.junit);
    if (!length_ && !options.realtime && !scenario.can_end()) length_ = kDefaultLength;
    world_.on_log([this](const std::string& text) {
        timeline_.remark('"' + host::printable(text) + '"');
        remember(text);
    });
    runner_.on_failure([this](const ExpectationResult& outcome, Time) {
        timeline_.alarm(fmt::format("FAILED {}:{}: {}", scenario_.file, outcome.line, outcome.expectation));
    });
}

std::string Session::doubts() const {
    if (world_.drive() != nullptr) return {};
    struct Pair {
        store::Setting setting;
        std::uint32_t motor;
    };
    const Pair pairs[] = {
        {store::Setting::motor_baud, options_.jvl_baud()},
        {store::Setting::motor_is_mac800, program_.names.motor == registers::Model::mac800 ? 1U : 0U},
        {store::Setting::old_register_codes, options_.old_register_codes ? 1U : 0U},
    };
    std::string text;
    for (const Pair& pair : pairs) {
        const std::uint32_t stored = world_.setting(pair.setting);
        if (stored == pair.motor) continue;
        const std::string_view name =
            registers::gateway::find_setting(static_cast<std::uint8_t>(pair.setting))->name;
        text += fmt::format(
            "the gateway's stored setting {} is {} and the motor's is {}: they cannot communicate; "
            "nanoctl settings set {}={} --keep, then nanoctl reset\n",
            name, stored, pair.motor, name, pair.motor);
    }
    return text;
}

std::string Session::motor_in_words() const {
    if (world_.drive() != nullptr) return world_.drive()->in_words();
    return fmt::format("{}, {} baud, {} communication", registers::name_of(program_.names.motor),
                       world_.setting(store::Setting::motor_baud),
                       world_.setting(store::Setting::safe_communication) == 0 ? "rapid" : "safe");
}

void Session::say(const std::string& text, std::size_t indent) const {
    constexpr std::size_t kFurther = 4;
    constexpr std::size_t kLeast = 20;
    if (columns_ == 0) {
        fmt::print("{:{}}{}\n", "", indent, text);
        return;
    }
    const std::size_t margin = indent + kFurther;
    std::size_t before = indent;
    for (const std::string& line : wrapped(text, std::max(columns_, margin + kLeast) - margin)) {
        fmt::print("{:{}}{}\n", "", before, line);
        before = margin;
    }
}

void Session::heading() const {
    const std::string seed =
        options_.faults == LineFaults{} ? "" : fmt::format(", faults with seed {}", options_.seed);
    const std::string names =
        program_.symbols.empty() ? "" : fmt::format(", names from {}", program_.symbols);
    say(fmt::format("{}: {} terms, {}{}{}", host::printable(program_.file), world_.gateway().table().size(),
                    motor_in_words(), seed, names));
    fmt::print("\n");
    if (!options_.quiet) timeline_.heading();
}

void Session::advance(Time limit) {
    if (length_) limit = std::min(limit, *length_);
    if (now() == Time{0}) show();
    while (!ended_ && now() < limit) {
        Time stop = limit;
        if (const auto due = runner_.next_due()) stop = std::min(stop, *due);
        if (csv_) stop = std::min(stop, csv_->next_due());
        world_.step(stop);
        if (after_step_) after_step_();
        show();
    }
    if (length_ && now() >= *length_) ended_ = true;
}

void Session::show() {
    bool acted = false;
    do {
        last_ = world_.take_snapshot();
        follow_orders();
        watch_.look();
        acted = runner_.observe(last_);
        if (!options_.quiet) timeline_.observe(last_);
        if (csv_) csv_->observe(last_);
        if (vcd_) vcd_->observe(last_);
    } while (acted);
    if (runner_.ended()) ended_ = true;
}

/// The orders of a drive of another family are not compared with the sequence's.
void Session::follow_orders() {
    if (world_.drive() != nullptr) return;
    for (const SentOrder& order : last_.orders) auditor_.ordered(order);
    if (!world_.mac().orders().empty()) {
        for (const Order& order : world_.take_executed()) auditor_.executed(order);
    }
    auditor_.settle(world_.on_their_way());
}

void Session::press(unsigned input) {
    world_.toggle_input(input);
    show();
}

std::string Session::keys() const {
    std::string text = "keys:";
    for (unsigned i = 0; i < kInputs; ++i) text += fmt::format(" {} {},", i, program_.names.input(i));
    text.back() = ';';
    return text + " q ends";
}

std::string Session::status_line() const {
    const registers::Scale scale = registers::scale_of(program_.names.motor);
    std::string inputs;
    for (unsigned i = 0; i < kInputs; ++i) inputs += (last_.inputs >> i & 1) != 0 ? '1' : '0';
    return fmt::format("q ends, 0-5 toggle: {} | {:.1f} s  {}{}  P_IST {} ({:.2f} rev)", inputs,
                       static_cast<double>(now().count()) / 1e9, program_.names.step(last_.step),
                       last_.error ? "  ERROR" : "", last_.p_ist,
                       static_cast<double>(last_.p_ist) / scale.counts_per_rev);
}

bool Session::finish() {
    runner_.finish(last_);
    watch_.look();
    if (!options_.quiet) timeline_.observe(last_);
    if (csv_) {
        csv_->finish(last_);
        leave_symbols();
    }
    if (vcd_) vcd_->finish(now());
    if (junit_) {
        junit_->write(junit_of(runner_.outcomes(), scenario_.file, program_.file, now()));
        junit_->commit();
    }
    summary();
    return runner_.failures() == 0;
}

/// Writes the data for a plot of the trace: the program's names and the unit of a count. For a table without
/// names those of an earlier trace are removed.
void Session::leave_symbols() const {
    const std::string path = symbols_beside_trace(options_);
    if (path.empty()) return;
    const std::size_t end = program_.symbols_text.rfind('}');
    if (end == std::string::npos) {
        remove_left(path);
        return;
    }
    std::string text = program_.symbols_text.substr(0, end);
    while (text.ends_with('\n')) text.pop_back();
    const registers::Scale scale = registers::scale_of(program_.names.motor);
    OutputFile file(path);
    file.write(fmt::format("{},\n{}{},\"samples_per_second\":{}}}\n}}\n", text, kLeftByTrace,
                           scale.counts_per_rev, scale.samples_per_second));
    file.commit();
}

void Session::summary() {
    const registers::Scale scale = registers::scale_of(program_.names.motor);
    const auto& driver = world_.driver();
    std::string outputs;
    for (unsigned i = 0; i < kOutputs; ++i) {
        if ((last_.outputs >> i & 1) != 0) outputs += (outputs.empty() ? "" : " ") + program_.names.output(i);
    }
    fmt::print("\n");
    const double revs = static_cast<double>(last_.p_ist) / scale.counts_per_rev;
    const auto& machine = program_.names.machine;
    const std::string in_unit =
        machine ? fmt::format(", {:.3f} {}", revs * machine->per_rev, machine->name) : "";
    say(fmt::format("ended at {} ms in step {}, P_IST {} counts ({:.3f} rev{}), outputs {}{}",
                    in_milliseconds(now()), program_.names.step(last_.step), last_.p_ist, revs, in_unit,
                    outputs.empty() ? "all off" : outputs, last_.error ? ", ERROR" : ""));
    say(fmt::format(
        "{} scans; orders: {} executed, {} discarded; {} messages sent again, {} link losses, {} watchdog "
        "resets",
        world_.gateway().scans(), driver.counters().orders, driver.counters().discarded,
        driver.counters().resent, driver.counters().link_losses, world_.board().bites()));
    if (watch_.waits_for_motor())
        say("the sequence has not begun: the gateway waits for the motor, which does not answer");
    lines_in_words();
    if (csv_) say(fmt::format("trace: {}", *options_.csv));
    if (vcd_) say(fmt::format("trace: {}", *options_.vcd));
    if (junit_) say(fmt::format("JUnit: {}", *options_.junit));
    judgements();
    last_remarks();
}

void Session::lines_in_words() {
    const VirtualSerialLine* found = world_.drive() != nullptr ? world_.drive()->line() : &world_.line();
    if (found == nullptr) return;
    const VirtualSerialLine& line = *found;
    say(in_words("line to the motor", line.to_motor().counters()));
    say(in_words("line from the motor", line.from_motor().counters()));
    if (world_.drive() == nullptr) compare_orders();
}

void Session::compare_orders() {
    const OrderAudit found = auditor_.finish(world_.on_their_way());
    if (!found.under_way.empty()) {
        say(fmt::format("still on their way: {}", list(found.under_way, program_.names)));
    }
    if (found.missing.empty() && found.unordered.empty()) {
        say(fmt::format("{}the motor executed what was ordered, and nothing else",
                        found.under_way.empty() ? "" : "apart from that "));
        return;
    }
    say(fmt::format("ordered and not executed: {}", list(found.missing, program_.names)));
    say(fmt::format("executed and not ordered: {}", list(found.unordered, program_.names)));
}

void Session::judgements() const {
    if (runner_.outcomes().empty()) return;
    const std::size_t failed = runner_.failures();
    fmt::print("expectations: {} passed, {}{} failed{}\n", runner_.outcomes().size() - failed,
               failed != 0 ? palette_.bad : "", failed, palette_.plain);
    for (const ExpectationResult& outcome : runner_.outcomes()) {
        if (outcome.passed) continue;
        say(fmt::format("{}:{}: expected: {}; seen: {}", scenario_.file, outcome.line,
                        host::printable(outcome.expectation), outcome.seen),
            2);
    }
}

void Session::remember(const std::string& remark) {
    if (remarked_ != now()) remarks_.clear();
    remarked_ = now();
    remarks_.push_back(host::printable(remark));
}

/// A scenario's remarks at its end must not be mistaken for success.
void Session::last_remarks() const {
    if (remarked_ != now()) return;
    for (const std::string& remark : remarks_)
        say(fmt::format("{}, at {} ms", remark, in_milliseconds(remarked_)));
}

}  // namespace nplc::sim
