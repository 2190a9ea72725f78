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

/// Where the names of a table are kept. Called on the panel's thread.
class SymbolShelf {
  public:
    struct Found {
        std::string file{};  ///< what the table was made of, or its own name; for people
        std::string text{};  ///< as `seqc build` writes F.sym; empty: none
    };
    virtual Found find(std::size_t axis, std::uint32_t crc) = 0;
    /// Names that came with an upload. Empty, or one line why they are not kept.
    virtual std::string keep(std::size_t axis, std::uint32_t crc, std::string_view text) = 0;

  protected:
    ~SymbolShelf() = default;
};

struct PanelAxis {
    faces::AxisModel* model = nullptr;
    std::string motor{};  ///< its model's name, MAC140 or MAC34-1; empty: as the settings tell
};

struct PanelOptions {
    WebOptions web{};
    std::string program;   ///< name and version, for people
    std::string token;     ///< who has it may operate; empty: one is made and printed at the start
    std::string password;  ///< must be given before anything is shown; empty: nobody needs one
};

/// The panel: a page, and the wire behind it (PROTOCOL.md), on a thread of its own. The axes' loops feel
/// nothing of it but the images that they take for it.
class Panel {
  public:
    struct Opened {
        std::unique_ptr<Panel> panel;
        std::string error;  ///< one line, if there is no panel
    };
    /// Listens; nobody is answered before start(). Beyond this machine it is refused without a password and
    /// a token. Before the axes' loops begin. `symbols` and `simulation` may be null.
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

/// 24 letters and digits from the system's source of chance.
std::string make_token();

}  // namespace nplc::panel
