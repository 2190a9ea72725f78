#include "macreg/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "macreg/change.h"
#include "macreg/values.h"
#include "text/text.h"

namespace nplc::macreg {

using mactalk_client::Interrupted;
using registers::Access;
using registers::Model;
using registers::Register;
using spelling::trimmed;

namespace {

constexpr std::size_t kMostProblems = 100;
constexpr std::uint32_t kAll = ~std::uint32_t{0};

/// Registers that are writable, but that the motor itself counts, shows or sets, or that act at once.
bool is_passing(const Register& reg) {
    switch (reg.number) {
        case registers::MODE_REG:
        case registers::P_SOLL:
        case registers::P_FNC:
        case registers::P_IST:
        case registers::P_REG_P:
        case registers::V_REG_P:
        case registers::A_REG_P:
        case registers::T_REG_P:
        case registers::L_REG_P:
        case registers::Z_REG_P:
            return true;
        default:
            break;
    }
    static const std::set<std::string_view> kRunning{"REC_CNT",   "IA_OFFSET",  "IB_OFFSET",
                                                     "IC_OFFSET", "SERIAL_NMB", "P_NEW"};
    return kRunning.count(reg.name) != 0;
}

ParameterSet read(Motor& motor, bool everything, const Received& received,
                  const std::function<bool()>& goes_on) {
    ParameterSet set{.model = motor.model()};
    std::vector<const Register*> wanted;
    for (const Register& reg : motor.map()) {
        if (everything || is_parameter(motor.model(), reg)) wanted.push_back(&reg);
    }
    for (std::size_t at = 0; at < wanted.size();) {
        if (goes_on && !goes_on()) throw Interrupted("interrupted");
        const unsigned end = wanted[at]->number + block_numbers(motor.model());
        std::vector<const Register*> some;
        for (; at < wanted.size() &&
               wanted[at]->number + registers::cells_of(motor.model(), *wanted[at]).count <= end;
             ++at)
            some.push_back(wanted[at]);
        std::map<std::uint8_t, std::int64_t> fresh;
        const Snapshot block = motor.read_block(some);
        for (const auto& [number, raw] : block.values()) {
            const std::uint32_t mask = everything ? kAll : setting_bits(motor.model(), *motor.find(number));
            fresh[number] = raw & static_cast<std::int32_t>(mask);
        }
        set.values.insert(fresh.begin(), fresh.end());
        if (received) received(fresh, at, wanted.size());
    }
    return set;
}

/// The text that parses to exactly this raw value.
std::string exact_text(const Register& reg, Model model, std::int64_t raw) {
    const std::string text = value_text(reg, model, raw);
    const TypedValue typed = typed_value(reg, model, text);
    if (typed.error.empty() && typed.raw == raw) return text;
    return fmt::format("raw:{}", raw);
}

/// A value read from a motor may be outside the register's range; a dump writes it as raw:N, which is
/// accepted again.
std::optional<std::int64_t> found_in_motor(const Register& reg, std::string_view text) {
    if (!text.starts_with("raw:")) return std::nullopt;
    const auto raw = spelling::whole_number(text.substr(4));
    const bool fits = raw && registers::value_of(reg.format, registers::bits_of(reg.format, *raw)) == *raw;
    return fits ? raw : std::nullopt;
}

struct Parser {
    ParsedFile file{};
    unsigned line = 0;
    std::size_t shown = 0;                  ///< measurements and states, in comments of `dump --all`
    std::optional<std::size_t> declared{};  ///< registers, by the last line

    void problem(std::string text) { file.problems.push_back({line, std::move(text)}); }

    void header(const std::string& key, const std::string& value) {
        if (file.set.header.count(key) != 0) return problem(fmt::format("'{}' stands here twice", key));
        file.set.header[key] = value;
        if (key == "end") end(value);
        if (key == "incomplete") file.set.incomplete = value;
        if (key != "model") return;
        if (!file.set.values.empty()) return problem("the model must be named before the first register");
        file.set.model_is_known = value != "MAC50-141";
        if (!file.set.model_is_known) return;
        const auto model = registers::model_of(value);
        if (!model)
            return problem(fmt::format(
                "'{}' is no model; write MAC50, MAC95, MAC140, MAC141, MAC50-141 or MAC800", value));
        file.set.model = *model;
    }

    void end(const std::string& value) {
        std::size_t count = 0;
        const auto [rest, error] = std::from_chars(value.data(), value.data() + value.size(), count);
        const std::string_view unit = trimmed({rest, value.data() + value.size()});
        // If only this line is cut off, all values before it are complete
        if (error != std::errc() || !std::string_view("registers").starts_with(unit))
            return problem(fmt::format("'end = {}': write `end = N registers`", value));
        declared = count;
    }

    /// "# P_IST = ...": of `dump --all`, and counted by its last line.
    void comment(std::string_view text) {
        text = trimmed(text.substr(1));
        const registers::Register* reg = registers::find(file.set.model, text.substr(0, text.find(' ')));
        if (reg != nullptr && !is_parameter(file.set.model, *reg) &&
            text.substr(reg->name.size()).starts_with(" = "))
            ++shown;
    }

    /// Why it is incomplete; empty if it is complete.
    std::string missing() const {
        const std::size_t found = file.set.values.size();
        if (!declared) return "no line says 'end = ...', so it may be cut short";
        if (*declared == found || *declared == found + shown) return {};
        return fmt::format(
            "its last line says {} registers, and it has {}: lines are missing or were added (then write "
            "that number into the last line)",
            *declared, shown == 0 ? found : found + shown);
    }

    void value(const std::string& name, const std::string& text) {
        const NamedRegister named = find_register(file.set.model, name);
        if (named.reg == nullptr) return problem(named.error);
        if (!is_parameter(file.set.model, *named.reg))
            return problem(fmt::format(
                "{} is no parameter but something the motor shows or does; take the line out", name));
        if (file.set.values.count(named.reg->number) != 0)
            return problem(fmt::format("{} stands here twice", name));
        const TypedValue typed = typed_value(*named.reg, file.set.model, text);
        const auto found = found_in_motor(*named.reg, text);
        if (!typed.error.empty() && !found) return problem(typed.error);
        if (const std::string none = no_mode(file.set.model, *named.reg, typed.raw);
            typed.error.empty() && !none.empty())
            return problem(none);
        file.set.values[named.reg->number] = typed.error.empty() ? typed.raw : *found;
    }

    void read_line(std::string_view text) {
        if (text.starts_with('#')) return comment(text);
        text = trimmed(text.substr(0, text.find('#')));
        if (text.empty()) return;
        const auto equals = text.find('=');
        if (equals == std::string_view::npos) return problem(fmt::format("'{}': write NAME = VALUE", text));
        const std::string name(trimmed(text.substr(0, equals)));
        const std::string rest(trimmed(text.substr(equals + 1)));
        if (name.empty() || rest.empty()) return problem(fmt::format("'{}': write NAME = VALUE", text));
        const bool is_header =
            std::all_of(name.begin(), name.end(), [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; });
        is_header ? header(name, rest) : value(name, rest);
    }
};

}  // namespace

bool is_parameter(Model, const Register& reg) {
    return reg.access != Access::read_only && !is_passing(reg);
}

ParameterSet read_parameters(Motor& motor, const Received& received, const std::function<bool()>& goes_on) {
    return read(motor, false, received, goes_on);
}

ParameterSet read_everything(Motor& motor, const Received& received, const std::function<bool()>& goes_on) {
    return read(motor, true, received, goes_on);
}

std::string header_text(Motor& motor, std::string_view model_name, std::string_view date) {
    const auto show = [&](const char* name) { return motor.read(std::string_view(name)); };
    return fmt::format(
        "# Parameters of a MAC motor, by `macreg dump`; `macreg load` brings them back.\n"
        "# A value may be given with a unit, as raw:1600, as 0x640 or by names; what stands behind # is not "
        "read.\n"
        "model = {}\nmotor_type = {}\nserial_number = {}\nfirmware = {}\nhardware = {}\naddress = {}\ndate = "
        "{}\n\n",
        model_name, show("MOTOR_TYPE"), motor.read(serial_register(motor.model())), show("PROG_VERSION"),
        show("HW_VERSION"), motor.address(), date);
}

std::string value_line(Model model, const Register& reg, std::int64_t raw) {
    const bool parameter = is_parameter(model, reg);
    const std::string left =
        fmt::format("{}{} = {}", parameter ? "" : "# ", reg.name, exact_text(reg, model, raw));
    return fmt::format("{:<36} # {}, raw {}: {}{}\n", left, reg.number, raw,
                       registers::details_of(model, reg.number)->title,
                       reg.dangerous && parameter ? " (dangerous)" : "");
}

std::string end_text(std::size_t registers) {
    return fmt::format("\nend = {} registers\n", registers);
}

std::string incomplete_text(std::string_view why) {
    std::string line(why.substr(0, why.find('\n')));
    std::replace(line.begin(), line.end(), '#', ' ');
    return fmt::format("\nincomplete = {}\n", line.empty() ? "unknown" : line);
}

ParsedFile parse_parameters(std::string_view text) {
    Parser parser;
    while (!text.empty()) {
        if (parser.file.problems.size() == kMostProblems) {
            parser.problem("and more: is this a file of macreg dump?");
            return parser.file;
        }
        const auto end = std::min(text.find('\n'), text.size());
        ++parser.line;
        parser.read_line(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    parser.line = 0;
    if (parser.file.set.incomplete.empty()) parser.file.set.incomplete = parser.missing();
    if (parser.file.set.header.count("model") == 0)
        parser.problem("no line says 'model = ...'; this is no file of macreg dump");
    if (parser.file.set.values.empty() && parser.file.problems.empty()) parser.problem("holds no register");
    return parser.file;
}

std::vector<Difference> differences(const ParameterSet& left, const ParameterSet& right) {
    std::vector<Difference> all;
    for (const Register& reg : registers::map_of(left.model)) {
        const auto of = [&](const ParameterSet& set) -> std::optional<std::int64_t> {
            const auto found = set.values.find(reg.number);
            return found == set.values.end() ? std::nullopt : std::optional(found->second);
        };
        if (of(left) != of(right)) all.push_back({&reg, of(left), of(right)});
    }
    return all;
}

}  // namespace nplc::macreg
