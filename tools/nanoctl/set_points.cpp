#include "nanoctl/set_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <utility>

#include "base/bytes.h"
#include "base/crc32.h"
#include "set_points/values.h"

namespace nplc::nanoctl {
namespace {

constexpr unsigned kReads = 50;

std::uint32_t pointer_to(std::size_t view) {
    return static_cast<std::uint32_t>(view << 16);
}

[[noreturn]] void give_up() {
    throw Refused(gw::Result::wrong_check, gw::SET_POINT_DATA, 0,
                  "the set-points cannot be read, another client reads them all the time; try again");
}

/// The registers behind the pointer; other clients move the same pointer.
Block read_part(GatewayClient& gateway, std::uint32_t pointer) {
    for (unsigned i = 0; i < kReads; ++i) {
        gateway.write(gw::SET_POINT_POINTER, pointer);
        const Block block = gateway.read_block(gw::SET_POINT_POINTER);
        if (block.front() == pointer) return block;
    }
    give_up();
}

/// `part`: how much of each block counts. Gateways before showed changes only from their first byte on, whole
/// ones.
std::vector<std::uint8_t> read_view(GatewayClient& gateway, std::size_t view, std::size_t length,
                                    std::size_t part = gw::kSetPointDataBytes) {
    std::vector<std::uint8_t> bytes;
    for (std::size_t at = 0; at < length; at += part) {
        bytes.resize(at);
        const Block block = read_part(gateway, pointer_to(view) | static_cast<std::uint32_t>(at));
        for (std::size_t word = 1; word < block.size(); ++word) {
            bytes.resize(bytes.size() + 4);
            base::store_u32(&bytes[bytes.size() - 4], block[word]);
        }
    }
    bytes.resize(length);
    return bytes;
}

std::vector<std::int32_t> read_values(GatewayClient& gateway, std::uint8_t first, std::size_t count) {
    const Block block = gateway.read_block(first);
    std::vector<std::int32_t> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(static_cast<std::int32_t>(block[i]));
    return values;
}

set_points::Record read_record(GatewayClient& gateway) {
    for (unsigned i = 0; i < kReads; ++i) {
        const std::uint32_t crc = gateway.read(gw::SET_POINT_RECORD);
        const std::vector<std::uint8_t> bytes = read_view(gateway, 0, gateway.read(gw::SET_POINT_BYTES));
        if (base::crc32(bytes) != crc) continue;
        if (const auto record = set_points::decode(bytes)) return *record;
    }
    give_up();
}

}  // namespace

bool takes_set_points(GatewayClient& gateway) {
    return gateway.read(gw::SET_POINT_COUNT) != 0;
}

KeptSetPoints read_set_points(GatewayClient& gateway) {
    const std::uint32_t count = gateway.read(gw::SET_POINT_COUNT);
    if (count == 0)
        throw Refused(gw::Result::no_register, gw::SET_POINT_COUNT, 0,
                      "the gateway's firmware keeps no set-points: it is too old, or was built without them");
    if ((count & 0xFF) == 0)
        throw Refused(
            gw::Result::other_table, gw::SET_POINT_COUNT, 0,
            "the active table has no set-points; declare them with SET_POINT, build and upload it with "
            "its F.sym beside");
    KeptSetPoints kept;
    kept.record = read_record(gateway);
    kept.recipes = count >> 16 & 0xFF;
    kept.state = gateway.read(gw::SET_POINT_STATE);
    kept.in_force = read_values(gateway, gw::SET_POINT, kept.record.values.size());
    kept.wanted = read_values(gateway, gw::SET_POINT_WANTED, kept.record.values.size());
    return kept;
}

std::vector<set_points::Recipe> read_recipes(GatewayClient& gateway, const KeptSetPoints& kept) {
    std::vector<set_points::Recipe> recipes;
    for (std::size_t number = 1; number <= kept.recipes; ++number) {
        if (read_view(gateway, number, 1).front() == 0) continue;
        const auto bytes = read_view(gateway, number, set_points::kRecipeBytes);
        set_points::Recipe recipe =
            set_points::decode_recipe(bytes, kept.record, static_cast<std::uint8_t>(number));
        if (!recipe.name.empty()) recipes.push_back(std::move(recipe));
    }
    return recipes;
}

set_points::Record read_active_record(GatewayClient& gateway) {
    if ((gateway.read(gw::SET_POINT_COUNT) & 0xFF) == 0) return {};
    return read_record(gateway);
}

KnownChanges read_changes(GatewayClient& gateway) {
    constexpr std::size_t kKept = 16;
    KnownChanges known{read_active_record(gateway), {}};
    if (known.record.values.empty()) return {};
    constexpr std::size_t kWhole = gw::kSetPointDataBytes / gw::kChangeBytes * gw::kChangeBytes;
    const auto bytes = read_view(gateway, static_cast<std::size_t>(gw::SetPointView::changes),
                                 kKept * gw::kChangeBytes, kWhole);
    known.changes = set_points::decode_changes(bytes, known.record);
    return known;
}

namespace {

/// A pending request in the gateway, identified by its number.
class SentRequest {
  public:
    SentRequest(GatewayClient& gateway, std::vector<std::uint8_t> request)
        : gateway_(gateway), request_(std::move(request)) {
        while (number_ == 0) number_ = std::random_device{}();
        set_points::give_number(request_, number_);
    }

    /// Repeated until its result is known: the gateway carries it out once.
    GatewayClient::LastResult outcome() {
        for (unsigned i = 0; i < kAttempts; ++i) {
            if (i != 0) gateway_.look_for_interruption();
            if (gateway_.master().try_write_long(gateway_.address(), gw::SET_POINT_WRITE, request_,
                                                 kAnswered))
                return {gw::Result::done, gw::SET_POINT_WRITE, 0};
            if (const auto ended = wait_for_end()) return *ended;
            const GatewayClient::LastResult last = gateway_.last_result();
            if (last.reg == gw::SET_POINT_WRITE && is_of_the_line(last.result)) return last;
        }
        return {gw::Result::busy, gw::SET_POINT_WRITE, 0};
    }

  private:
    static constexpr unsigned kAttempts = 12;
    static constexpr base::Milliseconds kAnswered{3'000};
    static constexpr base::Milliseconds kLook{100};
    static constexpr base::Milliseconds kLongest{60'000};

    /// The error is not of the request itself, so it was not begun.
    static bool is_of_the_line(gw::Result result) {
        return result == gw::Result::seat_taken || result == gw::Result::too_late;
    }

    /// nullopt: the outcome is unknown to the gateway.
    std::optional<GatewayClient::LastResult> wait_for_end() {
        const base::Instant end = gateway_.master().wire().now() + kLongest;
        for (;;) {
            const auto word = look();
            if (!word) return std::nullopt;
            if (*word != gw::kRequestUnderWay)
                return GatewayClient::LastResult{static_cast<gw::Result>(*word & 0xFF), gw::SET_POINT_WRITE,
                                                 static_cast<std::uint16_t>(*word >> 16)};
            if (gateway_.master().wire().now() >= end)
                throw Refused(gw::Result::busy, gw::SET_POINT_WRITE, 0,
                              "the gateway has been storing it for a minute and has not ended; look with "
                              "`nanoctl set-points` and `recipe list` whether it was stored");
            gateway_.look_for_interruption();
            gateway_.master().pause(kLook);
        }
    }

    std::optional<std::uint32_t> look() {
        const Block block =
            read_part(gateway_, pointer_to(static_cast<std::size_t>(gw::SetPointView::requests)));
        for (std::size_t i = 0; i < gw::kKeptRequests; ++i) {
            if (block[1 + 2 * i] == number_) return block[2 + 2 * i];
        }
        return std::nullopt;
    }

    GatewayClient& gateway_;
    std::vector<std::uint8_t> request_;
    std::uint32_t number_ = 0;
};

GatewayClient::LastResult outcome_of(GatewayClient& gateway, std::vector<std::uint8_t> request) {
    constexpr const char* kNotKnown =
        "{}; whether it was stored is not known: look with `nanoctl set-points` and `recipe list`";
    SentRequest sent(gateway, std::move(request));
    try {
        return sent.outcome();
    } catch (const mactalk_client::LineError& error) {
        throw mactalk_client::LineError(error.kind(), fmt::format(fmt::runtime(kNotKnown), error.what()));
    } catch (const Interrupted& interrupted) {
        throw Interrupted(fmt::format(fmt::runtime(kNotKnown), interrupted.what()));
    }
}

}  // namespace

void write_set_points(GatewayClient& gateway, const set_points::Record& record,
                      std::vector<std::uint8_t> request) {
    const GatewayClient::LastResult ended = outcome_of(gateway, std::move(request));
    if (ended.result == gw::Result::done) return;
    std::string why(gw::describe(ended.result));
    const bool names_one = ended.result == gw::Result::out_of_range ||
                           ended.result == gw::Result::wrong_unit ||
                           ended.result == gw::Result::not_for_motor;
    if (names_one && ended.detail < record.values.size()) {
        const set_points::SetPoint& point = record.values[ended.detail];
        why = fmt::format("{}: {}; it takes {}", point.name, why, set_points::range_text(point));
    }
    throw Refused(ended.result, ended.reg, ended.detail, why + "; nothing was changed");
}

}  // namespace nplc::nanoctl
