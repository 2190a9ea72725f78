#pragma once

#include <functional>
#include <map>
#include <string>

#include "lsp/workspace.h"

/// The request handlers of the server, one function for each request of the protocol.
namespace nplc::seqc::lsp {

using Handler = Json (*)(Workspace& workspace, const Json& params);
using Handlers = std::map<std::string, Handler, std::less<>>;

void add_navigation(Handlers& handlers);  ///< definition, references, highlights, rename, symbols
void add_display(Handlers& handlers);     ///< hover, colours, hints, folding, selection, lenses
void add_editing(Handlers& handlers);     ///< completion, signatures, formatting, quick fixes

/// All diagnostics of a text and of the files that it includes, by URI.
std::map<std::string, Json> diagnostics_of(Workspace& workspace, const Document& document);

/// A code lens: a line above the text that triggers a client command.
Json lens_json(const Json& range, const std::string& title, const std::string& command, Json arguments);

/// The names of colours_of's types, in their order.
Json token_types();

/// A document, its program and the place of a request.
struct At {
    At(Workspace& workspace, const Json& params);
    Document& document;
    View view;
    std::uint32_t offset = 0;
    const analysis::Program& program() const;
};

}  // namespace nplc::seqc::lsp
