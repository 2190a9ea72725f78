// What lets an axis's sequence start by itself, through starts and ends of every kind.
#include "axis_store.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "base/crc32.h"

namespace {

struct Disk {
    std::atomic<bool> holds = false;
    std::atomic<bool> fails = false;
} disk;

}  // namespace

/// In place of the C library's.
extern "C" int fdatasync(int file) {
    while (disk.holds) std::this_thread::yield();
    if (!disk.fails) return ::fsync(file);
    errno = EIO;
    return -1;
}

namespace nplc::boards {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;
using enum AutostartPermission;

constexpr std::uint32_t kRecord = 14 * 2048;
constexpr std::size_t kHeader = 6;  // "NPO1", the permission, the name's length

class AxisStoreTest : public testing::Test {
  protected:
    AxisStoreTest() {
        std::string made = (fs::temp_directory_path() / "axis_store_XXXXXX").string();
        root_ = ::mkdtemp(made.data());
        today = kThatDay;
    }
    ~AxisStoreTest() override { fs::remove_all(root_); }

    /// One run of the service.
    struct Run {
        Run(const std::string& folder, const std::string& name, const BoardStart& board)
            : axis(name),
              commissioned(fs::path(folder).parent_path().string(), [] { return today; }),
              store(axis_journal, name, commissioned) {
            testing::internal::CaptureStderr();
            error = store.open(folder);
            if (!error.empty()) return;
            is_after_crash = store.is_after_crash(board);
            permission = store.permission();
            error = store.mark_running();
            said = testing::internal::GetCapturedStderr();
        }
        /// What is said of it, in the end.
        std::string command_run() {
            const base::Instant now{};
            auto outcome = store.give_permission(now);
            while (!outcome) outcome = store.give_permission(now);
            return *outcome;
        }
        void end() { EXPECT_EQ(store.mark_ended(), ""); }

        std::string axis;
        Journal journal{LogLevel::debug};
        AxisJournal axis_journal{journal, axis};
        CommissionedAxes commissioned;
        AxisStore store;
        bool is_after_crash = false;
        AutostartPermission permission = bad_mark;
        std::string error;
        std::string said;
    };

    std::string folder(const std::string& axis = "a") const { return (root_ / axis).string(); }
    std::string store(const std::string& axis = "a") const { return folder(axis) + "/store.bin"; }
    std::string list() const { return (root_ / "commissioned.txt").string(); }
    std::string mark(const std::string& axis = "a") const { return folder(axis) + "/running"; }

    Run start(const BoardStart& board = {}, const std::string& axis = "a") const {
        return {folder(axis), axis, board};
    }
    AutostartPermission start_and_end(const BoardStart& board = {}, const std::string& axis = "a") const {
        Run run = start(board, axis);
        EXPECT_EQ(run.error, "");
        run.end();
        return run.permission;
    }
    void command_run_once(const std::string& axis = "a") const {
        Run run = start({}, axis);
        EXPECT_EQ(run.command_run(), "");
        EXPECT_EQ(run.error, "");
        run.end();
    }

    static std::string content(const std::string& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    static void write(const std::string& path, const std::string& bytes) {
        std::ofstream(path, std::ios::binary) << bytes;
    }
    /// As the version before 2 left it.
    void write_old_mark(std::string word) const {
        word.resize(7, ' ');
        write_mark(word);
    }
    /// The power is cut and comes back: what stands there is of another boot.
    void cut_power() const { write_mark(content(mark()).substr(0, 7)); }
    void write_mark(const std::string& word) const {
        const std::string checked = word + " 01234567-89ab-cdef-0123-456789abcdef ";
        std::array<char, 10> crc{};
        const std::vector<std::uint8_t> bytes(checked.begin(), checked.end());
        std::snprintf(crc.data(), crc.size(), "%08x\n", static_cast<unsigned>(base::crc32(bytes)));
        write(mark(), checked + crc.data());
    }

    static constexpr std::chrono::sys_seconds kThatDay{1'700'000'000s};  // 2023-11-14 22:13:20 UTC
    static inline std::chrono::sys_seconds today = kThatDay;
    fs::path root_;
};

TEST_F(AxisStoreTest, ANewOneWaitsForAFirstRun) {
    for (int i = 0; i < 3; ++i) {
        Run run = start();
        EXPECT_EQ(run.permission, first_run);
        EXPECT_NE(run.said.find("new here: waits for a first run command"), std::string::npos) << run.said;
        run.end();
    }
    command_run_once();
    EXPECT_EQ(start_and_end(), given);
    EXPECT_EQ(start_and_end(), given);
}

TEST_F(AxisStoreTest, ACrashWaitsThroughAnyNumberOfOrderlyStarts) {
    command_run_once();
    { Run crashed = start(); }
    {
        Run run = start();
        EXPECT_TRUE(run.is_after_crash);
        EXPECT_EQ(run.permission, after_crash);
        run.end();
    }
    for (int i = 0; i < 3; ++i) EXPECT_EQ(start_and_end(), after_crash);
    command_run_once();
    EXPECT_EQ(start_and_end(), given);
}

// Lost, another axis's or blank while the service runs once and ends in order; then the copy is put back.
TEST_F(AxisStoreTest, ACrashIsNotForgottenByWayOfAnotherStore) {
    command_run_once("b");
    command_run_once();
    const std::string own = content(store());
    for (const std::string& other : {std::string(), content(store("b")), std::string(own.size(), '\xFF')}) {
        start();  // and no end: it is killed
        other.empty() ? static_cast<void>(fs::remove(store())) : write(store(), other);
        EXPECT_NE(start_and_end(), given);
        write(store(), own);
        EXPECT_EQ(start_and_end(), after_crash);
        EXPECT_EQ(start_and_end(), after_crash);
        command_run_once();
        EXPECT_EQ(start_and_end(), given);
    }
}

TEST_F(AxisStoreTest, AWatchdogsResetToo) {
    command_run_once();
    EXPECT_EQ(start_and_end({.by_watchdog = true}), given) << "it is over: a run has ended in this boot";
    write_old_mark("running");
    EXPECT_EQ(start_and_end({.by_watchdog = true}), after_crash);
    EXPECT_EQ(start_and_end(), after_crash);
}

TEST_F(AxisStoreTest, APowerCutGoesAsItIsConfigured) {
    command_run_once();
    write_old_mark("running");
    EXPECT_EQ(start_and_end(), given);
    write_old_mark("running");
    EXPECT_EQ(start_and_end({.power_cut_waits = true}), after_crash);
    EXPECT_EQ(start_and_end(), after_crash);
}

TEST_F(AxisStoreTest, AWatchdogThatCannotTellItsResetsMakesAPowerCutWait) {
    EXPECT_TRUE(power_cut_waits({}, false));
    EXPECT_FALSE(power_cut_waits({}, true));
    EXPECT_FALSE(power_cut_waits({}, {})) << "without watchdog_device";
    for (const std::optional<bool> tells_resets : {std::optional<bool>(), {false}, {true}}) {
        EXPECT_TRUE(power_cut_waits(true, tells_resets));
        EXPECT_FALSE(power_cut_waits(false, tells_resets));
    }
    command_run_once();
    write_old_mark("running");
    EXPECT_EQ(start_and_end({.power_cut_waits = power_cut_waits({}, false)}), after_crash);
}

TEST_F(AxisStoreTest, APowerCutAfterACrashIsStillACrash) {
    command_run_once();
    { Run crashed = start(); }
    EXPECT_EQ(note_crash(folder()), "");
    cut_power();
    EXPECT_EQ(start_and_end(), after_crash);
    cut_power();
    EXPECT_EQ(start_and_end(), after_crash);
    command_run_once();
    EXPECT_EQ(note_crash(folder()), "") << "an orderly end stays one";
    cut_power();
    EXPECT_EQ(start_and_end(), given);
    { Run run = start(); }
    cut_power();
    EXPECT_EQ(note_crash(folder()), "") << "the end of a start that failed, after a power cut";
    EXPECT_EQ(start_and_end(), given);
    EXPECT_EQ(note_crash(folder("nowhere")), "");
}

TEST_F(AxisStoreTest, ARunningServiceIsNotNotedAsCrashed) {
    command_run_once();
    {
        Run run = start();
        const std::string before = content(mark());
        EXPECT_TRUE(is_in_use(folder()));
        EXPECT_NE(note_crash(folder()), "");
        EXPECT_EQ(content(mark()), before);
        run.end();
    }
    EXPECT_FALSE(is_in_use(folder()));
    EXPECT_FALSE(is_in_use(folder("nowhere")));
    EXPECT_EQ(start_and_end(), given);
}

TEST_F(AxisStoreTest, AnEndWithTheMotorUnstoppedWaitsInTheNextBootToo) {
    command_run_once();
    {
        Run run = start();
        EXPECT_EQ(run.store.mark_crashed(), "");
    }
    cut_power();
    EXPECT_EQ(start_and_end(), after_crash);
}

/// With the power cut between the two, the crash is known by either.
TEST_F(AxisStoreTest, ACrashIsInTheStoreBeforeTheMarkSaysThatItRuns) {
    command_run_once();
    { Run crashed = start(); }
    EXPECT_EQ(note_crash(folder()), "");
    const std::string noted = content(mark());
    const std::string axis = "a";
    Journal journal{LogLevel::error};
    AxisJournal axis_journal{journal, axis};
    CommissionedAxes commissioned(root_.string());
    AxisStore again(axis_journal, axis, commissioned);
    ASSERT_EQ(again.open(folder()), "");
    EXPECT_TRUE(again.is_after_crash({}));
    fs::rename(store(), store() + ".away");
    EXPECT_NE(again.mark_running(), "");
    EXPECT_EQ(content(mark()), noted);
    fs::rename(store() + ".away", store());
}

TEST_F(AxisStoreTest, JunkInTheMarkWaitsLikewise) {
    command_run_once();
    write(mark(), "junk");
    EXPECT_EQ(start_and_end(), bad_mark);
    EXPECT_EQ(start_and_end(), bad_mark);
    fs::remove(mark());
    EXPECT_EQ(start_and_end(), bad_mark);
    command_run_once();
    EXPECT_EQ(start_and_end(), given);
}

TEST_F(AxisStoreTest, WhatWasLostStartsNothing) {
    command_run_once();
    write(store(), std::string(32 * 1024, '\xFF'));
    {
        Run run = start();
        EXPECT_EQ(run.permission, lost);
        EXPECT_NE(run.said.find("what was stored is lost"), std::string::npos) << run.said;
        run.end();
    }
    EXPECT_EQ(start_and_end(), lost);

    command_run_once();
    fs::remove(store());
    EXPECT_EQ(start_and_end(), lost);
    EXPECT_EQ(start_and_end(), lost);
    command_run_once();
    EXPECT_EQ(start_and_end(), given);
}

// Two axes that were in use; the folder of one is removed.
TEST_F(AxisStoreTest, AFolderThatIsLostIsNotTakenForANewAxis) {
    const std::string lost_since =
        "a: its store was lost (it was in use since 2023-11-14): waits for `nanoctl run`";
    command_run_once("a");
    command_run_once("b");
    today += std::chrono::days(30);
    fs::remove_all(folder());
    for (int i = 0; i < 3; ++i) {
        Run run = start();
        EXPECT_EQ(run.permission, first_run);
        EXPECT_EQ(run.store.trace(), gateway::StoreTrace::lost);
        EXPECT_NE(run.said.find(lost_since), std::string::npos) << run.said;
        EXPECT_EQ(run.said.find("new here"), std::string::npos) << run.said;
        run.end();
        EXPECT_EQ(start_and_end({}, "b"), given);
    }
    command_run_once();
    EXPECT_EQ(start_and_end(), given);
    fs::remove_all(folder());
    Run run = start();
    EXPECT_NE(run.said.find("in use since 2023-12-14"), std::string::npos) << "its later store: " << run.said;
}

TEST_F(AxisStoreTest, AnAxisThatWasNeverCommissionedIsNewWhateverIsRemoved) {
    command_run_once("b");
    start_and_end();
    fs::remove_all(folder());
    Run run = start();
    EXPECT_EQ(run.store.trace(), gateway::StoreTrace::none);
    EXPECT_NE(run.said.find("new here"), std::string::npos) << run.said;
}

TEST_F(AxisStoreTest, WithTheWholeStateDirectoryEachIsNew) {
    command_run_once("a");
    command_run_once("b");
    fs::remove_all(root_);
    for (const char* axis : {"a", "b"}) {
        Run run = start({}, axis);
        EXPECT_EQ(run.permission, first_run);
        EXPECT_EQ(run.store.trace(), gateway::StoreTrace::none);
        EXPECT_NE(run.said.find("new here"), std::string::npos) << run.said;
    }
}

TEST_F(AxisStoreTest, AnAxisThatIsLeftOutAndComesBackIsNotLost) {
    command_run_once("a");
    command_run_once("b");
    for (int i = 0; i < 3; ++i) EXPECT_EQ(start_and_end({}, "b"), given) << "without a";
    Run run = start();
    EXPECT_EQ(run.permission, given);
    EXPECT_EQ(run.said, "");
}

TEST_F(AxisStoreTest, AnAxisOfBeforeTheListGetsIntoIt) {
    command_run_once();
    { Run crashed = start(); }
    fs::remove(list());
    start_and_end();
    EXPECT_EQ(start_and_end(), after_crash);
    ASSERT_TRUE(fs::exists(list()));
    fs::remove_all(folder());
    EXPECT_NE(start().said.find("its store was lost (it was in use since 2023-11-14)"), std::string::npos);
}

TEST_F(AxisStoreTest, ADamagedListIsNone) {
    command_run_once("longer-name");
    command_run_once();
    const std::string sound = content(list());
    const auto expect_none = [&](const std::string& damaged) {
        write(list(), damaged);
        const CommissionedAxes read(root_.string());
        EXPECT_EQ(read.fault(), list() + ": is damaged");
        EXPECT_EQ(read.since("a"), std::nullopt);
        EXPECT_EQ(read.since("longer-name"), std::nullopt);
    };
    for (std::size_t bit = 0; bit < 8 * sound.size(); ++bit) {
        std::string damaged = sound;
        damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
        expect_none(damaged);
    }
    for (std::size_t length = 0; length < sound.size(); ++length) expect_none(sound.substr(0, length));
    expect_none(sound + "\n");
    expect_none(std::string(100'000, 'x'));

    EXPECT_EQ(start_and_end(), given) << "it permits nothing and forbids nothing";
    const CommissionedAxes again(root_.string());
    EXPECT_EQ(again.fault(), "");
    EXPECT_EQ(again.since("a"), today) << "entered anew";
    write(list(), sound);
    EXPECT_EQ(CommissionedAxes(root_.string()).since("longer-name"), kThatDay);
}

TEST_F(AxisStoreTest, AListThatCannotBeReadOrWrittenStopsNothing) {
    fs::create_directories(list() + "/in_the_way");
    {
        Run run = start();
        EXPECT_EQ(run.commissioned.fault(), list() + ": cannot be read: Is a directory");
        EXPECT_EQ(run.command_run(), "");
        EXPECT_EQ(run.permission, first_run);
        EXPECT_EQ(run.store.permission(), given);
        auto outcome = run.commissioned.poll();
        while (!outcome) outcome = run.commissioned.poll();
        EXPECT_EQ(*outcome, list() + ": cannot be written: Is a directory");
        run.end();
    }
    EXPECT_EQ(start_and_end(), given);
    fs::remove_all(list());
    fs::create_symlink(store(), list());
    EXPECT_EQ(CommissionedAxes(root_.string()).fault(),
              list() + ": cannot be read: Too many levels of symbolic links");
}

/// The second is entered while the first may be on its way to the disk; another process enters a third, which
/// the first does not know.
TEST_F(AxisStoreTest, NoneOfTheListIsForgotten) {
    {
        CommissionedAxes one(root_.string());
        CommissionedAxes other(root_.string());
        other.enter("c");
        auto outcome = other.poll();
        while (!outcome) outcome = other.poll();
        EXPECT_EQ(*outcome, "");
        one.enter("a");
        one.enter("b");
    }
    const CommissionedAxes read(root_.string());
    for (const char* axis : {"a", "b", "c"}) EXPECT_TRUE(read.since(axis)) << axis;
    EXPECT_EQ(read.since("d"), std::nullopt);
}

TEST_F(AxisStoreTest, AnotherAxissStoreWaitsAndIsNamed) {
    command_run_once("a");
    command_run_once("b");
    fs::copy_file(store("b"), store("a"), fs::copy_options::overwrite_existing);
    for (int i = 0; i < 2; ++i) {
        Run run = start();
        EXPECT_EQ(run.permission, first_run);
        EXPECT_EQ(run.store.trace(), gateway::StoreTrace::anothers);
        EXPECT_NE(run.said.find("is the store of axis b"), std::string::npos) << run.said;
        run.end();
    }
    command_run_once("a");
    EXPECT_EQ(start_and_end(), given);
}

TEST_F(AxisStoreTest, AStoreOfTheVersionBeforeCountsAsRunOnce) {
    fs::create_directories(folder());
    write(store(), std::string(32 * 1024, '\xFF'));
    write_old_mark("ended");
    {
        Run run = start();
        EXPECT_EQ(run.permission, given);
        EXPECT_NE(run.said.find("of a version before"), std::string::npos) << run.said;
        run.end();
    }
    EXPECT_EQ(start_and_end(), given);
    // Its store was lost before the new version saw it.
    fs::remove_all(folder());
    fs::create_directories(folder());
    write_old_mark("ended");
    EXPECT_EQ(start_and_end(), lost);
}

TEST_F(AxisStoreTest, WhatCannotBeWrittenIsNotGiven) {
    Run run = start();
    fs::rename(store(), store() + ".away");
    EXPECT_NE(run.command_run().find("cannot be written"), std::string::npos);
    EXPECT_EQ(run.store.permission(), first_run);
    fs::rename(store() + ".away", store());
    EXPECT_EQ(run.command_run(), "");
    EXPECT_EQ(run.store.permission(), given);
    run.end();
}

/// A second of the time that give_permission() is given; the disk itself takes as long as the test wants.
TEST_F(AxisStoreTest, ADiskThatTakesLongIsNotWaitedForForEver) {
    Run run = start();
    disk.holds = true;
    const base::Instant asked{};
    EXPECT_EQ(run.store.give_permission(asked), std::nullopt);
    EXPECT_EQ(run.store.give_permission(asked + 999ms), std::nullopt);
    EXPECT_EQ(run.store.give_permission(asked + 1s), "the store takes longer than 1 s to be written");
    EXPECT_EQ(run.store.permission(), first_run);
    EXPECT_EQ(run.store.give_permission(asked + 5s), std::nullopt) << "asked again";
    EXPECT_EQ(run.store.give_permission(asked + 6s), "the store takes longer than 1 s to be written");
    EXPECT_EQ(run.store.permission(), first_run);
    disk.holds = false;
    EXPECT_EQ(run.command_run(), "");
    EXPECT_EQ(run.store.permission(), given);
    run.end();
}

TEST_F(AxisStoreTest, ADiskThatFailsGivesNothing) {
    Run run = start();
    disk.fails = true;
    EXPECT_EQ(run.command_run(), store() + ": cannot be written: Input/output error");
    EXPECT_EQ(run.store.permission(), first_run);
    disk.fails = false;
    EXPECT_EQ(run.command_run(), "");
    EXPECT_EQ(run.store.permission(), given);
    run.end();
}

TEST_F(AxisStoreTest, EachFlippedBitOfTheRecordWaits) {
    command_run_once();
    const std::string sound = content(store());
    ASSERT_EQ(sound.size(), 32U * 1024);
    for (std::size_t bit = 0; bit < 8 * (kHeader + 1 + 4); ++bit) {
        std::string damaged = sound;
        char& byte = damaged[kRecord + bit / 8];
        byte = static_cast<char>(byte ^ (1 << bit % 8));
        write(store(), damaged);
        EXPECT_EQ(start_and_end(), bad_mark) << bit;
        EXPECT_EQ(start_and_end(), bad_mark) << bit;
    }
    command_run_once();
    EXPECT_EQ(content(store()), sound);
}

}  // namespace
}  // namespace nplc::boards
