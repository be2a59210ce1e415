// runtime/programs/common/contact_sheet.cpp: halved frames in a grid.
#include "runtime/programs/common/contact_sheet.h"

#include <algorithm>
#include <cmath>

namespace kinora {

namespace {
constexpr int kGap = 4;
constexpr int kGrey = 40;
}  // namespace

void ContactSheet::add(const Image8& image) {
    Image8 half{std::max(1, image.width / 2), std::max(1, image.height / 2), {}};
    half.rgba.resize(size_t(half.width) * size_t(half.height) * 4);
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x) {
            int sum[3] = {};
            for (int k = 0; k < 4; ++k) {
                int sx = std::min(2 * x + (k & 1), image.width - 1);
                int sy = std::min(2 * y + (k >> 1), image.height - 1);
                const uint8_t* p = &image.rgba[(size_t(sy) * size_t(image.width) + size_t(sx)) * 4];
                for (int c = 0; c < 3; ++c) sum[c] += p[c] * p[3] + kGrey * (255 - p[3]);
            }
            uint8_t* to = &half.rgba[(size_t(y) * size_t(half.width) + size_t(x)) * 4];
            for (int c = 0; c < 3; ++c) to[c] = uint8_t(sum[c] / (4 * 255));
            to[3] = 255;
        }
    frames_.push_back(std::move(half));
}

Image8 ContactSheet::picture() const {
    if (frames_.empty()) return {1, 1, {kGrey, kGrey, kGrey, 255}};
    int width = frames_[0].width + kGap, height = frames_[0].height + kGap;
    // As near to 16:9 as whole columns come.
    int columns = std::clamp(
        int(std::lround(std::sqrt(double(frames_.size()) * 16.0 / 9.0 * height / width))), 1,
        int(frames_.size()));
    int rows = (int(frames_.size()) + columns - 1) / columns;
    Image8 sheet{columns * width + kGap, rows * height + kGap, {}};
    for (size_t i = 0; i < size_t(sheet.width) * size_t(sheet.height); ++i)
        sheet.rgba.insert(sheet.rgba.end(), {kGrey, kGrey, kGrey, 255});
    for (size_t f = 0; f < frames_.size(); ++f) {
        const Image8& frame = frames_[f];
        int left = int(f) % columns * width + kGap, top = int(f) / columns * height + kGap;
        for (int y = 0; y < frame.height; ++y)
            std::copy_n(&frame.rgba[size_t(y) * size_t(frame.width) * 4], size_t(frame.width) * 4,
                        &sheet.rgba[(size_t(top + y) * size_t(sheet.width) + size_t(left)) * 4]);
    }
    return sheet;
}

}  // namespace kinora
