#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "faces/axis_model.h"
#include "panel/simulation.h"
#include "panel/web_server.h"

namespace nplc::panel {

/// Storage for the names of tables. Called on the panel's thread.
class SymbolShelf {
  public:
    struct Found {
        std::string file{};  ///< the table's source, or its own name; for display
        std::string text{};  ///< content of F.sym as written by `seqc build`; empty: none
    };
    virtual Found find(std::size_t axis, std::uint32_t crc) = 0;
    /// Stores the names of an upload. Empty, or a one-line error.
    virtual std::string keep(std::size_t axis, std::uint32_t crc, std::string_view text) = 0;

  protected:
    ~SymbolShelf() = default;
};

struct PanelAxis {
    faces::AxisModel* model = nullptr;
    std::string motor{};  ///< its model's name, MAC140 or MAC34-1; empty: from the settings
};

struct PanelOptions {
    WebOptions web{};
    std::string program;   ///< name and version, for display
    std::string token;     ///< allows its owner to operate; empty: generated and printed at the start
    std::string password;  ///< required before anything is shown; empty: none required
};

/// The panel: a page and its protocol (PROTOCOL.md), on its own thread. The axes' loops only provide images
/// for it.
class Panel {
  public:
    struct Opened {
        std::unique_ptr<Panel> panel;
        std::string error;  ///< one line, if it cannot be started
    };
    /// Listens; answers only after start(). Beyond this machine a password and a token are required. To be
    /// called before the axes' loops begin. `symbols` and `simulation` may be null.
    static Opened open(const PanelOptions& options, const std::vector<PanelAxis>& axes, SymbolShelf* symbols,
                       Simulation* simulation);
    ~Panel();
    Panel(const Panel&) = delete;
    Panel& operator=(const Panel&) = delete;

    void start();
    /// `http://127.0.0.1:8080/`
    std::string url() const;
    const std::string& token() const;

  private:
    struct Parts;
    explicit Panel(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

/// 24 letters and digits from the system's random number generator.
std::string make_token();

}  // namespace nplc::panel
