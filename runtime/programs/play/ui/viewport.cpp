// runtime/programs/play/ui/viewport.cpp: the picture, the mouse over it, and what is written on it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "runtime/player/display.h"
#include "runtime/player/scene_maker.h"
#include "runtime/programs/play/ui/panels.h"

namespace kinora::play {

namespace {

constexpr double kSizeDelay = 0.2;  // seconds that a size must last before pictures have it
constexpr float kDegreesPerPixel = 0.4f;
constexpr double kFlyPerSecond = 0.7;  // of the distance to what the camera looks at
constexpr double kLongestTurn = 0.1;   // seconds; a window at rest has longer ones
constexpr float kDollyPerPixel = 1.005f, kDollyPerNotch = 1.12f;

std::string number(double value) {
    return fmt::format("{:.6g}", value);
}

void shadowed_text(ImDrawList* list, ImVec2 at, ImU32 color, const std::string& text) {
    list->AddText({at.x + 1, at.y + 1}, IM_COL32(0, 0, 0, 160), text.c_str());
    list->AddText(at, color, text.c_str());
}

// "" where no other or finer scene is on its way.
std::string opening_text(const Player& player) {
    const Opening opening = player.opening();
    if (opening.step == Opening::Step::None)
        return player.load_state() == LoadState::Loading ? "Reading the scene" : "";
    if (opening.step == Opening::Step::Dices)
        return fmt::format("Splitting displaced surfaces finer, {:.0f} s", opening.seconds);
    const char* what =
        opening.step == Opening::Step::Reads ? "Reading the scene" : "Building the scene";
    return fmt::format("{}, {:.0f} s. Esc leaves it", what, opening.seconds);
}

}  // namespace

// As large as it fits, without distortion; where it fits exactly, pixel on pixel.
void Viewport::place(const Picture& picture, ImVec2 corner, ImVec2 size) {
    const auto width = static_cast<float>(picture.width),
               height = static_cast<float>(picture.height);
    float zoom = std::min(size.x / width, size.y / height);
    if (zoom > 1 && zoom < 1.02f) zoom = 1;
    const ImVec2 shown{std::round(width * zoom), std::round(height * zoom)};
    low_ = {corner.x + std::floor((size.x - shown.x) / 2),
            corner.y + std::floor((size.y - shown.y) / 2)};
    high_ = {low_.x + shown.x, low_.y + shown.y};
}

void Viewport::follow(Context& context, ImVec2 size) {
    next_turn_ = -1;
    if (!follow_size_ || !Context::has("size")) return;
    const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
    const ImVec2 wanted{std::floor(size.x * scale.x), std::floor(size.y * scale.y)};
    if (wanted.x < 16 || wanted.y < 16) return;
    const double now = ImGui::GetTime();
    if (wanted.x != wanted_.x || wanted.y != wanted_.y) {
        wanted_ = wanted;
        wanted_since_ = now;
    }
    const int width = static_cast<int>(wanted.x), height = static_cast<int>(wanted.y);
    if (width == width_ && height == height_) return;
    const double left = wanted_since_ + kSizeDelay - now;
    if (left > 0 && width_ > 0) {
        next_turn_ = left;
        return;
    }
    width_ = width;
    height_ = height;
    context.player.run("size", {fmt::format("{}", width), fmt::format("{}", height)});
}

void Viewport::take_wheel(Context& context) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.MouseWheel != 0 && Context::has("dolly"))
        context.run("dolly", {number(std::pow(kDollyPerNotch, io.MouseWheel))});
}

// Left: orbit; with Shift, or the middle button: pan; with Ctrl: look; right: dolly, or flight.
// Without a move: a click.
void Viewport::take_mouse(Context& context, bool hovered) {
    const ImGuiIO& io = ImGui::GetIO();
    if (hovered) take_wheel(context);
    if (take_wipe(context, hovered)) return;
    for (int button = 0; button < 3; ++button)
        if (button_ < 0 && hovered && ImGui::IsMouseClicked(button)) {
            button_ = button;
            moved_ = false;
        }
    if (button_ < 0) return;
    if (!ImGui::IsMouseDown(button_)) {
        const int button = std::exchange(button_, -1);
        if (moved_ || !picture_) return;
        const auto pixel = [](float p, float low, float high, int count) {
            return fmt::format("{}", std::clamp(static_cast<int>((p - low) / (high - low) *
                                                                 static_cast<float>(count)),
                                                0, count - 1));
        };
        const std::vector<std::string> at{pixel(io.MousePos.x, low_.x, high_.x, picture_->width),
                                          pixel(io.MousePos.y, low_.y, high_.y, picture_->height)};
        const bool inside = io.MousePos.x >= low_.x && io.MousePos.y >= low_.y &&
                            io.MousePos.x < high_.x && io.MousePos.y < high_.y;
        if (inside && button == 0 && Context::has("click")) context.run("click", at);
        if (inside && button == 2 && Context::has("pivot")) context.run("pivot", at);
        return;
    }
    if (take_flight(context)) return;
    if (!moved_ && !ImGui::IsMouseDragging(button_, 3)) return;
    ImVec2 moved = io.MouseDelta;
    if (!moved_) moved = ImGui::GetMouseDragDelta(button_, 0);
    moved_ = true;
    if (moved.x == 0 && moved.y == 0) return;
    const float height = std::max(1.0f, high_.y - low_.y);
    if (button_ == 2 || (button_ == 0 && io.KeyShift))
        context.run("pan", {number(-moved.x / height), number(moved.y / height)});
    else if (button_ == 0)
        turn(io.KeyCtrl ? "look" : "orbit", context, moved);
    else
        context.run("dolly", {number(std::pow(kDollyPerPixel, moved.y))});
}

void Viewport::show_under_pointer(const Context& context) {
    under_pointer_.clear();
    const ImVec2 p = ImGui::GetIO().MousePos;
    if (!picture_ || p.x < low_.x || p.y < low_.y || p.x >= high_.x || p.y >= high_.y) return;
    const raytrace::Film& film = picture_->film;
    if (film.width <= 0 || film.height <= 0) return;
    const float x = (p.x - low_.x) / (high_.x - low_.x), y = (p.y - low_.y) / (high_.y - low_.y);
    const auto at = [](float share, int count) {
        return std::min(static_cast<int>(share * static_cast<float>(count)), count - 1);
    };
    const vec4& c = film.at(at(x, film.width), at(y, film.height));
    under_pointer_ =
        fmt::format("{:4d} {:4d}   {:8.4f} {:8.4f} {:8.4f}   {:.3f}", at(x, picture_->width),
                    at(y, picture_->height), c.x, c.y, c.z, c.w);
    const std::string& aov = context.state().picture.aov;
    if (aov.empty()) return;
    under_pointer_ += "   " + aov;
    for (float value :
         shown_numbers(*picture_, aov, static_cast<double>(x), static_cast<double>(y)))
        under_pointer_ += fmt::format(" {:.5g}", value);
}

// What the colors stand for, in the picture's lower right corner.
void Viewport::draw_scale(const Theme& theme, const NumberScale& scale) const {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float width = theme.px(180), height = theme.px(10), line = ImGui::GetTextLineHeight();
    const ImVec2 corner{high_.x - width - theme.px(16), high_.y - height - line - theme.px(18)};
    if (corner.x < low_.x || corner.y < low_.y) return;
    list->AddRectFilled({corner.x - theme.px(6), corner.y - theme.px(6)},
                        {corner.x + width + theme.px(6), corner.y + height + line + theme.px(8)},
                        IM_COL32(0, 0, 0, 150), theme.px(4));
    constexpr int kSteps = 60;
    for (int k = 0; k < kSteps; ++k) {
        const float share = (static_cast<float>(k) + 0.5f) / kSteps;
        const vec3 c = scale.in_color ? false_color(share) : vec3(share);
        const auto shown = [](float v) { return std::pow(v, 1 / 2.2f); };
        const float x = corner.x + width * static_cast<float>(k) / kSteps;
        list->AddRectFilled(
            {x, corner.y}, {x + width / kSteps + 0.5f, corner.y + height},
            ImGui::ColorConvertFloat4ToU32({shown(c.x), shown(c.y), shown(c.z), 1}));
    }
    const std::string high = fmt::format("{:.4g}", scale.high);
    const float y = corner.y + height + theme.px(2);
    list->AddText({corner.x, y}, theme.text, fmt::format("{:.4g}", scale.low).c_str());
    list->AddText({corner.x + width - ImGui::CalcTextSize(high.c_str()).x, y}, theme.text,
                  high.c_str());
}

// The line between the kept picture and the new one.
float Viewport::wipe_x(const PictureState& state) const {
    return std::round(low_.x + (high_.x - low_.x) * static_cast<float>(state.wipe_at));
}

void Viewport::draw_wipe(const Context& context) const {
    const PictureState& state = context.state().picture;
    const Theme& theme = context.theme;
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float x = wipe_x(state), middle = (low_.y + high_.y) / 2, r = theme.px(5);
    list->AddRectFilled({x, low_.y}, {x + 1, high_.y}, IM_COL32(255, 255, 255, 200));
    list->AddTriangleFilled({x - r * 2, middle}, {x - r * 0.7f, middle - r},
                            {x - r * 0.7f, middle + r}, IM_COL32(255, 255, 255, 220));
    list->AddTriangleFilled({x + r * 2 + 1, middle}, {x + r * 0.7f + 1, middle - r},
                            {x + r * 0.7f + 1, middle + r}, IM_COL32(255, 255, 255, 220));
    const std::string left = "kept: " + state.wipe;
    const float y = high_.y - ImGui::GetTextLineHeight() - theme.px(8);
    list->PushClipRect(low_, {x, high_.y}, true);
    shadowed_text(list, {x - ImGui::CalcTextSize(left.c_str()).x - theme.px(8), y}, theme.text,
                  left);
    list->PopClipRect();
    list->PushClipRect({x, low_.y}, high_, true);
    shadowed_text(list, {x + theme.px(8), y}, theme.text, "now");
    list->PopClipRect();
}

// Whether the mouse has the line.
bool Viewport::take_wipe(Context& context, bool hovered) {
    const PictureState& state = context.state().picture;
    if (state.wipe.empty() || !picture_) return wiping_ = false;
    const ImGuiIO& io = ImGui::GetIO();
    const bool is_near =
        hovered && button_ < 0 && std::abs(io.MousePos.x - wipe_x(state)) <= context.theme.px(5);
    if (is_near && ImGui::IsMouseClicked(0)) wiping_ = true;
    if (is_near || wiping_) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (!wiping_) return false;
    if (!ImGui::IsMouseDown(0)) {
        wiping_ = false;
        return true;
    }
    const float share = std::clamp((io.MousePos.x - low_.x) / (high_.x - low_.x), 0.0f, 1.0f);
    if (std::abs(static_cast<double>(share) - state.wipe_at) > 1e-4)
        context.run("wipe", {number(static_cast<double>(share))});
    return true;
}

// With the right button held, W A S D Q E move the camera, and the mouse turns it.
bool Viewport::take_flight(Context& context) {
    if (button_ != 1 || steering_ == dvec3(0.0)) return false;
    const ImGuiIO& io = ImGui::GetIO();
    const double seconds = std::min(static_cast<double>(io.DeltaTime), kLongestTurn);
    const dvec3 step = steering_ * (io.KeyShift ? 4.0 : 1.0) * kFlyPerSecond * seconds;
    context.run("fly", {number(step.x), number(step.y), number(step.z)});
    const ImVec2 moved = moved_ ? io.MouseDelta : ImVec2{0, 0};
    moved_ = true;
    if (moved.x != 0 || moved.y != 0) turn("look", context, moved);
    next_turn_ = 1.0 / 60;
    return true;
}

void Viewport::turn(const char* word, Context& context, ImVec2 moved) {
    context.run(word, {number(-moved.x * kDegreesPerPixel), number(moved.y * kDegreesPerPixel)});
}

void Viewport::overlay(Context& context, ImVec2 corner, ImVec2 size) {
    const Theme& theme = context.theme;
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float margin = theme.px(12), line = ImGui::GetTextLineHeight() + theme.px(2);
    const LoadState load = context.player.load_state();
    if (!picture_ || load == LoadState::Failed) {
        std::string text = "Drop a scene here: .dae .zae .kmz .gltf .glb";
        if (load == LoadState::Nothing)
            text =
                "Welcome. Drop a scene here (.dae .zae .kmz .gltf .glb), "
                "or press Ctrl+O and type its name.";
        if (load == LoadState::Loading) text = opening_text(context.player);
        if (load == LoadState::Ready) text = "Making the first picture";
        if (load == LoadState::Failed)
            text = "The scene could not be opened. The findings say why.";
        const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
        const ImVec2 at{std::round(corner.x + (size.x - extent.x) / 2),
                        picture_ ? corner.y + margin : std::round(corner.y + size.y / 2)};
        list->AddRectFilled({at.x - margin, at.y - theme.px(7)},
                            {at.x + extent.x + margin, at.y + extent.y + theme.px(7)},
                            IM_COL32(0, 0, 0, 150), theme.px(5));
        list->AddText(at, load == LoadState::Failed ? theme.error : theme.text, text.c_str());
    } else if (const std::string text = opening_text(context.player); !text.empty()) {
        shadowed_text(list, {corner.x + margin, corner.y + size.y - line - margin}, theme.accent,
                      text);
    }
    if (!picture_ || !context.open("hud")) return;
    const auto times = context.player.stage_times();
    if (times.empty()) return;
    const StageTimes& last = times.back();
    const PictureState& state = context.state().picture;
    std::vector<std::pair<ImU32, std::string>> lines;
    lines.emplace_back(theme.text, fmt::format("{:.1f} ms   {}x{}   {} spp{}", last.total,
                                               picture_->width, picture_->height, picture_->samples,
                                               picture_->refined ? "   refined" : ""));
    if (picture_->scale < 1)
        lines.emplace_back(theme.accent,
                           fmt::format("{:.0f} % of the width, to hold {:.0f} pictures a second",
                                       100 * picture_->scale, state.hold_rate));
    if (!state.aov.empty())
        lines.emplace_back(theme.accent, state.aov + (state.false_color ? ", false color" : ""));
    if (!state.light.empty()) lines.emplace_back(theme.accent, "light " + state.light + " alone");
    if (state.exposure != 0)
        lines.emplace_back(theme.dim, fmt::format("{:+.2g} stops", state.exposure));
    ImVec2 at{corner.x + margin, corner.y + margin};
    float width = theme.px(240);
    for (const auto& [color, text] : lines)
        width = std::max(width, ImGui::CalcTextSize(text.c_str()).x);
    const float high = line * static_cast<float>(lines.size());
    list->AddRectFilled({at.x - theme.px(6), at.y - theme.px(4)},
                        {at.x + width + theme.px(6), at.y + high + theme.px(2)},
                        IM_COL32(0, 0, 0, 110), theme.px(4));
    for (const auto& [color, text] : lines) {
        list->AddText(at, color, text.c_str());
        at.y += line;
    }
    ImGui::SetCursorScreenPos({at.x, at.y + theme.px(4)});
    draw_stage_times(context, {theme.px(240), theme.px(52)});
}

void Viewport::draw(Context& context, ImVec2 corner, ImVec2 size) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, context.theme.stage);
    follow(context, size);
    picture_ = context.player.picture();
    ImGui::SetCursorScreenPos(corner);
    ImGui::InvisibleButton("viewport", {std::max(size.x, 1.0f), std::max(size.y, 1.0f)},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    const bool hovered = ImGui::IsItemHovered();
    if (picture_ && picture_->width > 0 && picture_->height > 0) {
        texture_ = {picture_->rgba.data(), picture_->width, picture_->height, TexelFormat::Rgba8};
        place(*picture_, corner, size);
        list->AddImage(texture_id(&texture_), low_, high_);
        if (!context.state().picture.wipe.empty()) draw_wipe(context);
        if (picture_->numbers) draw_scale(context.theme, *picture_->numbers);
    }
    take_mouse(context, hovered);
    under_pointer_.clear();
    if (hovered) show_under_pointer(context);
    list->PushClipRect(corner, {corner.x + size.x, corner.y + size.y}, true);
    overlay(context, corner, size);
    list->PopClipRect();
}

}  // namespace kinora::play
