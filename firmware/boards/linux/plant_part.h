#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config.h"
#include "faces/axis_model.h"
#include "journal.h"

namespace nplc::boards {

/// The configured faces for `check-config`, one line each; empty: none.
std::vector<std::string> faces_in_words(const Config& config);

/// For `check-config`: the addresses of the plant that the package's service must be given first.
std::vector<std::string> closed_doors(const Config& config);

/// For `check-config` and the journal at the start: what works, but not as most want it.
std::vector<Mistake> plant_warnings(const Config& config);

/// For `check-config`: ports that need a right which the package's service does not have.
std::vector<Mistake> port_warnings(const Config& config);

/// The configured plant interfaces. A missing one stops no axis and is retried.
class PlantPart {
  public:
    PlantPart(const Config& config, Journal& journal) : config_(config), journal_(journal) {}

    /// To be called from the axes' loop before it begins. The axes must end after close().
    void open(faces::Axes axes, base::Instant now);
    /// Retries the missing ones.
    void look(base::Instant now);
    /// Latest time of the next look().
    base::Instant next() const { return again_; }
    void close() { faces_.clear(); }

  private:
    struct Face {
        std::string name;
        /// Returns the face, or null and an error.
        std::function<std::shared_ptr<void>(std::string& where, std::string& error)> open;
        std::shared_ptr<void> running{};
        bool was_told = false;
    };
    modbus::Settings telling(modbus::Settings settings);
    void add_modbus();
    void add_modbus_rtu();
    void add_metrics();
    void add_mqtt();

    const Config& config_;
    Journal& journal_;
    faces::Axes axes_;
    std::vector<Face> faces_;
    base::Instant again_ = base::kNever;
};

}  // namespace nplc::boards
