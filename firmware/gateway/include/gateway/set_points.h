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

/// The set-points of the active table: the values in force, which are in its terms; the wanted values, which
/// are stored and take effect at the next permitted point of the sequence; and the recipes. Without a working
/// store the defaults apply and nothing can be changed. See SET_POINTS.md.
class SetPoints final : public ValueSource {
  public:
    /// `area`: null on a board without storage for set-points.
    SetPoints(Gateway& gateway, ports::Storage& storage, const store::Area* area);
    SetPoints(const SetPoints&) = delete;
    SetPoints& operator=(const SetPoints&) = delete;

    static constexpr bool kIsThere = true;
    static constexpr std::size_t kRecordMemory = registers::set_points::kMostRecordBytes;

    /// For the start-up: reads the store.
    void mount();
    /// The stored values are damaged: a table with set-points does not start automatically.
    bool were_damaged() const { return damaged_; }
    /// Length of the record at the start of `behind_end_term`; 0: none.
    static std::size_t record_bytes(std::span<const std::uint8_t> behind_end_term) {
        return registers::set_points::record_bytes(behind_end_term);
    }
    static bool is_sound(std::span<const std::uint8_t> record, std::span<const std::uint8_t> table) {
        return registers::set_points::is_sound(record, table);
    }
    /// Sets the active table, whose bytes get the values in force, and its record; empty: the table has none.
    /// Only while stopped.
    void use(std::span<std::uint8_t> table, std::span<const std::uint8_t> record);
    /// Restores the defaults in a copy of a part of the table that begins at byte `offset`.
    void show_defaults(std::span<std::uint8_t> part, std::size_t offset) const;

    /// A client's write to SET_POINT_WRITE, from its start to its end.
    struct Writer {
        Origin origin{};
        base::Instant since{};
        std::uint32_t request = 0;  ///< 0: not begun
        void begin(Origin who, base::Instant now) {
            origin = who;
            since = now;
            request = 0;
        }
    };
    /// One request at a time is stored, and a request that has begun is completed even if its client no
    /// longer waits. `bytes` must stay valid until it has begun; if it cannot begin within kLongestWait it
    /// ends with `busy`, afterwards only its real outcome counts. A request repeated with the same number is
    /// not carried out twice.
    PendingResult serve(Writer& writer, std::span<const std::uint8_t> bytes, base::Instant now);
    static constexpr base::Microseconds kLongestWait{1'000'000};
    bool stores() const { return saving_; }
    std::uint32_t pointer() const { return pointer_; }
    void point_at(std::uint32_t pointer) { pointer_ = pointer; }
    /// Reads the block at SET_POINT_POINTER: the pointer, then the data it points at.
    void read_window(std::span<std::uint8_t> out);

    void poll();
    base::Instant next_poll(base::Instant now) { return store_.next_poll(now); }

    /// Registers SET_POINT_COUNT to SET_POINT_BYTES, and the SET_POINT and SET_POINT_WANTED registers.
    std::uint32_t value(std::uint8_t reg);
    /// The data that SET_POINT_POINTER points at; 0 beyond its end.
    void read(std::uint32_t pointer, std::span<std::uint8_t> out);

    /// Of what happened, for journals: the `age`th last change, 0 the last one.
    /// In memory as they are read.
    struct Change {
        std::uint32_t milliseconds = 0;  ///< of uptime
        std::uint8_t index = 0;
        Origin origin{};
        std::uint8_t recipe = 0;  ///< that was loaded; 0: a value was set
        std::uint8_t unused = 0;
        std::int32_t before = 0;
        std::int32_t now = 0;
    };
    static_assert(sizeof(Change) == registers::gateway::kChangeBytes && sizeof(Origin) == 1);
    /// Another number whenever the record or a recipe may be another one.
    std::uint32_t edition() const { return edition_; }
    static constexpr std::size_t kKeptChanges = 16;
    std::uint32_t changes() const { return changes_; }
    const Change& change(std::size_t age) const { return ring_[(changes_ - 1U - age) % kKeptChanges]; }
    /// Number of stored changes that belong to the current record.
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
        std::uint16_t dropped = 0;  ///< when a recipe is loaded: result of find_values()
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
    bool is_for_other_table_ = false;  ///< the table was replaced after the request was accepted
    std::uint16_t to_write_ = 0;       ///< bit mask: changed values that POWER_UP writes
    std::uint16_t dropped_ = 0;        ///< still to be logged
    Request request_;
    /// The last requests, refused ones included; number n is at n % kKeptRequests. Clients read this memory
    /// as it is.
    struct Asked {
        std::uint32_t own_number = 0;
        PendingResult outcome;
    };
    static_assert(sizeof(Asked) == 8 && std::endian::native == std::endian::little);
    std::array<Asked, registers::gateway::kKeptRequests> asked_{};
    std::uint32_t last_asked_ = 0;
    std::span<std::uint8_t> table_;
    registers::set_points::Record record_;
    std::uint32_t record_crc_ = 0;
    std::uint32_t changes_ = 0;
    std::uint32_t changed_record_ = 0;  ///< the record that `ring_` belongs to
    std::uint32_t first_change_ = 0;    ///< older changes belong to another record
    std::uint32_t edition_ = 0;
    Values in_force_{};
    Values wanted_{};
    Values after_;  ///< what is wanted once the request is stored
    std::array<Change, kKeptChanges> ring_{};
    store::SetPointStore store_;
};

/// Replaces SetPoints in a firmware without set-points.
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
        static void begin(Origin, base::Instant) {}
        static constexpr std::uint32_t request = 0;
    };
    static PendingResult serve(const Writer&, std::span<const std::uint8_t>, base::Instant) {
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
