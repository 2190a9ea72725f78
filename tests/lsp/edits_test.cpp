#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "lsp/server.h"

/// A server's view after edits is that after opening the text again.
namespace nplc::seqc::lsp {
namespace {

std::string text_of(const Json& message) {
    return message.dump(-1, ' ', false, Json::error_handler_t::replace);
}

class Session {
  public:
    explicit Session(std::string uri)
        : uri_(std::move(uri)), server_([this](const Json& message) {
              if (message.contains("method"))
                  told_ = message;
              else
                  answer_ = message;
          }) {
        request("initialize", {{"capabilities", {{"general", {{"positionEncodings", {"utf-8"}}}}}}});
    }

    void open(const std::string& text) {
        notify("textDocument/didOpen",
               {{"textDocument", {{"uri", uri_}, {"languageId", "seqc"}, {"version", 1}, {"text", text}}}});
    }
    void change(Json change) {
        notify("textDocument/didChange",
               {{"textDocument", {{"uri", uri_}, {"version", 1}}}, {"contentChanges", {std::move(change)}}});
    }
    Json request(const std::string& method, const Json& params) {
        server_.receive({{"jsonrpc", "2.0"}, {"id", 1}, {"method", method}, {"params", params}});
        return answer_;
    }
    /// Everything that can be asked without a place, and what some places answer.
    std::string view(const std::vector<Json>& places) {
        server_.catch_up();
        std::string all = text_of(told_);
        const Json whole = {{"start", {{"line", 0}, {"character", 0}}},
                            {"end", {{"line", 100000}, {"character", 0}}}};
        const Json document = {{"textDocument", {{"uri", uri_}}},
                               {"range", whole},
                               {"context", {{"diagnostics", Json::array()}}},
                               {"positions", places}};
        for (const char* method : {"documentSymbol", "foldingRange", "semanticTokens/full", "inlayHint",
                                   "codeLens", "formatting", "codeAction", "selectionRange"})
            all += text_of(request(std::string("textDocument/") + method, document)) + "\n";
        for (const Json& place : places) {
            for (const char* method : {"hover", "completion", "definition", "references", "signatureHelp",
                                       "onTypeFormatting", "documentHighlight", "prepareRename"}) {
                all += text_of(request(std::string("textDocument/") + method,
                                       {{"textDocument", {{"uri", uri_}}}, {"position", place}})) +
                       "\n";
            }
        }
        return all;
    }

  private:
    void notify(const std::string& method, const Json& params) {
        server_.receive({{"jsonrpc", "2.0"}, {"method", method}, {"params", params}});
    }

    std::string uri_;
    Json told_;
    Json answer_;
    Server server_;
};

struct Example {
    std::string uri;
    std::string text;
};

/// Programs, scenarios beside their programs, and a program's properties as a file of their own.
std::vector<Example> examples() {
    std::vector<Example> list;
    for (const auto& entry : std::filesystem::directory_iterator(SEQC_EXAMPLES)) {
        const std::string ending = entry.path().extension();
        if (ending != ".seq" && ending != ".scn") continue;
        std::ifstream file(entry.path());
        std::ostringstream text;
        text << file.rdbuf();
        list.push_back({"file://" + entry.path().string(), text.str()});
        if (ending == ".seq") list.back().uri = "file:///nowhere/machine.seq";
    }
    const std::string beside = std::string("file://") + SEQC_EXAMPLES;
    list.push_back({beside + "/pick_and_place.prop",
                    "// What must hold\nPROPERTY A: NEVER Grip AND STEP = Idle;\n"
                    "PROPERTY B: WHENEVER Start THEN Lamp WITHIN T#20ms;\nPROPERTY C: NEVER Gripp;\n"});
    return list;
}

using Random = std::mt19937;

std::size_t below(Random& random, std::size_t bound) {
    return std::uniform_int_distribution<std::size_t>(0, bound == 0 ? 0 : bound - 1)(random);
}

/// What a person types, pastes or breaks.
std::string insertion(Random& random, const std::string& text) {
    static const std::vector<std::string> kPieces = {";",
                                                     ":",
                                                     ":=",
                                                     "(",
                                                     ")",
                                                     "\n",
                                                     "    ",
                                                     "IF ",
                                                     "END_IF",
                                                     "THEN ",
                                                     "STEP X:\n",
                                                     "END_STEP\n",
                                                     "(*",
                                                     "*)",
                                                     "//",
                                                     "'",
                                                     "T#",
                                                     "%IX0.",
                                                     "16#",
                                                     "NEXT := ",
                                                     "a",
                                                     "\xC3\xA9",
                                                     "\xF0\x9F\x98\x80",
                                                     "\xFF",
                                                     "\r\n",
                                                     "\r",
                                                     "\t",
                                                     "OUT ",
                                                     "PROPERTY P: NEVER ",
                                                     "VAR_MOTOR\n",
                                                     "END_PROGRAM\n",
                                                     std::string(1, '\0'),
                                                     "999999999999999999999",
                                                     "TIMER."};
    if (below(random, 3) != 0) return kPieces[below(random, kPieces.size())];
    const std::size_t from = below(random, text.size());
    return text.substr(from, below(random, 60));
}

TEST(Edits, LeaveWhatOpeningAnewGives) {
    const char* wanted = std::getenv("NPLC_LSP_EDITS");
    const std::size_t edits = wanted == nullptr ? 600 : std::strtoull(wanted, nullptr, 10);
    constexpr std::size_t kBurst = 25;
    const unsigned seed = 20'261'125;
    Random random(seed);
    const std::vector<Example> list = examples();
    ASSERT_FALSE(list.empty());
    std::size_t done = 0;
    while (done < edits) {
        const Example& example = list[below(random, list.size())];
        std::string text = example.text;
        Session session(example.uri);
        session.open(text);
        for (std::size_t burst = 0; burst < 8 && done < edits; ++burst) {
            for (std::size_t i = 0; i < kBurst; ++i, ++done) {
                const std::size_t from = below(random, text.size() + 1);
                const std::size_t length =
                    below(random, 3) == 0 ? std::min(below(random, 40), text.size() - from) : 0;
                const std::string inserted = below(random, 4) == 0 ? "" : insertion(random, text);
                const analysis::Lines lines(text);
                const auto begin = static_cast<std::uint32_t>(from);
                const analysis::Place start = lines.place_of(begin, analysis::Encoding::utf8);
                const analysis::Place end =
                    lines.place_of(begin + static_cast<std::uint32_t>(length), analysis::Encoding::utf8);
                const std::uint32_t at = lines.offset_of(start, analysis::Encoding::utf8);
                const std::uint32_t to = std::max(at, lines.offset_of(end, analysis::Encoding::utf8));
                session.change({{"range",
                                 {{"start", {{"line", start.line}, {"character", start.character}}},
                                  {"end", {{"line", end.line}, {"character", end.character}}}}},
                                {"text", inserted}});
                text.replace(at, to - at, inserted);
            }
            std::vector<Json> places;
            const analysis::Lines lines(text);
            for (int i = 0; i < 3; ++i) {
                const auto place = lines.place_of(static_cast<std::uint32_t>(below(random, text.size() + 1)),
                                                  analysis::Encoding::utf8);
                places.push_back({{"line", place.line}, {"character", place.character}});
            }
            Session anew(example.uri);
            anew.open(text);
            ASSERT_EQ(session.view(places), anew.view(places))
                << "seed " << seed << ", after " << done << " edits:\n"
                << text;
        }
    }
}

}  // namespace
}  // namespace nplc::seqc::lsp
