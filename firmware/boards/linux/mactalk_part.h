#pragma once

#include <optional>
#include <string>

#include "gateway/gateway.h"
#include "journal.h"
#include "lines.h"
#include "motor/mactalk_line.h"

namespace nplc::boards {

/// The port to a JVL motor's own MacTalk port, if one is wired.
class MactalkPart {
  public:
    /// A port that cannot be opened is missing until look() finds it.
    void open(const std::string& path);
    /// For the user port, with a new driver; null: not wired.
    ports::SerialPort* start(motor::Motor& motor, std::uint8_t address);

    /// Logs the port's loss and return; stops a motor that does not answer on its FastMAC line, in addition
    /// to its driver's blind stop.
    void look(const gateway::Gateway& sequence, AxisJournal& journal, base::Instant now);
    base::Instant next_look(base::Instant now) const;

  private:
    std::optional<ReconnectingUart> port_;
    std::optional<motor::MactalkLine> line_;
    motor::Motor* motor_ = nullptr;
};

}  // namespace nplc::boards
