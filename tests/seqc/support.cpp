#include "support.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace nplc::seqc::test {

Scan scan(const std::vector<std::uint8_t>& table, int step, unsigned image, bool timer_zero,
          bool counter_zero) {
    Scan result;
    for (std::size_t i = 0; i + 8 <= table.size(); i += 8) {
        const std::uint8_t* t = &table[i];
        if ((t[0] & 0x3F) == 0x3F) break;
        const unsigned compared = (t[2] & 0x7FU) | 0x80U;
        const bool holds = (t[0] & 0x3F) == step && ((t[0] & 0x80) != 0 || timer_zero) &&
                           ((t[0] & 0x40) != 0 || counter_zero) && (image & compared) == (t[1] & compared);
        if (!holds) continue;
        char text[40];
        if ((t[2] & 0x80) != 0) {
            const unsigned low = t[4] + 256U * t[5];
            const unsigned high = t[6] + 256U * t[7];
            std::snprintf(text, sizeof text, "%d=%u%s", t[3] & 0x7F,
                          (t[3] & 0x80) != 0 ? low | (high << 16U) : low, (t[3] & 0x80) != 0 ? "L" : "");
            result.sends.emplace_back(text);
            continue;
        }
        if ((t[4] & 0x80) == 0) {
            std::snprintf(text, sizeof text, "%02X", t[4]);
            result.sends.emplace_back(text);
        }
        if ((t[3] & 0x3F) != 0x3E) result.next = t[3] & 0x3F;
        result.outputs = t[5] & 0x0F;
        result.clears = (t[5] & 0x40) != 0;
        result.counts = (t[5] & 0x80) != 0;
        const int preset = t[6] | (t[7] << 8);
        if (preset != 0) ((t[3] & 0x40) != 0 ? result.counter : result.timer) = preset;
    }
    return result;
}

Scan scan_case(const std::vector<std::uint8_t>& table, int step, unsigned number) {
    return scan(table, step, number & 0xFFU, (number & 0x100U) != 0, (number & 0x200U) != 0);
}

int terms_of(const std::vector<std::uint8_t>& table, int step) {
    int count = 0;
    for (std::size_t i = 0; i + 8 <= table.size() && (table[i] & 0x3F) != 0x3F; i += 8) {
        if ((table[i] & 0x3F) == step) ++count;
    }
    return count;
}

std::string term_text(const std::vector<std::uint8_t>& table, std::size_t index) {
    std::string text;
    for (std::size_t i = index * 8; i < index * 8 + 8 && i < table.size(); ++i) {
        char byte[8];
        std::snprintf(byte, sizeof byte, "%s%02X", text.empty() ? "" : " ", table[i]);
        text += byte;
    }
    return text;
}

std::string program(std::string_view steps) {
    return "PROGRAM Test MOTOR MAC140;\n"
           "VAR_INPUT A AT IN0 : BOOL; B AT IN1 : BOOL; C AT IN2 : BOOL; D AT IN3 : BOOL; E AT IN4 : BOOL; F "
           "AT IN5 : "
           "BOOL; END_VAR\n"
           "VAR_OUTPUT W AT OUT0 : BOOL; X AT OUT1 : BOOL; Y AT OUT2 : BOOL; Z AT OUT3 : BOOL; END_VAR\n"
           "ON ERROR NEXT := Fault;\n" +
           std::string(steps) +
           "\nSTEP Other: OUT X; IF A THEN NEXT := S; END_IF END_STEP\n"
           "STEP Fault: OWN ERROR; IF ANY ERROR AND F THEN RESET_ERROR; NEXT := Other; END_IF "
           "END_STEP\nEND_PROGRAM\n";
}

Compilation compiled(const std::string& source) {
    Compilation result = compile(source);
    EXPECT_TRUE(result.ok) << shown(result, source);
    return result;
}

std::string shown(const Compilation& compilation, std::string_view source) {
    std::string text;
    for (const Diagnostic& d : compilation.diagnostics) text += render(d, source, "test.seq");
    return text;
}

std::string codes(const Compilation& compilation) {
    std::string text;
    for (const Diagnostic& d : compilation.diagnostics) text += (text.empty() ? "" : " ") + d.code;
    return text;
}

std::string codes_in_frame(const Compilation& compilation) {
    Compilation left = compilation;
    std::erase_if(left.diagnostics, [](const Diagnostic& d) {
        return d.code == "W026" || d.code == "W033" || d.code == "W034";
    });
    return codes(left);
}

}  // namespace nplc::seqc::test
