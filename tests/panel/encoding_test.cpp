#include "encoding.h"

#include <gtest/gtest.h>

#include <string>

namespace nplc::panel {
namespace {

std::string encoded(const std::string& text) {
    return to_base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

// RFC 4648 §10.
TEST(Base64, TestVectors) {
    const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                           {"f", "Zg=="},
                                                           {"fo", "Zm8="},
                                                           {"foo", "Zm9v"},
                                                           {"foob", "Zm9vYg=="},
                                                           {"fooba", "Zm9vYmE="},
                                                           {"foobar", "Zm9vYmFy"}};
    for (const auto& [plain, text] : vectors) {
        EXPECT_EQ(encoded(plain), text);
        const auto back = from_base64(text);
        ASSERT_TRUE(back.has_value()) << text;
        EXPECT_EQ(std::string(back->begin(), back->end()), plain);
    }
}

TEST(Base64, WhatIsNoneIsRefused) {
    for (const char* text : {"Z", "Zg", "Zg=", "Z===", "====", "Zg==Zg==", "Zm9%", "Zm 9", "Zh=="})
        EXPECT_FALSE(from_base64(text).has_value()) << text;
}

}  // namespace
}  // namespace nplc::panel
