// runtime/programs/play/raster/raster.cpp: the commands of the draw lists; rectangles and
// triangles.
#include "runtime/programs/play/raster/raster.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "runtime/programs/play/raster/triangle_p.h"

namespace kinora::play {

namespace {

constexpr float kFarthest = 1 << 21;  // pixels; see Edge

int32_t to_subpixels(float pixels) {
    if (!(pixels > -kFarthest)) pixels = -kFarthest;  // NaN too
    return static_cast<int32_t>(std::lrint(std::min(pixels, kFarthest) * kSubpixels));
}

SpanTexels texels_of(ImTextureID id) {
    const auto* texture = static_cast<const Texture*>(id);
    if (!texture || !texture->texels) return {nullptr, 0, 0, 0, 0};
    return {texture->texels, texture->width, texture->height,
            texture->format == TexelFormat::Alpha8, texture->smooth};
}

// One draw command: its vertices as corners, its indices as rectangles and triangles.
class CommandPainter {
  public:
    CommandPainter(const ImDrawData& data, const ImDrawList& list, const ImDrawCmd& command,
                   const Target& target, const SpanKernel& kernel)
        : data_(data),
          vertices_(list.VtxBuffer.Data + command.VtxOffset),
          texture_(static_cast<const Texture*>(command.GetTexID())),
          state_{target, kernel, clip_of(command, target), texels_of(command.GetTexID())} {}

    bool hidden() const { return state_.clip.empty(); }

    void draw(std::span<const ImDrawIdx> indices) const {
        size_t i = 0;
        while (i + 2 < indices.size()) {
            if (i + 5 < indices.size() && rectangle(&indices[i])) {
                i += 6;
                continue;
            }
            triangle(corner(indices[i]), corner(indices[i + 1]), corner(indices[i + 2]));
            i += 3;
        }
    }

  private:
    float scaled(float position, float origin, float scale) const {
        return (position - origin) * scale;
    }

    PixelBox clip_of(const ImDrawCmd& command, const Target& target) const {
        const auto pixel = [](float p, int most) {
            return std::clamp(first_pixel(to_subpixels(p)), 0, most);
        };
        const ImVec2 o = data_.DisplayPos, s = data_.FramebufferScale;
        const ImVec4& c = command.ClipRect;
        return {pixel(scaled(c.x, o.x, s.x), target.width),
                pixel(scaled(c.y, o.y, s.y), target.height),
                pixel(scaled(c.z, o.x, s.x), target.width),
                pixel(scaled(c.w, o.y, s.y), target.height)};
    }

    Corner corner(ImDrawIdx index) const {
        const ImDrawVert& v = vertices_[index];
        const ImVec2 o = data_.DisplayPos, s = data_.FramebufferScale;
        const auto texel = [](float t, int size) {
            return (t * static_cast<float>(size) - 0.5f) * 256.0f;
        };
        return {to_subpixels(scaled(v.pos.x, o.x, s.x)), to_subpixels(scaled(v.pos.y, o.y, s.y)),
                texel(v.uv.x, state_.texture.width), texel(v.uv.y, state_.texture.height), v.col};
    }

    // Without a texture the vertex colours remain: a texel that is the same everywhere joins them.
    void triangle(Corner a, Corner b, Corner c) const {
        if (!state_.texture.texels || !same_texel(a, b) || !same_texel(a, c)) {
            draw_triangle(state_, a, b, c);
            return;
        }
        DrawState plain = state_;
        plain.texture = {nullptr, 0, 0, 0, 0};
        if (!white_at(a)) {
            draw_triangle(state_, a, b, c);
            return;
        }
        draw_triangle(plain, a, b, c);
    }

    static bool same_texel(const Corner& a, const Corner& b) { return a.u == b.u && a.v == b.v; }

    // All texels that a look-up here could mix are opaque white, as at ImGui's white pixel.
    bool white_at(const Corner& at) const {
        const SpanTexels& t = state_.texture;
        const auto x = static_cast<int>(std::floor(at.u / 256)),
                   y = static_cast<int>(std::floor(at.v / 256));
        for (int dy = 0; dy < 2; ++dy)
            for (int dx = 0; dx < 2; ++dx) {
                const auto tx = static_cast<size_t>(std::clamp(x + dx, 0, t.width - 1));
                const auto ty = static_cast<size_t>(std::clamp(y + dy, 0, t.height - 1));
                const size_t index = ty * static_cast<size_t>(t.width) + tx;
                if (t.alpha_only ? t.texels[index] != 255
                                 : std::any_of(t.texels + 4 * index, t.texels + 4 * index + 4,
                                               [](uint8_t c) { return c != 255; }))
                    return false;
            }
        return true;
    }

    // ImGui writes a rectangle as a b c, a c d from its upper left corner on.
    bool rectangle(const ImDrawIdx* i) const {
        if (i[3] != i[0] || i[4] != i[2]) return false;
        const Corner a = corner(i[0]), b = corner(i[1]), c = corner(i[2]), d = corner(i[5]);
        if (a.y != b.y || c.y != d.y || a.x != d.x || b.x != c.x) return false;
        if (a.x > b.x || a.y > d.y) return false;
        if (a.rgba != b.rgba || a.rgba != c.rgba || a.rgba != d.rgba) return false;
        const PixelBox box{
            std::max(first_pixel(a.x), state_.clip.x0), std::max(first_pixel(a.y), state_.clip.y0),
            std::min(first_pixel(c.x), state_.clip.x1), std::min(first_pixel(c.y), state_.clip.y1)};
        if (box.empty()) return true;
        if (!state_.texture.texels || (same_texel(a, c) && white_at(a))) {
            for (int y = box.y0; y < box.y1; ++y)
                state_.kernel.solid(row(box.x0, y), box.x1 - box.x0, a.rgba);
            return true;
        }
        if (a.v != b.v || c.v != d.v || a.u != d.u || b.u != c.u) return false;
        return texels_as_they_are(a, c, box);
    }

    // Texels that fall on pixel centres one to one: glyphs, and pictures without scale.
    bool texels_as_they_are(const Corner& a, const Corner& c, const PixelBox& box) const {
        const SpanTexels& t = state_.texture;
        if (std::lrint(c.u - a.u) != c.x - a.x || std::lrint(c.v - a.v) != c.y - a.y) return false;
        const long left = texel_at(box.x0, a.x, a.u), top = texel_at(box.y0, a.y, a.v);
        if (left < 0 || top < 0) return false;
        if (left + box.x1 - box.x0 > t.width || top + box.y1 - box.y0 > t.height) return false;
        const bool copy = !t.alpha_only && texture_->opaque && a.rgba == IM_COL32_WHITE;
        if (!t.alpha_only && !copy) return false;
        const auto count = box.x1 - box.x0;
        for (int y = box.y0; y < box.y1; ++y) {
            const size_t at = static_cast<size_t>(top + y - box.y0) * static_cast<size_t>(t.width) +
                              static_cast<size_t>(left);
            if (copy)
                std::memcpy(row(box.x0, y), t.texels + 4 * at, static_cast<size_t>(count) * 4);
            else
                state_.kernel.masked(row(box.x0, y), count, t.texels + at, a.rgba);
        }
        return true;
    }

    // The texel at a pixel's centre, or -1 if it lies between two.
    static long texel_at(int pixel, int32_t corner, float texel) {
        const long distance = long{pixel} * kSubpixels + kSubpixels / 2 - corner;
        const long at = distance + std::lrint(texel);
        const long nearest = (at + 128) >> 8;
        return std::abs(at - nearest * 256) > 1 ? -1 : nearest;
    }

    uint32_t* row(int x, int y) const {
        const Target& t = state_.target;
        return t.pixels + static_cast<size_t>(y) * static_cast<size_t>(t.stride) + x;
    }

    const ImDrawData& data_;
    const ImDrawVert* vertices_;
    const Texture* texture_;
    DrawState state_;
};

}  // namespace

void draw(const ImDrawData& data, const Target& target, const char* kernel) {
    const SpanKernel& spans = span_kernel(kernel);
    for (int n = 0; n < data.CmdListsCount; ++n) {
        const ImDrawList& list = *data.CmdLists[n];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            if (command.UserCallback) {
                if (command.UserCallback != ImDrawCallback_ResetRenderState)
                    command.UserCallback(&list, &command);
                continue;
            }
            const CommandPainter painter(data, list, command, target, spans);
            if (!painter.hidden())
                painter.draw({list.IdxBuffer.Data + command.IdxOffset, command.ElemCount});
        }
    }
}

}  // namespace kinora::play
