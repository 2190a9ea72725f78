#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "macreg/exchange_log.h"
#include "macreg/register_list.h"
#include "macreg/sample_view.h"

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
    void store(const Snapshot& values) { list_.store(values); }
    void tell(std::string note, bool bad = false);
    /// Empty: the motor answers.
    void set_trouble(std::string trouble);
    void set_recording(Recording recording) { samples_.set_recording(std::move(recording)); }
    void set_progress(std::string progress) { samples_.set_progress(std::move(progress)); }
    /// Bytes and meaning of the last exchange.
    void set_exchange(std::string sent, std::string received, const std::string& line) {
        exchanges_.add(std::move(sent), std::move(received), line);
    }

    // What is shown.
    const RegisterList& list() const { return list_; }
    const SampleView& samples() const { return samples_; }
    const ExchangeLog& exchanges() const { return exchanges_; }
    Panel panel() const { return panel_; }
    bool zoomed() const { return zoomed_; }
    bool shows_help() const { return help_; }
    bool is_live() const { return live_; }
    const Prompt& prompt() const { return prompt_; }
    const std::string& note() const { return note_; }
    bool is_bad() const { return bad_; }
    const std::string& trouble() const { return trouble_; }
    /// Mode and errors, or the line's failure.
    std::string state_words() const;

    /// The rows per page; set by the view.
    void set_page(std::size_t rows) { list_.set_page(rows); }

  private:
    Request browse(KeyPress key);
    Request browse_letter(char letter);
    Request answer_prompt(KeyPress key);
    Request finish_prompt();
    Request finish_write();
    Request finish_confirm();
    void move(int steps);
    void search(bool next);
    void ask(Prompt::Kind kind, std::string label, std::string text = {});
    void ask_write();
    void ask_service(Request::Kind kind);

    RegisterList list_;
    SampleView samples_;
    ExchangeLog exchanges_;
    Panel panel_ = Panel::parameters;
    bool zoomed_ = false;
    bool help_ = false;
    bool live_ = true;
    Prompt prompt_;
    std::string last_search_;
    std::string last_record_ = "P_IST,V_IST slow";
    Request pending_;  ///< waits for confirmation
    std::string note_;
    bool bad_ = false;
    std::string trouble_;
};

}  // namespace nplc::macreg
