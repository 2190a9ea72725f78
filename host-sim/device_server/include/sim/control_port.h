#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "hal_linux/byte_server.h"

namespace nplc::sim {

/// Where a person or a program says what happens to a device, a line each, and hears what became of it: an
/// endpoint for several clients, or `-`, the program's standard input and output. Nothing blocks.
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
    bool is_open() const { return is_console_ || server_ != nullptr; }
    bool is_console() const { return is_console_; }
    /// "control: unix:/tmp/bench" and a line's end; nothing if it is none.
    std::string described() const;

  private:
    struct Client {
        std::uint64_t visit = 0;
        std::string line{};
        bool too_long = false;
    };

    void take(std::size_t seat, std::string_view bytes, const CarryOut& carry_out);
    void answer(std::size_t seat, const Answer& answer);
    void read_console(const CarryOut& carry_out);

    std::unique_ptr<hal_linux::ByteServer> server_;
    std::vector<Client> clients_;
    bool is_console_ = false;
    bool console_ended_ = false;
};

}  // namespace nplc::sim
