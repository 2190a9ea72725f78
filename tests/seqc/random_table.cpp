#include "random_table.h"

namespace nplc::seqc::test {
namespace {

std::uint8_t byte(unsigned value) {
    return static_cast<std::uint8_t>(value);
}

}  // namespace

std::vector<std::uint8_t> random_table(Random& random, unsigned steps, unsigned terms) {
    std::vector<std::uint8_t> table;
    for (unsigned i = 0; i < terms; ++i) {
        const bool flex = random() % 5 == 0;
        const unsigned zeros = random() % 3 == 0 ? random() % 4 : 3;
        const unsigned care = (1U << random() % 7) | (random() % 2 == 0 ? 1U << random() % 7 : 0);
        const unsigned next = random() % 3 == 0 ? 0x3E : random() % steps;
        table.push_back(byte((zeros << 6) | random() % steps));
        table.push_back(byte((random() % 0x80) | (random() % 4 == 0 ? 0x80 : 0)));
        table.push_back(byte(care | (flex ? 0x80 : 0)));
        if (flex) {
            table.push_back(byte((1 + random() % 127) | (random() % 2 == 0 ? 0x80 : 0)));
            for (int b = 0; b < 4; ++b) table.push_back(byte(random()));
        } else {
            table.push_back(byte((random() % 4 << 6) | next));
            table.push_back(byte(random() % 2 == 0 ? 0x80 : random() % 0x80));
            table.push_back(byte(random() % 3 == 0 ? random() : random() % 16));
            const unsigned preset = random() % 2 == 0 ? 0 : random();
            table.push_back(byte(preset));
            table.push_back(byte(preset >> 8));
        }
    }
    table.insert(table.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
    return table;
}

}  // namespace nplc::seqc::test
