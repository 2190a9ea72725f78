#pragma once

#include <memory>
#include <string>
#include <vector>

#include "axis.h"
#include "commissioned.h"
#include "config.h"
#include "hal_linux/steady_clock.h"
#include "hal_linux/watchdog.h"
#include "panel_part.h"
#include "plant_part.h"

namespace nplc::boards {

/// A watchdog shared by several scans: feeds the real one only when all of them have fed since the last time.
class CommonWatchdog {
  public:
    explicit CommonWatchdog(std::vector<ports::Watchdog*> targets) : targets_(std::move(targets)) {}
    /// One per axis; to be called before the first of them is fed.
    ports::Watchdog& add();

  private:
    struct Part final : ports::Watchdog {
        explicit Part(CommonWatchdog& whole) : whole_(whole) {}
        void feed() override;
        CommonWatchdog& whole_;
        bool fed_ = false;
    };
    void look();

    std::vector<ports::Watchdog*> targets_;
    std::vector<std::unique_ptr<Part>> parts_;
};

/// The process: axes, their event loop, signals, watchdogs. `run` returns the exit code.
class Service {
  public:
    Service(const Config& config, Journal& journal)
        : config_(config),
          journal_(journal),
          commissioned_(config.state_directory),
          panel_(config, journal),
          plant_(config, journal) {}
    ~Service();
    Service(const Service&) = delete;
    Service& operator=(const Service&) = delete;

    int run();

  private:
    std::string open();
    void set_up_real_time();
    void serve_until_signal();
    void end_in_order();
    void wait_and_serve(base::Instant latest);
    void show_status();
    void tell_of_list();
    base::Instant wanted_by_watchdog() const;

    const Config& config_;
    Journal& journal_;
    hal_linux::SteadyClock clock_;
    std::unique_ptr<hal_linux::EventLoop> loop_;
    std::unique_ptr<hal_linux::ServiceWatchdog> service_;
    std::unique_ptr<hal_linux::DeviceWatchdog> device_;
    std::unique_ptr<CommonWatchdog> watchdog_;
    CommissionedAxes commissioned_;
    std::vector<std::unique_ptr<Axis>> axes_;
    PanelPart panel_;  ///< ends before the axes
    PlantPart plant_;  ///< likewise
    std::vector<base::Instant> next_;
    std::optional<base::Microseconds> watchdog_time_;
    base::Instant all_served_{};
    std::string shown_status_;
};

}  // namespace nplc::boards
