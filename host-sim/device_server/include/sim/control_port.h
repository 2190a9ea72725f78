#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "hal_linux/connections.h"

namespace nplc::sim {

/// Accepts actions on a device, one per line, from a user or a program and returns their results: an endpoint
/// for several clients, where a new one replaces the one that has been silent the longest, or `-`, the
/// program's standard input and output. Nothing blocks.
class ControlPort {
  public:
    /// Carries out a line; returns an error, requested text, or nothing.
    struct Answer {
        bool done = true;
        std::string text{};
    };
    using CarryOut = std::function<Answer(std::string_view line)>;

    /// An empty text opens nothing. Returns a one-line error, or an empty text.
    std::string open(const std::string& endpoint);
    /// Carries out each received line and answers it: `ok`, the text, or `error: ` and the text. Blank lines
    /// and text after a # are ignored.
    void serve(const CarryOut& carry_out);
    bool is_open() const { return is_console_ || connections_ != nullptr; }
    bool is_console() const { return is_console_; }
    /// "control: unix:/tmp/bench" and a line end; empty if there is none.
    std::string described() const;

  private:
    using Id = hal_linux::Connections::Id;
    struct Client {
        std::string line{};
        bool too_long = false;
        bool has_gone = false;
        std::uint64_t heard = 0;  ///< order of the last line over all clients
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
