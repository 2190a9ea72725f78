// Requests and answers as the Modbus Application Protocol V1.1b3 prints them, section 6.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include "modbus/map.h"
#include "protocol/modbus_pdu.h"

namespace nplc::modbus {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes bytes(const Answer& answer) {
    return {answer.bytes().begin(), answer.bytes().end()};
}
Exception refusal_of(const Bytes& pdu) {
    return decode(pdu).exception;
}

/// 6.3: registers 108-110 are 022Bh, 0000h, 0064h.
TEST(ModbusPdu, ReadsHoldingRegistersAsPrinted) {
    const Bytes pdu{0x03, 0x00, 0x6B, 0x00, 0x03};
    const Decoded decoded = decode(pdu);
    ASSERT_EQ(decoded.exception, Exception::none);
    EXPECT_EQ(decoded.request.space, Space::holding_register);
    EXPECT_EQ(decoded.request.address, 0x6B);
    EXPECT_EQ(decoded.request.count, 3);
    Answer answer(decoded.request);
    for (const int word : {0x022B, 0x0000, 0x0064}) answer.put_word(static_cast<std::uint16_t>(word));
    EXPECT_EQ(bytes(answer), (Bytes{0x03, 0x06, 0x02, 0x2B, 0x00, 0x00, 0x00, 0x64}));
}

/// 6.1: coils 20-38 are CDh 6Bh 05h.
TEST(ModbusPdu, PacksBitsAsPrinted) {
    const Bytes pdu{0x01, 0x00, 0x13, 0x00, 0x13};
    Answer answer(decode(pdu).request);
    const Bytes packed{0xCD, 0x6B, 0x05};
    for (unsigned i = 0; i < 19; ++i) answer.put_bit((packed[i / 8] >> i % 8 & 1) != 0);
    EXPECT_EQ(bytes(answer), (Bytes{0x01, 0x03, 0xCD, 0x6B, 0x05}));
}

/// 6.5, 6.6, 6.11, 6.12.
TEST(ModbusPdu, WritesAsPrinted) {
    const Bytes coil{0x05, 0x00, 0xAC, 0xFF, 0x00};
    EXPECT_TRUE(decode(coil).request.bit(0));
    EXPECT_EQ(bytes(Answer::echo(coil)), coil);
    const Bytes word{0x06, 0x00, 0x01, 0x00, 0x03};
    EXPECT_EQ(decode(word).request.word(0), 3);
    const Bytes coils{0x0F, 0x00, 0x13, 0x00, 0x0A, 0x02, 0xCD, 0x01};
    const Request request = decode(coils).request;
    EXPECT_EQ(request.count, 10);
    EXPECT_TRUE(request.bit(0));
    EXPECT_FALSE(request.bit(1));
    EXPECT_TRUE(request.bit(8));
    EXPECT_EQ(bytes(Answer::echo(coils)), (Bytes{0x0F, 0x00, 0x13, 0x00, 0x0A}));
    const Bytes words{0x10, 0x00, 0x01, 0x00, 0x02, 0x04, 0x00, 0x0A, 0x01, 0x02};
    EXPECT_EQ(decode(words).request.word(1), 0x0102);
}

TEST(ModbusPdu, RefusesWhatIsWrong) {
    EXPECT_EQ(refusal_of({0x2B}), Exception::illegal_function);
    EXPECT_EQ(refusal_of({0x00, 0, 0, 0, 1}), Exception::illegal_function);
    EXPECT_EQ(refusal_of({0x03, 0, 0, 0}), Exception::illegal_value);
    EXPECT_EQ(refusal_of({0x03, 0, 0, 0, 1, 0}), Exception::illegal_value);
    EXPECT_EQ(refusal_of({0x03, 0, 0, 0, 0}), Exception::illegal_value);
    EXPECT_EQ(refusal_of({0x03, 0, 0, 0, 126}), Exception::illegal_value);
    EXPECT_EQ(refusal_of({0x03, 0, 0, 0, 125}), Exception::none);
    EXPECT_EQ(refusal_of({0x01, 0, 0, 0x07, 0xD1}), Exception::illegal_value);
    EXPECT_EQ(refusal_of({0x01, 0, 0, 0x07, 0xD0}), Exception::none);
    EXPECT_EQ(refusal_of({0x03, 0xFF, 0xFF, 0, 2}), Exception::illegal_address);
    EXPECT_EQ(refusal_of({0x05, 0, 0, 0x12, 0x34}), Exception::illegal_value);
    EXPECT_EQ(refusal_of({0x10, 0, 0, 0, 2, 4, 0, 0, 0}), Exception::illegal_value);
    EXPECT_EQ(refusal_of({0x10, 0, 0, 0, 2, 3, 0, 0, 0, 0}), Exception::illegal_value);
    EXPECT_EQ(refusal_of({0x0F, 0, 0, 0, 9, 1, 0}), Exception::illegal_value);
    EXPECT_EQ(bytes(Answer::refusal(3, Exception::illegal_address)), (Bytes{0x83, 0x02}));
}

TEST(ModbusMap, EveryRowIsAValueOfTheAxisAndNoneOverlap) {
    for (const ValueRow& row : value_rows()) {
        ASSERT_NE(row.point, nullptr) << row.name;
        for (unsigned word = 0; word < row.words; ++word)
            EXPECT_EQ(find_row(row.space, static_cast<std::uint16_t>(row.address + word)), &row);
    }
}

TEST(ModbusMap, TheDocumentHasIt) {
    std::ifstream file(MODBUS_FOLDER "/README.md");
    std::stringstream text;
    text << file.rdbuf();
    EXPECT_NE(text.str().find(map_as_markdown()), std::string::npos)
        << "put the output of `nanoplc modbus-map --markdown` into it";
}

std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields{""};
    bool is_quoted = false;
    for (const char one : line) {
        if (one == '"')
            is_quoted = !is_quoted;
        else if (one == ',' && !is_quoted)
            fields.emplace_back();
        else
            fields.back() += one;
    }
    return fields;
}

/// A PLC's engineer imports it.
TEST(ModbusMap, TheCsvSaysHowEachValueIsRead) {
    std::istringstream text(map_as_csv({.unit = "mm", .per_revolution = 5}, registers::Model::mac140));
    std::string line;
    std::getline(text, line);
    EXPECT_EQ(line, "address,block,name,type,words,scale,unit,range,meaning,access");
    std::map<std::string, std::vector<std::string>> rows;
    while (std::getline(text, line)) {
        std::vector<std::string> fields = fields_of(line);
        ASSERT_EQ(fields.size(), 10U) << line;
        for (const std::size_t needed : {3U, 4U, 5U, 8U, 9U}) EXPECT_NE(fields[needed], "") << line;
        EXPECT_EQ(fields[7].empty(), fields[3] == "text") << line;
        rows.emplace(fields[2], std::move(fields));
    }
    using Row = std::vector<std::string>;
    const auto head = [&](const std::string& name) {
        const Row& row = rows.at(name);
        return Row(row.begin(), row.begin() + 8);
    };
    // 2^31 thousandths.
    EXPECT_EQ(head("position"), (Row{"102", "input_register", "position", "int32", "2", "0.001", "mm",
                                     "-2147483.648..2147483.647"}));
    EXPECT_EQ(head("ready"), (Row{"0", "discrete_input", "ready", "bool", "1", "1", "", "0..1"}));
    EXPECT_EQ(head("step"), (Row{"3", "input_register", "step", "uint16", "1", "1", "", "0..62"}));
    EXPECT_EQ(head("timer"),
              (Row{"18", "input_register", "timer", "uint32", "2", "1", "ms", "0..4294967295"}));
    // 001 3.2.5: V_SOLL is register 5, in 1/16 counts per sample; two words from 1000 + 2 n on.
    EXPECT_EQ(rows.at("motor.V_SOLL")[0], "1010");
    EXPECT_EQ(rows.at("motor.V_SOLL")[3], "int32");
}

TEST(ModbusMap, AValueOfTwoWordsHasASecondOne) {
    for (const ValueRow& row : value_rows()) {
        EXPECT_FALSE(is_second_word(row.space, row.address)) << row.name;
        if (row.words == 2) {
            EXPECT_TRUE(is_second_word(row.space, row.address + 1U)) << row.name;
        }
    }
    for (const unsigned second : {205U, 207U, 211U, 241U, 301U, 307U, 333U})
        EXPECT_TRUE(is_second_word(Space::input_register, second)) << second;
    for (const unsigned other : {201U, 203U, 243U, 309U, 317U, 812U, 821U, 901U})
        EXPECT_FALSE(is_second_word(Space::input_register, other)) << other;
    EXPECT_FALSE(is_second_word(Space::holding_register, kCommandNumber));
    EXPECT_TRUE(is_second_word(Space::holding_register, kSetPointsNew + 1U));
}

}  // namespace
}  // namespace nplc::modbus
