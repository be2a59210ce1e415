// tests/programs/common/contact_sheet_test.cpp: the frames of a render on one picture.
#include "runtime/programs/common/contact_sheet.h"

#include <gtest/gtest.h>

#include <array>

namespace kinora {
namespace {

Image8 plain(int width, int height, std::array<uint8_t, 4> color) {
    Image8 image{width, height, {}};
    for (int i = 0; i < width * height; ++i)
        image.rgba.insert(image.rgba.end(), color.begin(), color.end());
    return image;
}

std::array<int, 4> pixel(const Image8& image, int x, int y) {
    const uint8_t* p = &image.rgba[(size_t(y) * size_t(image.width) + size_t(x)) * 4];
    return {p[0], p[1], p[2], p[3]};
}

TEST(ContactSheet, ShowsFramesInOrderAtHalfTheirSize) {
    ContactSheet sheet;
    for (int f = 0; f < 6; ++f) sheet.add(plain(32, 18, {uint8_t(40 * f), 0, 0, 255}));
    Image8 picture = sheet.picture();
    ASSERT_EQ(picture.rgba.size(), size_t(picture.width) * size_t(picture.height) * 4);
    // Reading left to right, top to bottom, the frames' colours come in their order.
    std::vector<int> seen;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            auto p = pixel(picture, x, y);
            if (p[1] == 0 &&
                (seen.empty() || std::find(seen.begin(), seen.end(), p[0]) == seen.end()))
                seen.push_back(p[0]);
        }
    EXPECT_EQ(seen, (std::vector<int>{0, 40, 80, 120, 160, 200}));
    int shown = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) shown += pixel(picture, x, y)[1] == 0;
    EXPECT_EQ(shown, 6 * 16 * 9);
}

TEST(ContactSheet, LaysTransparentFramesOverGrey) {
    ContactSheet sheet;
    sheet.add(plain(16, 16, {200, 200, 200, 0}));
    Image8 picture = sheet.picture();
    auto corner = pixel(picture, 0, 0);
    EXPECT_EQ(pixel(picture, picture.width / 2, picture.height / 2), corner);
    EXPECT_EQ(corner[3], 255);
}

TEST(ContactSheet, TakesFramesOfOnePixelAndNone) {
    EXPECT_GE(ContactSheet().picture().width, 1);
    ContactSheet sheet;
    for (int f = 0; f < 5; ++f) sheet.add(plain(1, 1, {255, 255, 255, 255}));
    Image8 picture = sheet.picture();
    EXPECT_EQ(picture.rgba.size(), size_t(picture.width) * size_t(picture.height) * 4);
}

}  // namespace
}  // namespace kinora
