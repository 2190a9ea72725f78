#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>

#include "gateway/command_result.h"
#include "gateway/gateway.h"
#include "registers/gateway.h"
#include "store/set_points.h"

namespace nplc::gateway {

/// The set-points of the active table: the values in force, which stand in its terms; the wanted ones, which
/// are stored and take hold when the sequence lets them; and the recipes. Needs no store that works: without
/// one the defaults run and nothing can be changed. SET_POINTS.md tells all.
class SetPoints final : public ValueSource {
  public:
    /// `area`: null where the board keeps none.
    SetPoints(Gateway& gateway, ports::Storage& storage, const store::Area* area);
    SetPoints(const SetPoints&) = delete;
    SetPoints& operator=(const SetPoints&) = delete;

    static constexpr bool kIsThere = true;
    static constexpr std::size_t kRecordMemory = registers::set_points::kMostRecordBytes;

    /// For the start-up: looks at the store.
    void mount();
    /// What was stored is damaged: a table that has set-points starts nothing by itself.
    bool were_damaged() const { return damaged_; }
    /// Is what begins at `behind_end_term` a record? 0: none.
    static std::size_t record_bytes(std::span<const std::uint8_t> behind_end_term) {
        return registers::set_points::record_bytes(behind_end_term);
    }
    static bool is_sound(std::span<const std::uint8_t> record, std::span<const std::uint8_t> table) {
        return registers::set_points::is_sound(record, table);
    }
    /// The table in use from now on, whose bytes get the values, and its record; empty: it has none. Only
    /// while stopped.
    void use(std::span<std::uint8_t> table, std::span<const std::uint8_t> record);
    /// Puts the defaults back into a copy of a part of the table, from byte `offset` on.
    void show_defaults(std::span<std::uint8_t> part, std::size_t offset) const;

    /// Who writes to SET_POINT_WRITE, from the write to its end.
    struct Writer {
        Origin origin{};
        base::Instant since{};
        std::uint32_t request = 0;  ///< 0: not begun
    };
    /// One request at a time is stored, and it is whether its writer still waits or not. `bytes` are needed
    /// until it has begun, which ends with `busy` if others' storing takes kLongestWait; then nothing but its
    /// real end counts. The same request again is not carried out twice.
    Progress serve(Writer& writer, std::span<const std::uint8_t> bytes, base::Instant now);
    static constexpr base::Microseconds kLongestWait{1'000'000};
    bool stores() const { return saving_; }
    std::uint32_t pointer() const { return pointer_; }
    void point_at(std::uint32_t pointer) { pointer_ = pointer; }
    /// The block that is read from SET_POINT_POINTER: the pointer, then what it points at.
    void read_window(std::span<std::uint8_t> out);

    void poll();
    base::Instant next_poll(base::Instant now) { return store_.next_poll(now); }

    /// Registers SET_POINT_COUNT to SET_POINT_BYTES, SET_POINT and SET_POINT_WANTED with those behind them.
    std::uint32_t value(std::uint8_t reg);
    /// What SET_POINT_POINTER points at; 0 behind its end.
    void read(std::uint32_t pointer, std::span<std::uint8_t> out);

    /// Of what happened, for journals: the `age`th last change, 0 the last one.
    struct Change {
        std::uint32_t milliseconds = 0;  ///< of uptime
        std::uint8_t index = 0;
        Origin origin{};
        std::uint8_t recipe = 0;  ///< that was loaded; 0: a value was set
        std::int32_t before = 0;
        std::int32_t now = 0;
    };
    /// Another number whenever the record or a recipe may be another one.
    std::uint32_t edition() const { return edition_; }
    static constexpr std::size_t kKeptChanges = 16;
    std::uint32_t changes() const { return changes_; }
    const Change& change(std::size_t age) const { return ring_[(changes_ - 1U - age) % kKeptChanges]; }
    /// How many of them are of the record in use, and kept.
    std::size_t shown_changes() const {
        return std::min<std::size_t>(changes_ - first_change_, kKeptChanges);
    }
    const registers::set_points::Record& record() const { return record_; }

    // ValueSource
    bool has_change(std::uint8_t step) const override;
    std::optional<sequencer::MotorOrder> take(std::uint8_t step) override;

  private:
    using Values = std::array<std::int32_t, registers::set_points::kMost>;
    struct Request {
        SetPointRequest kind{};
        Origin origin{};
        std::uint8_t recipe = 0;
        std::uint16_t mask = 0;
        std::uint16_t dropped = 0;  ///< of a recipe, as of find_values()
        std::span<const std::uint8_t> name;
        std::span<const std::uint8_t> values;
        std::span<const std::uint8_t> units;
    };

    CommandResult read_request(std::span<const std::uint8_t> bytes, Request& request);
    CommandResult check_values(const Request& request) const;
    CommandResult find_recipe(Request& request, bool saves);
    void prepare(Request& request);
    CommandResult begin_request(std::span<const std::uint8_t> bytes, Origin origin);
    void load_recipe(std::uint8_t number);
    void keep(store::ValueSet set, const Values& values) const;
    bool motor_takes(const registers::set_points::Entry& entry, std::int32_t value) const;
    std::uint16_t find_values(store::ValueSet set, Values& values) const;
    void end_request();
    void finish_request();
    void note_changes();
    void take_all();
    void patch(std::size_t index);
    std::uint32_t state_word();
    bool differs_from_recipe();
    void view_changes(std::size_t offset, std::span<std::uint8_t> out) const;

    Gateway& gateway_;
    bool available_;
    bool damaged_ = false;
    bool saving_ = false;
    std::uint32_t pointer_ = 0;
    bool is_for_other_table_ = false;  ///< the table was exchanged since the request was taken
    std::uint16_t to_write_ = 0;       ///< a bit each: changed, and POWER_UP writes it
    std::uint16_t dropped_ = 0;        ///< to be logged
    Request request_;
    /// The last ones, refused or not; that of number n at n % kKeptRequests. In memory as they are read.
    struct Asked {
        std::uint32_t own_number = 0;
        Progress outcome;
    };
    static_assert(sizeof(Asked) == 8 && std::endian::native == std::endian::little);
    std::array<Asked, registers::gateway::kKeptRequests> asked_{};
    std::uint32_t last_asked_ = 0;
    std::span<std::uint8_t> table_;
    registers::set_points::Record record_;
    std::uint32_t record_crc_ = 0;
    std::uint32_t changes_ = 0;
    std::uint32_t changed_record_ = 0;  ///< whose values changes are shown of
    std::uint32_t first_change_ = 0;    ///< those before it are of another record
    std::uint32_t edition_ = 0;
    Values in_force_{};
    Values wanted_{};
    Values after_{};  ///< what is wanted once the request is stored
    std::array<Change, kKeptChanges> ring_{};
    store::SetPointStore store_;
};

/// In the place of SetPoints in a firmware that has none.
struct NoSetPoints {
    NoSetPoints(Gateway&, ports::Storage&, const store::Area*) {}
    static constexpr bool kIsThere = false;
    static constexpr std::size_t kRecordMemory = 0;
    static void mount() {}
    static constexpr bool were_damaged() { return false; }
    static constexpr std::size_t record_bytes(std::span<const std::uint8_t>) { return 0; }
    static constexpr bool is_sound(std::span<const std::uint8_t>, std::span<const std::uint8_t>) {
        return true;
    }
    static void use(std::span<std::uint8_t>, std::span<const std::uint8_t>) {}
    static void show_defaults(std::span<std::uint8_t>, std::size_t) {}
    struct Writer {
        Writer() = default;
        Writer(Origin, base::Instant) {}
        static constexpr std::uint32_t request = 0;
    };
    static Progress serve(const Writer&, std::span<const std::uint8_t>, base::Instant) {
        return CommandResult{Result::no_register};
    }
    static constexpr base::Microseconds kLongestWait{};
    static constexpr bool stores() { return false; }
    static constexpr std::uint32_t pointer() { return 0; }
    static void point_at(std::uint32_t) {}
    static void read_window(std::span<std::uint8_t>) {}
    static void poll() {}
    static base::Instant next_poll(base::Instant) { return base::kNever; }
    static std::uint32_t value(std::uint8_t) { return 0; }
};

#if NPLC_SET_POINTS
using SetPointsPart = SetPoints;
#else
using SetPointsPart = NoSetPoints;
#endif

}  // namespace nplc::gateway
