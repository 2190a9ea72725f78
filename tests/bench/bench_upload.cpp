// How much of the line an upload uses, in virtual time: the client on the firmware's own user port.
//
// A piece of 128 bytes takes 3 + 2 x 131 + 2 = 267 characters, one of turn-round and 3 of accept: 271. What a
// whole upload takes beyond that is asking, erasing, checking and the last piece.

#include <cstdio>
#include <string_view>

#include "gateway_unit.h"
#include "nanoctl/transfer.h"
#include "store_bench.h"

namespace {

using namespace nplc;

constexpr double kLeastShare = 0.95;

double seconds_at_best(std::size_t bytes, std::uint32_t baud) {
    const std::size_t rest = bytes % 128;
    const std::size_t characters = bytes / 128 * 271 + (rest == 0 ? 0 : 3 + 2 * (3 + rest) + 2 + 1 + 3);
    return static_cast<double>(characters) * 10 / baud;
}

double seconds_taken(const std::vector<std::uint8_t>& table, std::uint32_t baud) {
    nanoctl::GatewayUnit unit;
    mactalk_client::SimWire wire(unit, baud, 1);
    mactalk_client::Master master(wire, {.baud = baud});
    nanoctl::GatewayClient gateway(master, registers::gateway::kDefaultAddress);
    const base::Instant begun = wire.now();
    nanoctl::upload(gateway, table, [](std::size_t, std::size_t) {});
    return static_cast<double>((wire.now() - begun).count()) / 1e6;
}

/// False if a full table at the usual speed uses too little of the line.
bool measure() {
    bool enough = true;
    std::printf("| terms | baud | seconds | at best | share |\n| --- | --- | --- | --- | --- |\n");
    for (const std::size_t terms : {64U, 256U, 1024U}) {
        const auto table = store::table_of(terms, 1);
        for (const std::uint32_t baud : {9'600U, 19'200U, 115'200U}) {
            const double taken = seconds_taken(table, baud);
            const double best = seconds_at_best(table.size(), baud);
            std::printf("| %zu | %u | %.2f | %.2f | %.1f %% |\n", terms, baud, taken, best,
                        100 * best / taken);
            if (terms == 1024 && baud == 19'200) enough = best / taken >= kLeastShare;
        }
    }
    return enough;
}

}  // namespace

int main() {
    if (measure()) return 0;
    std::fprintf(stderr, "bench_upload: 1024 terms at 19200 baud use less than 95 %% of the line\n");
    return 1;
}
