// The payload against bytes put together by hand from sparkplug_b.proto, and what is kept for a broker that
// is away.
#include "sparkplug.h"

#include <gtest/gtest.h>

#include "edge_node.h"
#include "store.h"

namespace nplc::mqtt {
namespace {

using namespace std::string_literals;

TEST(Sparkplug, APayloadIsItsBytes) {
    Metric metric;
    metric.name = "ab";
    metric.alias = 300;
    metric.timestamp = 5;
    metric.type = DataType::boolean;
    metric.value = true;
    // Field n of wire type w begins with n * 8 + w: timestamp 1, metrics 2, seq 3; name 1, alias 2, timestamp
    // 3, datatype 4, boolean_value 14. 300 is ACh 02h as a varint.
    const std::string inner = "\x0A\x02"s + "ab" + "\x10\xAC\x02\x18\x05\x20\x0B\x70\x01"s;
    EXPECT_EQ(encode({.timestamp = 7, .metrics = {metric}, .seq = 0}),
              "\x08\x07\x12"s + static_cast<char>(inner.size()) + inner + "\x18\x00"s);
}

TEST(Sparkplug, EveryTypeComesBack) {
    Payload payload{.timestamp = 1'700'000'000'000, .metrics = {}, .seq = 255};
    const auto add = [&payload](DataType type, Value value) {
        Metric metric;
        metric.name = "m" + std::to_string(payload.metrics.size());
        metric.type = type;
        metric.value = std::move(value);
        payload.metrics.push_back(metric);
    };
    add(DataType::int64, std::int64_t{-2});
    add(DataType::int32, std::int64_t{-2});
    add(DataType::uint32, std::int64_t{4'000'000'000});
    add(DataType::real64, -0.5);
    add(DataType::boolean, false);
    add(DataType::text, "x"s);
    add(DataType::int64, {});
    payload.metrics[3].is_historical = true;
    payload.metrics[3].unit = "mm";
    payload.metrics[3].quality = 192;
    payload.metrics[3].description = "where it is";
    const auto back = decode(encode(payload));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->timestamp, payload.timestamp);
    EXPECT_EQ(back->seq, payload.seq);
    ASSERT_EQ(back->metrics.size(), payload.metrics.size());
    for (std::size_t i = 0; i < back->metrics.size(); ++i) {
        EXPECT_EQ(back->metrics[i].name, payload.metrics[i].name);
        EXPECT_EQ(back->metrics[i].value, payload.metrics[i].value) << i;
    }
    EXPECT_TRUE(back->metrics[3].is_historical);
}

TEST(Sparkplug, WhatIsDamagedIsNoPayload) {
    Metric metric;
    metric.name = "Command/run";
    metric.value = true;
    const std::string whole = encode({.timestamp = 7, .metrics = {metric}});
    for (std::size_t size = 1; size < whole.size(); ++size) {
        const auto part = decode(std::string_view(whole).substr(0, size));
        EXPECT_TRUE(!part || part->metrics.empty()) << size;
    }
    EXPECT_FALSE(decode("\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF"s));
    EXPECT_FALSE(decode("\x13"s));      // a group
    EXPECT_FALSE(decode("\x12\x7F"s));  // longer than it is
    unsigned seed = 1;
    for (int turn = 0; turn < 20'000; ++turn) {
        std::string noise = whole;
        for (char& byte : noise) {
            seed = seed * 1'103'515'245 + 12'345;
            if ((seed >> 16) % 4 == 0) byte = static_cast<char>(seed >> 20);
        }
        static_cast<void>(decode(noise));
    }
}

Record record(std::uint64_t milliseconds) {
    return {.milliseconds = milliseconds};
}

TEST(Store, WhatIsNotKnownToHaveArrivedIsSentAgain) {
    Store store(10);
    for (std::uint64_t i = 0; i < 4; ++i) store.push(record(i));
    store.note_sent();
    store.note_sent();
    store.ask();
    store.note_sent();
    store.confirm();  // the first two
    EXPECT_EQ(store.size(), 2U);
    EXPECT_EQ(store.next().milliseconds, 3U);
    store.restart();
    EXPECT_EQ(store.next().milliseconds, 2U);
    EXPECT_EQ(store.dropped(), 0U);
}

TEST(Store, OnlyWhatIsLostIsCounted) {
    Store store(2);
    for (std::uint64_t i = 0; i < 5; ++i) store.push(record(i));
    EXPECT_EQ(store.dropped(), 3U);  // never sent
    store.note_sent();
    store.note_sent();
    store.push(record(5));  // the first goes, sent and not known to have arrived
    EXPECT_EQ(store.dropped(), 3U);
    store.ask();
    store.confirm();
    store.restart();
    EXPECT_EQ(store.dropped(), 3U);
    store.note_sent();
    store.push(record(6));
    store.push(record(7));
    EXPECT_EQ(store.dropped(), 3U);
    store.restart();
    EXPECT_EQ(store.dropped(), 4U);
}

TEST(Options, BrokersAndTopics) {
    Options options;
    EXPECT_TRUE(broker::read_address("cell4:1883", options));
    EXPECT_EQ(options.host, "cell4");
    EXPECT_TRUE(broker::read_address("[::1]:8883", options));
    EXPECT_EQ(options.host, "::1");
    for (const char* wrong :
         {"", "cell4", ":1883", "cell4:0", "cell4:65536", "cell4:x", "mqtt://cell4:1883", "a b:1883"})
        EXPECT_FALSE(broker::read_address(wrong, options)) << wrong;
    for (const char* wrong : {"", "a/b", "+", "a#"}) EXPECT_FALSE(is_topic_part(wrong)) << wrong;
    EXPECT_TRUE(is_topic_part("cell 4"));
}

}  // namespace
}  // namespace nplc::mqtt
