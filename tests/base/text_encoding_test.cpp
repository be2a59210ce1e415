// tests/base/text_encoding_test.cpp: UTF-16 against bytes written out by hand.
#include "runtime/base/text_encoding.h"

#include <gtest/gtest.h>

#include <string_view>

namespace kinora {
namespace {

using namespace std::string_view_literals;

TEST(Utf8Text, LeavesOtherTextAlone) {
    for (std::string_view text : {""sv, "a"sv, "\xe9 Latin-1"sv,
                                  "\xef\xbb\xbf"
                                  "b"sv,
                                  "\xff"sv})
        EXPECT_EQ(utf8_text(std::string(text)), text);
}

TEST(Utf8Text, DecodesBothByteOrders) {
    EXPECT_EQ(utf8_text(std::string("\xff\xfe"
                                    "a\0\xe9\0\x1c\x20"sv)),
              "a\xc3\xa9\xe2\x80\x9c");
    EXPECT_EQ(utf8_text(std::string("\xfe\xff"
                                    "\0a\0\xe9\x20\x1c"sv)),
              "a\xc3\xa9\xe2\x80\x9c");
}

// U+1F600 is D83D DE00.
TEST(Utf8Text, JoinsSurrogatesAndReplacesHalves) {
    EXPECT_EQ(utf8_text(std::string("\xfe\xff\xd8\x3d\xde\0"sv)), "\xf0\x9f\x98\x80");
    EXPECT_EQ(utf8_text(std::string("\xfe\xff\xd8\x3d\0a"sv)),
              "\xef\xbf\xbd"
              "a");
    EXPECT_EQ(utf8_text(std::string("\xfe\xff\xde\0\0a"sv)),
              "\xef\xbf\xbd"
              "a");
    EXPECT_EQ(utf8_text(std::string("\xfe\xff\0a\0"sv)), "a\xef\xbf\xbd");
}

}  // namespace
}  // namespace kinora
