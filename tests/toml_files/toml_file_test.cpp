#include "toml_files/toml_file.h"

#include <gtest/gtest.h>

namespace nplc::toml_files {
namespace {

TEST(TomlFile, ValuesHaveTheirLines) {
    const File file = read_toml("# first\n[axis]\nname = \"a\"\nlist = [1, -2.5, true]\n");
    ASSERT_EQ(file.error, "");
    const Value* axis = file.root.find("axis");
    ASSERT_NE(axis, nullptr);
    ASSERT_NE(axis->find("name"), nullptr);
    EXPECT_EQ(axis->find("name")->text, "a");
    EXPECT_EQ(axis->find("name")->line, 3);
    const Value* list = axis->find("list");
    ASSERT_NE(list, nullptr);
    ASSERT_EQ(list->items.size(), 3U);
    EXPECT_EQ(list->items[0].kind, Value::Kind::integer);
    EXPECT_EQ(list->items[0].real, 1.0);
    EXPECT_EQ(list->items[1].kind, Value::Kind::real);
    EXPECT_EQ(list->items[1].real, -2.5);
    EXPECT_TRUE(list->items[2].boolean);
    EXPECT_EQ(axis->find("other"), nullptr);
}

TEST(TomlFile, WhatIsNotTomlHasALine) {
    const File file = read_toml("a = 1\nb =\n");
    EXPECT_EQ(file.line, 2);
    EXPECT_NE(file.error, "");
}

TEST(TomlFile, ALetterOutsideOfQuotesHasALine) {
    for (const char* text : {"a = 1\nb\xC3\xA4 = 2\n", "a = 1\n\xC3\xA4", "a = \"\"\nb = \xE2\x82\xAC"}) {
        const File file = read_toml(text);
        EXPECT_EQ(file.line, 2) << text;
        EXPECT_TRUE(file.error.starts_with("this is not TOML: ")) << file.error;
    }
    EXPECT_NE(read_toml("a = '''x'''''\n\xFF").error, "") << "no UTF-8";
}

// TOML 1.0: letters of any kind stand in comments and in the four kinds of quotes.
TEST(TomlFile, LettersInQuotesAndCommentsAreTaken) {
    for (const char* text : {"# \xC3\xA4\na = 1", "a = \"\xC3\xA4\"", "a = '\xC3\xA4'",
                             "a = \"\"\"\n\xC3\xA4 \" \xC3\xA4\"\"\"\"\"\nb = 1", "a = '''\n' \xC3\xA4'''''",
                             "\"\xC3\xA4\" = 1", "a = \"\\\" \xC3\xA4\"", "a = '\\' # \xC3\xA4\nb = 1",
                             "\xEF\xBB\xBF# \xC3\xA4", "a = \"\"  # \xC3\xA4"}) {
        EXPECT_EQ(read_toml(text).error, "") << text;
    }
}

// Found by tests/fuzz: toml++ took the letter behind the quote for a case that cannot be.
TEST(TomlFile, ALetterBehindAStrayQuoteIsRefused) {
    EXPECT_NE(read_toml("a=7e76=8[[re84('\xCA\x83$1").error, "");
    EXPECT_NE(read_toml("\xEF\xBB\xBF"
                        "88=[[re'\xC3\xA4")
                  .error,
              "");
}

std::string many(std::size_t count, const char* part) {
    std::string text;
    while (count-- > 0) text += part;
    return text;
}

// Tables in each other are built, read and freed by functions that call themselves.
TEST(TomlFile, WhatLiesTooDeepIsRefusedInItsLine) {
    constexpr std::size_t kMany = 50'000;
    const std::string texts[] = {
        "a = 1\nb" + many(kMany, ".b") + " = 1",
        "a = 1\n[b" + many(kMany, ".b") + "]",
        "a = 1\n[[b" + many(kMany, " . b") + "]]",
        "a = 1\nb" + many(kMany, ".\"b\"") + " = 1",
        "a = 1\nb = {b" + many(kMany, ".b") + " = 1}",
        "a = 1\nb = " + many(kMany, "["),
        "a = 1\nb = " + many(kMany, "{b="),
        "a = 1\nb = " + many(kMany, "[{b.b="),
        "a = '''\n'''''\nb = \"\\\"\"\nc" + many(kMany, ".b"),
        "a = \"\\\\\"\nb" + many(kMany, ".'b'") + " = 1",
    };
    for (const std::string& text : texts) {
        const File file = read_toml(text);
        EXPECT_EQ(file.line, text.starts_with("a = '") ? 4 : 2) << text.substr(0, 40);
        EXPECT_TRUE(file.error.starts_with("tables, lists and keys with dots lie more than 16 deep"))
            << file.error;
    }
}

TEST(TomlFile, TheDeepestIsRead) {
    EXPECT_EQ(read_toml("[a]\nb" + many(kDeepestToml - 1, ".b") + " = 1\nc.c = 1").error, "");
    EXPECT_NE(read_toml("[a]\nb" + many(kDeepestToml, ".b") + " = 1").error, "");
    EXPECT_EQ(read_toml("b = " + many(kDeepestToml - 1, "[") + many(kDeepestToml - 1, "]")).error, "");
    EXPECT_NE(read_toml("b = " + many(kDeepestToml, "[") + many(kDeepestToml, "]")).error, "");
}

// Brackets and dots that stand side by side or in texts are not deep.
TEST(TomlFile, LongIsNotDeep) {
    for (const std::string& text :
         {"a = [" + many(100, "1.5, [2.5, 3.5],\n") + "]", many(100, "[[a]]\nb.c = {d = 1.5, e = 2.5}\n"),
          "a = \"" + many(100, "[.{\\\"") + "\" # " + many(100, "[.{"), "a = '" + many(100, "[.{") + "'",
          "a = '''" + many(100, "[.{''\n") + "'''''",
          "a = \"\"\"" + many(100, "[.{\"\"\n\\\"\\\n") + "\"\"\""})
        EXPECT_EQ(read_toml(text).error, "") << text.substr(0, 40);
}

}  // namespace
}  // namespace nplc::toml_files
