#include "macreg/ui_model.h"

#include <fmt/format.h>

#include <utility>

#include "macreg/change.h"
#include "macreg/values.h"
#include "registers/convert.h"
#include "registers/layout.h"
#include "text/text.h"

namespace nplc::macreg {

using registers::Field;
using registers::Register;
using spelling::is_same;

namespace {

constexpr std::size_t kLongestInput = 60;

/// A field's value by its name or number; nullopt if it is neither, or too large.
std::optional<std::uint32_t> field_value(const Field& field, const std::string& text) {
    for (const auto& one : field.values) {
        if (is_same(one.name, text)) return one.value;
    }
    const std::uint32_t most = field.width >= 32 ? ~std::uint32_t{0} : (std::uint32_t{1} << field.width) - 1;
    const auto value = spelling::whole_number(text);
    if (!value || *value < 0 || *value > most) return std::nullopt;
    return static_cast<std::uint32_t>(*value);
}

/// As far as they have been read.
RawValues known_limits(const RegisterList& list) {
    RawValues known;
    for (const std::uint8_t number :
         {registers::MIN_P_IST, registers::MAX_P_IST, registers::P_IST, registers::ERR_STAT}) {
        const auto value = list.raw_of(number);
        if (!value) return {};
        known[number] = *value;
    }
    return known;
}

}  // namespace

UiModel::UiModel(registers::Model model) : list_(model) {}

Request UiModel::press(KeyPress key) {
    if (help_) {
        help_ = key.key == Key::none;  // Key::none: no key was pressed
        return {};
    }
    if (prompt_.kind != Prompt::Kind::none) return answer_prompt(key);
    if (key.key != Key::none) tell("");
    return browse(key);
}

Request UiModel::browse(KeyPress key) {
    const int page = static_cast<int>(list_.page());
    switch (key.key) {
        case Key::up:
            move(-1);
            break;
        case Key::down:
            move(1);
            break;
        case Key::page_up:
            move(-page);
            break;
        case Key::page_down:
            move(page);
            break;
        case Key::first:
            move(-100'000);
            break;
        case Key::last:
            move(100'000);
            break;
        case Key::left:
        case Key::right:
            samples_.move_curve(key.key == Key::left ? -1 : 1);
            break;
        case Key::tab:
        case Key::back_tab:
            panel_ = static_cast<Panel>((static_cast<int>(panel_) + (key.key == Key::tab ? 1 : kPanels - 1)) %
                                        kPanels);
            list_.move_field(0);
            break;
        case Key::enter:
            return browse_letter('w');
        case Key::escape:
            zoomed_ = false;
            break;
        case Key::character:
            return browse_letter(key.character);
        case Key::backspace:
        case Key::erase:
        case Key::none:
            break;
    }
    return {};
}

Request UiModel::browse_letter(char letter) {
    switch (letter) {
        case 'q':
        case 'Q':
            return {.kind = Request::Kind::quit};
        case 'r':
            return {.kind = Request::Kind::read, .reg = &list_.selected()};
        case 'R':
            return {.kind = Request::Kind::read_all};
        case 'w':
        case 'W':
            ask_write();
            break;
        case 's':
        case 'S':
            ask(Prompt::Kind::record, "record (registers, slow or fast): ", last_record_);
            break;
        case 'c':
        case 'C':
            set_recording({});
            break;
        case '/':
            list_.begin_search();
            ask(Prompt::Kind::search, "search: ");
            break;
        case 'n':
            search(true);
            break;
        case 'a':
            live_ = !live_;
            tell(live_ ? "values are read all the time" : "values are read when you press r");
            break;
        case 'z':
            zoomed_ = !zoomed_;
            break;
        case 'v':
            samples_.toggle_numbers();
            break;
        case 'F':
            ask_service(Request::Kind::save);
            break;
        case 'X':
            ask_service(Request::Kind::reset);
            break;
        case 'P':
            ask_service(list_.raw_of(registers::MODE_REG) == kSafe ? Request::Kind::exit_safe
                                                                   : Request::Kind::enter_safe);
            break;
        case '?':
        case 'h':
            help_ = true;
            break;
        default:
            break;
    }
    return {};
}

void UiModel::move(int steps) {
    if (panel_ == Panel::bits) {
        list_.move_field(steps);
    } else if (panel_ == Panel::samples) {
        samples_.move(steps);
    } else {
        list_.move(steps);
    }
}

void UiModel::ask(Prompt::Kind kind, std::string label, std::string text) {
    prompt_ = {kind, std::move(label), std::move(text)};
}

void UiModel::ask_write() {
    const Register& reg = list_.selected();
    if (panel_ == Panel::bits && !list_.fields().empty()) {
        if (!list_.raw_of(reg.number))
            return tell("read it first (r): the other bits stay as they are", true);
        return ask(Prompt::Kind::write,
                   fmt::format("{}.{} := ", reg.name, list_.fields()[list_.selected_field()].name));
    }
    ask(Prompt::Kind::write, fmt::format("{} ({}) := ", reg.name, choice_text(reg, list_.model())));
}

/// Commands that act on the whole motor require a typed yes, and a motor at standstill.
void UiModel::ask_service(Request::Kind kind) {
    const auto mode = list_.raw_of(registers::MODE_REG);
    if (!mode) return tell("the motor's mode has not been read yet", true);
    const Register& mode_reg = *registers::find(list_.model(), registers::MODE_REG);
    if (!is_passive(*mode))
        return tell(fmt::format("the motor is in {}: stop it first (w at MODE_REG, INIT_MODE)",
                                value_text(mode_reg, list_.model(), *mode)),
                    true);
    const auto start = list_.raw_of(registers::STARTMODE);
    const std::string starts = start ? "starts in " + value_text(mode_reg, list_.model(), *start & 0xFF)
                                     : std::string("starts anew");
    const std::string what = kind == Request::Kind::save    ? "save all memory to flash; resets, " + starts
                             : kind == Request::Kind::reset ? "reset, unsaved values are lost; " + starts
                             : kind == Request::Kind::enter_safe ? "SAFE_MODE: passive, deaf to FastMAC"
                                                                 : "leave SAFE_MODE for INIT_MODE";
    pending_ = {.kind = kind};
    ask(Prompt::Kind::confirm, what + "; type yes: ");
}

Request UiModel::answer_prompt(KeyPress key) {
    const bool searches = prompt_.kind == Prompt::Kind::search;
    switch (key.key) {
        case Key::character:
            if (prompt_.text.size() < kLongestInput) prompt_.text += key.character;
            break;
        case Key::backspace:
            if (!prompt_.text.empty()) prompt_.text.pop_back();
            break;
        case Key::erase:
            prompt_.text.clear();
            break;
        case Key::escape:
            if (searches) list_.give_up_search();
            prompt_ = {};
            tell("");
            return {};
        case Key::enter:
            return finish_prompt();
        default:
            return {};
    }
    if (searches) {
        last_search_ = prompt_.text;
        search(false);
    }
    return {};
}

Request UiModel::finish_prompt() {
    switch (prompt_.kind) {
        case Prompt::Kind::write:
            return finish_write();
        case Prompt::Kind::confirm:
            return finish_confirm();
        case Prompt::Kind::record:
            last_record_ = prompt_.text;
            prompt_ = {};
            return {.kind = Request::Kind::record, .text = last_record_};
        case Prompt::Kind::search:
        case Prompt::Kind::none:
            break;
    }
    prompt_ = {};
    return {};
}

Request UiModel::finish_write() {
    const Register& reg = list_.selected();
    Request request{.kind = Request::Kind::write, .reg = &reg};
    if (panel_ == Panel::bits && !list_.fields().empty()) {
        const Field& field = list_.fields()[list_.selected_field()];
        const auto value = field_value(field, prompt_.text);
        if (!value) {
            tell(fmt::format("'{}' is no value of {}, which has {} bit{}", prompt_.text, field.name,
                             field.width, field.width == 1 ? "" : "s"),
                 true);
            return {};
        }
        const auto bits = static_cast<std::uint32_t>(list_.raw_of(reg.number).value_or(0));
        const std::uint32_t changed = (bits & ~registers::mask_of(field)) | *value << field.first;
        request.raw = registers::value_of(registers::format_on_line(list_.model(), reg), changed);
    } else {
        const TypedValue typed = typed_value(reg, list_.model(), prompt_.text);
        if (!typed.error.empty()) {
            tell(typed.error, true);
            return {};
        }
        request.raw = typed.raw;
        if (!typed.rounding.empty()) tell(typed.rounding);
    }
    if (const std::string problem = no_mode(list_.model(), reg, request.raw); !problem.empty()) {
        tell(problem, true);
        return {};
    }
    prompt_ = {};
    const bool overwritten = reg.access == registers::Access::read_only;
    const std::string limits = limits_danger(known_limits(list_), {{reg.number, request.raw}});
    const std::string harm = limits.empty() ? danger(list_.model(), reg, request.raw) : limits;
    if (harm.empty() && !overwritten) return request;
    pending_ = request;
    const std::string value = value_text(reg, list_.model(), request.raw);
    if (harm.empty()) {
        ask(Prompt::Kind::confirm,
            fmt::format("{} is read only, the motor overwrites it; type yes: ", reg.name));
        return {};
    }
    ask(Prompt::Kind::confirm, fmt::format("{} := {}: {}; type yes: ", reg.name, value, harm));
    return {};
}

Request UiModel::finish_confirm() {
    const bool yes = prompt_.text == "yes";
    prompt_ = {};
    const Request request = std::exchange(pending_, {});
    if (yes) return request;
    tell(request.kind == Request::Kind::write ? "not confirmed, nothing was written"
                                              : "not confirmed, nothing was done");
    return {};
}

void UiModel::search(bool next) {
    if (last_search_.empty()) return;
    if (list_.search(last_search_, next)) return tell("");
    tell(fmt::format("nothing has '{}' in its name or title", last_search_), true);
}

void UiModel::tell(std::string note, bool bad) {
    note_ = std::move(note);
    bad_ = bad;
}

void UiModel::set_trouble(std::string trouble) {
    // Values read before the line was lost stay on the screen.
    if (trouble.empty() && !trouble_.empty() && !bad_) tell("the motor answers again");
    trouble_ = std::move(trouble);
}

std::string UiModel::state_words() const {
    return trouble_.empty() ? list_.state_words() : trouble_;
}

}  // namespace nplc::macreg
