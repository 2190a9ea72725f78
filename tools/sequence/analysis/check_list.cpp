#include <array>

#include "findings.h"

namespace nplc::verify {
namespace {

constexpr std::array kChecks = {
    Check{"V001", Severity::advice, "StepsReached", "every step can be reached"},
    Check{"V002", Severity::advice, "StepsLeft", "every step can be left"},
    Check{"V003", Severity::advice, "WayBack", "from every step there is a way back to the first"},
    Check{"V004", Severity::fault, "FaultAcknowledged", "every fault step can be acknowledged"},
    Check{"V005", Severity::fault, "ErrorReset", "after every ERROR a RESET_ERROR can be sent"},
    Check{"V006", Severity::advice, "OutputsOnError",
          "ERROR leaves no output on that a fault step does not set"},
    Check{"V007", Severity::advice, "ZerosPreset",
          "a timer or counter whose zero is waited for was set on every way"},
    Check{"V008", Severity::advice, "TimerPurpose", "a timer is used for what it was set for"},
    Check{"V009", Severity::advice, "MoveEndSeen", "the end of every move ordered can be seen"},
    Check{"V010", Severity::fault, "InPosComes", "an INPOS that is waited for without time limit can come"},
    Check{"V011", Severity::fault, "MoveHasVelocity", "no move to a place is ordered with velocity 0"},
    Check{"V012", Severity::advice, "OrdersLast", "no order of a scan undoes another of the same scan"},
    Check{"V013", Severity::advice, "StepsSettle",
          "with unchanged inputs steps do not follow each other without end"},
    Check{"V014", Severity::advice, "SelectedWritten", "every register that is selected is written"},
    Check{"V015", Severity::advice, "MoveLimited", "every wait for the end of a move has a time limit"},
};

bool same_outcome(const Group& a, const Group& b) {
    return &a == &b || a.outcome == b.outcome;
}

using Row = std::array<const Group*, 256>;

ImageSet differing(const Row& a, const Row& b) {
    ImageSet set;
    for (std::size_t i = 0; i < 256; ++i) set[i] = !same_outcome(*a[i], *b[i]);
    return set;
}

}  // namespace

std::span<const Check> checks() {
    return kChecks;
}

Sensitivity::Sensitivity(const Machine& machine) : timer_(63 * 2), counter_(63 * 2), in_pos_(63) {
    for (std::uint8_t step = 0; step <= sequencer::kLastStep; ++step) {
        std::array<Row, 4> rows;
        for (unsigned i = 0; i < 4 * 256; ++i) {
            const auto image = static_cast<std::uint8_t>(i);
            rows[i >> 8U][image] = &machine.group_with(step, (i & 0x100U) != 0, (i & 0x200U) != 0, image);
        }
        for (unsigned other = 0; other < 2; ++other) {
            timer_[step * 2U + other] = differing(rows[other * 2U], rows[other * 2U + 1]);
            counter_[step * 2U + other] = differing(rows[other], rows[other + 2U]);
        }
        for (const Row& row : rows) {
            for (unsigned image = 0; image < 256; ++image) {
                if (!same_outcome(*row[image], *row[image ^ sequencer::kInPos])) in_pos_[step] = true;
            }
        }
    }
}

}  // namespace nplc::verify
