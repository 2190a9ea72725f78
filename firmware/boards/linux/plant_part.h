#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "config.h"
#include "faces/axis_model.h"
#include "journal.h"

namespace nplc::boards {

/// What `check-config` says of the faces that listen or go out, a line each; empty: none is configured.
std::vector<std::string> faces_in_words(const Config& config);

/// The faces towards the plant that the configuration names. One that cannot be had stops no axis: it is
/// tried again.
class PlantPart {
  public:
    PlantPart(const Config& config, Journal& journal) : config_(config), journal_(journal) {}

    /// From the axes' loop, before it begins. They must end after close().
    void open(faces::Axes axes, base::Instant now);
    /// Tries again what is missing.
    void look(base::Instant now);
    /// When look() is wanted.
    base::Instant next() const { return again_; }
    void close() { faces_.clear(); }

  private:
    struct Face {
        std::string name;
        /// The face, or why not.
        std::function<std::shared_ptr<void>(std::string& where, std::string& error)> open;
        std::shared_ptr<void> running{};
        bool was_told = false;
    };
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
