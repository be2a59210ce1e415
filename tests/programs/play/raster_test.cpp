// tests/programs/play/raster_test.cpp: the rasteriser against one that tests every pixel of every
// triangle in double precision.
#include "runtime/programs/play/raster/raster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

namespace kinora::play {
namespace {

using Pixels = std::vector<uint32_t>;

struct Canvas {
    int width, height;
    Pixels pixels = Pixels(static_cast<size_t>(width * height), 0xff402010u);
    Target target() { return {pixels.data(), width, height, width}; }
};

struct Point {
    double x, y;
};

double snapped(float v) {
    return std::nearbyint(double{v} * 256) / 256;
}

// Twice the signed area of a, b, p: exact, since all are multiples of 1/512 below 2^20.
double side(Point a, Point b, Point p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

// With y down and corners clockwise: an edge that goes up is a left one; a flat one that goes right
// is a top one.
bool holds(Point a, Point b, Point p) {
    const double s = side(a, b, p);
    return s > 0 || (s == 0 && (b.y < a.y || (b.y == a.y && b.x > a.x)));
}

double texel(const Texture& t, int x, int y, int channel) {
    x = std::clamp(x, 0, t.width - 1);
    y = std::clamp(y, 0, t.height - 1);
    const auto index = static_cast<size_t>(y * t.width + x);
    if (t.format == TexelFormat::Alpha8) return channel == 3 ? t.texels[index] : 255.0;
    return t.texels[4 * index + static_cast<size_t>(channel)];
}

double filtered(const Texture& t, double u, double v, int channel) {
    const double x = u * t.width - 0.5, y = v * t.height - 0.5;
    const double fx = std::floor(x), fy = std::floor(y);
    const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
    const double wx = x - fx, wy = y - fy;
    const double top = texel(t, ix, iy, channel) * (1 - wx) + texel(t, ix + 1, iy, channel) * wx;
    const double low =
        texel(t, ix, iy + 1, channel) * (1 - wx) + texel(t, ix + 1, iy + 1, channel) * wx;
    return top * (1 - wy) + low * wy;
}

void blend_slowly(uint32_t& pixel, const double rgba[4]) {
    const double alpha = rgba[3] / 255;
    uint32_t out = 0;
    for (int i = 0; i < 4; ++i) {
        const double d = pixel >> (8 * i) & 255;
        const double value = i == 3 ? rgba[3] + d * (1 - alpha) : rgba[i] * alpha + d * (1 - alpha);
        out |= static_cast<uint32_t>(std::lrint(value)) << (8 * i);
    }
    pixel = out;
}

void triangle_slowly(Canvas& canvas, const ImVec4& clip, const Texture* texture, ImDrawVert a,
                     ImDrawVert b, ImDrawVert c) {
    const auto at = [](const ImDrawVert& v) { return Point{snapped(v.pos.x), snapped(v.pos.y)}; };
    if (side(at(a), at(b), at(c)) < 0) std::swap(b, c);
    const Point pa = at(a), pb = at(b), pc = at(c);
    const double area = side(pa, pb, pc);
    if (area == 0) return;
    for (int y = 0; y < canvas.height; ++y)
        for (int x = 0; x < canvas.width; ++x) {
            const Point p{x + 0.5, y + 0.5};
            if (p.x < snapped(clip.x) || p.y < snapped(clip.y) || p.x >= snapped(clip.z) ||
                p.y >= snapped(clip.w))
                continue;
            if (!holds(pa, pb, p) || !holds(pb, pc, p) || !holds(pc, pa, p)) continue;
            const double wa = side(pb, pc, p) / area, wb = side(pc, pa, p) / area;
            const double wc = 1 - wa - wb;
            double rgba[4];
            for (int i = 0; i < 4; ++i) {
                const auto channel = [i](ImU32 col) {
                    return static_cast<double>(col >> (8 * i) & 255);
                };
                rgba[i] = wa * channel(a.col) + wb * channel(b.col) + wc * channel(c.col);
                if (texture)
                    rgba[i] *= filtered(*texture, wa * a.uv.x + wb * b.uv.x + wc * c.uv.x,
                                        wa * a.uv.y + wb * b.uv.y + wc * c.uv.y, i) /
                               255;
            }
            blend_slowly(canvas.pixels[static_cast<size_t>(y * canvas.width + x)], rgba);
        }
}

void draw_slowly(const ImDrawData& data, Canvas& canvas) {
    for (int n = 0; n < data.CmdListsCount; ++n) {
        const ImDrawList& list = *data.CmdLists[n];
        for (const ImDrawCmd& command : list.CmdBuffer)
            for (unsigned i = 0; i < command.ElemCount; i += 3) {
                const auto vertex = [&](unsigned k) {
                    return list
                        .VtxBuffer[static_cast<int>(command.VtxOffset) +
                                   list.IdxBuffer[static_cast<int>(command.IdxOffset + i + k)]];
                };
                triangle_slowly(canvas, command.ClipRect,
                                static_cast<const Texture*>(command.GetTexID()), vertex(0),
                                vertex(1), vertex(2));
            }
    }
}

int worst_channel(const Pixels& a, const Pixels& b) {
    int worst = 0;
    for (size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < 32; c += 8)
            worst = std::max(worst, std::abs(static_cast<int>(a[i] >> c & 255) -
                                             static_cast<int>(b[i] >> c & 255)));
    return worst;
}

// A list filled by hand, without an ImGui context.
struct Drawing {
    explicit Drawing(int width, int height, const Texture* texture = nullptr) : list(nullptr) {
        ImDrawCmd command;
        command.ClipRect = {0, 0, static_cast<float>(width), static_cast<float>(height)};
        command.TextureId = texture_id(texture);
        list.CmdBuffer.push_back(command);
        data.Valid = true;
        data.CmdLists = &lists;
        data.CmdListsCount = 1;
        data.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
        data.FramebufferScale = {1, 1};
    }
    void corner(float x, float y, ImU32 color, float u = 0, float v = 0) {
        list.VtxBuffer.push_back({{x, y}, {u, v}, color});
    }
    void indices(std::initializer_list<int> some) {
        for (int i : some) {
            list.IdxBuffer.push_back(static_cast<ImDrawIdx>(i));
            ++list.CmdBuffer[0].ElemCount;
        }
    }
    void triangle() {
        const int n = list.VtxBuffer.Size;
        indices({n - 3, n - 2, n - 1});
    }
    ImDrawList list;
    ImDrawList* lists = &list;
    ImDrawData data;
};

class Kernel : public testing::TestWithParam<std::string> {
  protected:
    // The largest difference in a channel from the slow rasteriser.
    int difference(const ImDrawData& data, int width, int height) {
        Canvas fast{width, height}, slow{width, height};
        draw(data, fast.target(), GetParam().c_str());
        draw_slowly(data, slow);
        EXPECT_NE(slow.pixels, Canvas({width, height}).pixels) << "nothing was drawn";
        return worst_channel(fast.pixels, slow.pixels);
    }
};
INSTANTIATE_TEST_SUITE_P(All, Kernel, testing::ValuesIn(span_kernels()),
                         [](const auto& kernel) { return kernel.param; });

struct Random {
    std::mt19937 engine{7};
    float in(float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(engine);
    }
    ImU32 color() { return engine(); }
};

TEST_P(Kernel, ColouredTrianglesOfAnyShapeAgree) {
    Random random;
    for (int trial = 0; trial < 200; ++trial) {
        Drawing drawing(61, 47);
        // large, tiny, beyond the target on all sides
        const float size = std::pow(2.0f, random.in(-2, 8)), x = random.in(-20, 80),
                    y = random.in(-20, 60);
        for (int i = 0; i < 3; ++i)
            drawing.corner(x + random.in(-size, size), y + random.in(-size, size), random.color());
        drawing.triangle();
        Canvas fast{61, 47}, slow{61, 47};
        draw(drawing.data, fast.target(), GetParam().c_str());
        draw_slowly(drawing.data, slow);
        ASSERT_LE(worst_channel(fast.pixels, slow.pixels), 2) << "trial " << trial;
    }
}

TEST_P(Kernel, SliversHaveTheColoursOfTheirEnds) {
    Drawing drawing(300, 40);
    for (int i = 0; i < 12; ++i) {
        const float y = 2.5f + 3 * static_cast<float>(i);
        drawing.corner(1, y, IM_COL32(255, 0, 0, 255));
        drawing.corner(299, y + 0.004f * static_cast<float>(i), IM_COL32(0, 255, 0, 255));
        drawing.corner(299, y + 0.3f, IM_COL32(0, 0, 255, 0));
        drawing.triangle();
    }
    EXPECT_LE(difference(drawing.data, 300, 40), 2);
}

std::vector<uint8_t> random_texels(size_t count) {
    std::mt19937 engine(3);
    std::vector<uint8_t> out(count);
    for (uint8_t& byte : out) byte = static_cast<uint8_t>(engine());
    return out;
}

TEST_P(Kernel, TexturesAreFilteredAsDoublesWould) {
    const auto texels = random_texels(9 * 7 * 4);
    for (TexelFormat format : {TexelFormat::Rgba8, TexelFormat::Alpha8}) {
        const Texture texture{texels.data(), 9, 7, format};
        Random random;
        for (int trial = 0; trial < 50; ++trial) {
            Drawing drawing(64, 50, &texture);
            for (int i = 0; i < 3; ++i)
                drawing.corner(random.in(-5, 70), random.in(-5, 55), random.color(),
                               random.in(-0.2f, 1.2f), random.in(-0.2f, 1.2f));
            drawing.triangle();
            Canvas fast{64, 50}, slow{64, 50};
            draw(drawing.data, fast.target(), GetParam().c_str());
            draw_slowly(drawing.data, slow);
            ASSERT_LE(worst_channel(fast.pixels, slow.pixels), 4) << "trial " << trial;
        }
    }
}

TEST_P(Kernel, RectanglesOfTexelsOneToOneAreCopied) {
    auto texels = random_texels(16 * 16 * 4);
    for (size_t i = 3; i < texels.size(); i += 4) texels[i] = 255;
    for (TexelFormat format : {TexelFormat::Rgba8, TexelFormat::Alpha8}) {
        Texture texture{texels.data(), 16, 16, format};
        texture.opaque = true;
        Drawing drawing(40, 40, &texture);
        drawing.list.CmdBuffer[0].ClipRect = {3, 0, 40, 13};  // cuts on two sides
        const ImU32 color =
            format == TexelFormat::Alpha8 ? IM_COL32(200, 90, 10, 180) : IM_COL32_WHITE;
        drawing.corner(1, 2, color, 2.0f / 16, 1.0f / 16);
        drawing.corner(12, 2, color, 13.0f / 16, 1.0f / 16);
        drawing.corner(12, 15, color, 13.0f / 16, 14.0f / 16);
        drawing.corner(1, 15, color, 2.0f / 16, 14.0f / 16);
        drawing.indices({0, 1, 2, 0, 2, 3});
        EXPECT_LE(difference(drawing.data, 40, 40), 1);
    }
}

TEST_P(Kernel, TheNearestTexelIsUnfiltered) {
    const uint8_t texels[] = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 9, 9, 255};
    Texture texture{texels, 2, 2};
    texture.smooth = false;
    Drawing drawing(8, 8, &texture);
    drawing.corner(0, 0, IM_COL32_WHITE, 0, 0);
    drawing.corner(8, 0, IM_COL32_WHITE, 1, 0);
    drawing.corner(8, 8, IM_COL32_WHITE, 1, 1);
    drawing.corner(0, 8, IM_COL32_WHITE, 0, 1);
    drawing.indices({0, 1, 2, 0, 2, 3});
    Canvas canvas{8, 8};
    draw(drawing.data, canvas.target(), GetParam().c_str());
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            uint32_t expected;
            std::memcpy(&expected, texels + 4 * (x / 4 + 2 * (y / 4)), 4);
            ASSERT_EQ(canvas.pixels[static_cast<size_t>(8 * y + x)], expected) << x << " " << y;
        }
}

// A fan about a random point: every pixel of the square belongs to one triangle, so that a half
// transparent colour is blended once everywhere.
TEST_P(Kernel, TrianglesThatShareEdgesDrawEachPixelOnce) {
    Random random;
    for (int trial = 0; trial < 100; ++trial) {
        Drawing drawing(32, 32);
        const auto quarter = [&] {
            return std::round(random.in(0, 128)) / 4;
        };  // meets centres often
        drawing.corner(quarter(), quarter(), 0x80ffffff);
        const float border[][2] = {{0, 0},   {quarter(), 0},  {32, 0}, {32, quarter()},
                                   {32, 32}, {quarter(), 32}, {0, 32}, {0, quarter()}};
        for (const auto& p : border) drawing.corner(p[0], p[1], 0x80ffffff);
        for (int i = 0; i < 8; ++i) {
            if (i % 2)
                drawing.indices({0, 1 + i, 1 + (i + 1) % 8});
            else
                drawing.indices({1 + (i + 1) % 8, 0, 1 + i});
        }
        Canvas canvas{32, 32};
        draw(drawing.data, canvas.target(), GetParam().c_str());
        for (uint32_t pixel : canvas.pixels)
            ASSERT_EQ(pixel, canvas.pixels[0]) << "trial " << trial;
        ASSERT_NE(canvas.pixels[0], 0xff402010u);
    }
}

TEST_P(Kernel, CoordinatesBeyondAllBoundsAreClipped) {
    Drawing drawing(16, 16);
    drawing.corner(-1e30f, -1e30f, 0xff0000ff);
    drawing.corner(1e30f, -1e30f, 0xff0000ff);
    drawing.corner(8, INFINITY, 0xff0000ff);
    drawing.triangle();
    drawing.corner(NAN, NAN, 0xffffffff);
    drawing.corner(-1e30f, NAN, 0xffffffff);
    drawing.corner(-NAN, -INFINITY, 0xffffffff);
    drawing.triangle();
    Canvas canvas{16, 16};
    draw(drawing.data, canvas.target(), GetParam().c_str());
    for (uint32_t pixel : canvas.pixels) ASSERT_EQ(pixel, 0xff0000ffu);
}

// Real draw lists: every widget of ImGui's demonstration, with text, curves and faded edges.
class Demo {
  public:
    Demo(float width, float height) {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        unsigned char* texels;
        io.Fonts->GetTexDataAsAlpha8(&texels, &font_.width, &font_.height);
        font_.texels = texels;
        font_.format = TexelFormat::Alpha8;
        io.Fonts->SetTexID(texture_id(&font_));
        io.DisplaySize = {width, height};
        for (int frame = 0; frame < 3; ++frame) {
            io.DeltaTime = 1.0f / 60;
            ImGui::NewFrame();
            ImGui::SetNextWindowPos({7.3f, 5});
            ImGui::SetNextWindowSize({width - 20, height - 14});
            ImGui::ShowDemoWindow();
            ImDrawList* over = ImGui::GetForegroundDrawList();
            over->AddBezierCubic({10, 10}, {90.5f, 200}, {150, -20}, {width - 30, height - 30},
                                 0xc040ffff, 3.3f);
            over->AddCircleFilled({width / 2, height / 2}, 31.7f, 0x9000c0ff);
            over->AddRectFilledMultiColor({20, 40}, {120, 90}, 0xff0000ff, 0xff00ff00, 0x40ff0000,
                                          0x80ffffff);
            ImGui::Render();
        }
    }
    ~Demo() { ImGui::DestroyContext(); }
    const ImDrawData& data() const { return *ImGui::GetDrawData(); }

  private:
    Texture font_;
};

TEST_P(Kernel, AWholeInterfaceAgrees) {
    const Demo demo(330, 240);
    EXPECT_LE(difference(demo.data(), 330, 240), 4);
}

TEST(Kernels, GiveTheSameBits) {
    const Demo demo(640, 400);
    Canvas first{640, 400};
    draw(demo.data(), first.target(), span_kernels()[0].c_str());
    for (const std::string& name : span_kernels()) {
        Canvas other{640, 400};
        draw(demo.data(), other.target(), name.c_str());
        EXPECT_EQ(other.pixels, first.pixels) << name;
    }
}

TEST(Draw, ScalesAsTheDisplayDoes) {
    Drawing drawing(20, 20);
    for (auto [x, y] : {std::pair{12.0f, 13.0f}, {17.0f, 13.0f}, {17.0f, 16.0f}, {12.0f, 16.0f}})
        drawing.corner(x, y, 0xff00ff00);
    drawing.indices({0, 1, 2, 0, 2, 3});
    drawing.list.CmdBuffer[0].ClipRect = {10, 10, 16, 30};
    drawing.data.DisplayPos = {10, 10};
    drawing.data.FramebufferScale = {2, 2};
    Canvas canvas{20, 20};
    draw(drawing.data, canvas.target());
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x) {
            const bool inside = x >= 4 && x < 12 && y >= 6 && y < 12;
            ASSERT_EQ(canvas.pixels[static_cast<size_t>(20 * y + x)],
                      inside ? 0xff00ff00u : 0xff402010u);
        }
}

}  // namespace
}  // namespace kinora::play
