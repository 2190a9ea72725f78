// Screen layout: parameters on the left and bits on the right, below them the samples, then the line's bytes;
// one line for the state above and one for notes and prompts below.
#include "terminal.h"

#include <fmt/format.h>

#include <algorithm>

#include "curses_headers.h"
#include "macreg/layout.h"
#include "macreg/values.h"

namespace nplc::macreg {

using registers::Field;
using registers::Register;

namespace {

struct Box {
    int top = 0;
    int left = 0;
    int rows = 0;
    int columns = 0;
};

constexpr int kLineRows = 4;
constexpr int kEmptySamplesRows = 2;
constexpr int kParameterColumns = 44;
constexpr int kLabelColumns = 10;

class Screen {
  public:
    Screen(UiModel& model, const Terminal& terminal, const std::string& title)
        : model_(model), terminal_(terminal), title_(title) {
        getmaxyx(stdscr, rows_, columns_);
    }

    void draw() {
        ::erase();
        if (rows_ < kLeastRows || columns_ < kLeastColumns) {
            put(0, 0, columns_, fmt::format("{} by {} is too small", columns_, rows_));
            put(1, 0, columns_, "80 by 24 is right; q quits");
        } else if (model_.shows_help()) {
            draw_help();
        } else {
            draw_panels();
        }
        ::refresh();
    }

  private:
    void draw_panels() {
        draw_state();
        const Box all{1, 0, rows_ - 2, columns_};
        if (model_.zoomed()) {
            draw_panel(model_.panel(), all);
        } else {
            const bool samples =
                !model_.samples().recording().columns.empty() || !model_.samples().progress().empty();
            const int rest = all.rows - kLineRows;
            const int upper = samples ? std::max(6, rest * 11 / 20) : rest - kEmptySamplesRows;
            const int left = std::max(kParameterColumns, columns_ / 2);
            draw_panel(Panel::parameters, {all.top, 0, upper, left});
            draw_panel(Panel::bits, {all.top, left, upper, columns_ - left});
            draw_panel(Panel::samples, {all.top + upper, 0, all.rows - kLineRows - upper, columns_});
            draw_panel(Panel::line, {rows_ - 1 - kLineRows, 0, kLineRows, columns_});
        }
        draw_bottom();
    }

    void draw_panel(Panel panel, Box box) {
        switch (panel) {
            case Panel::parameters:
                return draw_parameters(box);
            case Panel::bits:
                return draw_bits(box);
            case Panel::samples:
                return draw_samples(box);
            case Panel::line:
                return draw_line(box);
        }
    }

    void put(int y, int x, int width, const std::string& text, attr_t attributes = A_NORMAL) {
        if (y < 0 || y >= rows_ || width <= 0) return;
        ::attron(static_cast<int>(attributes));
        // Texts are cut by bytes, as if each were a column; only curves are not ASCII, and they fit.
        ::mvaddnstr(y, x, text.c_str(), static_cast<int>(text.size()));
        ::attroff(static_cast<int>(attributes));
    }
    /// Cut and padded to the width.
    void cell(int y, int x, int width, const std::string& text, attr_t attributes = A_NORMAL) {
        if (width <= 0) return;
        put(y, x, width, fmt::format("{:<{}}", text.substr(0, static_cast<std::size_t>(width)), width),
            attributes);
    }
    attr_t colour(short pair, attr_t without) const {
        return terminal_.has_colours() ? static_cast<attr_t>(COLOR_PAIR(pair)) : without;
    }
    attr_t bad() const { return colour(kPairBad, A_BOLD) | A_BOLD; }

    /// The panel's heading; returns the first row of its contents.
    Box heading(Panel panel, Box box, const std::string& text) {
        const bool active = model_.panel() == panel;
        std::string line = (active ? "[" : " ") + text + (active ? "]" : " ");
        line = line.substr(0, static_cast<std::size_t>(std::max(0, box.columns - 1)));
        const auto used = static_cast<int>(line.size());
        ::mvhline(box.top, box.left, terminal_.is_utf8() ? ACS_HLINE : '-', box.columns);
        put(box.top, box.left + 1, used, line, active ? A_REVERSE : colour(kPairTitle, A_BOLD));
        return {box.top + 1, box.left, box.rows - 1, box.columns};
    }

    void draw_state() {
        const std::string state = model_.state_words();
        const bool wrong = !model_.trouble().empty() || model_.list().has_error();
        const attr_t attributes = A_REVERSE | (wrong ? bad() : A_BOLD);
        cell(0, 0, columns_, " " + state, attributes);
        const int room = columns_ - static_cast<int>(state.size()) - 4;
        const auto shown = static_cast<int>(
            std::min<std::size_t>(title_.size(), static_cast<std::size_t>(std::max(0, room))));
        put(0, columns_ - shown - 1, shown, title_.substr(0, static_cast<std::size_t>(shown)), A_REVERSE);
    }

    void draw_parameters(Box box) {
        box = heading(Panel::parameters, box, model_.is_live() ? "Parameters" : "Parameters, read by r");
        model_.set_page(static_cast<std::size_t>(std::max(1, box.rows)));
        int y = box.top;
        for (const Register* row : model_.list().visible()) {
            const Register& reg = *row;
            const bool is_selected = row == &model_.list().selected();
            cell(y++, box.left, box.columns - 1, parameter_words(reg, box.columns - 1),
                 is_selected ? (model_.panel() == Panel::parameters ? A_REVERSE : A_BOLD) : A_NORMAL);
        }
    }

    std::string parameter_words(const Register& reg, int width) const {
        const std::string head =
            fmt::format("{:>3}{}{:<12} ", reg.number, reg.dangerous ? '!' : ' ', reg.name);
        const auto raw = model_.list().raw_of(reg.number);
        if (!raw) return head + "-";
        const std::string value = value_text(reg, model_.list().model(), *raw);
        const std::string plain = fmt::format("{}", *raw);
        const int room = width - static_cast<int>(head.size() + value.size()) - 1;
        if (value.starts_with(plain) || room < static_cast<int>(plain.size())) return head + value;
        return head + value + fmt::format("{:>{}}", plain, room + 1);
    }

    void draw_bits(Box box) {
        const Register& reg = model_.list().selected();
        const auto raw = model_.list().raw_of(reg.number);
        const auto bits = static_cast<std::uint32_t>(raw.value_or(0));
        box = heading(Panel::bits, box,
                      fmt::format("{} {}", reg.name, raw ? fmt::format("{:X}h", bits & mask_of(reg)) : ""));
        const auto fields = model_.list().fields();
        if (fields.empty()) return draw_about(box, reg);
        const std::size_t selected = model_.list().selected_field();
        const auto meaning =
            wrapped(fields[selected].meaning, static_cast<std::size_t>(std::max(10, box.columns - 2)),
                    static_cast<std::size_t>(std::max(1, box.rows / 2)));
        const auto page = static_cast<std::size_t>(std::max(1, box.rows - static_cast<int>(meaning.size())));
        const std::size_t first = selected >= page ? selected - page + 1 : 0;
        for (std::size_t i = 0; i < page && first + i < fields.size(); ++i) {
            const Field& field = fields[first + i];
            const bool active = model_.panel() == Panel::bits && first + i == selected;
            cell(box.top + static_cast<int>(i), box.left + 1, box.columns - 1,
                 field_words(field, bits, raw.has_value()), active ? A_REVERSE : A_NORMAL);
        }
        int y = box.top + box.rows - static_cast<int>(meaning.size());
        for (const std::string& line : meaning)
            cell(y++, box.left + 1, box.columns - 1, line, colour(kPairTitle, A_NORMAL));
    }

    std::uint32_t mask_of(const Register& reg) const {
        const bool wide =
            model_.list().model() == registers::Model::mac800 || registers::is_32_bit(reg.format);
        return wide ? 0xFFFFFFFF : 0xFFFF;
    }

    static std::string field_words(const Field& field, std::uint32_t bits, bool known) {
        const std::string place = field.width == 1
                                      ? fmt::format("{}", field.first)
                                      : fmt::format("{}..{}", field.first + field.width - 1, field.first);
        const std::uint32_t value = registers::value_in(field, bits);
        const auto* name = registers::named(field, value);
        return fmt::format("{:>6} {:<13} {}{}", place, field.name, known ? fmt::format("{}", value) : "-",
                           known && name != nullptr ? fmt::format(" {}", name->name) : "");
    }

    void draw_about(Box box, const Register& reg) {
        const auto* details = registers::details_of(model_.list().model(), reg.number);
        int y = box.top;
        const int end = box.top + box.rows;
        const auto width = static_cast<std::size_t>(std::max(10, box.columns - 3));
        const auto paragraph = [&](const std::string& text) {
            for (const std::string& line : wrapped(text, width, static_cast<std::size_t>(end - y)))
                cell(y++, box.left + 2, box.columns - 3, line);
        };
        if (details != nullptr) paragraph(std::string(details->title));
        paragraph(fmt::format("raw {} to {}, {}, {}", reg.min, reg.max, registers::name_of(reg.format),
                              registers::name_of(reg.access)));
        if (reg.dangerous) paragraph("! a wrong value may damage the motor");
        paragraph(std::string(reg.section));
        if (details != nullptr) paragraph(std::string(details->note));
    }

    void draw_samples(Box box) {
        const Recording& recording = model_.samples().recording();
        if (!model_.samples().progress().empty() || recording.columns.empty()) {
            box = heading(Panel::samples, box, "Samples");
            cell(box.top, box.left + 2, box.columns - 3,
                 model_.samples().progress().empty() ? "s records: name the registers, slow or fast"
                                                     : model_.samples().progress());
            return;
        }
        const auto& column = recording.columns[model_.samples().curve()];
        const auto [least, most] = std::minmax_element(column.values.begin(), column.values.end());
        std::string about =
            fmt::format("Samples: {}{}", column.name, column.unit.empty() ? "" : " [" + column.unit + "]");
        if (recording.columns.size() > 1)
            about += fmt::format(" {} of {}, left and right", model_.samples().curve() + 1,
                                 recording.columns.size());
        about += fmt::format("; {} samples in {:.3f} s", recording.size(), recording.time_s.back());
        box = heading(Panel::samples, box, about);
        if (model_.samples().shows_numbers()) return draw_numbers(box, recording);
        const int width = box.columns - kLabelColumns - 1;
        const auto rows = text_curve(column.values, width, box.rows, *least, *most, terminal_.is_utf8());
        for (int i = 0; i < static_cast<int>(rows.size()); ++i)
            put(box.top + i, box.left + kLabelColumns, width, rows[static_cast<std::size_t>(i)],
                colour(kPairCurve, A_NORMAL));
        cell(box.top, box.left, kLabelColumns - 1, fmt::format("{:>9.6g}", *most));
        cell(box.top + box.rows - 1, box.left, kLabelColumns - 1, fmt::format("{:>9.6g}", *least));
    }

    void draw_numbers(Box box, const Recording& recording) {
        const auto line = [&](int y, const std::string& time, const auto& text_of) {
            std::string text = fmt::format("{:>9}", time);
            for (const auto& column : recording.columns) text += fmt::format(" {:>12}", text_of(column));
            cell(box.top + y, box.left, box.columns, text);
        };
        line(0, "s", [](const auto& column) { return column.name; });
        for (int y = 1; y < box.rows; ++y) {
            const std::size_t i = model_.samples().sample() + static_cast<std::size_t>(y) - 1;
            if (i >= recording.size()) break;
            line(y, fmt::format("{:.4f}", recording.time_s[i]),
                 [&](const auto& column) { return fmt::format("{:.8g}", column.values[i]); });
        }
    }

    void draw_line(Box box) {
        box = heading(Panel::line, box, "Transmit and receive");
        cell(box.top, box.left, box.columns, "> " + model_.exchanges().sent());
        cell(box.top + 1, box.left, box.columns, "< " + model_.exchanges().received());
        const auto& lines = model_.exchanges().lines();
        const auto room = static_cast<std::size_t>(std::max(0, box.rows - 2));
        const std::size_t first = lines.size() > room ? lines.size() - room : 0;
        for (std::size_t i = first; i < lines.size(); ++i)
            cell(box.top + 2 + static_cast<int>(i - first), box.left, box.columns, lines[i]);
    }

    /// As many lines as needed, upwards from `last`: a message ends with what to do.
    void draw_note(int last) {
        const auto lines = wrapped(model_.note(), static_cast<std::size_t>(columns_ - 1),
                                   static_cast<std::size_t>(rows_ / 2));
        int y = last - static_cast<int>(lines.size()) + 1;
        for (const std::string& line : lines) cell(y++, 0, columns_, line, model_.is_bad() ? bad() : A_BOLD);
    }

    void draw_bottom() {
        const int y = rows_ - 1;
        const Prompt& prompt = model_.prompt();
        ::curs_set(prompt.kind == Prompt::Kind::none ? 0 : 1);
        draw_note(prompt.kind == Prompt::Kind::none ? y : y - 1);
        if (prompt.kind != Prompt::Kind::none) {
            // The user types at the end of a long label and text.
            const std::string text = prompt.label + prompt.text;
            const auto width = static_cast<std::size_t>(columns_ - 1);
            const std::string shown = text.size() > width ? text.substr(text.size() - width) : text;
            cell(y, 0, columns_ - 1, shown, A_BOLD);
            ::move(y, static_cast<int>(shown.size()));
        } else if (model_.note().empty()) {
            cell(y, 0, columns_ - 1,
                 "arrows  r read  w write  s samples  / search  Tab panel  z zoom  ? help  q quit");
        }
    }

    void draw_help() {
        constexpr const char* kHelp[] = {
            "macreg ui",
            "",
            "  arrows, PgUp, PgDn, Home, End   select a register, a bit or a curve",
            "  Tab, Shift-Tab                  next panel, the one before",
            "  r   R                           read the selected register; read all",
            "  a                               read all the time, or only by r",
            "  w, Enter                        write: a number with or without unit, 0x1F,",
            "                                  a name such as P_MODE; in the bits panel one bit.",
            "                                  It is read back. What is marked ! asks first.",
            "  s                               record samples and show them",
            "  c                               clear the samples; the motor does not notice",
            "  left, right                     the next of the recorded registers",
            "  v                               the samples as numbers, or as a curve",
            "  F   X   P                       save to flash; reset; SAFE_MODE, in and out; all ask",
            "  /   n                           search names and titles; the next one",
            "  z, Esc                          the panel on the whole screen, and back",
            "  q                               quit; the motor stays as it is",
            "",
            "Any key goes back.",
        };
        int y = 0;
        for (const char* line : kHelp) {
            cell(y, 1, columns_ - 2, line, y == 0 ? A_BOLD : A_NORMAL);
            ++y;
        }
    }

    UiModel& model_;
    const Terminal& terminal_;
    const std::string& title_;
    int rows_ = 0;
    int columns_ = 0;
};

}  // namespace

void draw(UiModel& model, const Terminal& terminal, const std::string& title) {
    Screen(model, terminal, title).draw();
}

}  // namespace nplc::macreg
