#include "lsp/server.h"

#include <gtest/gtest.h>

#include <sstream>

#include "lsp/scenario_words.h"
#include "rpc/message.h"

namespace nplc::seqc::lsp {
namespace {

TEST(Rpc, ReadsWhatItWrites) {
    std::stringstream stream;
    rpc::write_message(stream, {{"a", "\xC3\xA9"}});
    rpc::write_message(stream, {{"b", 2}});
    EXPECT_EQ(rpc::read_message(stream).message, (Json{{"a", "\xC3\xA9"}}));
    EXPECT_EQ(rpc::read_message(stream).message, (Json{{"b", 2}}));
    EXPECT_EQ(rpc::read_message(stream).kind, rpc::Incoming::Kind::end);
}

TEST(Rpc, TakesFurtherHeadersInAnyCase) {
    std::istringstream stream("content-type: x\r\nCONTENT-LENGTH: 2\r\n\r\n{}");
    EXPECT_EQ(rpc::read_message(stream).kind, rpc::Incoming::Kind::message);
}

TEST(Rpc, ReadsOverWhatIsNoJson) {
    std::istringstream stream("Content-Length: 2\r\n\r\n}{Content-Length: 2\r\n\r\n{}");
    EXPECT_EQ(rpc::read_message(stream).kind, rpc::Incoming::Kind::malformed);
    EXPECT_EQ(rpc::read_message(stream).kind, rpc::Incoming::Kind::message);
}

// Identities and arguments are copied by functions that call themselves.
TEST(Rpc, ReadsOverWhatIsTooDeep) {
    const auto deep = [](std::size_t depth) {
        const std::string content = R"({"id":)" + std::string(depth, '[') + std::string(depth, ']') + "}";
        return "Content-Length: " + std::to_string(content.size()) + "\r\n\r\n" + content;
    };
    std::istringstream stream(deep(500'000) + deep(rpc::kDeepestMessage) + deep(rpc::kDeepestMessage - 1));
    EXPECT_EQ(rpc::read_message(stream).problem,
              "the content's lists and objects lie more than 100 deep in each other");
    EXPECT_EQ(rpc::read_message(stream).kind, rpc::Incoming::Kind::malformed);
    EXPECT_EQ(rpc::read_message(stream).kind, rpc::Incoming::Kind::message);
}

TEST(Rpc, EndsInTheMiddleOfAMessage) {
    std::istringstream stream("Content-Length: 20\r\n\r\n{}");
    EXPECT_EQ(rpc::read_message(stream).kind, rpc::Incoming::Kind::end);
}

TEST(Uri, IsThePathAndBack) {
    EXPECT_EQ(path_of_uri("file:///a%20b/%C3%A9.seq"), "/a b/\xC3\xA9.seq");
    EXPECT_EQ(uri_of_path("/a b/\xC3\xA9.seq"), "file:///a%20b/%C3%A9.seq");
    EXPECT_EQ(path_of_uri("file:///C:/x.seq"), "C:/x.seq");
    EXPECT_EQ(path_of_uri("untitled:Untitled-1"), "");
}

TEST(Words, AreThoseOutsideOfCommentsAndTexts) {
    const auto words =
        words_of("at 1 s Start := 1 # Start\nlog \"Start\"\nexpect step = Work and Start // Work\n");
    std::string steps;
    int starts = 0;
    for (const Word& word : words) {
        if (word.is_step) steps += word.text;
        if (word.text == "Start") ++starts;
    }
    EXPECT_EQ(steps, "Work");
    EXPECT_EQ(starts, 2);
}

TEST(Words, EndWithAnyText) {
    for (const char* text : {"(*", "\"", "'", "#", "/", "(", "1.5x", "step ="})
        EXPECT_LE(words_of(text).size(), 1U);
}

}  // namespace
}  // namespace nplc::seqc::lsp
