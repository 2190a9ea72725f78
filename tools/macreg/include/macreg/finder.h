#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "mactalk_client/master.h"
#include "registers/mac.h"

/// Which units are on a MacTalk line (001 §5.1: a unit answers to its own address and to 255).
namespace nplc::macreg {

struct FoundUnit {
    std::uint8_t address = 0;
    bool gateway = false;
    registers::Model model = registers::Model::mac140;  ///< mac140 stands for any of MAC50 to MAC141
    std::int64_t serial_number = 0;
    std::int64_t version = 0;
    std::int64_t mode = 0;
};

struct FinderOptions {
    std::uint32_t baud = 19'200;
    base::Microseconds patience{60'000};
    bool every_address = false;  ///< also when a single motor answers to 255
    std::function<bool()> goes_on{};
    std::function<void(unsigned address)> progress{};
};

struct Found {
    std::vector<FoundUnit> units{};
    bool noise = false;  ///< bytes came that were no answer: a wrong speed, or several units at once
    unsigned asked = 0;  ///< addresses that were asked one by one
};

/// At one speed. Silence to 255 ends it at once; a single motor is known by its own answer, several by asking
/// each address. Writes nothing. Throws LineError if the port is gone, mactalk_client::Interrupted.
Found find_units(mactalk_client::Wire& wire, const FinderOptions& options);

}  // namespace nplc::macreg
