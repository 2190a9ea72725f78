#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "hal_linux/connections.h"

namespace nplc::sim {

/// Where a person or a program says what happens to a device, a line each, and hears what became of it: an
/// endpoint for several clients, one more in the place of who has said nothing for the longest time, or `-`,
/// the program's standard input and output. Nothing blocks.
class ControlPort {
  public:
    /// Carries a line out; answers what went wrong, or what was asked for, or nothing.
    struct Answer {
        bool done = true;
        std::string text{};
    };
    using CarryOut = std::function<Answer(std::string_view line)>;

    /// An empty text opens nothing. Answers what went wrong, in one line, or nothing.
    std::string open(const std::string& endpoint);
    /// Each line that has come is carried out and answered: `ok`, the text, or `error: ` and the text. Blank
    /// lines and what follows a # are nothing.
    void serve(const CarryOut& carry_out);
    bool is_open() const { return is_console_ || connections_ != nullptr; }
    bool is_console() const { return is_console_; }
    /// "control: unix:/tmp/bench" and a line's end; nothing if it is none.
    std::string described() const;

  private:
    using Id = hal_linux::Connections::Id;
    struct Client {
        std::string line{};
        bool too_long = false;
        bool has_gone = false;
        std::uint64_t heard = 0;  ///< rises with every line of any client
    };

    void let_in();
    void take(Id id, std::string_view bytes, const CarryOut& carry_out);
    void answer(Id id, const Answer& answer);
    void read_console(const CarryOut& carry_out);

    std::unique_ptr<hal_linux::Connections> connections_;
    std::map<Id, Client> clients_;
    std::uint64_t lines_ = 0;
    bool is_console_ = false;
    bool console_ended_ = false;
};

}  // namespace nplc::sim
