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
using spelling::lower;

namespace {

constexpr std::size_t kMostLines = 200;
constexpr std::size_t kLongestInput = 60;

/// ERR_STAT's bits that have stopped a motor, or will; the others are information only.
bool is_error(const Field& field) {
    return field.name.ends_with("_ERR") && !field.name.starts_with("FRAME");
}

std::size_t stepped(std::size_t at, int steps, std::size_t size) {
    if (size == 0) return 0;
    const auto wanted = static_cast<std::ptrdiff_t>(at) + steps;
    return static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(wanted, 0, static_cast<std::ptrdiff_t>(size) - 1));
}

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

}  // namespace

UiModel::UiModel(registers::Model model) : model_(model) {
    for (const Register& reg : registers::map_of(model)) rows_.push_back(&reg);
}

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
    const int page = static_cast<int>(page_);
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
            curve_ = stepped(curve_, key.key == Key::left ? -1 : 1, recording_.columns.size());
            break;
        case Key::tab:
        case Key::back_tab:
            panel_ = static_cast<Panel>((static_cast<int>(panel_) + (key.key == Key::tab ? 1 : kPanels - 1)) %
                                        kPanels);
            field_ = stepped(field_, 0, fields().size());
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
            return {.kind = Request::Kind::read, .reg = &selected()};
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
            row_before_search_ = row_;
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
            numbers_ = !numbers_;
            break;
        case 'F':
            ask_service(Request::Kind::save);
            break;
        case 'X':
            ask_service(Request::Kind::reset);
            break;
        case 'P':
            ask_service(raw_of(registers::MODE_REG) == kSafe ? Request::Kind::exit_safe
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
        field_ = stepped(field_, steps, fields().size());
    } else if (panel_ == Panel::samples && numbers_) {
        sample_ = stepped(sample_, steps, recording_.size());
    } else if (panel_ == Panel::samples) {
        curve_ = stepped(curve_, steps, recording_.columns.size());
    } else {
        row_ = stepped(row_, steps, rows_.size());
        field_ = 0;
    }
}

void UiModel::ask(Prompt::Kind kind, std::string label, std::string text) {
    prompt_ = {kind, std::move(label), std::move(text)};
}

void UiModel::ask_write() {
    const Register& reg = selected();
    if (panel_ == Panel::bits && !fields().empty()) {
        if (!raw_of(reg.number)) return tell("read it first (r): the other bits stay as they are", true);
        return ask(Prompt::Kind::write, fmt::format("{}.{} := ", reg.name, fields()[field_].name));
    }
    ask(Prompt::Kind::write, fmt::format("{} ({}) := ", reg.name, choice_text(reg, model_)));
}

/// Commands that act on the whole motor require a typed yes, and a motor at standstill.
void UiModel::ask_service(Request::Kind kind) {
    const auto mode = raw_of(registers::MODE_REG);
    if (!mode) return tell("the motor's mode has not been read yet", true);
    const Register& mode_reg = *registers::find(model_, registers::MODE_REG);
    if (!is_passive(*mode))
        return tell(fmt::format("the motor is in {}: stop it first (w at MODE_REG, INIT_MODE)",
                                value_text(mode_reg, model_, *mode)),
                    true);
    const auto start = raw_of(registers::STARTMODE);
    const std::string starts =
        start ? "starts in " + value_text(mode_reg, model_, *start & 0xFF) : std::string("starts anew");
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
            if (searches) row_ = row_before_search_;
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

/// As far as they have been read.
RawValues UiModel::known_limits() const {
    RawValues known;
    for (const std::uint8_t number :
         {registers::MIN_P_IST, registers::MAX_P_IST, registers::P_IST, registers::ERR_STAT}) {
        const auto value = raw_of(number);
        if (!value) return {};
        known[number] = *value;
    }
    return known;
}

Request UiModel::finish_write() {
    const Register& reg = selected();
    Request request{.kind = Request::Kind::write, .reg = &reg};
    if (panel_ == Panel::bits && !fields().empty()) {
        const Field& field = fields()[field_];
        const auto value = field_value(field, prompt_.text);
        if (!value) {
            tell(fmt::format("'{}' is no value of {}, which has {} bit{}", prompt_.text, field.name,
                             field.width, field.width == 1 ? "" : "s"),
                 true);
            return {};
        }
        const auto bits = static_cast<std::uint32_t>(raw_of(reg.number).value_or(0));
        const std::uint32_t changed = (bits & ~registers::mask_of(field)) | *value << field.first;
        request.raw = registers::value_of(registers::format_on_line(model_, reg), changed);
    } else {
        const TypedValue typed = typed_value(reg, model_, prompt_.text);
        if (!typed.error.empty()) {
            tell(typed.error, true);
            return {};
        }
        request.raw = typed.raw;
        if (!typed.rounding.empty()) tell(typed.rounding);
    }
    if (const std::string problem = no_mode(model_, reg, request.raw); !problem.empty()) {
        tell(problem, true);
        return {};
    }
    prompt_ = {};
    const bool overwritten = reg.access == registers::Access::read_only;
    const std::string limits = limits_danger(known_limits(), {{reg.number, request.raw}});
    const std::string harm = limits.empty() ? danger(model_, reg, request.raw) : limits;
    if (harm.empty() && !overwritten) return request;
    pending_ = request;
    const std::string value = value_text(reg, model_, request.raw);
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

/// Searches down from the selected row and wraps around; names first, then titles.
void UiModel::search(bool next) {
    if (last_search_.empty()) return;
    const std::string wanted = lower(last_search_);
    const std::size_t from = next ? row_ + 1 : row_before_search_;
    const auto look = [&](auto text_of) {
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const std::size_t at = (from + i) % rows_.size();
            if (lower(text_of(*rows_[at])).find(wanted) == std::string::npos) continue;
            row_ = at;
            field_ = 0;
            return true;
        }
        return false;
    };
    const auto name = [](const Register& reg) { return fmt::format("{} {}", reg.number, reg.name); };
    const auto title = [&](const Register& reg) {
        const auto* details = registers::details_of(model_, reg.number);
        return fmt::format("{} {}", details != nullptr ? details->title : "", mactalk_name(reg));
    };
    if (look(name) || look(title)) return tell("");
    if (!next) row_ = row_before_search_;
    tell(fmt::format("nothing has '{}' in its name or title", last_search_), true);
}

void UiModel::store(const Snapshot& values) {
    for (const auto& [number, value] : values.values()) values_[number] = value;
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

void UiModel::set_recording(Recording recording) {
    recording_ = std::move(recording);
    curve_ = stepped(curve_, 0, recording_.columns.size());
    sample_ = 0;
}

void UiModel::set_exchange(std::string sent, std::string received, const std::string& line) {
    sent_ = std::move(sent);
    received_ = std::move(received);
    lines_.push_back(line);
    if (lines_.size() > kMostLines) lines_.pop_front();
}

std::size_t UiModel::first_row() const {
    const std::size_t first = row_ - std::min(row_, page_ / 2);
    return std::min(first, rows_.size() - std::min(rows_.size(), page_));
}

std::span<const Register* const> UiModel::visible() const {
    const std::size_t first = first_row();
    return std::span<const Register* const>(rows_).subspan(first, std::min(page_, rows_.size() - first));
}

std::optional<std::int64_t> UiModel::raw_of(std::uint8_t number) const {
    const auto found = values_.find(number);
    return found == values_.end() ? std::nullopt : std::optional(found->second);
}

std::span<const Field> UiModel::fields() const {
    return registers::fields_of(model_, selected().number);
}

bool UiModel::has_error() const {
    const auto bits = static_cast<std::uint32_t>(raw_of(registers::ERR_STAT).value_or(0));
    for (const Field& field : registers::fields_of(model_, registers::ERR_STAT)) {
        if (is_error(field) && registers::value_in(field, bits) != 0) return true;
    }
    return false;
}

std::string UiModel::state_words() const {
    if (!trouble_.empty()) return trouble_;
    const auto mode = raw_of(registers::MODE_REG);
    const auto errors = raw_of(registers::ERR_STAT);
    if (!mode || !errors) return "reading";
    std::string words = value_text(*registers::find(model_, registers::MODE_REG), model_, *mode);
    const auto bits = static_cast<std::uint32_t>(*errors);
    bool any = false;
    for (const Field& field : registers::fields_of(model_, registers::ERR_STAT)) {
        if (!is_error(field) || registers::value_in(field, bits) == 0) continue;
        words += fmt::format(" {}", field.name);
        any = true;
    }
    return any ? words : words + ", no error";
}

}  // namespace nplc::macreg
