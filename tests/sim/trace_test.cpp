#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "sim/snapshot.h"
#include "sim/trace_file.h"

namespace nplc::sim {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

class Trace : public testing::Test {
  protected:
    Trace() {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::temp_directory_path() / (std::string("nplc_trace_") + info->name());
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~Trace() override { fs::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    static std::vector<std::string> lines(const std::string& file) {
        std::ifstream stream(file);
        std::vector<std::string> result;
        for (std::string line; std::getline(stream, line);) result.push_back(line);
        return result;
    }

    fs::path folder_;
};

TEST_F(Trace, CsvHasARowForEveryChangeAndEveryTenMilliseconds) {
    CsvTrace trace(path("t.csv"));
    Snapshot s;
    trace.observe(s);
    s.time = 250us;
    trace.observe(s);  // nothing new
    s.time = 500us;
    s.step = 3;
    s.timer = 490;
    s.inputs = 5;
    s.orders = {{.command = 0x41}, {.is_register_write = true, .reg = 65, .value = 3146}};
    trace.observe(s);
    EXPECT_EQ(trace.next_due(), Time(10'500us));
    s.orders.clear();
    s.time = 10'400us;
    trace.observe(s);  // not due yet
    s.time = 10'500us;
    trace.observe(s);
    s.time = 11ms;
    s.p_ist = -12;
    s.v_ist = -3;
    s.outputs = 9;
    s.in_position = s.error = true;
    s.counter = 7;
    trace.observe(s);
    s.time = 12ms;
    trace.finish(s);
    const std::vector<std::string> expected{
        "time_ms,step,timer,counter,inputs,outputs,inpos,error,command,p_ist,v_ist",
        "0.000,0,0,0,0,0,0,0,,0,0",
        "0.500,3,490,0,5,0,0,0,41 65=3146,0,0",
        "10.500,3,490,0,5,0,0,0,,0,0",
        "11.000,3,490,7,5,9,1,1,,-12,-3",
        "12.000,3,490,7,5,9,1,1,,-12,-3",
    };
    EXPECT_EQ(lines(path("t.csv")), expected);
}

TEST_F(Trace, AChangeTakesThePlaceOfARowThatWasOnlyDue) {
    CsvTrace trace(path("t.csv"));
    Snapshot s;
    trace.observe(s);
    s.time = 10ms;
    trace.observe(s);  // due
    s.inputs = 4;
    trace.observe(s);  // and at the same instant a change
    s.step = 1;
    trace.observe(s);  // a second one
    s.time = 20ms;
    trace.observe(s);  // due
    EXPECT_EQ(trace.next_due(), Time(30ms));
    s.time = 30ms;
    trace.observe(s);  // due
    s.time = 31ms;
    s.step = 2;
    trace.observe(s);
    s.time = 41ms;
    trace.observe(s);  // due
    trace.finish(s);
    const std::vector<std::string> expected{
        "0.000,0,0,0,0,0,0,0,,0,0",  "10.000,0,0,0,4,0,0,0,,0,0", "10.000,1,0,0,4,0,0,0,,0,0",
        "20.000,1,0,0,4,0,0,0,,0,0", "30.000,1,0,0,4,0,0,0,,0,0", "31.000,2,0,0,4,0,0,0,,0,0",
        "41.000,2,0,0,4,0,0,0,,0,0",
    };
    auto rows = lines(path("t.csv"));
    rows.erase(rows.begin());
    EXPECT_EQ(rows, expected);
}

TEST_F(Trace, TheFileAppearsOnlyWhenItIsWhole) {
    {
        CsvTrace trace(path("t.csv"));
        trace.observe({});
        EXPECT_FALSE(fs::exists(path("t.csv")));
    }
    EXPECT_TRUE(fs::is_empty(folder_)) << "an abandoned trace leaves nothing behind";
    CsvTrace trace(path("t.csv"));
    trace.finish({});
    EXPECT_TRUE(fs::exists(path("t.csv")));
}

TEST_F(Trace, AnOlderFileStaysUntilTheNewOneIsWhole) {
    std::ofstream(path("t.csv")) << "old\n";
    { const CsvTrace abandoned(path("t.csv")); }
    EXPECT_EQ(lines(path("t.csv")).front(), "old");
}

TEST_F(Trace, AFolderOrAMissingFolderIsRefused) {
    EXPECT_THROW(CsvTrace{folder_.string()}, FileError);
    EXPECT_THROW(CsvTrace{path("missing/t.csv")}, FileError);
}

/// Reads a value change dump back: per signal name, its values and their times in microseconds.
struct Dump {
    std::map<std::string, std::string> name_of;
    std::map<std::string, std::vector<std::pair<long, std::string>>> changes;
    bool times_ascend = true;
    long end = -1;

    explicit Dump(const std::vector<std::string>& lines) {
        bool definitions = true;
        for (const std::string& line : lines) {
            std::istringstream words(line);
            std::string first;
            words >> first;
            if (first == "$var") {
                std::string type, bits, id, name;
                words >> type >> bits >> id >> name;
                name_of[id] = name;
            } else if (first == "$enddefinitions") {
                definitions = false;
            } else if (!definitions && first[0] == '#') {
                const long time = std::stol(first.substr(1));
                times_ascend = times_ascend && time > end;
                end = time;
            } else if (!definitions) {
                std::string id;
                const bool scalar = first[0] == '0' || first[0] == '1';
                if (scalar) {
                    id = first.substr(1);
                } else {
                    words >> id;
                }
                changes[name_of.at(id)].emplace_back(end, scalar ? first.substr(0, 1) : first);
            }
        }
    }
};

TEST_F(Trace, VcdCanBeReadBack) {
    Names names;
    names.inputs[0] = "Start";
    names.steps[2] = "Hold on";
    VcdTrace trace(path("t.vcd"), names);
    Snapshot s;
    trace.observe(s);
    s.time = 1500us;
    s.step = 2;
    s.inputs = 1;
    s.p_ist = -1;
    s.v_ist = 197;
    s.orders = {{.command = 0x41}};
    trace.observe(s);
    s.time = 9ms;
    s.inputs = 0;
    s.orders.clear();
    trace.observe(s);
    trace.finish(10ms);

    const auto text = lines(path("t.vcd"));
    EXPECT_NE(std::find(text.begin(), text.end(), "$timescale 1 us $end"), text.end());
    const Dump dump(text);
    using Changes = std::vector<std::pair<long, std::string>>;
    EXPECT_TRUE(dump.times_ascend);
    EXPECT_EQ(dump.end, 10'000);
    EXPECT_EQ(dump.changes.at("Start"), (Changes{{0, "0"}, {1500, "1"}, {9000, "0"}}));
    EXPECT_EQ(dump.changes.at("step"), (Changes{{0, "b000000"}, {1500, "b000010"}}));
    EXPECT_EQ(dump.changes.at("step_name"), (Changes{{0, "s0"}, {1500, "sHold_on"}}));
    EXPECT_EQ(dump.changes.at("command"), (Changes{{0, "s-"}, {1500, "sPOSITION(P2)"}, {2500, "s-"}}));
    EXPECT_EQ(dump.changes.at("p_ist").back().second, "b" + std::string(32, '1'));
    // 197 counts/sample x 520.8333 samples/s x 60 / 4096 counts = 1502.99 rpm
    EXPECT_EQ(dump.changes.at("speed_rpm").back().second, "r1502.99");
    EXPECT_EQ(dump.changes.at("OUT3"), (Changes{{0, "0"}}));
}

TEST_F(Trace, AnInvertedInputIsInTheVcdByItsName) {
    Names names;
    names.inputs[2] = "Estop";
    names.inverted_inputs = 0x04;
    VcdTrace trace(path("t.vcd"), names);
    Snapshot s;
    trace.observe(s);
    s.time = 5ms;
    s.inputs = 0x04;
    trace.observe(s);
    trace.finish(10ms);
    using Changes = std::vector<std::pair<long, std::string>>;
    EXPECT_EQ(Dump(lines(path("t.vcd"))).changes.at("Estop"), (Changes{{0, "1"}, {5000, "0"}}));
}

TEST_F(Trace, SignalsCalledAsTheDumpsOwnAreToldFromThem) {
    Names names;
    names.inputs[1] = "command";
    names.outputs[2] = "step_name";
    VcdTrace trace(path("t.vcd"), names);
    Snapshot s;
    s.inputs = 2;
    s.step = 3;
    trace.observe(s);
    trace.finish(10ms);
    const Dump dump(lines(path("t.vcd")));
    using Changes = std::vector<std::pair<long, std::string>>;
    EXPECT_EQ(dump.changes.at("command"), (Changes{{0, "s-"}}));
    EXPECT_EQ(dump.changes.at("command_IN1"), (Changes{{0, "1"}}));
    EXPECT_EQ(dump.changes.at("step_name"), (Changes{{0, "s3"}}));
    EXPECT_EQ(dump.changes.at("step_name_OUT2"), (Changes{{0, "0"}}));
}

TEST(Words, CommandsReadAsInAProgram) {
    const auto mac = registers::Model::mac140;
    EXPECT_EQ(in_words({.command = 0x41}, mac), "POSITION(P2)");  // 10 00001
    EXPECT_EQ(in_words({.command = 0x0A}, mac), "INIT(V3)");      // 00 01010
    EXPECT_EQ(in_words({.command = 0x33}, mac), "VELOCITY(A4)");  // 01 10011
    EXPECT_EQ(in_words({.command = 0x61}, mac), "RESET_ERROR");   // 11 00001
    EXPECT_EQ(in_words({.command = 0x6E}, mac), "USE_SET(3)");    // 11 01110
    EXPECT_EQ(in_words({.command = 0x7F}, mac), "USE_FLEXMAC");   // 11 11111
    EXPECT_EQ(in_words({.is_register_write = true, .reg = 65, .value = 3146}, mac), "V1 := 3146");
    EXPECT_EQ(in_words({.is_register_write = true, .reg = 49, .value = 0xFFFFFFFF}, mac), "P1 := -1");
}

TEST(Words, NumbersAreAsInTheTraceFormat) {
    EXPECT_EQ(in_numbers(SentOrder{.command = 0x01}), "01");
    EXPECT_EQ(in_numbers(SentOrder{.is_register_write = true, .reg = 127, .value = 0xFFFFFFFF}),
              "127=4294967295");
}

}  // namespace
}  // namespace nplc::sim
