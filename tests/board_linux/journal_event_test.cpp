// NANOPLC_EVENT of the journal's messages.
#include "journal_event.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "journal.h"

namespace nplc::boards {
namespace {

TEST(JournalEvent, EveryKeyIsOnceAndInTheDocument) {
    std::ifstream file(BOARD_README);
    const std::string document{std::istreambuf_iterator<char>(file), {}};
    std::set<std::string_view> seen;
    for (const std::string_view key : kJournalEventKeys) {
        EXPECT_TRUE(seen.insert(key).second) << key;
        EXPECT_NE(document.find("`" + std::string(key) + "`"), std::string::npos) << key;
    }
}

template <class Any>
concept writes_without_event = requires(Any journal, std::string text) {
    journal.write(LogLevel::error, text);
};

TEST(JournalEvent, NothingIsWrittenWithoutOne) {
    EXPECT_FALSE(writes_without_event<Journal&>);
    EXPECT_FALSE(writes_without_event<AxisJournal&>);
}

TEST(JournalEvent, ACauseIsTheLogsKey) {
    const JournalFields fields = cause_field(gateway::SafeReason::link_down);
    ASSERT_EQ(fields.size(), 1U);
    EXPECT_EQ(fields[0].name, "CAUSE");
    EXPECT_EQ(fields[0].value, "link_down");
}

}  // namespace
}  // namespace nplc::boards
