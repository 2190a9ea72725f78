#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "faces/axis_model.h"
#include "modbus/map.h"
#include "modbus/set_point_words.h"
#include "protocol/modbus_pdu.h"

namespace nplc::modbus {

enum class Silence : std::uint8_t { nothing, stop, safe };

struct Settings {
    std::vector<std::uint8_t> units{};  ///< of each axis, unique; missing or 0: by the axis's place
    bool low_word_first = false;        ///< word order of two-register values
    bool writes = true;                 ///< false: only stop, safe and hold
    /// Reaction when the operating master is silent for `silence`, or has disconnected.
    Silence on_silence = Silence::nothing;
    base::Milliseconds silence{5'000};
    /// Says why the machine of an axis is stopped for a silent master. From the face's thread.
    std::function<void(const std::string& axis, const std::string& text)> tell{};
};

/// Unit of the axis at `index`: its own, or that of the first axis plus `index`.
constexpr std::uint8_t unit_of(const Settings& settings, std::size_t index, std::uint8_t first) {
    const bool is_fixed = index < settings.units.size() && settings.units[index] != 0;
    return is_fixed ? settings.units[index] : static_cast<std::uint8_t>(first + index);
}

/// What the clients of one address have written, and how their last command ended.
struct Handshake {
    std::string address;
    // Until command_number was written as 0 since the start, nothing is carried out: a master that writes its
    // block cyclically must not start a machine after a restart of the gateway.
    bool is_armed = false;
    std::uint16_t command = 0;
    std::uint16_t number = 0;
    std::uint16_t done_number = 0;
    std::uint16_t result = 0;
    std::uint16_t detail = 0;
    std::uint16_t recipe = 0;  ///< for kLoadRecipe

    std::uint8_t coils = 0;           ///< as written last
    std::uint8_t coils_were_off = 0;  ///< written as 0 since the start
    std::uint64_t used = 0;
};

/// An axis as a slave: the state shared by its clients. Used by the server's thread.
class Unit {
  public:
    static constexpr std::size_t kMostAddresses = 64;

    Unit(faces::AxisModel& axis, const Settings& common, std::uint8_t unit = 1)
        : model(axis), settings(common), number(unit) {}

    faces::AxisModel& model;
    const Settings& settings;
    const std::uint8_t number;

    /// Of more than kMostAddresses the one that was used the longest ago begins anew, and is not armed. Valid
    /// until the next call.
    Handshake& handshake(const std::string& address);

    /// After a start of the gateway in the same process what was written before it counts no more.
    void follow_start(const faces::AxisImage& image);

    std::uint32_t acknowledged = 0;  ///< of event_count

    std::uint64_t master = 0;   ///< the last operating session; 0: none
    std::string master_name{};  ///< its name
    base::Instant heard{};      ///< last request from it

    /// The command for on_silence that is due; once, and told.
    std::optional<faces::Command> due(base::Instant now);

  private:
    std::vector<Handshake> handshakes_;
    std::uint64_t uses_ = 0;
    std::uint64_t restarts_ = 0;  ///< seen
};

/// Time of a request, and the limit of its age.
struct Moment {
    base::Instant now{};
    base::Instant
        arrived{};  ///< it arrived later than this; a command that may be older than 1 s is too_late
};

/// One client. A request is answered at once, or after the axis's loop has carried it out; only then the next
/// one is handled.
class Session {
  public:
    /// A command that takes longer is answered, and done_number says when it has ended.
    static constexpr base::Milliseconds kLongestAnswer{1'000};

    /// Clients with the same `name` share a handshake.
    Session(std::vector<std::unique_ptr<Unit>>& units, std::string name, faces::Bell& bell);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// `number` is that of a unit; 0 and 255 too are a single axis's. Empty: take() returns the answer later.
    std::optional<Answer> serve(std::uint8_t number, std::span<const std::uint8_t> pdu, const Moment& moment);
    std::uint64_t number() const { return number_; }
    bool is_waiting() const { return waiting_.has_value(); }
    std::optional<Answer> take(base::Instant now);
    /// Whether a request is a write of stop, safe or hold, for which no other one may wait.
    static bool asks_stop(std::span<const std::uint8_t> pdu);
    /// Answers the request in progress for the next one; its commands go on.
    Answer put_aside();

  private:
    struct Waiting {
        Request request{};
        std::size_t index = 0;
        bool is_handshake = false;
        bool has_number = false;   ///< of a handshake; false: a stop without one
        std::uint16_t number = 0;  ///< command_number
        bool takes_set_points = false;
        bool operates = false;
        base::Instant begun{};
        bool is_whole = false;  ///< all of its commands were accepted
        std::vector<std::uint32_t> ids{};
        std::vector<faces::Completion> ended{};
    };
    /// The data for answering a request.
    struct Look {
        Unit& unit;
        std::size_t index;
        faces::AxisImage image;
        std::shared_ptr<const faces::SetPointBook> book;
        std::shared_ptr<const faces::Findings> why;  ///< null: not requested or unknown
        base::Instant now;
        base::Instant arrived;
    };

    /// What this client itself has written, so that repeating it is nothing new whatever others write.
    struct Written {
        std::optional<std::uint16_t> number{};
        std::uint8_t coils = 0;
    };

    static SetPointLook set_points_of(const Look& look);
    /// The axis's data are stale.
    static bool is_old(const Look& look);

    Unit* find(std::uint8_t unit);
    Handshake& handshake_of(Unit& unit) const { return unit.handshake(name_); }
    Answer read(const Look& look, const Request& request);
    Exception put(const Look& look, Space space, std::uint16_t address, Answer& answer) const;
    static Word why_word(const Look& look, std::uint16_t address);
    faces::PointValue status_word(const Look& look) const;
    std::optional<Word> own_word(const Look& look, std::uint16_t address) const;
    std::optional<std::uint16_t> own_value(const Look& look, std::uint16_t address) const;
    Word holding_word(const Look& look, std::uint16_t address) const;

    std::optional<Answer> write_coils(const Look& look, const Request& request);
    std::optional<Answer> write_holding(const Look& look, const Request& request);
    void stage(const Look& look, const Request& request);
    std::optional<faces::Command> handshake(const Look& look, const Request& request);
    std::optional<faces::Command> ordered(const Look& look, Handshake& shake);
    static std::optional<faces::Command> end_handshake(Handshake& shake, faces::Result result);
    std::optional<Answer> use_window(const Look& look, const Request& request);
    std::optional<Answer> begin(const Look& look, const Request& request,
                                const std::vector<faces::Command>& commands, bool is_handshake);
    void take_ended(base::Instant now);
    /// Enters how a handshake ended, unless a newer command has begun.
    void enter(const Waiting& waiting);
    /// Who was refused operates nothing, and nobody waits for its silence.
    void note_master(const Waiting& waiting, base::Instant now);
    Answer finished();
    Answer window_answer(const Unit& unit) const;

    std::vector<std::unique_ptr<Unit>>& units_;
    std::string name_;
    faces::Bell& bell_;
    std::uint64_t number_ = faces::Seat::new_number();
    std::vector<std::unique_ptr<faces::CommandDesk::Client>> clients_;  ///< for each unit; null: not yet
    std::vector<StagedSetPoints> staged_;                               ///< for each unit
    std::vector<Written> written_;                                      ///< for each unit
    std::optional<Waiting> waiting_;
    std::optional<Waiting> aside_;              ///< a handshake whose request was answered before its end
    std::array<std::uint8_t, kMostPdu> pdu_{};  ///< the request in progress
    std::size_t size_ = 0;
};

}  // namespace nplc::modbus
