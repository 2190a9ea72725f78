#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "macreg/change.h"
#include "macreg/motor.h"
#include "macreg/recording.h"
#include "registers/details.h"

/// The contents of the full screen and the effects of keys, without a terminal and without a line.
namespace nplc::macreg {

enum class Panel : std::uint8_t { parameters, bits, samples, line };
inline constexpr int kPanels = 4;

enum class Key : std::uint8_t {
    none,
    character,
    up,
    down,
    left,
    right,
    page_up,
    page_down,
    first,
    last,
    tab,
    back_tab,
    enter,
    escape,
    backspace,
    erase,  ///< the whole line
};

struct KeyPress {
    Key key = Key::none;
    char character = 0;
};

/// A request to the motor caused by a key.
struct Request {
    enum class Kind : std::uint8_t {
        none,
        read,
        read_all,
        write,
        record,
        save,  ///< to the flash; the motor resets
        reset,
        enter_safe,
        exit_safe,
        quit,
    } kind = Kind::none;
    const registers::Register* reg = nullptr;
    std::int64_t raw = 0;
    std::string text{};  ///< record: "P_IST,V_IST slow"
};

/// The line at the bottom when it prompts for input.
struct Prompt {
    enum class Kind : std::uint8_t { none, search, write, confirm, record } kind = Kind::none;
    std::string label{};
    std::string text{};
};

class UiModel {
  public:
    explicit UiModel(registers::Model model);

    Request press(KeyPress key);

    // What came from the line.
    void store(const Snapshot& values);
    void tell(std::string note, bool bad = false);
    /// Empty: the motor answers.
    void set_trouble(std::string trouble);
    void set_recording(Recording recording);
    void set_progress(std::string progress) { progress_ = std::move(progress); }
    /// Bytes and meaning of the last exchange, and of those before it.
    void set_exchange(std::string sent, std::string received, const std::string& line);

    // What is shown.
    registers::Model model() const { return model_; }
    const std::vector<const registers::Register*>& rows() const { return rows_; }
    std::size_t selected_row() const { return row_; }
    /// The first row on a page around the selected one, and the registers of that page.
    std::size_t first_row() const;
    std::span<const registers::Register* const> visible() const;
    const registers::Register& selected() const { return *rows_[row_]; }
    std::optional<std::int64_t> raw_of(std::uint8_t number) const;
    std::span<const registers::Field> fields() const;
    std::size_t selected_field() const { return field_; }
    Panel panel() const { return panel_; }
    bool zoomed() const { return zoomed_; }
    bool shows_help() const { return help_; }
    bool is_live() const { return live_; }
    const Prompt& prompt() const { return prompt_; }
    const std::string& note() const { return note_; }
    bool is_bad() const { return bad_; }
    const std::string& trouble() const { return trouble_; }
    const std::string& progress() const { return progress_; }
    const Recording& recording() const { return recording_; }
    std::size_t curve() const { return curve_; }
    /// The samples as a table, from this row on.
    bool shows_numbers() const { return numbers_; }
    std::size_t sample() const { return sample_; }
    const std::string& sent() const { return sent_; }
    const std::string& received() const { return received_; }
    const std::deque<std::string>& lines() const { return lines_; }
    /// Mode and errors, or the line's failure.
    std::string state_words() const;
    bool has_error() const;

    /// The rows per page; set by the view.
    void set_page(std::size_t rows) { page_ = std::max<std::size_t>(1, rows); }

  private:
    Request browse(KeyPress key);
    Request browse_letter(char letter);
    Request answer_prompt(KeyPress key);
    Request finish_prompt();
    RawValues known_limits() const;
    Request finish_write();
    Request finish_confirm();
    void move(int steps);
    void search(bool next);
    void ask(Prompt::Kind kind, std::string label, std::string text = {});
    void ask_write();
    void ask_service(Request::Kind kind);

    registers::Model model_;
    std::vector<const registers::Register*> rows_;
    std::map<std::uint8_t, std::int64_t> values_;
    std::size_t row_ = 0;
    std::size_t field_ = 0;
    std::size_t curve_ = 0;
    std::size_t sample_ = 0;
    bool numbers_ = false;
    std::size_t page_ = 10;
    Panel panel_ = Panel::parameters;
    bool zoomed_ = false;
    bool help_ = false;
    bool live_ = true;
    Prompt prompt_;
    std::size_t row_before_search_ = 0;
    std::string last_search_;
    std::string last_record_ = "P_IST,V_IST slow";
    Request pending_;  ///< waits for confirmation
    std::string note_;
    bool bad_ = false;
    std::string trouble_;
    std::string progress_;
    Recording recording_;
    std::string sent_;
    std::string received_;
    std::deque<std::string> lines_;
};

}  // namespace nplc::macreg
