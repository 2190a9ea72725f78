#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>

#include "panel/panel.h"
#include "set_point_feed.h"

namespace nplc::panel {

/// An entry of an axis's event log, as stored by the panel.
struct LoggedEvent {
    std::uint64_t number = 0;  ///< from 1 on, of this process
    std::uint32_t milliseconds = 0;
    std::uint8_t code = 0;
    std::uint8_t step = 0;
    std::uint16_t detail = 0;
    std::string text{};
};

/// The panel's data of one axis: its last image, its events, its table with names, each in the text form of
/// the protocol.
class AxisFeed {
  public:
    AxisFeed(const PanelAxis& axis, std::size_t index, SymbolShelf* symbols)
        : model_(*axis.model), motor_(axis.motor), index_(index), symbols_(symbols) {}

    /// Checks for changes.
    void look(base::Instant now);

    faces::AxisModel& model() { return model_; }
    const std::string& name() const { return model_.name(); }
    const faces::AxisImage& image() const { return image_; }
    std::uint32_t age(base::Instant now) const;  ///< of the image, ms
    /// Increases with each new table, or new names.
    std::uint32_t program_number() const { return program_number_; }
    const std::string& program_text() const { return program_text_; }
    /// Increases with each change of values or recipes.
    std::uint32_t set_points_number() const { return set_points_number_; }
    const SetPointFeed& set_points() const { return set_points_; }
    /// Increases with each change of the causes of a standstill.
    std::uint32_t why_number() const { return why_number_; }
    const std::string& why_text() const { return why_text_; }
    /// The names on the shelf may have changed.
    void read_names_anew() { has_program_ = false; }

    /// All registers, or the differences to `before`. Empty: nothing to send now.
    std::string image_text(const faces::AxisImage* before, bool slow_too, base::Instant now) const;
    std::uint64_t last_event() const { return last_event_; }
    std::string events_text(std::uint64_t after) const;
    /// The axis's metadata for a client: a member of `hello`.
    std::string info_text() const;

  private:
    void take_events();
    std::string event_text(const LoggedEvent& event);
    void take_why(const std::shared_ptr<const faces::Findings>& why);
    void take_program();

    faces::AxisModel& model_;
    std::string motor_;
    std::size_t index_;
    SymbolShelf* symbols_;
    faces::AxisImage image_;
    std::deque<LoggedEvent> events_;
    std::uint64_t last_event_ = 0;
    std::uint32_t log_count_ = 0;
    std::uint64_t restarts_ = 0;
    std::shared_ptr<const faces::AxisTable> table_;
    std::shared_ptr<const faces::Findings> why_;
    std::string why_text_;
    std::uint32_t why_number_ = 0;
    SetPointFeed set_points_;
    std::uint32_t set_points_number_ = 0;
    bool has_program_ = false;
    std::uint32_t program_number_ = 0;
    std::string program_text_;
};

/// `table activated`, with the meaning of the detail.
std::string event_in_words(std::uint8_t code, std::uint16_t detail);

}  // namespace nplc::panel
