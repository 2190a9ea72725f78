#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "faces/image.h"
#include "faces/why_keeper.h"
#include "gateway/controller.h"

namespace nplc::faces {

/// Accesses one motor register at a time, between the sequence's orders: for a face's request, else the
/// values of AxisImage in turns. Shares the motor with the user port, which has the larger part. A read that
/// an activation interrupts is repeated.
class MotorReader {
  public:
    explicit MotorReader(base::Microseconds period) : period_(period) {}

    enum class State : std::uint8_t { under_way, done, failed };

    /// Begins an access for a face.
    void begin(const motor::Access& access);
    State poll(gateway::Controller& controller, base::Instant now);
    std::uint32_t value() const { return value_; }
    /// The face no longer waits for it.
    void drop(gateway::Controller& controller);
    /// Latest time of the next poll() for the access.
    base::Instant next(const gateway::Controller& controller, base::Instant now) const;

    /// Reads the image's values when due, with `has_trend` the torque as often as position and velocity. Not
    /// during a face's access.
    void look_around(gateway::Controller& controller, AxisImage& image, base::Instant now, base::Instant wall,
                     bool has_trend);
    /// Reads the values for the analysis of causes, between the image's values.
    void begin_survey(registers::Model model);
    bool surveys() const { return !to_survey_.empty(); }
    /// Returns the completed survey.
    std::optional<Survey> take_survey();
    /// The survey was given up since the last call: a register could not be read.
    bool take_survey_failure() { return std::exchange(survey_failed_, false); }
    bool is_for_face() const { return wanted_ && !item_ && surveyed_ == nullptr; }
    bool is_idle() const { return !wanted_; }
    /// The motor has a new driver.
    void forget();
    /// All is read anew, as at first.
    void hurry() { hurried_ = kHurried; }
    /// When look_around() has work to do, by the faces' clock.
    base::Instant due() const {
        if (period_.count() == 0) return base::kNever;
        return surveys() ? base::Instant{} : due_;
    }

  private:
    /// Items beside position and velocity.
    static constexpr unsigned kHurried = kMotorItems - 2;

    /// The driver's accesses that have ended.
    struct Ended {
        std::uint32_t done = 0;
        std::uint32_t failed = 0;
        bool operator==(const Ended&) const = default;
    };

    struct Last {
        base::Instant ended{};        ///< end of the previous access
        base::Instant port_waited{};  ///< the user port was seen to wait for the motor
    };

    State take(gateway::Controller& controller, base::Instant now);
    /// Since this one was begun, the first of which is this one.
    Ended ended_since(const gateway::Controller& controller) const;
    MotorItem next_other(registers::Model model);
    void choose_item(const AxisImage& image, bool has_trend);
    void choose_surveyed();
    void note_surveyed(base::Instant wall);
    void note_item(AxisImage& image, base::Instant wall);
    base::Microseconds pause(const gateway::Controller& controller, base::Instant now) const;

    base::Microseconds period_;
    std::optional<motor::Access> wanted_;
    std::optional<base::Instant> begun_;
    bool asked_ = false;
    std::uint8_t failures_ = 0;
    std::uint32_t value_ = 0;
    Ended before_{};  ///< when this access was begun
    Last last_;

    std::optional<MotorItem> item_;                      ///< for wanted_
    std::vector<const registers::Register*> to_survey_;  ///< remaining registers, the next one last
    const registers::Register* surveyed_ = nullptr;      ///< for wanted_
    std::size_t before_left_ = 0;                        ///< of to_survey_, for Survey::before
    Survey survey_;
    bool survey_ended_ = false;
    bool survey_failed_ = false;
    bool read_item_ = false;  ///< the read before was of an item
    unsigned turn_ = 0;
    unsigned other_ = static_cast<unsigned>(MotorItem::error_word);  ///< of the items read in turns
    unsigned hurried_ = kHurried;                                    ///< remaining reads of the first pass
    base::Instant due_{};
};

}  // namespace nplc::faces
